# Finds nvcc and tries it, before CMake is told of it: enable_language(CUDA) ends the
# configuration where a compiler doesn't work.

# pcl_flashreg_find_nvcc(<command>): the compiler that CMake would take, with its arguments,
# or the one that was found and tried before, or else where NVIDIA's packages put it, though
# that is not on everybody's PATH. Empty if there is none.
function(pcl_flashreg_find_nvcc command)
  if(CMAKE_CUDA_COMPILER)
    set(nvcc ${CMAKE_CUDA_COMPILER})
  elseif(PCL_FLASHREG_WORKING_NVCC)
    set(nvcc ${PCL_FLASHREG_WORKING_NVCC})
  elseif(NOT "$ENV{CUDACXX}" STREQUAL "")
    separate_arguments(nvcc UNIX_COMMAND "$ENV{CUDACXX}")
  else()
    find_program(nvcc nvcc
      HINTS ENV CUDA_PATH PATHS /usr/local/cuda PATH_SUFFIXES bin NO_CACHE)
  endif()
  if(NOT nvcc)
    set(nvcc "")
  endif()
  set(${command} ${nvcc} PARENT_SCOPE)
endfunction()

# pcl_flashreg_first_errors(<text> <output> <result>): the first two lines of what a compiler
# said that tell of an error.
function(pcl_flashreg_first_errors text output result)
  # What CMake's lists are made of is none of ours.
  string(REPLACE ";" "," output "${output}")
  string(REPLACE "[" "(" output "${output}")
  string(REPLACE "]" ")" output "${output}")
  string(REGEX MATCHALL "[^\r\n]*([Ee]rror|fatal|cannot)[^\r\n]*" lines "${output}")
  if(NOT lines)
    string(REGEX MATCHALL "[^\r\n]+" lines "${output}")
  endif()
  if(NOT lines)
    set(lines "ends with \"${result}\" and says nothing")
  endif()
  list(SUBLIST lines 0 2 lines)
  list(JOIN lines "\n  " lines)
  set(${text} "\n  ${lines}" PARENT_SCOPE)
endfunction()

# pcl_flashreg_nvcc_version(<version> <complaint> <command>): of CUDA.
function(pcl_flashreg_nvcc_version version complaint)
  set(${version} "" PARENT_SCOPE)
  if(NOT ARGN)
    set(${complaint} "there is none" PARENT_SCOPE)
    return()
  endif()
  execute_process(COMMAND ${ARGN} --version TIMEOUT 60
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(result EQUAL 0 AND output MATCHES "release [0-9.]+, V([0-9.]+)")
    set(${version} ${CMAKE_MATCH_1} PARENT_SCOPE)
    set(${complaint} "" PARENT_SCOPE)
    return()
  endif()
  pcl_flashreg_first_errors(errors "${output}" "${result}")
  list(JOIN ARGN " " name)
  set(${complaint} "${name} --version is not answered as by nvcc:${errors}" PARENT_SCOPE)
endfunction()

# pcl_flashreg_nvcc_architectures(<flags> <architectures>): as CMake makes flags of them.
function(pcl_flashreg_nvcc_architectures flags architectures)
  set(all "")
  foreach(architecture IN LISTS architectures)
    if(NOT architecture MATCHES "^([0-9]+[a-z]?)(-real|-virtual)?$")
      list(APPEND all -arch=${architecture})
      continue()
    endif()
    set(number ${CMAKE_MATCH_1})
    set(code sm_${number})
    if(CMAKE_MATCH_2 STREQUAL "-virtual")
      set(code compute_${number})
    endif()
    list(APPEND all -gencode=arch=compute_${number},code=${code})
  endforeach()
  set(${flags} ${all} PARENT_SCOPE)
endfunction()

# pcl_flashreg_try_nvcc(<complaint> <architectures> <command>): makes a small program, with the
# flags that CMake takes from its variables and the environment. Once for each nvcc that
# works: CMake keeps what it was called with then, and the environment may be another one.
function(pcl_flashreg_try_nvcc complaint architectures)
  set(${complaint} "" PARENT_SCOPE)
  if("${ARGN}" STREQUAL "${PCL_FLASHREG_WORKING_NVCC}")
    return()
  endif()
  set(flags "$ENV{CUDAFLAGS}")
  if(DEFINED CMAKE_CUDA_FLAGS)
    set(flags "${CMAKE_CUDA_FLAGS}")
  endif()
  separate_arguments(flags UNIX_COMMAND "${flags}")
  pcl_flashreg_nvcc_architectures(code "${architectures}")
  set(host ${CMAKE_CUDA_HOST_COMPILER})
  if(NOT "$ENV{CUDAHOSTCXX}" STREQUAL "")
    set(host $ENV{CUDAHOSTCXX})
  endif()
  if(host)
    list(PREPEND host -ccbin)
  endif()

  set(folder ${PROJECT_BINARY_DIR}/CMakeFiles/pcl_flashreg_nvcc)
  file(REMOVE_RECURSE ${folder})
  file(WRITE ${folder}/kernel.cu "#include <optional>
__global__ void increment(int* value) { ++*value; }
int main()
{
  int* value = nullptr;
  if (cudaMalloc(&value, sizeof(int)) != cudaSuccess)
    return 1;
  increment<<<1, 1>>>(value);
  return cudaFree(value) != cudaSuccess;
}
")
  execute_process(
    COMMAND ${ARGN} ${flags} ${host} ${code} -std=c++17 -cudart static
      kernel.cu -o kernel
    WORKING_DIRECTORY ${folder} TIMEOUT 300
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(result EQUAL 0 AND EXISTS ${folder}/kernel)
    set(PCL_FLASHREG_WORKING_NVCC "${ARGN}" CACHE INTERNAL "The nvcc that was tried")
    return()
  endif()
  pcl_flashreg_first_errors(errors "${output}" "${result}")
  list(JOIN ARGN " " name)
  set(${complaint} "${name} cannot compile and link a kernel:${errors}" PARENT_SCOPE)
endfunction()
