// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vantage/geometry/box.hpp>

// What looks wrong with a mesh that was read, a line for a person; empty where nothing does.
namespace vantage::apps {

/// Where a mesh is longer than one in metres is ever: a world 2 km, an object 100 m.
[[nodiscard]] std::string doubt_about_world_unit(const std::string& file, const Box& bounds);
[[nodiscard]] std::string doubt_about_object_unit(const std::string& file, const Box& bounds);
/// Where a world is higher than wide: it may lie on its side.
[[nodiscard]] std::string doubt_about_axis(const std::string& file, const Box& bounds);

}  // namespace vantage::apps
