# The CUDA backend: built where there is a compiler for it. PCL_FLASHREG_CUDA says whether.

set(PCL_FLASHREG_WITH_CUDA AUTO CACHE STRING
  "Build the CUDA backend: ON, OFF, or AUTO for where nvcc works")
set_property(CACHE PCL_FLASHREG_WITH_CUDA PROPERTY STRINGS AUTO ON OFF)
set(PCL_FLASHREG_CUDA_ARCHITECTURES "" CACHE STRING
  "Compute capabilities that kernels are compiled for, as in CMAKE_CUDA_ARCHITECTURES; empty for one of each generation since Turing")

set(PCL_FLASHREG_CUDA OFF)
if(PCL_FLASHREG_WITH_CUDA)
  include(PclFlashregNvcc)
  pcl_flashreg_find_nvcc(nvcc)
  pcl_flashreg_nvcc_version(version complaint ${nvcc})
  if(version AND version VERSION_LESS 12)
    set(complaint "${nvcc} is of CUDA ${version}")
  elseif(version)
    # The last entry's intermediate code is for whatever comes later.
    set(CMAKE_CUDA_ARCHITECTURES 75-real 80-real 90)
    if(version VERSION_GREATER_EQUAL 12.8)
      set(CMAKE_CUDA_ARCHITECTURES 75-real 80-real 90-real 100-real 120)
    endif()
    if(PCL_FLASHREG_CUDA_ARCHITECTURES)
      set(CMAKE_CUDA_ARCHITECTURES ${PCL_FLASHREG_CUDA_ARCHITECTURES})
    endif()
    pcl_flashreg_try_nvcc(complaint "${CMAKE_CUDA_ARCHITECTURES}" ${nvcc})
  endif()
  if(NOT complaint)
    set(CMAKE_CUDA_COMPILER ${nvcc})
    set(CMAKE_CUDA_RUNTIME_LIBRARY Static)
    enable_language(CUDA)
    find_package(CUDAToolkit)
    if(TARGET CUDA::cudart_static)
      set(PCL_FLASHREG_CUDA ON)
    else()
      set(complaint "${nvcc} has no toolkit with a static runtime")
    endif()
  endif()
  if(PCL_FLASHREG_CUDA)
    message(STATUS "pcl_flashreg: CUDA backend for ${CMAKE_CUDA_ARCHITECTURES}")
  elseif(PCL_FLASHREG_WITH_CUDA STREQUAL "AUTO")
    message(NOTICE "pcl_flashreg: the CUDA backend is left out for want of an nvcc of "
      "CUDA 12 or later that works: ${complaint}")
  else()
    message(FATAL_ERROR "PCL_FLASHREG_WITH_CUDA is ${PCL_FLASHREG_WITH_CUDA}: it takes an "
      "nvcc of CUDA 12 or later that works: ${complaint}")
  endif()
endif()

# Kernels, and the host's side of them.
set(PCL_FLASHREG_CUDA_KERNELS
  cuda/estimation/cliques.cu
  cuda/estimation/first_order_graph.cu
  cuda/estimation/hypotheses.cu
  cuda/estimation/pivots.cu
  cuda/estimation/refinement.cu
  cuda/estimation/second_order_graph.cu
  cuda/estimation/second_order_graph_bounded.cu
  cuda/estimation/verification.cu)
set(PCL_FLASHREG_CUDA_HOST
  cuda/estimation/caller_memory.cpp
  cuda/estimation/cuda_backend.cpp
  cuda/support/error.cpp
  cuda/estimation/stages.cpp
  cuda/estimation/trace.cpp)
list(TRANSFORM PCL_FLASHREG_CUDA_KERNELS PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
list(TRANSFORM PCL_FLASHREG_CUDA_HOST PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)

# A library of kernels. A target of its own: nvcc knows none of the host compiler's options.
function(pcl_flashreg_add_kernels target)
  add_library(${target} OBJECT ${ARGN})
  target_include_directories(${target} PRIVATE
    ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/include)
  # As on the host: no contraction but where the source says so; division and roots are
  # rounded correctly, as is nvcc's default.
  target_compile_options(${target} PRIVATE --fmad=false)
  if(PCL_FLASHREG_WERROR)
    target_compile_options(${target} PRIVATE
      --Werror=all-warnings -Xcompiler=-Wall,-Wextra)
  endif()
  set_target_properties(${target} PROPERTIES
    CUDA_STANDARD 17
    CUDA_STANDARD_REQUIRED ON
    POSITION_INDEPENDENT_CODE ON
    CUDA_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON)
endfunction()

# Adds the CUDA backend to the core.
function(pcl_flashreg_add_cuda core)
  pcl_flashreg_add_kernels(pcl_flashreg_kernels ${PCL_FLASHREG_CUDA_KERNELS})

  target_sources(${core} PRIVATE
    ${PCL_FLASHREG_CUDA_HOST} $<TARGET_OBJECTS:pcl_flashreg_kernels>)
  target_include_directories(${core} PRIVATE ${PROJECT_SOURCE_DIR})
  target_include_directories(${core} SYSTEM PRIVATE ${CUDAToolkit_INCLUDE_DIRS})
  target_link_libraries(${core} PRIVATE ${CMAKE_DL_LIBS} rt)
  get_target_property(type ${core} TYPE)
  if(type STREQUAL "STATIC_LIBRARY")
    # CUDA's runtime goes into the archive, so that who links it needs no CUDA.
    set(script ${CMAKE_CURRENT_BINARY_DIR}/${core}_with_runtime.mri)
    file(GENERATE OUTPUT ${script} CONTENT "open $<TARGET_FILE:${core}>
addlib $<TARGET_FILE:CUDA::cudart_static>
save
end
")
    add_custom_command(TARGET ${core} POST_BUILD
      COMMAND ${CMAKE_AR} -M < ${script} VERBATIM
      COMMENT "Adding CUDA's runtime to the library")
  else()
    target_link_libraries(${core} PRIVATE CUDA::cudart_static)
    target_link_options(${core} PRIVATE -Wl,--exclude-libs,ALL)
  endif()
endfunction()
