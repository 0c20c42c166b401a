# SPDX-License-Identifier: MIT
# Installs the package: one export file and one dependency file per component, and the config file that reads them.
include(CMakePackageConfigHelpers)

set(vantage_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/vantage")
set(vantage_package_build_dir "${PROJECT_BINARY_DIR}/package")
get_property(vantage_components GLOBAL PROPERTY VANTAGE_COMPONENTS)

# Writes the dependency file of a component: the vantage components that it links, then its packages. Whether private
# packages are needed is decided here, because the type of the library is known here and not in the config.
function(vantage_write_dependencies component)
  get_target_property(type vantage_${component} TYPE)
  set(links_property LINK_LIBRARIES)
  if(type STREQUAL "INTERFACE_LIBRARY")
    set(links_property INTERFACE_LINK_LIBRARIES)
  endif()
  get_target_property(links vantage_${component} ${links_property})
  get_property(packages GLOBAL PROPERTY VANTAGE_PUBLIC_DEPENDENCIES_${component})
  if(type STREQUAL "STATIC_LIBRARY")
    get_property(private_packages GLOBAL PROPERTY VANTAGE_PRIVATE_DEPENDENCIES_${component})
    list(APPEND packages ${private_packages})
  endif()
  set(needed ${links})
  list(FILTER needed INCLUDE REGEX "^vantage::")
  list(TRANSFORM needed REPLACE "^vantage::" "")
  set(content "# What vantage::${component} (${type}) needs.\nset(vantage_${component}_components \"${needed}\")\n")
  string(APPEND content "set(vantage_${component}_packages \"${packages}\")\n")
  file(CONFIGURE OUTPUT "${vantage_package_build_dir}/vantage-${component}-dependencies.cmake" CONTENT "${content}" @ONLY)
  install(FILES "${vantage_package_build_dir}/vantage-${component}-dependencies.cmake"
          DESTINATION "${vantage_package_dir}")
  install(EXPORT vantage-${component}-targets NAMESPACE vantage:: DESTINATION "${vantage_package_dir}")
endfunction()

foreach(component IN LISTS vantage_components)
  vantage_write_dependencies(${component})
endforeach()

configure_package_config_file(
  "${PROJECT_SOURCE_DIR}/cmake/vantageConfig.cmake.in" "${vantage_package_build_dir}/vantageConfig.cmake"
  INSTALL_DESTINATION "${vantage_package_dir}" NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file("${vantage_package_build_dir}/vantageConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${vantage_package_build_dir}/vantageConfig.cmake"
              "${vantage_package_build_dir}/vantageConfigVersion.cmake"
              "${PROJECT_SOURCE_DIR}/cmake/FindVantageArm.cmake" "${PROJECT_SOURCE_DIR}/cmake/FindVantageOpenCV.cmake"
        DESTINATION "${vantage_package_dir}")
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}")

# vantage.pc: core for projects without CMake.
if(IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}" OR IS_ABSOLUTE "${CMAKE_INSTALL_INCLUDEDIR}")
  set(vantage_pc_prefix "${CMAKE_INSTALL_PREFIX}")
  set(vantage_pc_includedir "${CMAKE_INSTALL_FULL_INCLUDEDIR}")
  set(vantage_pc_libdir "${CMAKE_INSTALL_FULL_LIBDIR}")
else()
  file(RELATIVE_PATH vantage_pc_prefix "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
  string(REGEX REPLACE "/$" "" vantage_pc_prefix "\${pcfiledir}/${vantage_pc_prefix}")
  set(vantage_pc_includedir "\${prefix}/${CMAKE_INSTALL_INCLUDEDIR}")
  set(vantage_pc_libdir "\${prefix}/${CMAKE_INSTALL_LIBDIR}")
endif()
configure_file("${PROJECT_SOURCE_DIR}/cmake/vantage.pc.in" "${vantage_package_build_dir}/vantage.pc" @ONLY)
install(FILES "${vantage_package_build_dir}/vantage.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
