# SPDX-License-Identifier: MIT

# vantage_add_library(<component> SOURCES ... HEADERS ... LINKS PUBLIC|PRIVATE ...)
# HEADERS are the public ones, relative to include/; each must compile alone.
function(vantage_add_library component)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;HEADERS;LINKS")
  set(target vantage_${component})
  list(TRANSFORM arg_HEADERS PREPEND "${PROJECT_SOURCE_DIR}/include/")
  add_library(${target} ${arg_SOURCES})
  add_library(vantage::${component} ALIAS ${target})
  target_sources(${target} PUBLIC FILE_SET HEADERS BASE_DIRS "${PROJECT_SOURCE_DIR}/include" FILES ${arg_HEADERS})
  target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}/src")
  target_link_libraries(${target} ${arg_LINKS})
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${component} VERIFY_INTERFACE_HEADER_SETS ON)
  vantage_warnings(${target})
endfunction()

function(vantage_warnings target)
  if(PROJECT_IS_TOP_LEVEL)
    target_compile_options(
      ${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast
                        $<$<BOOL:${VANTAGE_WARNINGS_AS_ERRORS}>:-Werror>)
  endif()
endfunction()
