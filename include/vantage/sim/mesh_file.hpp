// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vantage/compiler.hpp>
#include <vantage/sim/triangle_mesh.hpp>

namespace VANTAGE_EXPORT vantage {

/// How to take the coordinates of a mesh file.
struct MeshFileOptions {
  /// Which axis of the file points up.
  enum class Up : std::uint8_t { Y, Z };
  /// Which axis of the file's coordinates points up; Y is turned about x so that z points up. None: as the file has
  /// it. COLLADA files say (`up_axis`), in glTF it is y by definition, and in other formats z is taken.
  std::optional<Up> up = std::nullopt;
  double scale = 1.0;  ///< metres per unit of the file, > 0; a COLLADA file's own unit counts besides
};

/// The triangles of a mesh file in any format that Assimp reads (PLY, OBJ, STL, glTF, COLLADA ...), with the
/// transforms of its nodes applied. Points, lines and degenerate polygons are left out; materials and textures do not
/// matter. Throws std::runtime_error, naming the path, if the file is missing or damaged, holds no triangle or only a
/// part of what it names, has a vertex that is not finite, a face whose corner does not exist or with more than 1000
/// corners, or more than 2^27 vertices; and std::invalid_argument for a scale that is not positive.
[[nodiscard]] TriangleMesh read_mesh_file(const std::filesystem::path& path, const MeshFileOptions& options = {});

}  // namespace vantage
