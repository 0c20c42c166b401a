# SPDX-License-Identifier: MIT
# The targets opencv_core, opencv_imgproc and opencv_imgcodecs: from OpenCV's own package where that is installed, else
# straight from headers and libraries. Debian ships OpenCV's package file only together with all of OpenCV and its 150
# dependencies, while three small packages are all that pictures need.
include(FindPackageHandleStandardArgs)

find_package(OpenCV 4 QUIET CONFIG COMPONENTS core imgproc imgcodecs)
if(OpenCV_FOUND AND TARGET opencv_core)
  set(VantageOpenCV_LIBRARIES opencv_core opencv_imgproc opencv_imgcodecs)
  find_package_handle_standard_args(VantageOpenCV REQUIRED_VARS VantageOpenCV_LIBRARIES)
  return()
endif()

find_path(VantageOpenCV_INCLUDE_DIR opencv2/imgcodecs.hpp PATH_SUFFIXES opencv4)
find_library(VantageOpenCV_core_LIBRARY opencv_core)
find_library(VantageOpenCV_imgproc_LIBRARY opencv_imgproc)
find_library(VantageOpenCV_imgcodecs_LIBRARY opencv_imgcodecs)
mark_as_advanced(VantageOpenCV_INCLUDE_DIR VantageOpenCV_core_LIBRARY VantageOpenCV_imgproc_LIBRARY
                 VantageOpenCV_imgcodecs_LIBRARY)
find_package_handle_standard_args(
  VantageOpenCV REQUIRED_VARS VantageOpenCV_core_LIBRARY VantageOpenCV_imgproc_LIBRARY VantageOpenCV_imgcodecs_LIBRARY
                              VantageOpenCV_INCLUDE_DIR)

if(VantageOpenCV_FOUND)
  foreach(module core imgproc imgcodecs)
    if(NOT TARGET opencv_${module})
      add_library(opencv_${module} UNKNOWN IMPORTED)
      set_target_properties(
        opencv_${module} PROPERTIES IMPORTED_LOCATION "${VantageOpenCV_${module}_LIBRARY}"
                                    INTERFACE_INCLUDE_DIRECTORIES "${VantageOpenCV_INCLUDE_DIR}")
    endif()
  endforeach()
endif()
