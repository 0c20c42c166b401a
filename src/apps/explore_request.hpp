// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/height_band.hpp>
#include <vantage/planner/make_planner.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/report/run_recorder.hpp>
#include <vantage/robot/motion_model.hpp>
#include <vantage/sim/simulated_sensor.hpp>
#include <vantage/sim/world.hpp>
#include <vector>

namespace vantage::apps {

/// Options of `vantage explore` as typed.
struct ExploreRequest {
  std::string world;
  std::string up;               // "y" or "z"; empty: as the file says
  std::optional<double> scale;  // of a mesh file, metres per unit
  std::string size;
  std::string planner = "harmonic";
  std::string sensor = "panoramic";
  double resolution_m = 0.2;
  std::string region;
  std::string start;
  double robot_radius_m = 0.15;
  double scan_spacing_m = 0.5;
  std::optional<double> max_speed_m_s;  // these four, or none: the run is not timed
  std::optional<double> max_acceleration_m_s2;
  std::optional<double> max_yaw_rate_deg_s;
  std::optional<double> scan_rate_hz;
  std::optional<double> max_yaw_acceleration_deg_s2;  // these two only beside them
  std::optional<double> planning_latency_s;
  bool yaw_only = false;
  std::string band;
  bool no_floor = false;
  bool look_around = false;
  bool wear = false;
  bool bound = false;
  bool audit = false;
  bool no_coverage = false;
  double noise = 0.0;
  std::string pose_noise;  // "metres,degrees"
  std::size_t max_views = 500;
  double memory_limit_mb = 0.0;  // 10^6 bytes; 0: none
  std::uint64_t seed = 1;
  int threads = 1;
  std::string out;
  std::string json;
  bool quiet = false;
  std::vector<std::string> settings;
};

/// Calls `act`; the message of a std::invalid_argument from it gets the option in front.
template <class Act>
auto naming(const std::string& option, const Act& act) {
  try {
    return act();
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(option + ": " + error.what());
  }
}

// What the options mean. Each function throws std::invalid_argument or std::runtime_error with the option or file
// at fault.
[[nodiscard]] World world_of(const ExploreRequest& request);
/// Options of a mesh file, from `--up` and `--scale`.
[[nodiscard]] MeshFileOptions mesh_options_of(const ExploreRequest& request);
/// Whether `--world` is a file of this kind and not a name.
[[nodiscard]] bool is_world_file(const ExploreRequest& request, World::FileKind kind);
[[nodiscard]] RangeSensor sensor_of(const ExploreRequest& request);
[[nodiscard]] std::optional<Box> region_of(const ExploreRequest& request);
/// `--band`; none: the robot flies.
[[nodiscard]] std::optional<HeightBandOptions> band_of(const ExploreRequest& request);
/// `--max-speed` and its like; none: the run is not timed.
[[nodiscard]] std::optional<MotionModel> motion_of(const ExploreRequest& request);
[[nodiscard]] std::optional<Pose> start_of(const ExploreRequest& request);
[[nodiscard]] RunRecorderSetup recorder_setup(const ExploreRequest& request, const std::string& command,
                                              const std::string& world, const RangeSensor& sensor);
[[nodiscard]] Settings settings_of(const ExploreRequest& request);
/// The numbers of a list "1,2.5,-3" given to `flag`, each within +-10^6.
[[nodiscard]] std::vector<double> numbers_of(const char* flag, const std::string& text);
/// `--memory-limit` in bytes; 0: none.
[[nodiscard]] std::size_t max_bytes_of(double memory_limit_mb);
/// Noise of depth and poses, from `--noise` and `--pose-noise`.
[[nodiscard]] SensorNoise noise_of(const ExploreRequest& request);
/// The box "x0,y0,z0,x1,y1,z1" given to `flag`, metres.
[[nodiscard]] Box box_of(const char* flag, const std::string& text);
/// Checks numbers and ranges that need no file.
void check_numbers(const ExploreRequest& request);
/// Checks that a region holds a cell, can be addressed, and has no more cells than fit into memory: the ground truth
/// takes at least a byte per cell. `source` is what gave the region, for example "--world rooms".
void check_cells(const std::string& source, bool is_mesh, const Box& region, double resolution_m);

}  // namespace vantage::apps
