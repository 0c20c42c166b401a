# SPDX-License-Identifier: MIT

# vantage_add_library(<component> [SOURCES ...] [BODIES ...] [PRIVATE_HEADERS ...] HEADERS ...
#                     LINKS PUBLIC|PRIVATE ...)
# BODIES: files under include/ that define what headers declare; each is compiled once, as a source.
# HEADERS: public headers relative to include/. Each of them and each body must compile alone.
function(vantage_add_library component)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;BODIES;PRIVATE_HEADERS;HEADERS;LINKS")
  set(target vantage_${component})
  set_property(GLOBAL APPEND PROPERTY VANTAGE_COMPONENTS ${component})
  set_property(GLOBAL APPEND PROPERTY VANTAGE_HEADERS ${arg_HEADERS})
  set_property(GLOBAL APPEND PROPERTY VANTAGE_PRIVATE_FILES ${arg_PRIVATE_HEADERS} ${arg_BODIES})
  foreach(body IN LISTS arg_BODIES)
    string(REGEX REPLACE "^vantage/(.+)/impl/(.+)\\.ipp$" "${PROJECT_BINARY_DIR}/bodies/\\1/\\2.cpp" source "${body}")
    file(CONFIGURE OUTPUT "${source}" CONTENT "#include <${body}>\n")
    list(APPEND arg_SOURCES "${source}")
  endforeach()
  add_library(${target} ${arg_SOURCES})
  add_library(vantage::${component} ALIAS ${target})
  vantage_unite_folders(${target})
  target_include_directories(
    ${target}
    PUBLIC "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>" "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>"
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
  vantage_link_one_way(${target} compiled)
  vantage_warnings(${target})
  if(VANTAGE_INSTALL)
    install(
      TARGETS ${target}
      EXPORT vantage-${component}-targets
      RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}"
      LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}"
      ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
    vantage_install_headers(${arg_HEADERS} ${arg_PRIVATE_HEADERS} ${arg_BODIES})
  endif()
  if(VANTAGE_BUILD_TESTS)
    vantage_check_headers(${component} ${arg_HEADERS} ${arg_BODIES})
  endif()
endfunction()

# vantage_add_header_library(<component> LINKS ...)
# The headers of core with their bodies, for hosts that compile them with their own sources.
function(vantage_add_header_library component)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "LINKS")
  set(target vantage_${component})
  set_property(GLOBAL APPEND PROPERTY VANTAGE_COMPONENTS ${component})
  add_library(${target} INTERFACE)
  add_library(vantage::${component} ALIAS ${target})
  target_include_directories(${target} INTERFACE "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>"
                                                 "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
  target_link_libraries(${target} INTERFACE ${arg_LINKS})
  target_compile_features(${target} INTERFACE cxx_std_20)
  target_compile_definitions(${target} INTERFACE VANTAGE_HEADER_ONLY VANTAGE_CONTRACTS_NOTHING)
  target_compile_options(${target} INTERFACE -ffp-contract=off)
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${component})
  vantage_link_one_way(${target} headers)
  if(VANTAGE_INSTALL)
    install(TARGETS ${target} EXPORT vantage-${component}-targets)
  endif()
endfunction()

# CMake refuses a program that links both the compiled library and the headers with their bodies.
function(vantage_link_one_way target way)
  set_property(TARGET ${target} APPEND PROPERTY COMPATIBLE_INTERFACE_STRING VANTAGE_LINKED_AS)
  set_property(TARGET ${target} PROPERTY INTERFACE_VANTAGE_LINKED_AS ${way})
endfunction()

# Installs each header into its folder. CMake 3.22 has no header sets, which would do this.
function(vantage_install_headers)
  foreach(header IN LISTS ARGN)
    get_filename_component(folder "${header}" DIRECTORY)
    install(FILES "${PROJECT_SOURCE_DIR}/include/${header}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/${folder}")
  endforeach()
endfunction()

# Target public_headers: compiles each public header and each body alone. Unity builds hide a missing include.
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
  target_compile_options(vantage_${component}_headers PRIVATE -O0)  # the code is not kept
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
