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

/// Seed and size of the worlds that World::by_name generates.
struct WorldOptions {
  std::uint64_t seed = 1;  ///< random seed of `office` and `maze`
  double length_m = 0.0;   ///< extent along x of `office` and `maze`, metres: 0 (default of the world) or in [4, 200]
  double width_m = 0.0;    ///< extent along y, as `length_m`
};

/// A known world: its surfaces and the region to explore.
struct World {
  /// The name given to the function that made the world, or the file.
  std::string name;
  TriangleMesh mesh;  ///< all surfaces, metres, z up
  Box region;         ///< region to explore, metres; includes the walls of a closed world
  /// Part of the region that a search of voids covers, metres; the rest is known before the first scan. None for
  /// most worlds.
  std::optional<Box> searched = std::nullopt;
  /// The pixels of a world that is a plane; `mesh` then holds their walls. None: the world is a space.
  std::optional<GroundPlan> plan = std::nullopt;

  /// A world by NAME:
  /// - `rooms`: a closed cube of 10.2 m, 51 x 51 x 51 cells of 0.2 m, with horizontal and vertical walls one cell
  ///   thick and openings in them; independent of the seed (Shade & Newman 2011);
  /// - `office`: a corridor with furnished rooms on both sides, 20 x 14 x 3 m by default;
  /// - `maze`: passages 1.4 m wide and 2 m high with a few loops, 13 x 10 m by default;
  /// - `two-storey`: two floors of rooms joined by a stairwell, 12 x 9 x 5.8 m;
  /// - `table`: a table (top at z = 0.427277 m, x +-0.4, y +-0.5) in an empty room, x +-1.8, y +-1.8, z 0..2 m
  ///   (reference data of Vasquez-Gomez et al.);
  /// - `crates-open`: a block as large as a computer, two boxes open at the top and three planks before the wall
  ///   of a laboratory at x = 1.1 m, y +-1.25 m, up to 1.5 m, and before a robot at the origin that faces +x
  ///   (first scene of Dornhege & Kleiner 2011, in sizes of our own);
  /// - `crates-closed`: two large closed boxes and three smaller ones with small openings at the same place (their
  ///   second scene).
  ///
  /// The crates are made of cells of 0.025 m with surfaces 2.5 mm inside them (planks lie askew), all other worlds
  /// but `table` of cells of 0.2 m with surfaces 1 cm inside them (`surface_of_cells`). Throws
  /// std::invalid_argument if there is no such world, with the list of names, or with the option at fault.
  [[nodiscard]] static World by_name(std::string_view name, const WorldOptions& options = {});
  /// The names `by_name` knows.
  [[nodiscard]] static const std::vector<std::string_view>& names();

  /// Reads a mesh file; the region is the bounds of the mesh. Throws as read_mesh_file.
  [[nodiscard]] static World from_mesh_file(const std::filesystem::path& path, const MeshFileOptions& options = {});
  /// Makes a world of a map: free cells are free; everything else, occupied or unknown, is solid, so that the
  /// world is closed. Throws std::invalid_argument if no cell is free or the bounds of the known cells hold more than
  /// 10^9 cells.
  [[nodiscard]] static World from_map(std::string name, const OccupancyMap& map);
  /// Makes a world that is a plane, for a GroundRobot and a sensor of `in_plane`. A cell is occupied if any solid
  /// pixel reaches into it. Throws as GroundPlan::validate.
  [[nodiscard]] static World from_plan(std::string name, GroundPlan plan);
  /// Reads a world by the ending of its name: .yaml and .yml are nav2 maps (read_nav2_map), .bt and .ot OctoMaps,
  /// everything else is a mesh, for which `options` counts. Throws std::runtime_error with the path.
  [[nodiscard]] static World from_file(const std::filesystem::path& path, const MeshFileOptions& options = {});
  /// Kinds of world files.
  enum class FileKind : std::uint8_t { Mesh, OctoMap, Plan };
  /// The kind by the ending of the name alone; the file need not exist.
  [[nodiscard]] static FileKind kind_of_file(const std::filesystem::path& path);
};

}  // namespace vantage
