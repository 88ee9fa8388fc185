# The documentation's site, where Doxygen is: cmake --build BUILD --target docs. Warnings are
# errors.
find_package(Doxygen)
find_package(Python3 COMPONENTS Interpreter)
if(NOT DOXYGEN_FOUND OR NOT Python3_Interpreter_FOUND)
  return()
endif()
set(PCL_FLASHREG_DOCS_OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/docs)
set(PCL_FLASHREG_DOCS_INPUT "")
foreach(input README.md CONTRIBUTING.md docs include)
  string(APPEND PCL_FLASHREG_DOCS_INPUT " \"${PROJECT_SOURCE_DIR}/${input}\"")
endforeach()
configure_file(${PROJECT_SOURCE_DIR}/docs/site/Doxyfile.in docs/Doxyfile @ONLY)
set(PCL_FLASHREG_DOCS_OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/docs/comments)
configure_file(${PROJECT_SOURCE_DIR}/docs/site/comments.Doxyfile.in
  docs/comments.Doxyfile @ONLY)
add_custom_target(docs
  COMMAND Doxygen::doxygen docs/Doxyfile
  WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}
  COMMENT "Documentation: ${CMAKE_CURRENT_BINARY_DIR}/docs/html/index.html" VERBATIM)
if(PCL_FLASHREG_BUILD_TESTS)
  add_test(NAME test_docs COMMAND Doxygen::doxygen docs/Doxyfile
    WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
  add_test(NAME test_comments COMMAND Doxygen::doxygen docs/comments.Doxyfile
    WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
endif()
