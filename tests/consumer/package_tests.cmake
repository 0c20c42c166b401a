# SPDX-License-Identifier: MIT
# Tests of the package in three ways (installed, subdirectory, fetchcontent), and of its errors for missing components.
set(consumer_source "${CMAKE_CURRENT_LIST_DIR}")
set(consumer_build "${PROJECT_BINARY_DIR}/consumer")
set(consumer_prefix "${consumer_build}/prefix")

# Headers that an earlier build installed are gone.
add_test(NAME package.empty_prefix COMMAND "${CMAKE_COMMAND}" -E rm -rf "${consumer_prefix}")
set_tests_properties(package.empty_prefix PROPERTIES FIXTURES_SETUP installed_package LABELS package)
add_test(NAME package.install COMMAND "${CMAKE_COMMAND}" --install "${PROJECT_BINARY_DIR}" --prefix "${consumer_prefix}")
set_tests_properties(package.install PROPERTIES DEPENDS package.empty_prefix FIXTURES_SETUP installed_package
                                                LABELS package)

# vantage_consumer_test(<name> <folder> <option>...): configures, builds and runs the consumer. The options must come
# before --test-command, which takes all arguments that follow.
function(vantage_consumer_test name folder)
  add_test(
    NAME package.${name}
    COMMAND
      "${CMAKE_CTEST_COMMAND}" --build-and-test "${consumer_source}" "${consumer_build}/${folder}" --build-generator
      "${CMAKE_GENERATOR}" --build-noclean --build-options "-DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}"
      "-DCMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER}" ${ARGN} --test-command "${CMAKE_CTEST_COMMAND}"
      --output-on-failure --no-tests=error)
  set_tests_properties(package.${name} PROPERTIES LABELS package PROCESSORS 2)
endfunction()

set(without_heavy -DVANTAGE_BUILD_VISION=OFF -DVANTAGE_BUILD_SIM=OFF -DVANTAGE_BUILD_ARM=OFF)
foreach(package OpenCV VantageArm embree Embree assimp nlohmann_json CLI11)
  list(APPEND without_heavy -DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()

get_property(components GLOBAL PROPERTY VANTAGE_COMPONENTS)
if(VANTAGE_INSTALL)
  vantage_consumer_test(installed installed -DWAY=installed "-DCMAKE_PREFIX_PATH=${consumer_prefix}")
  string(JOIN "$<SEMICOLON>" components_list ${components})
  vantage_consumer_test(installed_every_component every_component -DWAY=installed
                        "-DCMAKE_PREFIX_PATH=${consumer_prefix}" "-DCOMPONENTS=${components_list}" -DOTHER_PROCESSORS=ON)
  vantage_consumer_test(installed_without_heavy without_heavy -DWAY=installed "-DCMAKE_PREFIX_PATH=${consumer_prefix}"
                        ${without_heavy})
  add_test(NAME package.unknown_component
           COMMAND "${CMAKE_COMMAND}" -G "${CMAKE_GENERATOR}" -S "${consumer_source}" -B
                   "${consumer_build}/unknown_component" -DWAY=installed "-DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}"
                   "-DCMAKE_PREFIX_PATH=${consumer_prefix}" "-DCOMPONENTS=core;telepathy")
  set_tests_properties(
    package.unknown_component
    PROPERTIES LABELS package PASS_REGULAR_EXPRESSION
               "vantage[ \n]+was[ \n]+built[ \n]+without[ \n]+'telepathy'.[ \n]+it[ \n]+has:[ \n]+core")
  find_program(PKG_CONFIG NAMES pkgconf pkg-config REQUIRED)
  add_test(NAME package.pkg_config
           COMMAND "${consumer_source}/consume_by_pkg_config.sh" "${PKG_CONFIG}"
                   "${consumer_prefix}/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "${CMAKE_CXX_COMPILER}"
                   "${consumer_source}/consume_core.cpp" "${consumer_build}/consume_by_pkg_config")
  set_tests_properties(package.pkg_config PROPERTIES LABELS package)
  set_tests_properties(
    package.installed package.installed_every_component package.installed_without_heavy package.unknown_component
    package.pkg_config PROPERTIES FIXTURES_REQUIRED installed_package)
endif()
# Both ways build the same files in one folder, which is not cleaned, so that the library is compiled once.
set(part "-DVANTAGE_SOURCE_DIR=${PROJECT_SOURCE_DIR}" "-DFETCHCONTENT_SOURCE_DIR_VANTAGE=${PROJECT_SOURCE_DIR}"
         -DFETCHCONTENT_FULLY_DISCONNECTED=ON -DBUILD_SHARED_LIBS=ON -DCMAKE_UNITY_BUILD=ON -DCMAKE_BUILD_TYPE=None)
vantage_consumer_test(subdirectory part -DWAY=subdirectory ${part} ${without_heavy})
vantage_consumer_test(fetchcontent part -DWAY=fetchcontent ${part} ${without_heavy})
set_tests_properties(package.fetchcontent PROPERTIES DEPENDS package.subdirectory)
