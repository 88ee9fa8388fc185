# Configures the core with and without what the Python module takes: PCL_FLASHREG_WITH_PYTHON=AUTO
# leaves the module out where pybind11 is missing, and says so; ON fails.
#   CASE  with, without (pybind11), off
include(${CMAKE_CURRENT_LIST_DIR}/../package/run.cmake)

function(configure expected_result text)
  execute_process(
    COMMAND ${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${WORK_DIR}/build -G ${GENERATOR}
      -D CMAKE_CXX_COMPILER=${CXX} -D Eigen3_DIR=${EIGEN} -D Python3_EXECUTABLE=${PYTHON}
      -D PCL_FLASHREG_WITH_PCL=OFF -D PCL_FLASHREG_WITH_CUDA=OFF ${ARGN}
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  string(REGEX REPLACE "[ \n]+" " " output "${output}") # CMake breaks lines
  if(NOT result EQUAL expected_result)
    message(FATAL_ERROR "${ARGN} ended with ${result}:\n${output}")
  endif()
  if(NOT output MATCHES "${text}")
    message(FATAL_ERROR "Nothing says '${text}':\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

if(CASE STREQUAL "with")
  configure(0 "Python module for ${PYTHON}" -D PCL_FLASHREG_WITH_PYTHON=ON)
elseif(CASE STREQUAL "off")
  configure(0 "Generating done" -D PCL_FLASHREG_WITH_PYTHON=OFF)
  if(output MATCHES "pybind11|Python module")
    message(FATAL_ERROR "pybind11 was looked for:\n${output}")
  endif()
else()
  set(without -D CMAKE_DISABLE_FIND_PACKAGE_pybind11=ON)
  configure(0 "the Python module is left out: there is no pybind11" ${without}
    -D PCL_FLASHREG_WITH_PYTHON=AUTO)
  configure(1 "PCL_FLASHREG_WITH_PYTHON is ON, but there is no pybind11" ${without}
    -D PCL_FLASHREG_WITH_PYTHON=ON)
endif()
