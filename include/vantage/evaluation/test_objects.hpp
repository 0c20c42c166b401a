// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vantage/compiler.hpp>
#include <vantage/sim/triangle_mesh.hpp>

namespace VANTAGE_EXPORT vantage {

/// Generates an object: closed surfaces, counter-clockwise seen from outside, metres, z up, standing on z = 0. The
/// seed sets its proportions. Names:
/// - thin: `chair` (legs, rungs and slats), `basket` (a grille of wires), `lamp` (a foot, a rod, a shade);
/// - hollow: `mug`, `vase` (narrow neck), `shelf` (a large box with compartments);
/// - solid: `blob`, `banana`, `crate`.
///
/// Throws std::invalid_argument with the list of names if there is no such object.
[[nodiscard]] TriangleMesh generated_object(std::string_view name, std::uint64_t seed = 1);
/// The names `generated_object` knows.
[[nodiscard]] std::span<const std::string_view> generated_object_names();

}  // namespace vantage
