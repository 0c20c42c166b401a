// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/sim/object_scene.hpp>
#include <vantage/view/candidate_views.hpp>
#include <vantage/view/object_views.hpp>

#include <vantage/geometry/impl/dice.hpp>
#include <vantage/map/impl/plain_stream.hpp>

namespace vantage {
namespace {

// How far the body reaches, with room for cells that it touches.
double body_m(const ObjectSceneOptions& options) { return options.body_radius_m + 2.0 * options.resolution_m; }

// Memory and time follow the region, so it holds no more than the views and the ways between them need.
Box region_around(const ObjectScene& scene, const ObjectSceneOptions& options) {
  const double reach_m = *std::max_element(scene.radii_m.begin(), scene.radii_m.end()) +
                         std::max(0.5 * scene.box.extent().norm(), body_m(options));
  Box region{scene.box.centre().array() - reach_m, scene.box.centre().array() + reach_m};
  if (options.table && options.start) {
    region.extend(*options.start - Eigen::Vector3d::Constant(body_m(options)));
    region.extend(*options.start + Eigen::Vector3d::Constant(body_m(options)));
  }
  return region;
}

std::string comma_separated(const std::vector<double>& numbers) {
  detail::PlainStream text;
  text.precision(17);
  for (const double number : numbers) {
    text << (text.tellp() > 0 ? "," : "") << number;
  }
  return text.str();
}

}  // namespace

ObjectScene object_scene(const TriangleMesh& object, const RangeSensor& sensor, const ObjectSceneOptions& options) {
  ObjectScene scene;
  if (options.object_box) {
    scene.box = *options.object_box;
  } else {
    constexpr double kMarginM = 0.03;
    scene.box = object.bounds();
    scene.box.min.array() -= kMarginM;
    scene.box.max.array() += kMarginM;
    if (options.table) {  // leaves out the table itself
      scene.box.min.z() = std::max(scene.box.min.z(), kTableTopM + 0.5 * options.resolution_m);
    }
  }
  scene.radii_m = options.radii_m;
  if (scene.radii_m.empty()) {
    const double radius_m = fitting_radius_m(scene.box, sensor, options.resolution_m, body_m(options));
    scene.radii_m = {options.table ? std::min(radius_m, 1.5) : radius_m};
  }
  const Box around = region_around(scene, options);
  if (options.table) {
    scene.world = World::by_name("table");
    Box& room = scene.world.region;
    room = {room.min.cwiseMax(around.min), room.max.cwiseMin(around.max)};
  } else {
    scene.world.region = around;
  }
  scene.world.name = options.name;
  scene.world.mesh.append(object);
  return scene;
}

Settings planner_settings(const ObjectScene& scene) {
  const Box& box = scene.box;
  return {{"object", comma_separated({box.min.x(), box.min.y(), box.min.z(), box.max.x(), box.max.y(), box.max.z()})},
          {"radii_m", comma_separated(scene.radii_m)}};
}

namespace {

// How large the box appears from a pose far away: the area of its faces towards the pose as seen from there, of
// which only the part counts that nothing outside of the box hides.
double apparent_area_m2(const Box& box, const Truth& truth, const Pose& pose) {
  constexpr int kPoints = 6;  // per edge of a face
  const VoxelFrame& frame = truth.map().frame();
  const VoxelBox inside = frame.cells_touched_by(box);
  const Eigen::Vector3d from = pose.translation();
  const Eigen::Vector3d axis = optical_axis(pose);
  double area_m2 = 0.0;
  for (int normal = 0; normal < 3; ++normal) {
    const int across = (normal + 1) % 3;
    const int along = (normal + 2) % 3;
    Eigen::Vector3d point;
    point[normal] = axis[normal] < 0.0 ? box.max[normal] : box.min[normal];
    int open = 0;
    for (int i = 0; i < kPoints * kPoints; ++i) {
      const int column = i % kPoints;
      const int row = i / kPoints;
      point[across] = box.min[across] + box.extent()[across] * (column + 0.5) / kPoints;
      point[along] = box.min[along] + box.extent()[along] * (row + 0.5) / kPoints;
      bool hidden = false;
      for (const VoxelIndex& cell : VoxelRay(frame, from, point)) {
        hidden = hidden || (!inside.contains(cell) && truth.map().at(cell) == Occupancy::Occupied);
      }
      open += hidden ? 0 : 1;
    }
    area_m2 += std::abs(axis[normal]) * box.extent()[across] * box.extent()[along] * open / (kPoints * kPoints);
  }
  return area_m2;
}

}  // namespace

Pose draw_first_view(const ObjectScene& scene, const Truth& truth, const Platform& platform, std::uint64_t seed) {
  const std::vector<double> radius{scene.radii_m.front()};
  std::vector<std::pair<double, Pose>> views;
  double largest = 0.0;
  for (const Pose& view : views_around(scene.box.centre(), radius)) {
    const Pose pose = platform.facing(view.translation(), optical_axis(view));
    if (platform.admits(truth.map(), pose)) {
      views.emplace_back(apparent_area_m2(scene.box, truth, pose), pose);
      largest = std::max(largest, views.back().first);
    }
  }
  std::erase_if(views, [&](const auto& view) { return view.first < 0.9 * largest; });
  if (views.empty()) {
    throw std::invalid_argument("the robot's body fits nowhere on the first shell of views, " +
                                std::to_string(radius.front()) + " m around the object");
  }
  detail::Dice dice(seed);
  return views[dice.below(views.size())].second;
}

}  // namespace vantage
