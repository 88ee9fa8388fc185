# What a shell wants of the programs beside them: completion, and where help2man is, manual pages
# of what --help says.
if(NOT PCL_FLASHREG_BUILD_APPS)
  return()
endif()
find_program(PCL_FLASHREG_HELP2MAN help2man)
mark_as_advanced(PCL_FLASHREG_HELP2MAN)
set(completion ${PROJECT_SOURCE_DIR}/apps/completion/pcl_flashreg.bash)

# pcl_flashreg_add_manual(name "what the program does")
function(pcl_flashreg_add_manual name summary)
  if(NOT TARGET ${name})
    return()
  endif()
  install(FILES ${completion} RENAME ${name}
    DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  if(PCL_FLASHREG_BUILD_TESTS)
    add_test(NAME completion.${name} COMMAND bash -c "source ${completion}
      COMP_WORDS=(${name} --vers) COMP_CWORD=1
      _pcl_flashreg $<TARGET_FILE:${name}>
      [[ \${COMPREPLY[*]} == --version ]]")
  endif()
  if(NOT PCL_FLASHREG_HELP2MAN OR CMAKE_CROSSCOMPILING OR PCL_FLASHREG_SANITIZE)
    return()
  endif()
  set(page ${CMAKE_CURRENT_BINARY_DIR}/man/${name}.1)
  add_custom_command(OUTPUT ${page}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_CURRENT_BINARY_DIR}/man
    COMMAND ${PCL_FLASHREG_HELP2MAN} --no-info --name ${summary} --output ${page}
      $<TARGET_FILE:${name}>
    DEPENDS ${name} VERBATIM)
  add_custom_target(${name}_manual ALL DEPENDS ${page})
  install(FILES ${page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  if(PCL_FLASHREG_BUILD_TESTS)
    add_test(NAME manual.${name} COMMAND ${CMAKE_COMMAND} -E cat ${page})
    set_tests_properties(manual.${name} PROPERTIES PASS_REGULAR_EXPRESSION "[.]SH OPTIONS")
  endif()
endfunction()

pcl_flashreg_add_manual(pcl_flashreg_align
  "registers two point clouds without an initial guess, and says whether to trust it")
pcl_flashreg_add_manual(pcl_flashreg_map "makes a map of a folder of scans in any order")
pcl_flashreg_add_manual(pcl_flashreg_localize "finds scans in a map")
pcl_flashreg_add_manual(pcl_flashreg_evaluate
  "measures methods of registration on pairs whose true poses are known")
