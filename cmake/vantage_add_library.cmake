# SPDX-License-Identifier: MIT

# vantage_add_library(<component> SOURCES ... HEADERS ... [GENERATED_HEADERS ...]
#                     [UMBRELLA ...] LINKS PUBLIC|PRIVATE ...)
# HEADERS: public headers relative to include/; each must compile alone. GENERATED_HEADERS: headers in the build tree.
# UMBRELLA: the header in the build tree that is written here and includes all others.
function(vantage_add_library component)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "UMBRELLA" "SOURCES;HEADERS;GENERATED_HEADERS;LINKS")
  set(target vantage_${component})
  set_property(GLOBAL APPEND PROPERTY VANTAGE_COMPONENTS ${component})
  set_property(GLOBAL APPEND PROPERTY VANTAGE_HEADERS ${arg_HEADERS})
  if(arg_UMBRELLA)
    set(includes ${arg_HEADERS} ${arg_GENERATED_HEADERS})
    list(SORT includes)
    list(TRANSFORM includes REPLACE "(.+)" "#include <\\1>")
    list(JOIN includes "\n" includes)
    configure_file("${PROJECT_SOURCE_DIR}/cmake/umbrella.hpp.in" "${PROJECT_BINARY_DIR}/include/${arg_UMBRELLA}" @ONLY)
    list(APPEND arg_GENERATED_HEADERS ${arg_UMBRELLA})
  endif()
  add_library(${target} ${arg_SOURCES})
  add_library(vantage::${component} ALIAS ${target})
  vantage_unite_folders(${target})
  target_include_directories(
    ${target}
    PUBLIC "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>" "$<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>"
           "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>"
    PRIVATE "${PROJECT_SOURCE_DIR}/src")
  target_link_libraries(${target} ${arg_LINKS})
  target_compile_features(${target} PUBLIC cxx_std_20)
  # Same results on every processor: a * b + c rounds twice. Without errno, sqrt can be vectorised.
  target_compile_options(${target} PRIVATE -ffp-contract=off -fno-math-errno)
  set_target_properties(
    ${target}
    PROPERTIES EXPORT_NAME ${component}
               POSITION_INDEPENDENT_CODE ON
               CXX_VISIBILITY_PRESET hidden
               VISIBILITY_INLINES_HIDDEN ON
               DEFINE_SYMBOL ""
               VERSION ${PROJECT_VERSION}
               SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  vantage_warnings(${target})
  if(VANTAGE_INSTALL)
    install(
      TARGETS ${target}
      EXPORT vantage-${component}-targets
      RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}"
      LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}"
      ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
    vantage_install_headers("${PROJECT_SOURCE_DIR}/include" ${arg_HEADERS})
    vantage_install_headers("${PROJECT_BINARY_DIR}/include" ${arg_GENERATED_HEADERS})
  endif()
  if(VANTAGE_BUILD_TESTS)
    vantage_check_headers(${component} ${arg_HEADERS} ${arg_GENERATED_HEADERS})
  endif()
endfunction()

# Installs each header into its folder. CMake 3.22 has no header sets, which would do this.
function(vantage_install_headers root)
  foreach(header IN LISTS ARGN)
    get_filename_component(folder "${header}" DIRECTORY)
    install(FILES "${root}/${header}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/${folder}")
  endforeach()
endfunction()

# Target public_headers: compiles each public header alone.
function(vantage_check_headers component)
  set(sources)
  foreach(header IN LISTS ARGN)
    set(source "${PROJECT_BINARY_DIR}/public_headers/${header}.cpp")
    file(CONFIGURE OUTPUT "${source}" CONTENT "#include <${header}>\n")
    list(APPEND sources "${source}")
  endforeach()
  add_library(vantage_${component}_headers OBJECT EXCLUDE_FROM_ALL ${sources})
  target_link_libraries(vantage_${component}_headers PRIVATE vantage::${component})
  set_target_properties(vantage_${component}_headers PROPERTIES UNITY_BUILD OFF)
  vantage_warnings(vantage_${component}_headers)
  if(NOT TARGET public_headers)
    add_custom_target(public_headers)
  endif()
  add_dependencies(public_headers vantage_${component}_headers)
endfunction()

# Groups the sources of each folder for unity builds (CMAKE_UNITY_BUILD).
function(vantage_unite_folders target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    get_filename_component(folder "${source}" DIRECTORY)
    set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "${folder}")
  endforeach()
endfunction()

# Enables vantage's warnings for its own targets, only if it is the top-level project.
function(vantage_warnings target)
  if(PROJECT_IS_TOP_LEVEL)
    target_compile_options(
      ${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast
                        $<$<BOOL:${VANTAGE_WARNINGS_AS_ERRORS}>:-Werror>)
  endif()
endfunction()
