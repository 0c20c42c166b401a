# SPDX-License-Identifier: MIT
# Defines the targets opencv_core, opencv_imgproc, opencv_imgcodecs, opencv_calib3d and opencv_surface_matching, from
# OpenCV's own package if it is installed, else from headers and libraries. Debian ships OpenCV's package file only
# with all of OpenCV and its 150 dependencies; vantage needs only a few of its packages.
include(FindPackageHandleStandardArgs)
set(VantageOpenCV_modules core imgproc imgcodecs calib3d surface_matching)

find_package(OpenCV 4 QUIET CONFIG COMPONENTS ${VantageOpenCV_modules})
if(OpenCV_FOUND AND TARGET opencv_core)
  list(TRANSFORM VantageOpenCV_modules PREPEND opencv_ OUTPUT_VARIABLE VantageOpenCV_LIBRARIES)
  find_package_handle_standard_args(VantageOpenCV REQUIRED_VARS VantageOpenCV_LIBRARIES)
  return()
endif()

find_path(VantageOpenCV_INCLUDE_DIR opencv2/imgcodecs.hpp PATH_SUFFIXES opencv4)
mark_as_advanced(VantageOpenCV_INCLUDE_DIR)
set(VantageOpenCV_required)
foreach(module IN LISTS VantageOpenCV_modules)
  find_library(VantageOpenCV_${module}_LIBRARY opencv_${module})
  mark_as_advanced(VantageOpenCV_${module}_LIBRARY)
  list(APPEND VantageOpenCV_required VantageOpenCV_${module}_LIBRARY)
endforeach()
find_package_handle_standard_args(VantageOpenCV REQUIRED_VARS ${VantageOpenCV_required} VantageOpenCV_INCLUDE_DIR)

if(VantageOpenCV_FOUND)
  foreach(module IN LISTS VantageOpenCV_modules)
    if(NOT TARGET opencv_${module})
      add_library(opencv_${module} UNKNOWN IMPORTED)
      set_target_properties(
        opencv_${module} PROPERTIES IMPORTED_LOCATION "${VantageOpenCV_${module}_LIBRARY}"
                                    INTERFACE_INCLUDE_DIRECTORIES "${VantageOpenCV_INCLUDE_DIR}")
    endif()
  endforeach()
endif()
