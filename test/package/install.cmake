# Installs into a fresh prefix.
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
file(REMOVE_RECURSE ${PREFIX})
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${PREFIX})
expect_file(${PREFIX}/include/pcl_flashreg/estimator.h)
expect_file(${PREFIX}/share/pcl_flashreg/package.xml)

# Nothing that is installed may name the folders it was made in.
file(GLOB_RECURSE texts ${PREFIX}/*.cmake ${PREFIX}/*.pc ${PREFIX}/*.h ${PREFIX}/*.hpp)
foreach(text IN LISTS texts)
  file(READ ${text} content)
  foreach(folder ${SOURCE_DIR} ${BUILD_DIR} ${PREFIX})
    string(FIND "${content}" "${folder}" position)
    if(NOT position EQUAL -1)
      message(FATAL_ERROR "${text} names ${folder}")
    endif()
  endforeach()
endforeach()
