# SPDX-License-Identifier: MIT
# cmake -D NM=<nm> -D LIBRARY=<shared library> -P check_exports.cmake
# Checks that a shared library exports public names and none of vantage::detail.
cmake_minimum_required(VERSION 3.22...3.25)

execute_process(COMMAND "${NM}" -DC --defined-only "${LIBRARY}" OUTPUT_VARIABLE symbols RESULT_VARIABLE code)
string(REGEX MATCHALL "\n[0-9a-f]+ [A-Za-z] vantage::([A-Z]|[a-z_]+\\()" public "${symbols}")
string(REGEX MATCHALL "\n[0-9a-f]+ [A-Za-z] ([a-z ]+ for )?vantage::detail::[^\n]*" private "${symbols}")
list(LENGTH public public_count)
list(LENGTH private private_count)
if(NOT code EQUAL 0 OR public_count LESS 5 OR private_count GREATER 0)
  list(JOIN private "" private)
  message(FATAL_ERROR "${LIBRARY} shows ${public_count} public names and ${private_count} of vantage::detail:${private}")
endif()
message(STATUS "${public_count} public names, none of vantage::detail")
