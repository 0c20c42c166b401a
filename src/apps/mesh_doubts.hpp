// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vantage/geometry/box.hpp>

// Warnings about a mesh that was read: one line for a person, or empty.
namespace vantage::apps {

/// Warns if a mesh is too long to be in metres: a world of more than 2 km, an object of more than 5 m.
[[nodiscard]] std::string doubt_about_world_unit(const std::string& file, const Box& bounds);
[[nodiscard]] std::string doubt_about_object_unit(const std::string& file, const Box& bounds);
/// Warns if a world is higher than wide: it may lie on its side.
[[nodiscard]] std::string doubt_about_axis(const std::string& file, const Box& bounds);

}  // namespace vantage::apps
