// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vantage/compiler.hpp>
#include <vantage/sim/triangle_mesh.hpp>

namespace VANTAGE_EXPORT vantage {

/// How to read the coordinates of a mesh file.
struct MeshFileOptions {
  /// Axis of the file that points up.
  enum class Up : std::uint8_t { Y, Z };
  /// Axis of the file that points up; with Y the mesh is turned about x. None: COLLADA files say it (`up_axis`),
  /// glTF has y, other formats are taken as z.
  std::optional<Up> up = std::nullopt;
  double scale = 1.0;  ///< metres per unit of the file, > 0; multiplies the unit that a COLLADA file names
};

/// Reads the triangles of a mesh file in any format of Assimp (PLY, OBJ, STL, glTF, COLLADA ...), with the
/// transforms of its nodes applied. Points, lines, degenerate polygons, materials and textures are ignored. Throws
/// std::runtime_error with the path if the file is missing or damaged, has no triangle or less than it announces,
/// has a vertex that is not finite, a face with a corner that does not exist or with more than 1000 corners, or
/// more than 2^27 vertices. Throws std::invalid_argument for a scale that is not positive.
[[nodiscard]] TriangleMesh read_mesh_file(const std::filesystem::path& path, const MeshFileOptions& options = {});

}  // namespace vantage
