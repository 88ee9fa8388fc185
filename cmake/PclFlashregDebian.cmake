# `cpack -G DEB` in the build directory makes a Debian package of all that is installed, and one
# of the Python module.

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
if(PCL_FLASHREG_PYTHON)
  set(CPACK_DEB_COMPONENT_INSTALL ON)
  set(CPACK_COMPONENTS_ALL Unspecified python)
  set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_NAME pcl-flashreg)
  set(CPACK_COMPONENT_UNSPECIFIED_DESCRIPTION ${CPACK_PACKAGE_DESCRIPTION})
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-pcl-flashreg)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION
    "Finds the rigid transform between two point clouds with no initial guess, repeats
itself to the last bit, and says whether to trust the answer. Contains the Python module,
which takes NumPy arrays and files, and needs no PCL.")
  # The compiled part is for one version of Python alone.
  math(EXPR next_minor "${Python3_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "python3 (>= 3.${Python3_VERSION_MINOR}), python3 (<< 3.${next_minor}), python3-numpy")
  if(BUILD_SHARED_LIBS)
    string(APPEND CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      ", pcl-flashreg (= ${PROJECT_VERSION})")
  endif()
endif()
include(CPack)
