# SPDX-License-Identifier: MIT
# cmake -D CHECK=<script> -D ROOT=<planted tree> -D MESSAGE=<regex> -P expect_refusal.cmake
# Passes if the check fails on the planted tree with the expected message.
cmake_minimum_required(VERSION 3.22...3.25)

execute_process(COMMAND "${CMAKE_COMMAND}" -D "ROOT=${ROOT}" -P "${CHECK}" RESULT_VARIABLE code ERROR_VARIABLE error
                OUTPUT_QUIET)
if(code EQUAL 0)
  message(FATAL_ERROR "${CHECK} passed on ${ROOT}, where a fault is planted")
endif()
if(NOT error MATCHES "${MESSAGE}")
  message(FATAL_ERROR "${CHECK} failed on ${ROOT}, but not for the planted reason (${MESSAGE}):\n${error}")
endif()
