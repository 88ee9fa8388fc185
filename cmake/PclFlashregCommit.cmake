# Run by CMake at build time, -DSOURCE_DIR=... -DOUTPUT=...: writes the commit that is being
# built into a source file, which changes, and is compiled again, only when the commit does.
cmake_minimum_required(VERSION 3.22)
execute_process(
  COMMAND git describe --always --dirty
  WORKING_DIRECTORY ${SOURCE_DIR}
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
  set(commit unknown)
endif()
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT [=[
#include "provenance.h"

const char*
pcl_flashreg::benchmark::commit()
{
  return "@commit@";
}
]=])
