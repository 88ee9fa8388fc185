# cmake -DOBJECTS=... -DNM=... -DSOURCE_DIR=... -P hygiene.cmake
#
# Two rules that no compiler enforces: code compiled with instruction-set flags must not
# offer inline functions to the rest of the program (the linker keeps one copy, and an AVX
# copy crashes older processors); and the core and the Python module must not know PCL.

set(checked 0)
foreach(object IN LISTS OBJECTS)
  if(object MATCHES "simd/(avx2|avx512|neon)")
    execute_process(COMMAND ${NM} --defined-only ${object}
      OUTPUT_VARIABLE symbols RESULT_VARIABLE failed)
    if(failed)
      message(FATAL_ERROR "${NM} cannot read ${object}")
    endif()
    if(symbols MATCHES " [WVu] ")
      message(FATAL_ERROR "${object} offers inline functions to the program:\n${symbols}")
    endif()
    math(EXPR checked "${checked} + 1")
  endif()
endforeach()
if(checked EQUAL 0)
  message(FATAL_ERROR "no object with instruction-set flags among: ${OBJECTS}")
endif()

file(GLOB_RECURSE sources
  ${SOURCE_DIR}/src/*.h ${SOURCE_DIR}/src/*.cpp ${SOURCE_DIR}/cuda/*
  ${SOURCE_DIR}/python/*.h ${SOURCE_DIR}/python/*.cpp)
foreach(source IN LISTS sources)
  file(STRINGS ${source} includes REGEX "#include <pcl/")
  if(includes)
    message(FATAL_ERROR "${source} includes PCL: ${includes}")
  endif()
endforeach()
list(LENGTH sources count)
message(STATUS "${checked} objects and ${count} sources are clean")
