# The module goes where its Python looks.

set(PCL_FLASHREG_PYTHON_DIR "" CACHE STRING
  "Where the Python module is installed, below the prefix; empty for where Python looks there")

execute_process(COMMAND ${Python3_EXECUTABLE} -c
  "import sysconfig as s; print('deb_system' in s.get_scheme_names())"
  OUTPUT_VARIABLE debian OUTPUT_STRIP_TRAILING_WHITESPACE)
set(version ${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR})
set(folder ${PCL_FLASHREG_PYTHON_DIR})
set(system_folder ${PCL_FLASHREG_PYTHON_DIR})
if(NOT PCL_FLASHREG_PYTHON_DIR)
  set(folder lib/python${version}/site-packages)
  set(system_folder ${folder})
  if(debian STREQUAL "True")
    # What Debian packages bring is shared by all versions of Python 3.
    set(folder lib/python${version}/dist-packages)
    set(system_folder lib/python3/dist-packages)
  endif()
endif()
if(BUILD_SHARED_LIBS)
  file(RELATIVE_PATH libraries_from_module
    /prefix/${folder}/pcl_flashreg /prefix/${CMAKE_INSTALL_LIBDIR})
  set_target_properties(pcl_flashreg_python PROPERTIES
    INSTALL_RPATH "\$ORIGIN/${libraries_from_module}")
endif()
# The prefix is known when it is installed: a package's is another one.
install(CODE "
  set(PCL_FLASHREG_PYTHON_FOLDER ${folder})
  if(CMAKE_INSTALL_PREFIX STREQUAL \"/usr\")
    set(PCL_FLASHREG_PYTHON_FOLDER ${system_folder})
  endif()" COMPONENT python)
set(destination "\${PCL_FLASHREG_PYTHON_FOLDER}/pcl_flashreg")
install(TARGETS pcl_flashreg_python LIBRARY DESTINATION ${destination} COMPONENT python)
install(FILES ${sources} DESTINATION ${destination} COMPONENT python)
