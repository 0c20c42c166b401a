# SPDX-License-Identifier: MIT
# cmake -D COMPILER=<c++> -D HEADER=<path> -D INCLUDES=<folders> -D DEFINITIONS=<of vantage::headers>
#       -D OPTIONS=<of vantage::headers> -P check_fma.cmake
# Header-only, with fused multiply-add and without the declaration that contraction is off, a header fails with one
# line that names the remedy. With what vantage::headers brings, or without fused multiply-add, it compiles.
cmake_minimum_required(VERSION 3.22...3.25)

list(TRANSFORM INCLUDES PREPEND -I)
list(TRANSFORM DEFINITIONS PREPEND -D)
function(compile code_variable error_variable)
  execute_process(COMMAND "${COMPILER}" -std=c++20 -fsyntax-only ${INCLUDES} ${ARGN} -x c++ "${HEADER}"
                  RESULT_VARIABLE code ERROR_VARIABLE error)
  set(${code_variable} "${code}" PARENT_SCOPE)
  set(${error_variable} "${error}" PARENT_SCOPE)
endfunction()

compile(code error -DVANTAGE_HEADER_ONLY -march=haswell)
string(REGEX MATCHALL "error: [^\n]*" errors "${error}")
list(LENGTH errors count)
if(NOT count EQUAL 1 OR NOT errors MATCHES "-ffp-contract=off")
  message(FATAL_ERROR "with FMA and contraction: '${errors}' instead of one line that names -ffp-contract=off")
endif()
foreach(flags "-march=haswell;${DEFINITIONS};${OPTIONS}" "-march=haswell" "-DVANTAGE_HEADER_ONLY")
  compile(code error ${flags})
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "with ${flags}:\n${error}")
  endif()
endforeach()
