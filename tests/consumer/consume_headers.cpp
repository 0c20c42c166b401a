// SPDX-License-Identifier: MIT
// A second source of a program that uses vantage::headers: it links only if the bodies in both are inline.
#include <vantage/vantage.hpp>

std::size_t planners_known_here() { return vantage::planner_names().size(); }
