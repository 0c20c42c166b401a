# SPDX-License-Identifier: MIT
# What each component needs from outside. Found here, at the root, so that src/ and tests/ both see the targets.
vantage_find(core PUBLIC Eigen3 3.4 NO_MODULE)
vantage_find(core PUBLIC octomap 1.9)
if(VANTAGE_BUILD_SIM)
  vantage_find(sim PRIVATE embree 3)
  vantage_find(sim PRIVATE assimp)
endif()
