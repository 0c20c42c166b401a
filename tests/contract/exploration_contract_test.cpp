// SPDX-License-Identifier: MIT
// Properties that every planner must have with its default settings, over buildings with moving objects and windows
// of real ones, imperfect hosts, ideal and usual sensors, cell sizes, 3D and 2D. VANTAGE_CONTRACT_SEEDS: number of
// worlds per planner and host. VANTAGE_CONTRACT_FIRST_SEED: the first one.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <memory>
#include <numbers>
#include <ostream>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <vantage/evaluation/exploration_peers.hpp>
#include <vantage/planner/assume_free.hpp>
#include <vantage/planner/make_planner.hpp>
#include <vantage/planner/tour_planner.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/robot/ground_robot.hpp>
#include <vantage/sim/world.hpp>
#include <vector>

#include "contract/asked_goals.hpp"
#include "contract/changing_world.hpp"
#include "contract/real_building.hpp"
#include "contract/slow_audit.hpp"
#include "support/every_planner.hpp"
#include "support/real_data.hpp"
#include "support/sanitized.hpp"

namespace vantage {
namespace {

using detail::length_m;
using testing::Building;
using testing::ChangingWorld;

constexpr std::size_t kMostPlans = 1000;

enum class Host : std::uint8_t {
  Perfect,
  StopsShort,      // by up to 0.3 m and 15 degrees
  AbortsSilently,  // one goal in three, half-way
  AbortsAndReports,
  MovedByHand,  // every fifth time
  Inexact,      // 1 cm and half a degree off its estimated pose
  OffCentre,
  InACorner,
  PlansFromACopy,  // a new copy of the map for each plan
  Stuck,           // never moves and does not report it
  PlansOnItsWay,   // after three cells, with a motion model
};
constexpr std::uint32_t kHosts = 11;

std::string name_of(Host host) {
  static const std::vector<std::string> names{
      "perfect",           "stops_short", "aborts_silently", "aborts_and_reports",
      "moved_by_hand",     "inexact",     "off_centre",      "in_a_corner",
      "plans_from_a_copy", "stuck",       "plans_on_its_way"};
  return names[static_cast<std::size_t>(host)];
}

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

  /// Enumerates combinations of building, sensor, cell size and dimension.
  static Scene numbered(std::uint32_t number) {
    const std::uint32_t kind = number * 37 % 90;
    return {static_cast<Building>(kind % testing::kBuildings), number, kind / 5 % 3,
            std::array{0.1, 0.2, 0.4}[kind / 15 % 3], kind / 45 == 1};
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
  [[nodiscard]] ChangingWorld world() const {
    ChangingWorld made = real != nullptr ? testing::window_of(*real, seed, cell_m, body_cells)
                                         : testing::make_changing_world(building, seed, cell_m, flat);
    made.inset = inset;
    return made;
  }
  /// Surfaces on the faces of cells are mapped on both sides of them if poses are off by a hair, and then the body
  /// does not fit through doorways. So this host meets surfaces that lie in their cells, as most do.
  [[nodiscard]] Scene met_by(Host host) const {
    Scene scene = *this;
    scene.inset = host == Host::Inexact ? 0.25 : 0.0;
    return scene;
  }
  /// Kind 0 looks all around, 1 ahead, 2 all around near the horizon. Without `reports_no_return`, 1 and 2 are a
  /// usual depth camera and a usual lidar, which see nothing nearer than two cells.
  [[nodiscard]] RangeSensor sensor() const {
    constexpr double kPi = std::numbers::pi;
    const double tall = flat ? 0.001 : 1.0;
    const double near_m = reports_no_return ? 0.0 : 2.0 * cell_m;
    const auto rows = [&](std::size_t count) { return flat ? std::size_t{1} : count; };
    RangeSensor sensor =
        sensor_kind == 0 ? RangeSensor::spherical(180, rows(90), 2 * kPi, tall * kPi, near_m, 15.0 * cell_m)
        : sensor_kind == 1
            ? RangeSensor::pinhole(96, rows(72), 70.0 * kPi / 180.0, tall * 0.95, near_m, 25.0 * cell_m)
            : RangeSensor::spherical(240, rows(16), 2 * kPi, tall * 0.52, near_m, 25.0 * cell_m);
    sensor.reports_no_return = reports_no_return;
    return sensor;
  }
  [[nodiscard]] std::shared_ptr<const Platform> platform() const {
    const double radius_m = body_cells * cell_m;
    if (flat) {
      return std::make_shared<GroundRobot>(GroundRobotOptions{.radius_m = radius_m});
    }
    return std::make_shared<FreeFlyer>(FreeFlyerOptions{.radius_m = radius_m, .yaw_only = sensor_kind == 2});
  }
};

std::ostream& operator<<(std::ostream& out, const Scene& scene) {
  return out << "scene " << scene.seed << " ("
             << (scene.real != nullptr ? scene.real->name
                                       : "building " + std::to_string(static_cast<int>(scene.building)))
             << ", sensor " << scene.sensor_kind << (scene.reports_no_return ? "" : " without no-return")
             << ", cells of " << scene.cell_m << " m, body of " << scene.body_cells << " cells, "
             << (scene.flat ? "plane" : "space") << ")";
}

Pose along(const std::vector<Pose>& path, double way_m) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double step_m = (path[i].translation() - path[i - 1].translation()).norm();
    if (way_m < step_m) {
      Pose pose = path[i];
      pose.translation() =
          path[i - 1].translation() + way_m / step_m * (path[i].translation() - path[i - 1].translation());
      return pose;
    }
    way_m -= step_m;
  }
  return path.back();
}

bool same(const Plan& a, const Plan& b) {
  return a.outcome == b.outcome && a.leftover == b.leftover && a.goal.pose.matrix() == b.goal.pose.matrix() &&
         a.goal.utility == b.goal.utility && a.sought == b.sought && a.path.size() == b.path.size() &&
         std::equal(a.path.begin(), a.path.end(), b.path.begin(),
                    [](const Pose& p, const Pose& q) { return p.matrix() == q.matrix(); });
}

// A planner, or a peer of that name.
std::unique_ptr<ExplorationPlanner> planner_named(const std::string& name, const PlannerSetup& setup) {
  const auto peers = exploration_peer_names();
  return std::find(peers.begin(), peers.end(), name) != peers.end() ? make_exploration_peer(name, setup)
                                                                    : make_planner(name, setup);
}

/// A robot, its host and the results of the run.
class DrivenRobot {
 public:
  DrivenRobot(const std::string& planner, Host host, const Scene& scene)
      : host_(host),
        scene_(scene),
        world_(scene.world()),
        sensor_(scene.sensor()),
        platform_(scene.platform()),
        map_({.resolution_m = scene.cell_m, .region = world_.frame.box_of(world_.solid.box())}),
        engine_(scene.seed),
        planner_(planner_named(planner, setup(1))),
        on_threads_(planner_named(planner, setup(2))) {
    const double cell = scene.cell_m;
    Eigen::Vector3d at = world_.frame.centre_of(world_.start);
    if (host == Host::OffCentre) {
      at += cell * Eigen::Vector3d(0.31, -0.22, scene.flat ? 0.0 : 0.13);
    } else if (host == Host::InACorner) {
      at = cell * Eigen::Vector3d::Constant(1.0 + scene.body_cells + 1e-3);
      at.z() = scene.flat ? 0.5 * cell : at.z();
    }
    pose_ = pose_looking(at, 0.3);
    assume_free(map_, *platform_, pose_, start_clearance_m(*platform_, sensor_));
    for_each_cell(world_.solid.box(), [&](const VoxelIndex& at_cell) {
      if (world_.is_solid(at_cell)) {
        map_.set(at_cell, Occupancy::Unknown);  // the operator does not declare solid cells free
      }
    });
    look();
    explore();
  }

  std::size_t plans = 0;
  double gone_m = 0.0;
  Plan last;
  std::size_t collisions = 0;      // poses in which the body overlaps a solid cell that the map does not hold free
  std::set<VoxelIndex> misled_by;  // solid cells that it overlaps and that the map holds free
  testing::AskedGoals asked;
  std::size_t disagreements = 0;  // between plans of one and of two threads
  std::size_t thrown = 0;

  [[nodiscard]] std::vector<VoxelIndex> left() const {
    return testing::still_observable(map_, *platform_, sensor_, pose_, looked_);
  }
  /// Whether a person or a door is so near that the map may show no space for the body.
  [[nodiscard]] bool ends_beside_a_moving_object() const { return meets_a_moving_object(pose_, scene_.cell_m); }
  [[nodiscard]] double coverage() const {
    OccupancyMap truth({.resolution_m = scene_.cell_m, .region = world_.frame.box_of(world_.solid.box())});
    for_each_cell(world_.solid.box(), [&](const VoxelIndex& cell) {
      truth.set(cell, world_.is_solid(cell) ? Occupancy::Occupied : Occupancy::Free);
    });
    std::vector<VoxelIndex> places{world_.start};
    std::set<VoxelIndex> known(places.begin(), places.end());
    for (std::size_t next = 0; next < places.size(); ++next) {
      for (const VoxelIndex& step : kFaceNeighbours) {
        const VoxelIndex cell = places[next] + step;
        if (platform_->admits_cell(truth, cell) && !world_.has_sheet(cell) && known.insert(cell).second) {
          places.push_back(cell);
        }
      }
    }
    std::size_t observable = 0;
    std::size_t seen = 0;
    for_each_cell(world_.solid.box(), [&](const VoxelIndex& cell) {
      const Eigen::Vector3d centre = world_.frame.centre_of(cell);
      const auto sees = [&](const VoxelIndex& place) {
        const Eigen::Vector3d from = world_.frame.centre_of(place);
        const Pose facing = platform_->facing(from, centre - from);
        return (centre - from).norm() >= sensor_.min_range_m && (centre - from).norm() <= sensor_.max_range_m &&
               sensor_.in_view(facing.linear().transpose() * (centre - from)) && world_.in_sight(from, cell);
      };
      if (!world_.is_solid(cell) && (known.contains(cell) || std::any_of(places.begin(), places.end(), sees))) {
        ++observable;
        seen += map_.at(cell) != Occupancy::Unknown ? 1U : 0U;
      }
    });
    EXPECT_GT(observable, 50U);
    return static_cast<double>(seen) / static_cast<double>(observable);
  }

 private:
  // A robot that plans on its way has a motion model.
  [[nodiscard]] PlannerSetup setup(int threads) const {
    PlannerSetup setup{.sensor = sensor_, .platform = platform_, .seed = 7, .threads = threads};
    if (host_ == Host::PlansOnItsWay) {
      setup.motion = TourPlanner::default_motion();
    }
    return setup;
  }
  double draw(double from, double to) { return std::uniform_real_distribution<double>(from, to)(engine_); }

  void look() {
    Scan scan = testing::scan_of(world_, sensor_, truly_at());
    scan.world_from_sensor = pose_;
    map_.insert(scan);
    looked_.looks.push_back({pose_, map_});
    world_.tick(pose_.translation());
  }
  // The true pose when the robot believes that it is at `pose_`.
  Pose truly_at() {
    if (host_ != Host::Inexact) {
      return pose_;
    }
    const Eigen::Vector3d off(draw(-1, 1), draw(-1, 1), scene_.flat ? 0.0 : draw(-1, 1));
    Pose pose = pose_;
    pose.linear() =
        Eigen::AngleAxisd(draw(-0.5, 0.5) * std::numbers::pi / 180.0, Eigen::Vector3d::UnitZ()) * pose_.linear();
    pose.translation() += 0.01 * off.normalized();
    return pose;
  }

  Plan plan() {
    if (host_ != Host::PlansFromACopy) {
      const Plan made = planner_->plan(map_, pose_);
      if (host_ == Host::Perfect) {
        disagreements += same(made, on_threads_->plan(map_, pose_)) ? 0U : 1U;
      }
      return made;
    }
    const OccupancyMap copy = map_;
    return planner_->plan(copy, pose_);
  }

  void explore() {
    std::size_t waits = 0;
    for (; plans < kMostPlans; ++plans) {
      last = plan();
      if (last.outcome != Outcome::Move && last.outcome != Outcome::Explored && !world_.is_static() && waits < 30) {
        ++waits;  // as the contract asks: plan again later
        asked.begin_again();
        look();
        continue;
      }
      if (last.outcome != Outcome::Move) {
        return;
      }
      asked.count(last, pose_, map_);
      for (const VoxelIndex& cell : last.sought) {
        looked_.sought[cell].insert(map_.frame().cell_of(last.goal.pose.translation()));
      }
      go();
      look();
    }
  }

  void go() {
    const double whole_m = length_m(last.path);
    double way_m = whole_m;
    Pose end = last.goal.pose;
    if (host_ == Host::Stuck) {
      return;
    }
    const bool aborts = (host_ == Host::AbortsSilently || host_ == Host::AbortsAndReports) && engine_() % 3 == 0;
    if (aborts) {
      way_m = 0.5 * whole_m;
      end = along(last.path, way_m);
    } else if (host_ == Host::PlansOnItsWay && whole_m > 3.0 * scene_.cell_m) {
      way_m = 3.0 * scene_.cell_m;
      end = along(last.path, way_m);
    } else if (host_ == Host::StopsShort) {
      way_m = std::max(0.0, whole_m - draw(0.0, 0.3));
      const double off_rad = draw(-15.0, 15.0) * std::numbers::pi / 180.0;
      end.translation() = along(last.path, way_m).translation();
      end.linear() = Eigen::AngleAxisd(off_rad, Eigen::Vector3d::UnitZ()) * end.linear();
    }
    const std::vector<VoxelIndex> leaves = static_cells_in(pose_);
    for (double at_m = 0.0; at_m < way_m; at_m += 0.5 * scene_.cell_m) {
      if (meets_a_moving_object(along(last.path, at_m + 0.5 * scene_.cell_m))) {  // the controller stops
        way_m = at_m;
        end = along(last.path, at_m);
      }
      count_collision(along(last.path, at_m), leaves);
    }
    count_collision(end, leaves);
    pose_ = end;
    gone_m += way_m;
    if (host_ == Host::AbortsAndReports) {
      planner_->report(map_, pose_, aborts ? GoalResult::Failed : GoalResult::Reached);
    }
    if (host_ == Host::MovedByHand && plans % 5 == 4) {
      carry();
    }
  }
  // Whether a person or a closing door is within `gap_m` of the sphere of the body.
  [[nodiscard]] bool meets_a_moving_object(const Pose& pose, double gap_m = 0.0) const {
    return !touched(pose, scene_.body_cells * scene_.cell_m + gap_m, [&](const VoxelIndex& cell) {
              return world_.solid.value_or(cell, 1) == 0 && world_.is_solid(cell);
            }).empty();
  }
  // A ray through the edge of a solid cell may clear it in the map; then the map is wrong, not the plan. If a later
  // scan corrects the map, the body has to leave these cells, which were counted when it came.
  void count_collision(const Pose& pose, const std::vector<VoxelIndex>& leaves) {
    bool collides = false;
    for (const VoxelIndex& cell : static_cells_in(pose)) {
      if (std::find(leaves.begin(), leaves.end(), cell) != leaves.end()) {
        continue;
      }
      if (map_.at(cell) == Occupancy::Free) {
        misled_by.insert(cell);
      } else {
        collides = true;
      }
    }
    collisions += collides ? 1U : 0U;
  }
  // The static solid cells that the sphere of the body overlaps.
  [[nodiscard]] std::vector<VoxelIndex> static_cells_in(const Pose& pose) const {
    // A host that is off by half a degree maps distant surfaces beside their true place.
    const double off_m = host_ == Host::Inexact ? 0.01 + 0.01 * sensor_.max_range_m : 1e-6;
    return touched(pose, scene_.body_cells * scene_.cell_m - off_m,
                   [&](const VoxelIndex& cell) { return world_.solid.value_or(cell, 1) != 0; });
  }
  template <class Solid>
  [[nodiscard]] std::vector<VoxelIndex> touched(const Pose& pose, double radius_m, Solid&& is_solid) const {
    const VoxelIndex at = world_.frame.cell_of(pose.translation());
    std::vector<VoxelIndex> cells;
    for_each_cell(VoxelBox{at, at + VoxelIndex{1, 1, 1}}.grown(2), [&](const VoxelIndex& cell) {
      if (is_solid(cell) && !(scene_.flat && cell.z != 0) &&
          world_.filled(cell).distance_to(pose.translation()) < radius_m) {
        cells.push_back(cell);
      }
    });
    return cells;
  }
  // Moves the robot to a random place where it fits.
  void carry() {
    for (int attempt = 0; attempt < 200; ++attempt) {
      Pose there = pose_;
      const VoxelIndex extent = world_.solid.box().extent();
      there.translation() = world_.frame.centre_of({static_cast<std::int32_t>(draw(1.0, extent.x - 1.0)),
                                                    static_cast<std::int32_t>(draw(1.0, extent.y - 1.0)),
                                                    scene_.flat ? 0 : static_cast<std::int32_t>(draw(2.0, 5.0))});
      if (static_cells_in(there).empty() && !world_.is_solid(world_.frame.cell_of(there.translation()))) {
        pose_ = there;
        assume_free(map_, *platform_, pose_);
        return;
      }
    }
  }

  Host host_;
  Scene scene_;
  ChangingWorld world_;
  RangeSensor sensor_;
  std::shared_ptr<const Platform> platform_;
  OccupancyMap map_;
  std::mt19937 engine_;
  std::unique_ptr<ExplorationPlanner> planner_;
  std::unique_ptr<ExplorationPlanner> on_threads_;
  Pose pose_ = Pose::Identity();
  testing::LookedAt looked_;
};

std::uint32_t number_from(const char* variable, std::uint32_t otherwise) {
  const char* const text = std::getenv(variable);
  return text != nullptr ? static_cast<std::uint32_t>(std::strtoul(text, nullptr, 10)) : otherwise;
}

// Runs to the end. Returns whether the run ended as it must.
bool expect_contract(const std::string& planner, Host host, const Scene& scene) {
  const DrivenRobot run(planner, host, scene);
  const std::string what = ::testing::PrintToString(scene) + ", " + planner + ", " + name_of(host) + ", " +
                           std::to_string(run.plans) + " plans, " + std::string(to_string(run.last.outcome)) + ": " +
                           run.last.reason;
  SCOPED_TRACE(what);
  EXPECT_LT(run.plans, kMostPlans) << "it does not end by itself";
  // A robot that is carried elsewhere, or cannot turn, may see no cell in which the body fits, and a person may stand
  // in front of the robot, or close to its body, for as long as it waits. Then the plan says what helps.
  const bool may_lack_space = host == Host::MovedByHand || host == Host::Stuck || run.ends_beside_a_moving_object();
  const bool may_not_move = host == Host::Stuck || !scene.world().is_static();
  if (run.last.outcome == Outcome::Blocked) {
    const auto says = [&](const char* remedy) { return run.last.reason.find(remedy) != std::string::npos; };
    EXPECT_TRUE((may_lack_space && says("assume_free")) || (may_not_move && says("free it")));
  }
  EXPECT_LE(run.misled_by.size(), 3U);
  EXPECT_EQ(run.collisions, 0U);
  EXPECT_EQ(run.disagreements, 0U) << "of one and two threads";
  EXPECT_LE(run.asked.most(), 2U) << "the same goal again and again";
  const bool all_is_seen = run.last.outcome == Outcome::Explored ||
                           run.last.reason.find("there is more to see from free space that is cut off") == 0;
  if (all_is_seen) {  // of what can be reached
    const std::vector<VoxelIndex> left = run.left();
    EXPECT_EQ(left.size(), 0U) << "still observable: " << left.front().x << " " << left.front().y << " "
                               << left.front().z;
  }
  // With walls between cells, the map decides which cells are free. A robot that is placed behind bars, or that
  // maps walls where none are, may be cut off and report that.
  const bool maps_walls_twice = host == Host::Inexact && scene.inset == 0.0;
  const bool may_be_cut_off =
      (host == Host::MovedByHand || maps_walls_twice) && run.last.outcome != Outcome::Explored;
  const bool ended = run.last.outcome != Outcome::Move;
  if (!scene.world().is_static() || scene.building == Building::Sheets || host == Host::Stuck || may_be_cut_off ||
      !ended) {
    return ended;
  }
  // In a window of a real building, a shaft may be free that a level sensor cannot see before it is in it, and
  // slivers may be in sight that hide behind a part of a cell; the audit judges there.
  if (scene.real == nullptr) {
    EXPECT_GE(run.coverage(), 0.99);
  }
  if (host != Host::Perfect) {
    const DrivenRobot perfect(planner, Host::Perfect, scene);
    if (host == Host::PlansOnItsWay) {
      EXPECT_LE(run.gone_m, 3 * perfect.gone_m + 5 * scene.cell_m) << "the perfect host goes " << perfect.gone_m;
    } else {
      EXPECT_LE(run.plans, 3 * perfect.plans + 5) << "the perfect host takes " << perfect.plans;
    }
  }
  return ended;
}

using Pair = std::tuple<std::string, Host>;

// Runs the scenes numbered `first`, `first + step`, ..., as many as the environment asks for.
template <class SceneOf>
void expect_contract_in_each(const Pair& pair, std::uint32_t step, SceneOf&& scene_of) {
  const auto& [planner, host] = pair;
  const std::uint32_t seeds = number_from("VANTAGE_CONTRACT_SEEDS", 1);
  const std::uint32_t first = number_from("VANTAGE_CONTRACT_FIRST_SEED", 1) + static_cast<std::uint32_t>(host);
  std::size_t ended = 0;
  for (std::uint32_t i = 0; i < seeds; ++i) {
    ended += expect_contract(planner, host, scene_of(first + i * step).met_by(host)) ? 1U : 0U;
  }
  EXPECT_EQ(ended, seeds);
}

// The step has no factor in common with the kinds of scenes, so that every host meets all of them.
constexpr std::uint32_t kStep = kHosts + 2;

class ExplorationContract : public ::testing::TestWithParam<Pair> {};

TEST_P(ExplorationContract, Holds) { expect_contract_in_each(GetParam(), kStep, Scene::numbered); }

class ExplorationContractOfUsualSensors : public ExplorationContract {};

TEST_P(ExplorationContractOfUsualSensors, Holds) {
  expect_contract_in_each(GetParam(), kStep, Scene::with_a_usual_sensor);
}

/// Buildings below VANTAGE_DATA: floor plans, worlds of aerial exploration, houses and offices with furniture.
const std::vector<World>& real_buildings() {
  static const std::vector<World> all = [] {
    std::vector<World> worlds;
    for (const char* file : {"floorplans/kth/50052748.yaml", "environments/aerial/complex_office.stl",
                             "floorplans/kth/50052750.yaml", "environments/aws_small_house/small_house_collision.ply",
                             "floorplans/kth/50015847.yaml", "environments/gazebo/collapsed_house.ply",
                             "environments/aerial/maze1.obj", "environments/gazebo/osrf_first_office.ply"}) {
      worlds.push_back(World::from_file(test::real_data(file)));
      worlds.back().name = file;
    }
    return worlds;
  }();
  return all;
}

class ExplorationContractInRealBuildings : public ExplorationContract {};

TEST_P(ExplorationContractInRealBuildings, Holds) {
  VANTAGE_REAL_DATA(data, "floorplans");
  expect_contract_in_each(GetParam(), kHosts, [](std::uint32_t number) {
    return Scene::in_real_building(real_buildings()[number / kHosts % real_buildings().size()], number);
  });
}

// The peers only choose; what they share with the planners keeps the contract. A sample of it.
TEST(ExplorationContractCase, PeersKeepIt) {
  std::size_t ended = 0;
  std::size_t runs = 0;
  for (const std::string_view peer : exploration_peer_names()) {
    for (std::uint32_t host = 0; host < kHosts; host += test::kSanitized ? 3 : 1) {
      const Scene scene = Scene::numbered(1 + host).met_by(static_cast<Host>(host));
      ended += expect_contract(std::string(peer), static_cast<Host>(host), scene) ? 1U : 0U;
      ++runs;
    }
  }
  EXPECT_EQ(ended, runs);
}

// Runs that once broke the contract, by what was wrong.

// A person stood in the way. The robot turned on the spot, and that passed for progress.
TEST(ExplorationContractCase, ATurnOnTheSpotIsNotNearer) {
  EXPECT_TRUE(expect_contract("harmonic", Host::StopsShort, Scene::numbered(5102)));
}
// A person who had gone still stood in the map on both sides of the robot, which then asked for free space around it.
TEST(ExplorationContractCase, BetweenObstaclesThatAreKnownNothingIsToBeDeclaredFree) {
  EXPECT_TRUE(expect_contract("frontier-gain", Host::StopsShort, Scene::numbered(5142)));
}
// The robot stopped beside a goal from which alone it could look through a crack, for another cell each time.
TEST(ExplorationContractCase, BesideAGoalTheRobotComesNoNearer) {
  EXPECT_TRUE(expect_contract("tour", Host::StopsShort, Scene::numbered(6052)));
}
// The robot never moved, and the goal turned a little towards it: that passed for progress.
TEST(ExplorationContractCase, AGoalThatComesNearerIsNoProgress) {
  EXPECT_TRUE(expect_contract("tour", Host::Stuck, Scene::numbered(101000)));
}
// A person stood before the robot for good, and goal after goal followed.
TEST(ExplorationContractCase, ARobotThatDoesNotMoveIsBlocked) {
  EXPECT_TRUE(expect_contract("nearest-frontier", Host::OffCentre, Scene::numbered(100947)));
}
// The robot was carried into cells that a neighbouring space touches across edges alone.
TEST(ExplorationContractCase, ARobotLeavesAPocketAslant) {
  EXPECT_TRUE(expect_contract("frontier-gain", Host::MovedByHand, Scene::numbered(100445)));
}
// A cell was in line with two corners of walls as seen from two places, and was given up.
TEST(ExplorationContractCase, ALineOfSightThroughACornerIsNoEvidence) {
  EXPECT_TRUE(expect_contract("frontier-gain", Host::MovedByHand, Scene::numbered(5115)));
}

// A surface that was found beside a cell hid it from both places that had looked; from elsewhere it could be seen.
TEST(ExplorationContractCase, ALookThatASurfaceCutsOffDoesNotEndARun) {
  EXPECT_TRUE(expect_contract("harmonic", Host::StopsShort, Scene::numbered(1009102)));
}
// All places that saw a cell lay close to one from which it had been looked at in vain.
TEST(ExplorationContractCase, OneLookDoesNotEndARun) {
  EXPECT_TRUE(expect_contract("nearest-frontier", Host::StopsShort, Scene::numbered(1009271)));
}
// An unknown cell that could only be seen at a corner hid others, and was no target.
TEST(ExplorationContractCase, ACellSeenAtACornerHidesOthers) {
  EXPECT_TRUE(expect_contract("frontier-void", Host::StopsShort, Scene::numbered(5090)));
}
// The host gave up half-way three times, each time nearer to the only place from which the rest can be seen.
TEST(ExplorationContractCase, AFailureThatBroughtTheRobotNearerIsNoReasonToGiveUp) {
  EXPECT_TRUE(expect_contract("frontier-gain", Host::AbortsAndReports, Scene::numbered(100415)));
}
// A person came below the robot and stayed there: the map showed no space for the body.
TEST(ExplorationContractCase, APersonBelowTheRobotLeavesNoSpaceInTheMap) {
  EXPECT_TRUE(expect_contract("harmonic", Host::Inexact, Scene::numbered(910032).met_by(Host::Inexact)));
}
// Walls stand on faces of cells, and poses are off by 1 cm: the map has them on both sides, and a doorway is closed.
// That is said. Where the same walls stand in their cells, the doorway is open.
TEST(ExplorationContractCase, WallsThatAreMappedTwiceCutOff) {
  for (const std::string_view planner : planner_names()) {
    const Scene scene = Scene::numbered(5105);
    EXPECT_TRUE(expect_contract(std::string(planner), Host::Inexact, scene));
    EXPECT_EQ(DrivenRobot(std::string(planner), Host::Inexact, scene).last.outcome, Outcome::Unreachable);
    EXPECT_TRUE(expect_contract(std::string(planner), Host::Inexact, scene.met_by(Host::Inexact)));
  }
}

std::vector<Host> hosts() {
  std::vector<Host> all;
  for (std::uint32_t i = 0; i < kHosts; ++i) {
    all.push_back(static_cast<Host>(i));
  }
  return all;
}

// A window of a real building has no corner that is known to be free.
std::vector<Host> hosts_in_real_buildings() {
  std::vector<Host> all = hosts();
  std::erase(all, Host::InACorner);
  return all;
}

std::string name_of_pair(const ::testing::TestParamInfo<Pair>& pair) {
  return test::test_name(std::get<0>(pair.param) + "_" + name_of(std::get<1>(pair.param)));
}

INSTANTIATE_TEST_SUITE_P(Every, ExplorationContract,
                         ::testing::Combine(::testing::ValuesIn(test::every_planner()), ::testing::ValuesIn(hosts())),
                         name_of_pair);
INSTANTIATE_TEST_SUITE_P(Every, ExplorationContractOfUsualSensors,
                         ::testing::Combine(::testing::ValuesIn(test::every_planner()), ::testing::ValuesIn(hosts())),
                         name_of_pair);
INSTANTIATE_TEST_SUITE_P(Every, ExplorationContractInRealBuildings,
                         ::testing::Combine(::testing::ValuesIn(test::every_planner()),
                                            ::testing::ValuesIn(hosts_in_real_buildings())),
                         name_of_pair);

TEST(ExplorationContractSuite, HoldsEveryPlannerToEveryHostInEveryKindOfWorld) {
  EXPECT_EQ(test::every_planner().size(), 6U);
  EXPECT_EQ(hosts().size(), kHosts);
  std::set<std::tuple<Building, std::size_t, double, bool>> kinds;
  for (std::uint32_t number = 0; number < 90; ++number) {
    const Scene scene = Scene::numbered(number);
    kinds.insert({scene.building, scene.sensor_kind, scene.cell_m, scene.flat});
  }
  EXPECT_EQ(kinds.size(), testing::kBuildings * 3 * 3 * 2);
}

}  // namespace
}  // namespace vantage
