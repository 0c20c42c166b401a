// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vantage/compiler.hpp>
#include <vantage/map/height_band.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/report/run_record.hpp>
#include <vantage/robot/motion_model.hpp>
#include <vantage/robot/platform.hpp>
#include <vantage/sim/seen_surface.hpp>
#include <vantage/sim/simulated_sensor.hpp>
#include <vantage/sim/triangle_scene.hpp>
#include <vantage/sim/truth.hpp>
#include <vantage/sim/world.hpp>
#include <vector>

namespace vantage::detail {
class TimedRobot;
}

namespace VANTAGE_EXPORT vantage {

/// Map, budgets, motion, noise and measurements of an ExplorationRun.
struct ExplorationRunOptions {
  /// The map; without a region it gets that of the world. In a world that is a plane, z of the region is ignored:
  /// the map is the layer of cells above z = 0.
  OccupancyMapOptions map = {};
  /// The robot drives and explores the plane of these heights: the planner gets the plane of the HeightBand
  /// instead of the map, and coverage and collisions are those of the plane. The map's region is extended down to
  /// where a step ends, and the floor around the start is declared (start_floor_m) where there is one. None: the
  /// robot flies.
  std::optional<HeightBandOptions> band = std::nullopt;
  /// Radius around the sensor in which truly free cells are declared free at the start, metres, in [0, 5]
  /// (assume_free, start_clearance_m). The space of the body is always declared free.
  double start_clearance_m = 0.0;
  /// How the map draws the rays of a scan.
  RayPolicy ray_policy = RayPolicy::EveryReturn;
  std::size_t max_views = 500;  ///< budget of scans, > 0
  /// Budget of path, metres, > 0: the robot starts no path that would exceed it. None: no
  /// limit.
  std::optional<double> max_path_m = std::nullopt;
  double scan_spacing_m = 0.5;  ///< path length between two scans, metres, >= 0; 0: scans at goals only
  /// Limits of a timed run, in which the robot moves, turns, scans and plans in time; then `scan_spacing_m` has no
  /// effect. None: the robot is at each pose of its path at once.
  std::optional<MotionModel> motion = std::nullopt;
  /// Whether the robot turns once on the spot, level, scanning all around, before the first plan. A sensor with a
  /// narrow field of view does not see past what lies beside the body.
  bool look_around = false;
  std::uint64_t seed = 1;  ///< seed of the sensor's noise
  SensorNoise noise = {};  ///< noise of the simulated sensor
  /// Radius of the sphere for collisions with true surfaces, metres, >= 0. None: half the least extent of
  /// Platform::body_box, which includes a margin that the platform keeps.
  std::optional<double> body_radius_m = std::nullopt;
  int threads = 1;  ///< threads of the search for observable cells, > 0
  /// Whether coverage is measured. That takes finding all observable cells first: those of `unknown_box` if there
  /// is one.
  bool measure_coverage = true;
  /// Progress of that search, as Truth::observable reports it; may be empty.
  std::function<void(double share)> on_observable_share = {};
  /// Cells of the world that do not touch this box are known from the start, for example the room around an
  /// object; metres. None: nothing is known.
  std::optional<Box> unknown_box = std::nullopt;
  /// Boxes that are declared free before the first scan besides the space of the body, metres, world frame.
  std::vector<Box> declared_clear = {};
  /// Points on the surface of an object, world frame, metres. The share of them with a measured point within
  /// `surface_gap_m` is the surface coverage. Empty: it is not measured.
  std::vector<Eigen::Vector3d> surface_samples = {};
  double surface_gap_m = 0.005;  ///< metres, > 0; the default is that of the reference data of Vasquez-Gomez et al.
  /// Asked after every scan and after every plan; true ends the run as interrupted. May be empty.
  std::function<bool()> stop = {};
  /// The surface of an object; what images have shown of it is reported (SeenSurface). Empty: it is not measured.
  std::vector<SurfaceSample> object_surface = {};
};

/// Drives a planner through a known world to its end: scan, insert, plan, follow, and so on. On the path to a goal
/// the sensor scans every `scan_spacing_m`. The run plans again when `check` says that the plan is no longer good.
/// The same world, planner and options give the same record, except for computing times and memory.
///
/// A timed run (ExplorationRunOptions::motion) scans at a fixed rate. It asks for a plan from the pose of a scan,
/// under the same conditions as an untimed run, follows the previous plan for the planning latency, and joins the new
/// one without a stop if it can. The robot starts a trajectory only if it is known to be free up to where the robot
/// comes to rest. If a later scan closes it, the robot brakes.
class ExplorationRun {
 public:
  /// Called after every scan with its record and with the map that the planner plans in (`known`).
  using OnView = std::function<void(const ViewRecord&, const OccupancyMap&)>;

  /// Throws std::invalid_argument, which names the invalid option.
  ExplorationRun(const World& world, const RangeSensor& sensor, std::shared_ptr<const Platform> platform,
                 const ExplorationRunOptions& options = {});

  /// The ground truth that the run is measured by.
  [[nodiscard]] const Truth& truth() const { return truth_; }
  /// The surfaces of the world.
  [[nodiscard]] const TriangleScene& scene() const { return scene_; }
  /// The map of the last run. With a band it is the map from which the plane is projected.
  [[nodiscard]] const OccupancyMap& map() const { return map_; }
  /// The map that the planner plans in: the plane of the band, or else `map()`.
  [[nodiscard]] const OccupancyMap& known() const { return band_ ? band_->plane() : map_; }

  /// Throws std::invalid_argument if a run cannot start here: `start` is not rigid, outside the region, or not
  /// admitted in the true world.
  void check_start(const Pose& start) const;

  /// Runs until the planner is done, the budget is spent or ExplorationRunOptions::stop ends it. The space of the
  /// body at `start` is declared free first. Throws as `check_start`. A further run from the same start does not look
  /// for the observable cells again.
  RunRecord run(ExplorationPlanner& planner, const Pose& start, const OnView& on_view = {});

 private:
  struct Progress;
  void assume_start_free(const Pose& start);
  void scan(Progress& progress);
  // Turns once on the spot, with scans; in time if there is a robot.
  void look_around(Progress& progress, detail::TimedRobot* robot, const OnView& on_view);
  void plan(Progress& progress, ExplorationPlanner& planner);
  [[nodiscard]] bool goes_on(Progress& progress, ExplorationPlanner& planner, const OnView& on_view);
  void follow(Progress& progress, const OnView& on_view);
  void fly(Progress& progress, ExplorationPlanner& planner, const OnView& on_view);
  void fly_on(Progress& progress, detail::TimedRobot& robot, const OnView& on_view);
  void fly_until(Progress& progress, detail::TimedRobot& robot, double time_s);
  void scan_in_time(Progress& progress, const detail::TimedRobot& robot);
  [[nodiscard]] bool stopped() const { return options_.stop && options_.stop(); }
  void measure_observable(Progress& progress, const Pose& start) const;
  [[nodiscard]] bool collides(const Pose& from, const Pose& to, double radius_m) const;
  void move(Progress& progress, const Pose& to);
  static void turn_to(Progress& progress, const Pose& to);

  World world_;
  RangeSensor sensor_;
  std::shared_ptr<const Platform> platform_;
  ExplorationRunOptions options_;
  TriangleScene scene_;
  Truth truth_;
  OccupancyMap map_;
  std::optional<HeightBand> band_;
  std::vector<VoxelIndex> observable_;  // from the start of the latest run, because the next may start there, too
  std::optional<Pose> observable_from_;
};

}  // namespace vantage
