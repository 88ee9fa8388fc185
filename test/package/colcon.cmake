# `colcon build` builds and installs the project as a package of a workspace.
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
find_program(COLCON colcon)
if(NOT COLCON)
  message("SKIPPED: no colcon")
  return()
endif()
set(ENV{COLCON_HOME} ${WORK_DIR}/home)
run(${COLCON} --log-base log list --base-paths ${SOURCE_DIR})
if(NOT run_output MATCHES "pcl_flashreg[^\n]*\\(([a-z.]*cmake)\\)")
  message(FATAL_ERROR "colcon does not see the package:\n${run_output}")
endif()
# The programs and the kernels take minutes and have tests of their own.
run(${COLCON} --log-base log build --base-paths ${SOURCE_DIR}
  --build-base build --install-base install --event-handlers console_direct+
  --cmake-args -DPCL_FLASHREG_BUILD_APPS=OFF -DPCL_FLASHREG_WITH_PCL=${WITH_PCL}
    -DPCL_FLASHREG_WITH_CUDA=OFF -DPCL_FLASHREG_WITH_PYTHON=OFF
    -DCMAKE_CXX_COMPILER=${CXX})
set(installed ${WORK_DIR}/install/pcl_flashreg)
expect_file(${installed}/share/pcl_flashreg/package.xml)
file(GLOB config ${installed}/lib*/cmake/pcl_flashreg/pcl_flashregConfig.cmake)
expect_file("${config}")
