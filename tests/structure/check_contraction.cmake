# SPDX-License-Identifier: MIT
# cmake -D COMPILER=<g++ for x86-64> -D "INCLUDES=<folders>" -D "HEADERS=<public headers>" -D FOLDER=<output>
#       -P check_contraction.cmake
# On other processors, a compiler may round a * b + c once (contraction). Inline functions must not contain such an
# expression: the host's copy would compute other bits than the library, and the linker may choose the host's copy for
# the library. This finds what this compiler contracts; another compiler may contract more.
cmake_minimum_required(VERSION 3.22...3.25)

list(TRANSFORM HEADERS REPLACE "(.+)" "#include <\\1>")
list(JOIN HEADERS "\n" includes)
file(WRITE "${FOLDER}/inline_functions.cpp" "${includes}\n")
list(TRANSFORM INCLUDES PREPEND "-I")
execute_process(
  COMMAND "${COMPILER}" -std=c++20 -O2 -march=haswell -fkeep-inline-functions ${INCLUDES} -S -o
          "${FOLDER}/inline_functions.s" "${FOLDER}/inline_functions.cpp" RESULT_VARIABLE code ERROR_VARIABLE error)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "${error}")
endif()

set(functions 0)
set(ours FALSE)
set(faults)
file(STRINGS "${FOLDER}/inline_functions.s" lines REGEX "^_Z[A-Za-z0-9_]+:|vfn?m(add|sub)")
foreach(line IN LISTS lines)
  if(line MATCHES "^(_Z[A-Za-z0-9_]+):")
    set(name "${CMAKE_MATCH_1}")
    string(REGEX MATCH "^_ZN[VKRO]*7vantage" ours "${name}")
    if(ours)
      math(EXPR functions "${functions} + 1")
    endif()
  elseif(ours)
    list(APPEND faults "${name}")
  endif()
endforeach()
if(functions LESS 50)
  message(FATAL_ERROR "only ${functions} inline functions found")
endif()
if(faults)
  list(REMOVE_DUPLICATES faults)
  list(JOIN faults "\n  " faults)
  message(FATAL_ERROR "these round once where the library rounds twice:\n  ${faults}")
endif()
message(STATUS "${functions} inline functions round as the library does")
