# `cpack -G DEB` in the build directory makes one Debian package of all that is installed.

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME pcl-flashreg)
set(CPACK_PACKAGE_VENDOR "The pcl_flashreg authors")
set(CPACK_PACKAGE_CONTACT
  "The pcl_flashreg authors <authors@pcl-flashreg.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Global point cloud registration for PCL")
set(CPACK_PACKAGE_DESCRIPTION
  "Finds the rigid transform between two point clouds with no initial guess, repeats
itself to the last bit, and says whether to trust the answer. Contains the library, the
headers of the PCL classes, CMake and pkg-config files, and the programs.")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION libdevel)
# The headers need these; what the programs link is found by dpkg-shlibdeps.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libeigen3-dev")
if(PCL_FLASHREG_WITH_PCL)
  string(APPEND CPACK_DEBIAN_PACKAGE_DEPENDS ", libpcl-dev")
endif()
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/src)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ${BUILD_SHARED_LIBS})
include(CPack)
