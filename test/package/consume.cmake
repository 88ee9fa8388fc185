# Builds and runs consumer/ against the installed CMake package.
#   COMPONENT  core (with PCL hidden from it) or pcl
#   VERSION    what it asks for
#   FLAGS      compiler flags of the consumer
#   NEEDS      instruction sets that the flags take for granted
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
skip_unless_processor_has(${NEEDS})
if(skipped)
  return()
endif()

set(hide_pcl OFF)
if(COMPONENT STREQUAL "core")
  set(hide_pcl ON)
endif()
# The prefix is moved first: a package that works only where it was installed is broken.
file(COPY ${PREFIX}/ DESTINATION ${WORK_DIR}/moved)
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/consumer -B build
  -D CMAKE_BUILD_TYPE=Release
  -D CMAKE_CXX_COMPILER=${CXX}
  -D "CMAKE_CXX_FLAGS=${FLAGS}"
  -D CMAKE_PREFIX_PATH=${WORK_DIR}/moved
  -D CMAKE_DISABLE_FIND_PACKAGE_PCL=${hide_pcl}
  -D CONSUMED=${COMPONENT}
  -D WANTED=${VERSION})
if(NOT run_output MATCHES "Using .*${WORK_DIR}/moved/")
  message(FATAL_ERROR "another installation was found:\n${run_output}")
endif()
run(${CMAKE_COMMAND} --build build)
run(build/consumer)
