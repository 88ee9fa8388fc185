# The installed Python module, used from outside: the example, what README.md shows, and what
# pyproject.toml tells pip to build.
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
execute_process(COMMAND ${PYTHON} -c "import numpy" RESULT_VARIABLE failed
  OUTPUT_QUIET ERROR_QUIET)
if(failed)
  message("SKIPPED: ${PYTHON} has no NumPy")
  return()
endif()

# The prefix is moved first: a package that works only where it was installed is broken.
file(COPY ${PREFIX}/ DESTINATION ${WORK_DIR}/moved)
file(GLOB folder ${WORK_DIR}/moved/lib*/python3*/*-packages)
expect_file("${folder}")
set(ENV{PYTHONPATH} ${folder})
set(ENV{PYTHONDONTWRITEBYTECODE} 1)
set(pair ${SOURCE_DIR}/data/indoor/source.pcd ${SOURCE_DIR}/data/indoor/target.pcd)
run(${PYTHON} ${SOURCE_DIR}/examples/python_in_five_lines.py ${pair})
if(NOT run_output MATCHES "^Result\\(converged, confidence [01.]+")
  message(FATAL_ERROR "the example says:\n${run_output}")
endif()

file(READ ${SOURCE_DIR}/README.md readme)
string(REGEX MATCH "```python\n([^`]*)```" block "${readme}")
if(NOT block)
  message(FATAL_ERROR "README.md shows no Python")
endif()
file(WRITE ${WORK_DIR}/readme.py "${CMAKE_MATCH_1}")
file(COPY ${pair} DESTINATION ${WORK_DIR})
run(${PYTHON} readme.py)
if(NOT run_output MATCHES "Result\\(converged")
  message(FATAL_ERROR "what README.md shows says:\n${run_output}")
endif()

# The component that pip takes is all that is needed.
run(${PYTHON} -c "
try:
  import tomllib
except ImportError:
  raise SystemExit
settings = tomllib.load(open('${SOURCE_DIR}/pyproject.toml', 'rb'))['tool']['scikit-build']
assert settings['install']['components'] == ['python']
for name, value in settings['cmake']['define'].items():
  print('-D', f'{name}={value}', sep='')
")
string(REGEX MATCHALL "-D[^\n]+" definitions "${run_output}")
if(definitions)
  run(${CMAKE_COMMAND} -S ${SOURCE_DIR} -B pip -D CMAKE_CXX_COMPILER=${CXX}
    -D Python3_EXECUTABLE=${PYTHON} ${definitions})
  file(STRINGS ${WORK_DIR}/pip/CMakeCache.txt found REGEX "^PCL_DIR|^PCL_FLASHREG_PYTHON_DIR")
  if(NOT "${found}" STREQUAL "PCL_FLASHREG_PYTHON_DIR:STRING=.")
    message(FATAL_ERROR "pip would build with ${found}")
  endif()
endif()
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --component python --prefix ${WORK_DIR}/alone)
file(GLOB folder ${WORK_DIR}/alone/lib*/python3*/*-packages)
set(ENV{PYTHONPATH} ${folder})
run(${PYTHON} -c "import pcl_flashreg")
file(GLOB_RECURSE others ${WORK_DIR}/alone/*.h ${WORK_DIR}/alone/*.cmake)
if(others)
  message(FATAL_ERROR "more than the module: ${others}")
endif()
