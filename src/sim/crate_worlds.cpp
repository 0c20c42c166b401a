// SPDX-License-Identifier: MIT
#include "sim/crate_worlds.hpp"

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <utility>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/sim/triangle_mesh.hpp>

namespace vantage {
namespace {

constexpr VoxelFrame kCells{0.025};
constexpr double kCrateInsetM = 0.0025;
// What is searched: the floor's layer and 1.5 m above it, out to where a floor of 2.5 m by 2.5 m ends.
constexpr VoxelBox kPlace{{-20, -50, -1}, {80, 50, 60}};

class CrateScene {
 public:
  CrateScene() : solid_(kPlace, 0) { fill({kPlace.lo, {kPlace.hi.x, kPlace.hi.y, 0}}); }

  void fill(const VoxelBox& cells, std::uint8_t solid = 1) {
    for_each_cell(cells, [&](const VoxelIndex& cell) { solid_[cell] = solid; });
  }
  // A box with walls one cell thick.
  void closed_box(const VoxelBox& outside) {
    fill(outside);
    fill(outside.grown(-1), 0);
  }
  // The same without its lid.
  void open_box(const VoxelBox& outside) {
    fill(outside);
    fill({outside.lo + VoxelIndex{1, 1, 1}, outside.hi - VoxelIndex{1, 1, 0}}, 0);
  }
  void cut(const VoxelBox& opening) { fill(opening, 0); }
  // A two-by-four, 38 mm by 89 mm, with its length along its own x axis and its middle at `world_from_plank`.
  void plank(double length_m, const Pose& world_from_plank) {
    TriangleMesh wood;
    const Eigen::Vector3d half(0.5 * length_m, 0.5 * 0.089, 0.5 * 0.038);
    wood.add_box({-half, half});
    planks_.append(wood, world_from_plank);
  }

  [[nodiscard]] World world(std::string name) const {
    World world;
    world.name = std::move(name);
    world.mesh = surface_of_cells(solid_, kCells, kCrateInsetM, false);
    world.mesh.append(planks_);
    world.region = kCells.box_of(kPlace);
    return world;
  }

 private:
  VoxelGrid<std::uint8_t> solid_;
  TriangleMesh planks_;
};

// A plank whose middle is at `middle_m`, turned about the vertical and then lifted at its far end.
Pose lying(const Eigen::Vector3d& middle_m, double yaw_rad, double lift_rad = 0.0) {
  return Eigen::Translation3d(middle_m) * Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(-lift_rad, Eigen::Vector3d::UnitY());
}

}  // namespace

// A computer's tower, two boxes open at the top and some two-by-fours: one before the boxes, one leaning against the
// tower, one across the corner of a box.
World crates_open_world() {
  CrateScene scene;
  scene.fill({{26, 3, 0}, {44, 11, 17}});
  scene.open_box({{24, -24, 0}, {44, -8, 14}});
  scene.open_box({{46, 12, 0}, {62, 32, 16}});
  scene.plank(1.0, lying({0.53, 0.35, 0.0205}, 1.4));
  scene.plank(0.9, lying({1.27, -0.1, 0.235}, 1.9, 0.5));
  scene.plank(0.7, lying({0.95, -0.36, 0.372}, 0.7));
  return scene.world("crates-open");
}

// Two large closed boxes that nothing sees into, and smaller ones with a small opening each: two on the large ones,
// turned to the robot and aside, and one on the floor, open above.
World crates_closed_world() {
  CrateScene scene;
  scene.closed_box({{36, -28, 0}, {60, -6, 18}});
  scene.closed_box({{38, 4, 0}, {58, 28, 16}});
  scene.closed_box({{38, -24, 18}, {52, -10, 30}});
  scene.cut({{38, -20, 22}, {39, -14, 28}});
  scene.closed_box({{40, 8, 16}, {54, 24, 27}});
  scene.cut({{43, 8, 18}, {50, 9, 24}});
  scene.closed_box({{21, -6, 0}, {35, 8, 11}});
  scene.cut({{25, -2, 10}, {31, 4, 11}});
  return scene.world("crates-closed");
}

}  // namespace vantage
