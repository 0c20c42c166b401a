// SPDX-License-Identifier: MIT
#include "layouts.hpp"

std::vector<Layout> plain_layouts() { return {kLayouts.begin(), kLayouts.end()}; }
