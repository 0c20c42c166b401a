# SPDX-License-Identifier: MIT
# Defines the targets vantage_kdl, vantage_ompl and vantage_urdf from the headers and libraries of orocos-kdl, OMPL and
# urdfdom. Their own package files define no targets, or require libraries that only the build of OMPL needed.
include(FindPackageHandleStandardArgs)

find_path(VantageArm_kdl_INCLUDE_DIR kdl/chain.hpp)
find_library(VantageArm_kdl_LIBRARY orocos-kdl)
find_path(VantageArm_ompl_INCLUDE_DIR ompl/geometric/planners/rrt/RRTConnect.h PATH_SUFFIXES ompl-1.7 ompl-1.6 ompl-1.5)
find_library(VantageArm_ompl_LIBRARY ompl)
find_path(VantageArm_urdf_INCLUDE_DIR urdf_parser/urdf_parser.h PATH_SUFFIXES urdfdom)
find_library(VantageArm_urdf_LIBRARY urdfdom_model)
find_library(VantageArm_console_LIBRARY console_bridge)
mark_as_advanced(VantageArm_kdl_INCLUDE_DIR VantageArm_kdl_LIBRARY VantageArm_ompl_INCLUDE_DIR VantageArm_ompl_LIBRARY
                 VantageArm_urdf_INCLUDE_DIR VantageArm_urdf_LIBRARY VantageArm_console_LIBRARY)
find_package_handle_standard_args(
  VantageArm REQUIRED_VARS VantageArm_kdl_LIBRARY VantageArm_kdl_INCLUDE_DIR VantageArm_ompl_LIBRARY
                           VantageArm_ompl_INCLUDE_DIR VantageArm_urdf_LIBRARY VantageArm_urdf_INCLUDE_DIR
                           VantageArm_console_LIBRARY)

if(VantageArm_FOUND)
  foreach(library kdl ompl urdf)
    if(NOT TARGET vantage_${library})
      add_library(vantage_${library} UNKNOWN IMPORTED)
      set_target_properties(
        vantage_${library} PROPERTIES IMPORTED_LOCATION "${VantageArm_${library}_LIBRARY}"
                                      INTERFACE_INCLUDE_DIRECTORIES "${VantageArm_${library}_INCLUDE_DIR}")
    endif()
  endforeach()
  set_target_properties(vantage_urdf PROPERTIES INTERFACE_LINK_LIBRARIES "${VantageArm_console_LIBRARY}")
endif()
