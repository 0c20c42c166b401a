# SPDX-License-Identifier: MIT

# vantage_find(<component> PUBLIC|PRIVATE <package> [arguments of find_package]...)
# Finds a dependency of a component, or fails and names the option to build without it. Records it for the installed
# package, which must find PUBLIC dependencies always and PRIVATE ones only for static libraries.
macro(vantage_find component visibility package)
  find_package(${package} ${ARGN} QUIET)
  if(NOT ${package}_FOUND)
    if("${component}" STREQUAL "core")
      message(FATAL_ERROR "vantage::core needs ${package} (${package} ${ARGN}), which was not found; "
                          "cmake/debian-packages.txt names the Debian packages")
    endif()
    message(FATAL_ERROR "vantage::${component} needs ${package} (${package} ${ARGN}), which was not found; install it "
                        "(cmake/debian-packages.txt names the Debian packages) or switch the component off with "
                        "VANTAGE_BUILD_VISION=OFF, VANTAGE_BUILD_ARM=OFF or VANTAGE_BUILD_SIM=OFF")
  endif()
  string(JOIN " " vantage_find_arguments ${package} ${ARGN})
  set_property(GLOBAL APPEND PROPERTY VANTAGE_${visibility}_DEPENDENCIES_${component} "${vantage_find_arguments}")
endmacro()
