# SPDX-License-Identifier: MIT
# Consumers built for other processors than the library: the layouts, a plan and ray cells must be the same as in the
# library. A compiler without C++20 must be rejected in the first error.

# layouts.hpp lists every struct and class of the installed component headers that is not a template.
get_target_property(include_dir vantage::core INTERFACE_INCLUDE_DIRECTORIES)
set(includes)
set(layouts)
file(GLOB headers RELATIVE "${include_dir}" "${include_dir}/vantage/*/*.hpp")
foreach(header IN LISTS headers)
  string(REGEX MATCH "^vantage/([a-z]+)/" folder "${header}")
  if(CMAKE_MATCH_1 MATCHES "^(picture|vision|arm|report|sim)$" AND NOT CMAKE_MATCH_1 IN_LIST COMPONENTS)
    continue()
  endif()
  string(APPEND includes "#include <${header}>\n")
  file(READ "${include_dir}/${header}" text)
  string(REGEX REPLACE "template <[^;{]*>\n(struct|class) [A-Za-z]+" "" text "${text}")
  string(REGEX MATCHALL "\n(struct|class) [A-Z][A-Za-z0-9]+ [^;\n]*{" types "${text}")
  foreach(type IN LISTS types)
    string(REGEX REPLACE "^\n(struct|class) ([A-Za-z0-9]+) .*" "\\2" type "${type}")
    string(APPEND layouts "    Layout{\"${type}\", sizeof(vantage::${type}), alignof(vantage::${type})},\n")
  endforeach()
endforeach()
string(APPEND layouts "    Layout{\"Pose\", sizeof(vantage::Pose), alignof(vantage::Pose)},\n")
configure_file(layouts.hpp.in "${PROJECT_BINARY_DIR}/layouts.hpp" @ONLY)

add_library(plain_layouts OBJECT plain_layouts.cpp)
target_include_directories(plain_layouts PRIVATE "${PROJECT_BINARY_DIR}")
list(REMOVE_ITEM COMPONENTS headers)
list(TRANSFORM COMPONENTS PREPEND vantage:: OUTPUT_VARIABLE component_targets)
target_link_libraries(plain_layouts PRIVATE ${component_targets})

# vantage_host(<part> <flag>...): builds consume_<part>.cpp with optimisation, as a consumer would.
function(vantage_host part)
  string(REPLACE "-march=" "_" host "${part}${ARGN}")
  add_executable(${host} consume_${part}.cpp)
  target_link_libraries(${host} PRIVATE ${component_targets})
  target_compile_options(${host} PRIVATE -O2 ${ARGN})
  if(part STREQUAL "layouts")
    target_sources(${host} PRIVATE $<TARGET_OBJECTS:plain_layouts>)
    target_include_directories(${host} PRIVATE "${PROJECT_BINARY_DIR}")
  endif()
  add_test(NAME ${host} COMMAND ${host})
endfunction()

set(flags -march=native)
include(CheckCXXSourceRuns)
check_cxx_source_runs("int main() { return __builtin_cpu_supports(\"avx2\") && __builtin_cpu_supports(\"fma\") ? 0 : 1; }"
                      runs_haswell)
if(runs_haswell)
  list(APPEND flags -march=haswell)
else()
  message(STATUS "no host for -march=haswell: this processor is no x86-64 with AVX2")
endif()
vantage_host(layouts)
vantage_host(rays)
foreach(flag IN LISTS flags)
  vantage_host(layouts ${flag})
  vantage_host(core ${flag})
  vantage_host(rays ${flag})
endforeach()

add_test(NAME without_cxx20
         COMMAND "${CMAKE_COMMAND}" -D "COMPILER=${CMAKE_CXX_COMPILER}" -D "INCLUDE_DIR=${include_dir}" -D
                 "EIGEN_DIR=$<JOIN:$<TARGET_PROPERTY:Eigen3::Eigen,INTERFACE_INCLUDE_DIRECTORIES>,>" -P
                 "${CMAKE_CURRENT_LIST_DIR}/expect_cxx20.cmake")
