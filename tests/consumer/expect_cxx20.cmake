# SPDX-License-Identifier: MIT
# cmake -D COMPILER=<c++> -D INCLUDE_DIR=<installed headers> -D EIGEN_DIR=<its headers> -P expect_cxx20.cmake
# Checks that the basic headers and the umbrella header, compiled as C++17, fail with vantage's own message as the
# first error.
cmake_minimum_required(VERSION 3.22...3.25)

file(GLOB headers RELATIVE "${INCLUDE_DIR}" "${INCLUDE_DIR}/vantage/geometry/*.hpp"
     "${INCLUDE_DIR}/vantage/vantage.hpp")
list(LENGTH headers count)
if(count LESS 10)
  message(FATAL_ERROR "only ${count} headers under ${INCLUDE_DIR}")
endif()
foreach(header IN LISTS headers)
  execute_process(COMMAND "${COMPILER}" -std=c++17 -fsyntax-only "-I${INCLUDE_DIR}" "-I${EIGEN_DIR}" -x c++
                          "${INCLUDE_DIR}/${header}" RESULT_VARIABLE code ERROR_VARIABLE error)
  string(REGEX MATCH "[^\n]*error: [^\n]*" first "${error}")
  if(code EQUAL 0 OR NOT first MATCHES "vantage needs C\\+\\+20")
    message(FATAL_ERROR "${header} as C++17: '${first}' instead of a line that asks for C++20")
  endif()
endforeach()
message(STATUS "${count} headers ask for C++20 first")
