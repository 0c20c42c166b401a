// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vantage/geometry/box.hpp>

#include "apps/explore_request.hpp"

// Warnings about a mesh that was read: one line for a person, or empty.
namespace vantage::apps {

/// Warns if an object is too long to be in metres: more than 5 m.
[[nodiscard]] std::string doubt_about_object_unit(const std::string& file, const Box& bounds);
/// Warns if the mesh of a world is longer than 2 km, or higher than wide so that it may lie on its side, unless
/// --scale or --up tells. `bounds` are those of the world.
[[nodiscard]] std::string doubts_about_world(const ExploreRequest& request, const Box& bounds);

}  // namespace vantage::apps
