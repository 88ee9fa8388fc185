# Builds the program that README.md shows, with the CMake file that it shows, and runs it on
# the bundled indoor pair.
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
file(READ ${SOURCE_DIR}/README.md readme)
foreach(language cpp cmake)
  string(REGEX MATCH "```${language}\n([^`]*)```" block "${readme}")
  if(NOT block)
    message(FATAL_ERROR "README.md shows no ${language}")
  endif()
  set(${language} "${CMAKE_MATCH_1}")
endforeach()
file(WRITE ${WORK_DIR}/main.cpp "${cpp}")
file(WRITE ${WORK_DIR}/CMakeLists.txt "${cmake}")
file(COPY ${SOURCE_DIR}/data/indoor/source.pcd ${SOURCE_DIR}/data/indoor/target.pcd
  DESTINATION ${WORK_DIR})
run(${CMAKE_COMMAND} -S . -B build
  -D CMAKE_BUILD_TYPE=Release
  -D CMAKE_CXX_COMPILER=${CXX}
  -D CMAKE_PREFIX_PATH=${PREFIX})
run(${CMAKE_COMMAND} --build build)
run(build/app)
