# SPDX-License-Identifier: MIT
# What each component needs from outside. Found here, at the root, so that src/ and tests/ both see the targets.
vantage_find(core PUBLIC Eigen3 3.4 NO_MODULE)
vantage_find(core PUBLIC octomap 1.9)
vantage_find(core PRIVATE Qhull)
if(VANTAGE_BUILD_SIM)
  vantage_find(sim PRIVATE embree 3)
  vantage_find(sim PRIVATE assimp)
endif()
if(VANTAGE_BUILD_VISION)
  vantage_find(vision PRIVATE VantageOpenCV)
endif()
if(VANTAGE_BUILD_ARM)
  vantage_find(arm PRIVATE VantageArm)
endif()
if(VANTAGE_BUILD_SIM)
  vantage_find(report PRIVATE nlohmann_json 3.10)
  vantage_find(report PRIVATE ZLIB)
  # Built into the library. A classic build, with THREE as a global: releases up to 147 have one.
  find_file(VANTAGE_THREE_JS three.min.js PATHS /usr/share/javascript/three PATH_SUFFIXES build)
  find_file(VANTAGE_ORBIT_CONTROLS_JS OrbitControls.js PATHS /usr/share/javascript/three/examples/js/controls)
  if(NOT VANTAGE_THREE_JS OR NOT VANTAGE_ORBIT_CONTROLS_JS)
    message(FATAL_ERROR "vantage::report needs three.js for its page, which was not found; install libjs-three, or set "
                        "VANTAGE_THREE_JS and VANTAGE_ORBIT_CONTROLS_JS to three.min.js and OrbitControls.js")
  endif()
endif()
if(VANTAGE_BUILD_SIM AND VANTAGE_BUILD_VISION)
  find_package(CLI11 2.1 REQUIRED)  # the program only: no component needs it
endif()
