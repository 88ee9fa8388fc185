# The Python module: built where there are a Python with its headers and pybind11.
# PCL_FLASHREG_PYTHON says whether.

set(python_default OFF)
if(PROJECT_IS_TOP_LEVEL)
  set(python_default AUTO)
endif()
set(PCL_FLASHREG_WITH_PYTHON ${python_default} CACHE STRING
  "Build the Python module: ON, OFF, or AUTO for where Python, NumPy and pybind11 are")
set_property(CACHE PCL_FLASHREG_WITH_PYTHON PROPERTY STRINGS AUTO ON OFF)

set(PCL_FLASHREG_PYTHON OFF)
if(NOT PCL_FLASHREG_WITH_PYTHON)
  return()
endif()

set(complaint "")
if(PCL_FLASHREG_SANITIZE)
  set(complaint "a Python that is built without the sanitizers can't load it")
endif()
if(NOT complaint)
  find_package(Python3 3.10 COMPONENTS Interpreter Development.Module)
  if(NOT Python3_FOUND)
    set(complaint "there is no Python 3.10 or later with its headers")
  endif()
endif()
if(NOT complaint)
  find_package(pybind11 2.9 CONFIG QUIET)
  if(NOT pybind11_FOUND)
    set(complaint "there is no pybind11 2.9 or later")
  endif()
endif()
# To be built it needs no NumPy, and whoever says ON may have it elsewhere.
if(NOT complaint AND PCL_FLASHREG_WITH_PYTHON STREQUAL "AUTO")
  execute_process(COMMAND ${Python3_EXECUTABLE} -c "import numpy"
    RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
  if(failed)
    set(complaint "${Python3_EXECUTABLE} has no NumPy")
  endif()
endif()

if(NOT complaint)
  set(PCL_FLASHREG_PYTHON ON)
  message(STATUS "pcl_flashreg: Python module for ${Python3_EXECUTABLE}")
elseif(PCL_FLASHREG_WITH_PYTHON STREQUAL "AUTO")
  message(NOTICE "pcl_flashreg: the Python module is left out: ${complaint}")
else()
  message(FATAL_ERROR
    "PCL_FLASHREG_WITH_PYTHON is ${PCL_FLASHREG_WITH_PYTHON}, but ${complaint}")
endif()
