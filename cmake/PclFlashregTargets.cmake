# What every target of this project has in common.

# PCL's own targets carry no include directories that a build tree needs beyond these;
# the plain names work for every PCL from 1.11 on.
set(PCL_FLASHREG_PCL_TARGETS
  pcl_common pcl_kdtree pcl_search pcl_features pcl_filters pcl_registration)

# Warnings, and the sanitizers where they are asked for: private to the target, so that no
# consumer inherits them.
function(pcl_flashreg_compile_options target)
  target_compile_features(${target} PRIVATE cxx_std_17)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wnon-virtual-dtor)
  if(PCL_FLASHREG_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(PCL_FLASHREG_SANITIZE OR CMAKE_BUILD_TYPE STREQUAL "Debug")
    # The standard library looks at its indices, too.
    target_compile_definitions(${target} PRIVATE
      $<$<COMPILE_LANGUAGE:CXX>:_GLIBCXX_ASSERTIONS>)
  endif()
  if(PCL_FLASHREG_SANITIZE)
    target_compile_options(${target} PRIVATE
      -fsanitize=${PCL_FLASHREG_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer -g)
    target_link_options(${target} PRIVATE -fsanitize=${PCL_FLASHREG_SANITIZE})
    # With the address sanitizer Eigen aligns memory in a way of its own, which the PCL
    # libraries, built without it, don't know: memory that one side takes and the other
    # gives back would be reported as an overflow.
    target_compile_definitions(${target} PRIVATE EIGEN_MALLOC_ALREADY_ALIGNED=1)
  endif()
endfunction()
