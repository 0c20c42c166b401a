// SPDX-License-Identifier: MIT
#include "apps/explore_request.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vantage/report/sensor_file.hpp>

#include <vantage/settings/impl/option_rule.hpp>

namespace vantage::apps {
namespace {

template <class Names>
bool is_known(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

std::vector<double> numbers_of(const char* flag, const std::string& text) {
  constexpr double kFurthest = 1e6;
  std::vector<double> numbers;
  std::size_t at = 0;
  while (at <= text.size()) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    const char* end = text.data() + comma;
    double number = 0.0;
    const auto [stopped, error] = std::from_chars(text.data() + at, end, number);
    if (error != std::errc{} || stopped != end || !std::isfinite(number)) {
      throw std::invalid_argument(std::string(flag) + ": '" + text.substr(at, comma - at) + "' in '" + text +
                                  "' is not a number");
    }
    if (std::abs(number) > kFurthest) {
      throw std::invalid_argument(std::string(flag) + ": '" + text.substr(at, comma - at) + "' in '" + text +
                                  "' must be within 1e6 either way");
    }
    numbers.push_back(number);
    at = comma + 1;
  }
  return numbers;
}

std::size_t max_bytes_of(double memory_limit_mb) {
  detail::require_option(memory_limit_mb == 0.0 || (memory_limit_mb >= 0.01 && memory_limit_mb <= 1e9),
                         "--memory-limit", memory_limit_mb, "0 or in [0.01, 1e9] MB");
  return static_cast<std::size_t>(memory_limit_mb * 1e6);
}

void check_numbers(const ExploreRequest& request) {
  const auto require = [](double value, const char* option, double least, double most, const char* rule) {
    detail::require_option(value >= least && value <= most, option, value, rule);  // false for NaN
  };
  require(request.resolution_m, "--resolution", 1e-4, 100.0, "in [0.0001, 100] metres");
  require(request.scale.value_or(1.0), "--scale", 1e-6, 1e6, "in [1e-6, 1e6]");
  require(request.robot_radius_m, "--robot-radius", 0.0, 100.0, "in [0, 100] metres");
  require(request.scan_spacing_m, "--scan-spacing", 0.0, 1e6, "in [0, 1e6] metres");
  require(request.noise, "--noise", 0.0, 1000.0, "in [0, 1000]");
  (void)noise_of(request);
  (void)motion_of(request);
  (void)max_bytes_of(request.memory_limit_mb);
  detail::require_option(request.max_views > 0, "--max-views", request.max_views, "> 0");
  detail::require_option(request.threads > 0, "--threads", request.threads, "> 0");
  if (!request.up.empty() && request.up != "y" && request.up != "z") {
    throw std::invalid_argument("--up is '" + request.up + "', must be y or z");
  }
  if (request.yaw_only && !request.band.empty()) {
    throw std::invalid_argument("--yaw-only does not go with --band: a robot that drives is level anyhow");
  }
}

SensorNoise noise_of(const ExploreRequest& request) {
  SensorNoise noise{.axial = request.noise};
  if (!request.pose_noise.empty()) {
    const std::vector<double> n = numbers_of("--pose-noise", request.pose_noise);
    if (n.size() != 2 || n[0] < 0.0 || n[0] > 10.0 || n[1] < 0.0 || n[1] > 180.0) {
      throw std::invalid_argument("--pose-noise '" + request.pose_noise +
                                  "' must be two numbers, metres in [0, 10] and degrees in [0, 180]");
    }
    noise.position_m = n[0];
    noise.angle_rad = n[1] * std::numbers::pi / 180.0;
  }
  return noise;
}

void check_cells(const std::string& source, bool is_mesh, const Box& region, double resolution_m) {
  constexpr double kMostCells = 1e9;
  const VoxelFrame frame{resolution_m};
  const Eigen::Vector3d extent = region.extent();
  const double cells = (extent / resolution_m).prod();
  std::ostringstream what;
  if (!frame.addressable(region.min) || !frame.addressable(region.max)) {
    what << "the region begins at " << region.min.x() << ',' << region.min.y() << ',' << region.min.z()
         << " m, further from 0 than cells of --resolution " << resolution_m
         << " reach: move it, or take larger cells";
  } else if (frame.cells_centred_in(region).empty()) {
    what << "the region of " << extent.x() << " x " << extent.y() << " x " << extent.z() << " m holds no cell of "
         << resolution_m << " m: take smaller cells, --resolution";
  } else if (!(cells <= kMostCells)) {
    what << "--resolution " << resolution_m << " makes " << cells << " cells of the region, must be at most "
         << kMostCells << ": take larger cells, or a smaller region";
  } else {
    return;
  }
  throw std::invalid_argument(source + ": " + what.str() +
                              (is_mesh ? "; a mesh whose unit is not the metre needs --scale" : ""));
}

MeshFileOptions mesh_options_of(const ExploreRequest& request) {
  MeshFileOptions options{.scale = request.scale.value_or(1.0)};
  if (!request.up.empty()) {
    options.up = request.up == "y" ? MeshFileOptions::Up::Y : MeshFileOptions::Up::Z;
  }
  return options;
}

namespace {

// Refuses options for mesh files and generated worlds where they do not apply.
void check_world_options(const ExploreRequest& request) {
  const bool is_named = is_known(World::names(), request.world);
  if (!is_world_file(request, World::FileKind::Mesh) && (!request.up.empty() || request.scale)) {
    throw std::invalid_argument((request.up.empty() ? "--scale: " : "--up: ") + request.world + " is no mesh file");
  }
  if (!is_named && !request.size.empty()) {
    throw std::invalid_argument("--size: the world of a file has a size of its own");
  }
}

// From "LENGTH,WIDTH"; empty: the default of the world.
WorldOptions world_options_of(const ExploreRequest& request) {
  WorldOptions options{.seed = request.seed};
  if (!request.size.empty()) {
    const std::vector<double> n = numbers_of("--size", request.size);
    if (n.size() != 2) {
      throw std::invalid_argument("--size has " + std::to_string(n.size()) + " numbers, must be LENGTH,WIDTH");
    }
    if (n[0] <= 0.0 || n[1] <= 0.0) {
      throw std::invalid_argument("--size '" + request.size + "' must be two numbers > 0");
    }
    options.length_m = n[0];
    options.width_m = n[1];
  }
  return options;
}

}  // namespace

World world_of(const ExploreRequest& request) {
  const bool is_name = is_known(World::names(), request.world) ||
                       (!std::filesystem::exists(request.world) &&
                        request.world.find_first_of("./") == std::string::npos);  // then it lists the names
  if (is_name && !is_known(World::names(), request.world)) {
    return World::by_name(request.world);
  }
  check_world_options(request);
  if (!is_name) {
    return World::from_file(request.world, mesh_options_of(request));
  }
  const WorldOptions options = world_options_of(request);
  // The name is known to exist, so an error is about the size.
  return naming("--size '" + request.size + "'", [&] { return World::by_name(request.world, options); });
}

bool is_world_file(const ExploreRequest& request, World::FileKind kind) {
  return !is_known(World::names(), request.world) && World::kind_of_file(request.world) == kind;
}

RangeSensor sensor_of(const ExploreRequest& request) {
  const std::string& sensor = request.sensor;
  const bool is_file = sensor.size() > 5 && sensor.compare(sensor.size() - 5, 5, ".json") == 0;
  return is_file || std::filesystem::exists(sensor) ? load_sensor(sensor) : RangeSensor::preset(sensor);
}

std::optional<Box> region_of(const ExploreRequest& request) {
  if (request.region.empty()) {
    return std::nullopt;
  }
  return box_of("--region", request.region);
}

Box box_of(const char* flag, const std::string& text) {
  const std::vector<double> n = numbers_of(flag, text);
  if (n.size() != 6) {
    throw std::invalid_argument(std::string(flag) + " has " + std::to_string(n.size()) +
                                " numbers, must be x0,y0,z0,x1,y1,z1");
  }
  Box box{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}};
  if (box.empty()) {
    throw std::invalid_argument(std::string(flag) + " '" + text +
                                "' is empty: x0 < x1, y0 < y1 and z0 < z1 must hold");
  }
  return box;
}

std::optional<HeightBandOptions> band_of(const ExploreRequest& request) {
  if (request.band.empty()) {
    return std::nullopt;
  }
  const std::vector<double> n = numbers_of("--band", request.band);
  if (n.size() != 2 && n.size() != 3) {
    throw std::invalid_argument("--band has " + std::to_string(n.size()) + " numbers, must be LOW,HIGH[,SENSOR]");
  }
  if (!(n[0] <= n[1]) || (n.size() > 2 && !(n[0] <= n[2] && n[2] <= n[1]))) {
    throw std::invalid_argument("--band '" + request.band + "' must hold LOW <= SENSOR <= HIGH");
  }
  return HeightBandOptions{.min_height_m = n[0],
                           .max_height_m = n[1],
                           .sensor_height_m = n.size() > 2 ? n[2] : 0.5 * (n[0] + n[1]),
                           .needs_floor = !request.no_floor};
}

std::optional<MotionModel> motion_of(const ExploreRequest& request) {
  constexpr double kRadians = std::numbers::pi / 180.0;
  const std::array<std::pair<const char*, const std::optional<double>&>, 4> needed{{
      {"--max-speed", request.max_speed_m_s},
      {"--max-acceleration", request.max_acceleration_m_s2},
      {"--max-yaw-rate", request.max_yaw_rate_deg_s},
      {"--scan-rate", request.scan_rate_hz},
  }};
  const bool any = std::any_of(needed.begin(), needed.end(), [](const auto& option) { return option.second; }) ||
                   request.max_yaw_acceleration_deg_s2 || request.planning_latency_s;
  if (!any) {
    return std::nullopt;
  }
  for (const auto& [flag, value] : needed) {
    if (!value) {
      throw std::invalid_argument(std::string(flag) +
                                  " is missing: --max-speed, --max-acceleration, --max-yaw-rate and --scan-rate make "
                                  "a run timed together, --max-yaw-acceleration and --planning-latency only beside "
                                  "them");
    }
  }
  MotionModel motion{.max_speed_m_s = *request.max_speed_m_s,
                     .max_acceleration_m_s2 = *request.max_acceleration_m_s2,
                     .max_yaw_rate_rad_s = *request.max_yaw_rate_deg_s * kRadians,
                     .scan_rate_hz = *request.scan_rate_hz};
  if (request.max_yaw_acceleration_deg_s2) {
    motion.max_yaw_acceleration_rad_s2 = *request.max_yaw_acceleration_deg_s2 * kRadians;
  }
  motion.planning_latency_s = request.planning_latency_s.value_or(motion.planning_latency_s);
  const auto require = [](double value, const char* option, double least, double most, const char* rule) {
    detail::require_option(value >= least && value <= most, option, value, rule);
  };
  require(motion.max_speed_m_s, "--max-speed", 1e-3, 1e3, "in [0.001, 1000] metres per second");
  require(motion.max_acceleration_m_s2, "--max-acceleration", 1e-3, 1e4, "in [0.001, 10000] metres per second^2");
  require(*request.max_yaw_rate_deg_s, "--max-yaw-rate", 0.1, 36000.0, "in [0.1, 36000] degrees per second");
  require(request.max_yaw_acceleration_deg_s2.value_or(1.0), "--max-yaw-acceleration", 0.1, 360000.0,
          "in [0.1, 360000] degrees per second^2");
  require(motion.scan_rate_hz, "--scan-rate", 0.01, 1000.0, "in [0.01, 1000] hertz");
  require(motion.planning_latency_s, "--planning-latency", 0.0, 60.0, "in [0, 60] seconds");
  return motion;
}

std::optional<Pose> start_of(const ExploreRequest& request) {
  if (request.start.empty()) {
    return std::nullopt;
  }
  const std::vector<double> n = numbers_of("--start", request.start);
  if (n.size() < 3 || n.size() > 5) {
    throw std::invalid_argument("--start has " + std::to_string(n.size()) +
                                " numbers, must be x,y,z[,yaw_deg[,pitch_deg]]");
  }
  constexpr double kRadians = std::numbers::pi / 180.0;
  return pose_looking({n[0], n[1], n[2]}, n.size() > 3 ? n[3] * kRadians : 0.0, n.size() > 4 ? n[4] * kRadians : 0.0);
}

RunRecorderSetup recorder_setup(const ExploreRequest& request, const std::string& command, const std::string& world,
                                const RangeSensor& sensor) {
  return {.command = command,
          .world = world,
          .planner = request.planner,
          .seed = request.seed,
          .threads = request.threads,
          .sensor = sensor};
}

Settings settings_of(const ExploreRequest& request) {
  Settings settings;
  for (const std::string& setting : request.settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw std::invalid_argument("--set '" + setting + "' must be key=value");
    }
    if (!settings.try_emplace(setting.substr(0, equals), setting.substr(equals + 1)).second) {
      throw std::invalid_argument("--set '" + setting + "': that setting is given twice");
    }
  }
  return settings;
}

}  // namespace vantage::apps
