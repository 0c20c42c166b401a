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
// The wall behind the crates: its first cell along x.
constexpr std::int32_t kWall = 44;
// The mapped region, in cells: the layer of the floor and 1.5 m above it, 2.5 m wide.
constexpr VoxelBox kPlace{{-20, -50, -1}, {46, 50, 60}};
// The laboratory around it, so that a ray past the crates meets a surface within the range of a Kinect.
const Box kLaboratory{{-2.0, -2.0, -kCrateInsetM}, {kWall * 0.025 + kCrateInsetM, 2.0, 2.5}};

class CrateScene {
 public:
  CrateScene() : solid_(kPlace, 0) {
    fill({kPlace.lo, {kPlace.hi.x, kPlace.hi.y, 0}});
    fill({{kWall, kPlace.lo.y, 0}, kPlace.hi});
  }

  void fill(const VoxelBox& cells, std::uint8_t solid = 1) {
    for_each_cell(cells, [&](const VoxelIndex& cell) { solid_[cell] = solid; });
  }
  // A box with walls one cell thick.
  void closed_box(const VoxelBox& outside) {
    fill(outside);
    fill(outside.grown(-1), 0);
  }
  // A box with walls one cell thick and no lid.
  void open_box(const VoxelBox& outside) {
    fill(outside);
    fill({outside.lo + VoxelIndex{1, 1, 1}, outside.hi - VoxelIndex{1, 1, 0}}, 0);
  }
  void cut(const VoxelBox& opening) { fill(opening, 0); }
  // A two-by-four, 38 mm by 89 mm, along its own x axis, with its centre at `world_from_plank`.
  void plank(double length_m, const Pose& world_from_plank) {
    TriangleMesh wood;
    const Eigen::Vector3d half(0.5 * length_m, 0.5 * 0.089, 0.5 * 0.038);
    wood.add_box({-half, half});
    planks_.append(wood, world_from_plank);
  }

  // `searched` stands on the floor, against the wall.
  [[nodiscard]] World world(std::string name, const VoxelBox& searched) const {
    World world;
    world.name = std::move(name);
    world.mesh = surface_of_cells(solid_, kCells, kCrateInsetM, false);
    world.mesh.append(planks_);
    world.mesh.add_box(kLaboratory);
    world.region = kCells.box_of(kPlace);
    world.searched = kCells.box_of(searched);
    return world;
  }

 private:
  VoxelGrid<std::uint8_t> solid_;
  TriangleMesh planks_;
};

// Pose of a plank with its centre at `middle_m`, turned about the vertical, then with its far end lifted.
Pose lying(const Eigen::Vector3d& middle_m, double yaw_rad, double lift_rad = 0.0) {
  return Eigen::Translation3d(middle_m) * Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(-lift_rad, Eigen::Vector3d::UnitY());
}

}  // namespace

// A computer tower, two boxes open at the top, and three two-by-fours on the floor before them.
World crates_open_world() {
  CrateScene scene;
  scene.fill({{26, -26, 0}, {44, -18, 17}});
  scene.open_box({{24, -18, 0}, {44, 2, 10}});
  scene.open_box({{22, 2, 0}, {44, 22, 12}});
  scene.plank(0.9, lying({0.47, -0.1, 0.0205}, 1.5));
  scene.plank(0.7, lying({0.40, 0.2, 0.0205}, 1.75));
  scene.plank(0.5, lying({0.45, -0.55, 0.0205}, 1.2));
  return scene.world("crates-open", {{14, -27, 0}, {kWall, 23, 18}});
}

// Two large closed boxes that no view sees into, and three smaller ones with an opening: two on the large ones,
// open towards the robot, and one on the floor, open at the top.
World crates_closed_world() {
  CrateScene scene;
  scene.closed_box({{26, -24, 0}, {44, 0, 14}});
  scene.closed_box({{26, 0, 0}, {44, 24, 14}});
  scene.closed_box({{32, -18, 14}, {44, -4, 24}});
  scene.cut({{32, -15, 16}, {33, -7, 23}});
  scene.closed_box({{32, 6, 14}, {44, 20, 24}});
  scene.cut({{32, 9, 16}, {33, 17, 23}});
  scene.closed_box({{16, -6, 0}, {26, 6, 8}});
  scene.cut({{17, -4, 7}, {23, 4, 8}});
  return scene.world("crates-closed", {{14, -26, 0}, {kWall, 26, 24}});
}

}  // namespace vantage
