# Installation: targets, headers, CMake package, pkg-config files, Debian package.

option(PCL_FLASHREG_INSTALL "Install what is built" ${PROJECT_IS_TOP_LEVEL})
if(NOT PCL_FLASHREG_INSTALL)
  return()
endif()
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/pcl_flashreg)

# Core and PCL classes are exported apart: who asks for the core alone needs no PCL.
install(TARGETS pcl_flashreg_core EXPORT pcl_flashregCore)
install(EXPORT pcl_flashregCore NAMESPACE pcl_flashreg:: DESTINATION ${package_dir}
  FILE pcl_flashregCoreTargets.cmake)
if(PCL_FLASHREG_WITH_PCL)
  install(TARGETS pcl_flashreg EXPORT pcl_flashregPcl)
  install(EXPORT pcl_flashregPcl NAMESPACE pcl_flashreg:: DESTINATION ${package_dir}
    FILE pcl_flashregPclTargets.cmake)
endif()

# The programs find a shared core from wherever the prefix is.
file(RELATIVE_PATH libraries_from_programs
  /prefix/${CMAKE_INSTALL_BINDIR} /prefix/${CMAKE_INSTALL_LIBDIR})
foreach(program pcl_flashreg_align pcl_flashreg_evaluate pcl_flashreg_localize pcl_flashreg_map)
  if(TARGET ${program} AND BUILD_SHARED_LIBS)
    set_target_properties(${program} PROPERTIES
      INSTALL_RPATH "\$ORIGIN/${libraries_from_programs}")
  endif()
endforeach()

install(DIRECTORY include/pcl_flashreg TYPE INCLUDE
  FILES_MATCHING PATTERN "*.h" PATTERN "*.hpp")
install(FILES package.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/pcl_flashreg)
install(FILES LICENSE TYPE DOC)

# CMake package.
get_target_property(core_type pcl_flashreg_core TYPE)
set(core_is_static OFF)
if(core_type STREQUAL "STATIC_LIBRARY")
  set(core_is_static ON)
endif()
configure_package_config_file(cmake/pcl_flashregConfig.cmake.in
  ${PROJECT_BINARY_DIR}/pcl_flashregConfig.cmake
  INSTALL_DESTINATION ${package_dir}
  NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/pcl_flashregConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/pcl_flashregConfig.cmake
  ${PROJECT_BINARY_DIR}/pcl_flashregConfigVersion.cmake
  DESTINATION ${package_dir})

# pkg-config. Paths are relative to the file, so that the prefix may move.
file(RELATIVE_PATH prefix_from_pc /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
set(thread_libraries "")
if(core_is_static)
  set(thread_libraries -pthread)
endif()
set(pkg_config_files pcl_flashreg_core.pc)
if(PCL_FLASHREG_WITH_PCL)
  # Older distributions put PCL's version into the names of its files.
  find_file(PCL_FLASHREG_PCL_REGISTRATION_PC pcl_registration.pc
    PATHS ${PCL_LIBRARY_DIRS} PATH_SUFFIXES pkgconfig NO_DEFAULT_PATH)
  mark_as_advanced(PCL_FLASHREG_PCL_REGISTRATION_PC)
  set(pcl_requires ${PCL_FLASHREG_PCL_TARGETS})
  if(NOT PCL_FLASHREG_PCL_REGISTRATION_PC)
    list(TRANSFORM pcl_requires APPEND -${PCL_VERSION_MAJOR}.${PCL_VERSION_MINOR})
  endif()
  list(JOIN pcl_requires ", " pcl_requires)
  list(APPEND pkg_config_files pcl_flashreg.pc)
endif()
foreach(file ${pkg_config_files})
  configure_file(cmake/${file}.in ${file} @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${file}
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endforeach()

if(PROJECT_IS_TOP_LEVEL)
  include(PclFlashregDebian)
endif()
