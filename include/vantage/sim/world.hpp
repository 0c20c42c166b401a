// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vantage/compiler.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/sim/ground_plan.hpp>
#include <vantage/sim/mesh_file.hpp>
#include <vantage/sim/triangle_mesh.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// What a generated world is drawn from.
struct WorldOptions {
  std::uint64_t seed = 1;  ///< office and maze only
  double length_m = 0.0;   ///< office and maze only: extent along x, 0 (the world's own) or in [4, 200]
  double width_m = 0.0;    ///< office and maze only: extent along y, 0 (the world's own) or in [4, 200]
};

/// A known world: its surfaces, and the region that an exploration of it means.
struct World {
  /// NAME or file.
  std::string name;
  TriangleMesh mesh;  ///< all surfaces, metres, z up
  Box region;         ///< metres; a closed world's walls are inside
  /// The part of the region that a search of voids means, metres; around it all is known before the first scan. None
  /// for most worlds.
  std::optional<Box> searched = std::nullopt;
  /// The world is a plane, that of these pixels; its mesh are their walls. None: it is a space.
  std::optional<GroundPlan> plan = std::nullopt;

  /// A world by NAME:
  /// - `rooms`: the test of Shade & Newman 2011: a closed cube of 10.2 m, 51 x 51 x 51 cells of 0.2 m, with
  /// horizontal
  ///   and vertical walls one cell thick and openings in them; it does not vary with the seed;
  /// - `office`: a corridor with furnished rooms on both sides, 20 x 14 x 3 m unless told;
  /// - `maze`: passages 1.4 m wide and 2 m high with a few loops, 13 x 10 m unless told;
  /// - `two-storey`: two floors of rooms joined by a stairwell, 12 x 9 x 5.8 m;
  /// - `table`: a table (top at z = 0.427277 m, x +-0.4, y +-0.5) in an empty room, x +-1.8, y +-1.8, z 0..2 m, as in
  ///   the reference data of Vasquez-Gomez et al.;
  /// - `crates-open`: a computer-sized block, two boxes open at the top and three two-by-fours, before the wall of a
  ///   laboratory at x = 1.1 m, y +-1.25 m, up to 1.5 m, and before a robot at the origin that faces +x: the first
  ///   scene of Dornhege & Kleiner 2011, in sizes of our own;
  /// - `crates-closed`: two large closed boxes and three smaller ones with small openings there: their second scene.
  /// The crates are made of cells of 0.025 m, with surfaces 2.5 mm inside them (planks lie askew); all others but the
  /// table are made of cells of 0.2 m, with surfaces 1 cm inside their cells (`surface_of_cells`). Throws
  /// std::invalid_argument listing the names if there is no such world, or naming the option at fault.
  [[nodiscard]] static World by_name(std::string_view name, const WorldOptions& options = {});
  /// The names `by_name` knows.
  [[nodiscard]] static const std::vector<std::string_view>& names();

  /// A mesh file as world, its region the mesh's bounds. Errors as `read_mesh_file`.
  [[nodiscard]] static World from_mesh_file(const std::filesystem::path& path, const MeshFileOptions& options = {});
  /// A map as ground truth: its free cells are the free space, and whatever bounds them is solid, occupied or not
  /// known: a truth with holes would have no end to explore. Throws std::invalid_argument if no cell is free.
  [[nodiscard]] static World from_map(std::string name, const OccupancyMap& map);
  /// A plane, for a robot that drives (GroundRobot) and a sensor of it (in_plane). A cell of it is
  /// occupied where any solid pixel reaches into it, however large its cells are. Throws std::invalid_argument as
  /// GroundPlan::validate.
  [[nodiscard]] static World from_plan(std::string name, GroundPlan plan);
  /// By what the file is: .yaml and .yml are nav2 maps (read_nav2_map), .bt and .ot OctoMaps (`options` has no say in
  /// either), everything else a mesh. Throws std::runtime_error naming the path.
  [[nodiscard]] static World from_file(const std::filesystem::path& path, const MeshFileOptions& options = {});
  /// What `from_file` takes a file of this name for.
  enum class FileKind : std::uint8_t { Mesh, OctoMap, Plan };
  /// By the ending of the name alone; the file need not exist.
  [[nodiscard]] static FileKind kind_of_file(const std::filesystem::path& path);
};

}  // namespace vantage
