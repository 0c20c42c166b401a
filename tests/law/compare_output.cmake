# SPDX-License-Identifier: MIT
# cmake -D ONE=<program> -D OTHER=<program> -P compare_output.cmake
# Both programs must succeed and print the same.
cmake_minimum_required(VERSION 3.22...3.25)

foreach(program ONE OTHER)
  execute_process(COMMAND ${${program}} OUTPUT_VARIABLE printed_${program} RESULT_VARIABLE code)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${${program}} ended with ${code}")
  endif()
endforeach()
if(NOT printed_ONE STREQUAL printed_OTHER)
  message(FATAL_ERROR "${ONE} and ${OTHER} print different plans")
endif()
