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
#include <vantage/robot/platform.hpp>
#include <vantage/sim/seen_surface.hpp>
#include <vantage/sim/simulated_sensor.hpp>
#include <vantage/sim/triangle_scene.hpp>
#include <vantage/sim/truth.hpp>
#include <vantage/sim/world.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// How a simulated exploration goes.
struct ExplorationRunOptions {
  /// Without a region: the world's own. Where the world is a plane, z of a region counts for nothing: the map is the
  /// layer of cells above z = 0.
  OccupancyMapOptions map = {};
  /// The robot drives, and explores the plane of these heights: the planner gets the map's HeightBand instead of the
  /// map, and collisions and coverage are those of the plane. None: it flies, and explores space.
  std::optional<HeightBandOptions> band = std::nullopt;
  /// How far around the sensor the space at the start is declared free, where it truly is, metres, >= 0 (assume_free,
  /// start_clearance_m); the space of the body is in any case.
  double start_clearance_m = 0.0;
  /// How the map draws the rays of a scan.
  RayPolicy ray_policy = RayPolicy::EveryReturn;
  std::size_t max_views = 500;  ///< the budget, > 0
  double scan_spacing_m = 0.5;  ///< a scan every so far along the way, >= 0; 0: at goals only
  /// Whether it turns once on the spot, level, scanning all around, before the first plan. A sensor of a narrow view
  /// sees no way past what lies beside the body.
  bool look_around = false;
  std::uint64_t seed = 1;  ///< of the sensor's noise
  SensorNoise noise = {};  ///< of the simulated sensor
  /// Of the sphere whose touching a true surface is a collision, >= 0; none: half the least extent of
  /// Platform::body_box, which counts a margin that the platform keeps for planning as body.
  std::optional<double> body_radius_m = std::nullopt;
  int threads = 1;  ///< for the observable cells, > 0
  /// Whether coverage is measured, which takes finding all observable cells first: those of `unknown_box`, if there
  /// is one.
  bool measure_coverage = true;
  /// Told of that search as Truth::observable tells of it; none: nobody is.
  std::function<void(double share)> on_observable_share = {};
  /// Cells of the world that do not touch this box are known from the start, as a room may be in which an object is
  /// to be looked at; none: nothing is.
  std::optional<Box> unknown_box = std::nullopt;
  /// Boxes that the host declares free before the first scan, besides the space of the body.
  std::vector<Box> declared_clear = {};
  /// Points on the surface of an object; the share of them with a measured point within `surface_gap_m` is reported
  /// as surface coverage. None: that is not measured.
  std::vector<Eigen::Vector3d> surface_samples = {};
  double surface_gap_m = 0.005;  ///< > 0 (V-G, in the reference data)
  /// Asked after every scan, and after every plan before it is followed; true ends the run there, as interrupted.
  std::function<bool()> stop = {};
  /// The surface of an object of which is reported what the images have shown (SeenSurface). None: that is not
  /// measured.
  std::vector<SurfaceSample> object_surface = {};
};

/// Drives a planner through a known world to its end: scan, insert, plan, follow, and so on. On the way to a goal the
/// sensor scans every `scan_spacing_m`; when a scan shows that the rest of the way is no longer admitted, or has
/// resolved all that the plan sought, the run plans again. The same world, planner and options give the same record,
/// but for its times and memory.
class ExplorationRun {
 public:
  /// Called after every scan, with what was recorded and what the planner plans in (`known`) then.
  using OnView = std::function<void(const ViewRecord&, const OccupancyMap&)>;

  /// Throws std::invalid_argument naming the option at fault.
  ExplorationRun(const World& world, const RangeSensor& sensor, std::shared_ptr<const Platform> platform,
                 const ExplorationRunOptions& options = {});

  /// The true state of the world that the run is measured by.
  [[nodiscard]] const Truth& truth() const { return truth_; }
  /// The map of the last run, of space in any case.
  [[nodiscard]] const OccupancyMap& map() const { return map_; }
  /// What the planner plans in: the plane of the band, or without one the map.
  [[nodiscard]] const OccupancyMap& known() const { return band_ ? band_->plane() : map_; }

  /// Runs until the planner says that it is done, or the budget or ExplorationRunOptions::stop ends it. The space of
  /// the body at `start` is declared free first. Throws std::invalid_argument if the platform is not admitted at
  /// `start` in the true world.
  RunRecord run(ExplorationPlanner& planner, const Pose& start, const OnView& on_view = {});

 private:
  struct Progress;
  void check_start(const Pose& start) const;
  void assume_start_free(const Pose& start);
  void know_surroundings();
  void scan(Progress& progress);
  void look_around(Progress& progress, const OnView& on_view);
  void plan(Progress& progress, ExplorationPlanner& planner, Plan& plan);
  void follow(Progress& progress, const Plan& plan, const OnView& on_view);
  [[nodiscard]] bool stopped() const { return options_.stop && options_.stop(); }
  void measure_observable(Progress& progress, const Pose& start) const;
  [[nodiscard]] bool collides(const Pose& from, const Pose& to, double radius_m) const;
  void move(Progress& progress, const Pose& to);

  World world_;
  RangeSensor sensor_;
  std::shared_ptr<const Platform> platform_;
  ExplorationRunOptions options_;
  TriangleScene scene_;
  Truth truth_;
  OccupancyMap map_;
  std::optional<HeightBand> band_;
};

}  // namespace vantage
