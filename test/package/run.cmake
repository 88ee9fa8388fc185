# Runs a command and ends the test with all its output if it fails.
#   run(<command> [<argument>...])         in WORK_DIR
# Leaves what the command printed in run_output.
macro(run)
  execute_process(COMMAND ${ARGV}
    WORKING_DIRECTORY ${WORK_DIR}
    RESULT_VARIABLE run_result
    OUTPUT_VARIABLE run_output
    ERROR_VARIABLE run_output)
  if(NOT run_result EQUAL 0)
    string(REPLACE ";" " " run_command "${ARGV}")
    message("${run_command}\n${run_output}")
    message(FATAL_ERROR "ended with ${run_result}")
  endif()
endmacro()

macro(expect_file file)
  if(NOT EXISTS ${file})
    message(FATAL_ERROR "missing: ${file}")
  endif()
endmacro()

# Sets skipped, and says so, if the processor lacks one of these instruction sets.
function(skip_unless_processor_has)
  set(skipped OFF PARENT_SCOPE)
  foreach(instruction_set IN LISTS ARGN)
    file(STRINGS /proc/cpuinfo supported REGEX "^flags.*[ \t]${instruction_set}( |$)"
      LIMIT_COUNT 1)
    if(NOT supported)
      message("SKIPPED: this processor has no ${instruction_set}")
      set(skipped ON PARENT_SCOPE)
    endif()
  endforeach()
endfunction()

# A fresh folder to work in.
file(REMOVE_RECURSE ${WORK_DIR})
file(MAKE_DIRECTORY ${WORK_DIR})
