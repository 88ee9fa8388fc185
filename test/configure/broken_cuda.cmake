# Configures the core where nvcc doesn't work: PCL_FLASHREG_WITH_CUDA=AUTO leaves the CUDA
# backend out, ON fails, and both say what nvcc said.
#   CASE  what is wrong
include(${CMAKE_CURRENT_LIST_DIR}/../package/run.cmake)

# Writes an nvcc that says that it is of a version, and does something when it is to compile.
set(nvcc ${WORK_DIR}/bin/nvcc)
function(write_nvcc version when_compiling)
  file(WRITE ${nvcc} "#!/bin/sh
case \"$*\" in *--version*)
  echo 'nvcc: NVIDIA (R) Cuda compiler driver'
  echo 'Cuda compilation tools, release ${version}, V${version}.99'
  exit 0
esac
${when_compiling}
")
  file(CHMOD ${nvcc} PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
endfunction()

function(configure result_variable output_variable)
  execute_process(
    COMMAND ${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${WORK_DIR}/build -G ${GENERATOR}
      -D CMAKE_CXX_COMPILER=${CXX} -D Eigen3_DIR=${EIGEN}
      -D PCL_FLASHREG_WITH_PCL=OFF ${ARGN}
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  string(REGEX REPLACE "[ \n]+" " " output "${output}") # CMake breaks lines
  set(${result_variable} ${result} PARENT_SCOPE)
  set(${output_variable} "${output}" PARENT_SCOPE)
endfunction()

function(expect_text text output)
  string(FIND "${output}" "${text}" position)
  if(position EQUAL -1)
    message(FATAL_ERROR "Nothing says '${text}':\n${output}")
  endif()
endfunction()

foreach(variable CUDACXX CUDAFLAGS CUDAHOSTCXX CUDA_PATH)
  unset(ENV{${variable}})
endforeach()
find_program(real_nvcc nvcc PATHS /usr/local/cuda/bin NO_CACHE)
set(path "$ENV{PATH}")
set(ENV{PATH} "${WORK_DIR}/bin:${path}")
set(options "")

if(CASE STREQUAL "fails" OR CASE STREQUAL "mended")
  write_nvcc(12.6 "echo 'crt/host_config.h:143:2: error: unsupported GNU version' >&2; exit 1")
  set(said "error: unsupported GNU version")
elseif(CASE STREQUAL "old")
  write_nvcc(11.5 "exit 0")
  set(said "is of CUDA 11.5.99")
elseif(CASE STREQUAL "unlinkable")
  write_nvcc(12.6 "echo 'ld: cannot find -lcudart_static'; exit 1")
  set(said "ld: cannot find -lcudart_static")
elseif(CASE STREQUAL "host_compiler")
  write_nvcc(12.6 "case \"$*\" in *-ccbin\\ /bin/false*) exit 7; esac; touch kernel")
  set(ENV{CUDAHOSTCXX} /bin/false)
  set(said "ends with \"7\" and says nothing")
elseif(CASE STREQUAL "missing")
  set(ENV{CUDACXX} ${WORK_DIR}/no/nvcc)
  set(said "${WORK_DIR}/no/nvcc --version is not answered as by nvcc: ends with \"No such file or directory\"")
elseif(CASE STREQUAL "preset")
  write_nvcc(12.6 "echo 'nvcc fatal : broken'; exit 1")
  set(options -D CMAKE_CUDA_COMPILER=${nvcc})
  set(ENV{PATH} "${path}")
  set(said "nvcc fatal : broken")
endif()

configure(result output ${options})
if(NOT result EQUAL 0)
  message(FATAL_ERROR "AUTO does not go on without CUDA:\n${output}")
endif()
expect_text("the CUDA backend is left out" "${output}")
expect_text("CUDA 12 or later" "${output}")
expect_text("${said}" "${output}")

configure(result output ${options} -D PCL_FLASHREG_WITH_CUDA=ON)
if(result EQUAL 0)
  message(FATAL_ERROR "ON goes on without CUDA:\n${output}")
endif()
expect_text("PCL_FLASHREG_WITH_CUDA is ON" "${output}")
expect_text("${said}" "${output}")

if(CASE STREQUAL "mended")
  if(NOT real_nvcc)
    message("SKIPPED: there is no nvcc that works")
    return()
  endif()
  set(ENV{PATH} "${path}")
  set(mend -D PCL_FLASHREG_WITH_CUDA=AUTO)
  configure(result output ${mend} -D PCL_FLASHREG_CUDA_ARCHITECTURES=90)
  if(NOT output MATCHES "CUDA backend for 90")
    set(mended "${output}")
    file(REMOVE_RECURSE ${WORK_DIR}/build)
    configure(result output ${mend} -D PCL_FLASHREG_CUDA_ARCHITECTURES=90)
    if(output MATCHES "CUDA backend for 90")
      message(FATAL_ERROR "A mended nvcc is of use in a fresh folder only:\n${mended}")
    endif()
    message("SKIPPED: this machine's nvcc does not work:\n${output}")
  endif()
endif()
