// SPDX-License-Identifier: MIT
#include <algorithm>
#include <benchmark/benchmark_scenes.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <vantage/geometry/box.hpp>
#include <vantage/view/candidate_views.hpp>
#include <vector>

namespace vantage {
namespace {

struct Ball {
  Eigen::Vector3d centre;
  double radius;
};

// Boxes and balls in a room, with ray intersections in closed form.
struct Scene {
  Box room;
  std::vector<Box> boxes;
  std::vector<Ball> balls;

  // Distance in metres from `from`, which must be in free space, along the unit vector `direction`.
  [[nodiscard]] double distance(const Eigen::Vector3d& from, const Eigen::Vector3d& direction) const {
    double nearest = slab(room, from, direction).second;
    for (const Box& box : boxes) {
      const auto [enter, leave] = slab(box, from, direction);
      nearest = enter > 0.0 && enter <= leave ? std::min(nearest, enter) : nearest;
    }
    for (const Ball& ball : balls) {
      const Eigen::Vector3d to_centre = ball.centre - from;
      const double along = to_centre.dot(direction);
      const double square = ball.radius * ball.radius - to_centre.squaredNorm() + along * along;
      if (square > 0.0 && along > std::sqrt(square)) {
        nearest = std::min(nearest, along - std::sqrt(square));
      }
    }
    return nearest;
  }

  static std::pair<double, double> slab(const Box& box, const Eigen::Vector3d& from,
                                        const Eigen::Vector3d& direction) {
    const Eigen::Array3d a = (box.min - from).array() / direction.array();
    const Eigen::Array3d b = (box.max - from).array() / direction.array();
    return {a.min(b).maxCoeff(), a.max(b).minCoeff()};
  }
};

Scene table_room(std::mt19937& engine) {
  Scene scene{{{-2, -2, 0}, {2, 2, 3.2}}, {{{-0.4, -0.6, 0.70}, {0.5, 0.6, 0.74}}}, {}};
  for (const double x : {-0.36, 0.41}) {
    for (const double y : {-0.56, 0.51}) {
      scene.boxes.push_back({{x, y, 0.0}, {x + 0.05, y + 0.05, 0.70}});
    }
  }
  scene.boxes.push_back({{1.2, -1.0, 0.0}, {1.98, 0.6, 1.8}});
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 8; ++i) {
    const double x = -0.3 + 0.7 * unit(engine);
    const double y = -0.5 + unit(engine);
    const double size = 0.04 + 0.06 * unit(engine);
    if (i % 2 == 0) {
      scene.boxes.push_back({{x, y, 0.74}, {x + size, y + 1.5 * size, 0.74 + 2.5 * size}});
    } else {
      scene.balls.push_back({{x, y, 0.74 + size}, size});
    }
  }
  return scene;
}

Scene hall(std::mt19937& engine) {
  Scene scene{{{-18, -9, 0}, {18, 9, 7}}, {}, {}};
  for (int x = -15; x <= 15; x += 6) {
    for (const double y : {-5.0, 5.0}) {
      scene.boxes.push_back({{x - 0.25, y - 0.25, 0}, {x + 0.25, y + 0.25, 7}});
    }
  }
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  while (scene.boxes.size() < 50) {
    const Eigen::Vector3d corner(-17 + 33 * unit(engine), -8.5 + 16 * unit(engine), 0);
    const Box crate{corner,
                    corner + Eigen::Vector3d(0.4 + unit(engine), 0.4 + unit(engine), 0.4 + 1.6 * unit(engine))};
    if (crate.distance_to({0, 0, 1}) > 1.0) {
      scene.boxes.push_back(crate);
    }
  }
  return scene;
}

// Whether a point is in the room and outside all objects.
bool is_open(const Scene& scene, const Eigen::Vector3d& point) {
  const auto holds = [&](const Box& box) { return box.contains(point); };
  const auto within = [&](const Ball& ball) { return (point - ball.centre).norm() < ball.radius; };
  return scene.room.contains(point) && std::none_of(scene.boxes.begin(), scene.boxes.end(), holds) &&
         std::none_of(scene.balls.begin(), scene.balls.end(), within);
}

}  // namespace

ObjectScene object_scene(double resolution_m, Surroundings surroundings, std::uint32_t seed) {
  std::mt19937 engine(seed);
  const Scene scene = table_room(engine);
  ObjectScene made{OccupancyMap({.resolution_m = resolution_m}), {}, {}};
  OccupancyMap& map = made.map;
  const VoxelFrame& frame = map.frame();
  made.object = frame.cells_centred_in({{-0.15, -0.2, 0.74}, {0.25, 0.2, 1.14}});
  if (surroundings == Surroundings::Known) {
    map.set_log_odds(frame.cells_centred_in(scene.room).grown(1), 3.5);
    for_each_cell(frame.cells_centred_in(scene.room), [&](const VoxelIndex& cell) {
      if (is_open(scene, frame.centre_of(cell))) {
        map.set_log_odds(cell, -2.0);
      }
    });
  } else {
    for (int i = 0; i < 6; ++i) {
      const double turn = i * std::numbers::pi / 3.0;
      const Eigen::Vector3d outwards(std::cos(turn), std::sin(turn), 0.0);
      const Eigen::Vector3d eye = 1.7 * outwards + Eigen::Vector3d(0.0, 0.0, 1.3);
      map.insert(
          table_scan(pose_looking_along(eye, i % 2 == 0 ? Eigen::Vector3d(-outwards) : outwards), 640, 480, seed));
    }
  }
  for_each_cell(made.object, [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Unknown); });
  map.insert(table_scan(640, 480, seed));
  const Eigen::Vector3d centre = frame.box_of(made.object).centre();
  for (const Eigen::Vector3d& direction : icosahedron_directions(2)) {
    const Eigen::Vector3d eye = centre + 1.5 * direction;
    if (map.at(frame.cell_of(eye)) == Occupancy::Free) {
      made.views.push_back(pose_looking_along(eye, centre - eye));
    }
  }
  return made;
}

Scan table_scan(const Pose& world_from_sensor, std::size_t width, std::size_t height, std::uint32_t seed) {
  std::mt19937 engine(seed);
  const Scene scene = table_room(engine);
  std::normal_distribution<double> noise(0.0, 0.001);
  const double focal_px = 525.0 * static_cast<double>(width) / 640.0;
  Scan scan;
  scan.width = width;
  scan.height = height;
  scan.world_from_sensor = world_from_sensor;
  const Eigen::Vector3d eye = world_from_sensor.translation();
  for (std::size_t row = 0; row < height; ++row) {
    for (std::size_t column = 0; column < width; ++column) {
      const Eigen::Vector3d pixel((static_cast<double>(column) - 0.5 * static_cast<double>(width - 1)) / focal_px,
                                  (static_cast<double>(row) - 0.5 * static_cast<double>(height - 1)) / focal_px, 1.0);
      const double range_m = scene.distance(eye, (scan.world_from_sensor.linear() * pixel).normalized());
      const double depth_m = range_m / pixel.norm();
      scan.points.push_back((pixel * (depth_m + noise(engine) * depth_m * depth_m)).cast<float>());
    }
  }
  return scan;
}

Scan table_scan(std::size_t width, std::size_t height, std::uint32_t seed) {
  const Eigen::Vector3d eye(-1.513, -1.327, 1.541);
  return table_scan(pose_looking_along(eye, Eigen::Vector3d(0.1, 0.05, 0.75) - eye), width, height, seed);
}

Scan hall_scan(std::uint32_t seed) {
  std::mt19937 engine(seed);
  const Scene scene = hall(engine);
  std::normal_distribution<double> noise(0.0, 0.01);
  Scan scan;
  scan.max_range_m = 20.0;
  scan.world_from_sensor = pose_looking({0.013, -0.027, 1.241}, 0.3);
  for (int row = 0; row < 64; ++row) {
    const double elevation = (-25.0 + 40.0 * row / 63.0) * std::numbers::pi / 180.0;
    for (int column = 0; column < 1024; ++column) {
      const double azimuth = 2.0 * std::numbers::pi * column / 1024.0;
      const Eigen::Vector3d ray(std::cos(elevation) * std::sin(azimuth), -std::sin(elevation),
                                std::cos(elevation) * std::cos(azimuth));
      const double range_m =
          scene.distance(scan.world_from_sensor.translation(), scan.world_from_sensor.linear() * ray) + noise(engine);
      if (range_m <= scan.max_range_m) {
        scan.points.push_back((ray * range_m).cast<float>());
      }
    }
  }
  std::shuffle(scan.points.begin(), scan.points.end(), engine);
  return scan;
}

}  // namespace vantage
