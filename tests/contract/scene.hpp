// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <ostream>
#include <string>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/robot/ground_robot.hpp>
#include <vantage/sim/world.hpp>

#include "contract/barrier.hpp"
#include "contract/changing_world.hpp"
#include "contract/fenced_platform.hpp"
#include "contract/ground_world.hpp"
#include "contract/host.hpp"
#include "contract/real_building.hpp"
#include "contract/rod_body.hpp"

namespace vantage::testing {

/// A world, a sensor and a platform.
struct Scene {
  Building building = Building::Rooms;
  std::uint32_t seed = 1;
  std::size_t sensor_kind = 0;
  double cell_m = 0.2;
  bool flat = false;
  double body_cells = 0.7;      // radius
  const World* real = nullptr;  // instead of `building`, a window of it
  double inset = 0.0;           // of surfaces in their cells, cells
  bool reports_no_return = true;
  double rod_cells = 0.0;  // length of the rod of an outstretched body
  bool drives = false;     // on a floor, and plans in a band of heights
  bool pits = false;       // in that floor
  Barrier barrier = Barrier::None;

  /// Enumerates combinations of building, sensor, cell size and dimension.
  static Scene numbered(std::uint32_t number) {
    const std::uint32_t kind = number * 37 % 90;
    return {static_cast<Building>(kind % kBuildings), number, kind / 5 % 3, std::array{0.1, 0.2, 0.4}[kind / 15 % 3],
            kind / 45 == 1};
  }
  /// The same with a depth camera or a lidar as they are.
  static Scene with_a_usual_sensor(std::uint32_t number) {
    Scene scene = numbered(number);
    scene.sensor_kind = 1 + number % 2;
    scene.reports_no_return = false;
    return scene;
  }
  /// The same of windows of a real building.
  static Scene in_real_building(const World& real, std::uint32_t number) {
    return {Building::Rooms,
            number,
            number % 3,
            std::array{0.05, 0.1, 0.2, 0.4}[number / 3 % 4],
            real.plan.has_value(),
            number % 5 == 4 ? 1.6 : 0.7,
            &real};
  }
  /// The same of rooms with pits in the floor. Only the sensor that looks all around sees the floor beside the robot.
  static Scene over_pits(std::uint32_t number) {
    Scene scene{Building::Rooms, number, number % 3, std::array{0.1, 0.2, 0.4}[number / 3 % 3]};
    scene.drives = scene.pits = true;
    return scene;
  }
  [[nodiscard]] ChangingWorld world() const {
    ChangingWorld made = real != nullptr ? window_of(*real, seed, cell_m, body_cells)
                                         : make_changing_world(building, seed, cell_m, flat);
    made.inset = inset;
    set_barrier(made, barrier, 1);
    if (pits) {
      dig_pits(made, seed);
    }
    return made;
  }
  /// Surfaces on the faces of cells are mapped on both sides of them if poses are off by a hair, and then the body
  /// does not fit through doorways. So this host meets surfaces that lie in their cells, as most do.
  [[nodiscard]] Scene met_by(Host host) const {
    Scene scene = *this;
    scene.inset = host == Host::Inexact ? 0.25 : 0.0;
    scene.rod_cells = host == Host::Outstretched ? 1.5 : 0.0;
    return scene;
  }
  /// Whether the planner explores one layer of cells.
  [[nodiscard]] bool is_plane() const { return flat || drives; }
  [[nodiscard]] double radius_m() const { return body_cells * cell_m; }
  /// Kind 0 looks all around, 1 ahead, 2 all around near the horizon. Without `reports_no_return`, 1 and 2 are a
  /// usual depth camera and a usual lidar, which see nothing nearer than two cells.
  [[nodiscard]] RangeSensor sensor() const {
    constexpr double kPi = std::numbers::pi;
    const double tall = flat ? 0.001 : 1.0;
    const double near_m = reports_no_return ? 0.0 : 2.0 * cell_m;
    const auto rows = [&](std::size_t count) { return flat ? std::size_t{1} : count; };
    RangeSensor sensor =
        sensor_kind == 0   ? RangeSensor::spherical(180, rows(90), 2 * kPi, tall * kPi, near_m, 15.0 * cell_m)
        : sensor_kind == 1 ? RangeSensor::pinhole(96, rows(72), 70.0 * kPi / 180.0, tall * (drives ? 1.6 : 0.95),
                                                  near_m, 25.0 * cell_m)
                           : RangeSensor::spherical(240, rows(drives ? 32 : 16), 2 * kPi,
                                                    tall * (drives ? 1.2 : 0.52), near_m, 25.0 * cell_m);
    sensor.reports_no_return = reports_no_return;
    return sensor;
  }
  [[nodiscard]] std::shared_ptr<const Platform> platform() const {
    std::shared_ptr<const Platform> made;
    if (is_plane()) {
      made = std::make_shared<GroundRobot>(GroundRobotOptions{.radius_m = radius_m()});
    } else {
      made = std::make_shared<FreeFlyer>(FreeFlyerOptions{.radius_m = radius_m(), .yaw_only = sensor_kind == 2});
    }
    if (rod_cells > 0.0) {
      // A little thicker than it is, because its motions are sampled.
      made = std::make_shared<RodBody>(std::move(made), radius_m() + 0.1 * cell_m, rod_cells * cell_m, is_plane());
    }
    if (barrier == Barrier::Fence) {
      made = std::make_shared<FencedPlatform>(std::move(made), world().doorway);
    }
    return made;
  }
};

inline std::ostream& operator<<(std::ostream& out, const Scene& scene) {
  return out << "scene " << scene.seed << " ("
             << (scene.real != nullptr ? scene.real->name
                                       : "building " + std::to_string(static_cast<int>(scene.building)))
             << ", sensor " << scene.sensor_kind << (scene.reports_no_return ? "" : " without no-return")
             << ", cells of " << scene.cell_m << " m, body of " << scene.body_cells << " cells, "
             << (scene.flat     ? "plane"
                 : scene.drives ? "floor"
                                : "space")
             << ")";
}

}  // namespace vantage::testing
