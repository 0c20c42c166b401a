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
/// transforms of its nodes applied. Points, lines and degenerate polygons are left out. Throws std::runtime_error,
/// naming the path, if the file is missing or cannot be read, holds no triangle, or has a vertex that is not finite;
/// and std::invalid_argument for a scale that is not positive.
[[nodiscard]] TriangleMesh read_mesh_file(const std::filesystem::path& path, const MeshFileOptions& options = {});

}  // namespace vantage
