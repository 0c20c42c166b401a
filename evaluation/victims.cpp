// SPDX-License-Identifier: MIT
// Which planner finds most victims per metre? Victims lie in boxes behind walls with holes, in an arena of the
// RoboCup Rescue league: a mesh file, and beside it NAME.victims.csv with one line "name,x,y,z,yaw" per victim
// (metres, radians).
//
//     victims ARENA.ply [MOST_VIEWS [SEED[,SEED]... [PLANNER[,KEY=VALUE]...]...]]
//
// A seed selects a start, the same for every planner.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vantage/sim/exploration_run.hpp>
#include <vantage/sim/simulated_sensor.hpp>
#include <vantage/vantage.hpp>
#include <vector>

namespace {

constexpr double kCellM = 0.05;
constexpr double kFoundShare = 0.3;  // a victim is found when this share of the cells in its box is known
constexpr double kStripM = 1.0;      // width of the ground around the arena
constexpr double kWallM = 1.2;       // height of the walls; the robot flies below it and cannot look over them
constexpr double kClearM = 0.25;     // the space this far around the start is declared free, in each axis

struct Victim {
  std::vector<vantage::VoxelIndex> inside;  // the cells in the box; all of them face its open side
  vantage::VoxelIndex before;               // a cell before the hole, from which one looks in
};

// The box is 0.5 m wide, 0.4 m high and 0.24 m deep. It is open towards +y of the victim, where a wall with a hole
// of 0.15 m stands.
Victim victim_at(const vantage::Pose& world_from_victim) {
  constexpr double kRimM = 0.5 * kCellM;  // half a cell, because cells count by their centres
  const vantage::Box box{{-0.247 + kRimM, 0.353 + kRimM, -0.197 + kRimM},
                         {0.247 - kRimM, 0.590 - kRimM, 0.197 - kRimM}};
  const vantage::VoxelFrame frame{kCellM};
  const vantage::VoxelIndex middle = frame.cell_of(world_from_victim * box.centre());
  Victim victim{.inside = {}, .before = frame.cell_of(world_from_victim * Eigen::Vector3d(0.0, 1.1, 0.0))};
  for_each_cell(vantage::VoxelBox{middle, middle + vantage::VoxelIndex{1, 1, 1}}.grown(8), [&](const auto& cell) {
    if (box.contains(world_from_victim.inverse() * frame.centre_of(cell))) {
      victim.inside.push_back(cell);
    }
  });
  return victim;
}

std::vector<Victim> read_victims(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line)) {
    throw std::runtime_error(path.string() + ": cannot be read");
  }
  std::vector<Victim> victims;
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    std::string name;
    std::array<double, 4> at{};
    if (words >> name >> at[0] >> at[1] >> at[2] >> at[3]) {
      victims.push_back(
          victim_at(Eigen::Translation3d(at[0], at[1], at[2]) * Eigen::AngleAxisd(at[3], Eigen::Vector3d::UnitZ())));
    }
  }
  return victims;
}

bool is_found(const Victim& victim, const vantage::OccupancyMap& map) {
  const auto known = std::count_if(victim.inside.begin(), victim.inside.end(),
                                   [&](const auto& cell) { return map.at(cell) != vantage::Occupancy::Unknown; });
  return static_cast<double>(known) >= kFoundShare * static_cast<double>(victim.inside.size());
}

// The arena up to the height of its walls, so that the robot cannot look over them.
vantage::World arena_of(const std::filesystem::path& mesh) {
  vantage::World world = vantage::World::from_file(mesh);
  const Eigen::Vector3d strip{kStripM, kStripM, 0.0};
  world.region = {world.region.min + strip, world.region.max - strip};
  world.region.min.z() = 0.0;
  world.region.max.z() = kWallM;
  return world;
}

struct Setup {
  vantage::World world;
  std::vector<Victim> victims;
  std::size_t most_views = 0;
  vantage::RangeSensor sensor = vantage::RangeSensor::preset("kinect");
  std::shared_ptr<const vantage::FreeFlyer> robot =
      std::make_shared<vantage::FreeFlyer>(vantage::FreeFlyerOptions{.radius_m = 0.2});

  [[nodiscard]] vantage::ExplorationRunOptions options(std::uint64_t seed) const {
    vantage::ExplorationRunOptions options;
    options.map.resolution_m = kCellM;
    options.max_views = most_views;
    options.look_around = true;
    options.seed = seed;
    options.measure_coverage = false;
    return options;
  }
};

// A random start with space around it from which the sensor measures something; other places look out of the
// arena.
vantage::Pose start_in(const Setup& setup, const vantage::Truth& truth, std::uint64_t seed) {
  const vantage::FreeFlyer room(vantage::FreeFlyerOptions{.radius_m = 1.74 * kClearM});
  vantage::SimulatedSensor camera(vantage::TriangleScene(setup.world.mesh), setup.sensor);
  for (std::uint64_t draw = 0; draw < 100; ++draw) {
    const auto pose = truth.draw_start(room, 100 * seed + draw);
    if (!pose) {
      break;
    }
    const vantage::Scan scan = camera.scan(*pose);
    const auto measured = std::count_if(scan.points.begin(), scan.points.end(),
                                        [](const Eigen::Vector3f& point) { return point.allFinite(); });
    if (2 * static_cast<std::size_t>(measured) > scan.points.size()) {
      return *pose;
    }
  }
  throw std::runtime_error("there is no room for the robot from where it sees something");
}

// NAME[,KEY=VALUE]...
std::unique_ptr<vantage::ExplorationPlanner> planner_of(const Setup& setup, const std::string& text,
                                                        std::uint64_t seed) {
  std::istringstream parts(text);
  std::string name;
  std::getline(parts, name, ',');
  vantage::Settings settings;
  for (std::string part; std::getline(parts, part, ',');) {
    const std::size_t is = std::min(part.find('='), part.size() - 1);
    settings[part.substr(0, is)] = part.substr(is + 1);
  }
  return vantage::make_planner(name, {.sensor = setup.sensor, .platform = setup.robot, .seed = seed}, settings);
}

struct Score {
  std::array<std::size_t, 4> found{};  // after each quarter of the views
  std::array<double, 4> metres{};
  std::size_t places = 0;  // places from which views were taken; turning on the spot costs views but no metres

  [[nodiscard]] double per_10_m() const {
    return metres[3] > 0.0 ? 10.0 * static_cast<double>(found[3]) / metres[3] : 0.0;
  }
};

Score search(const Setup& setup, const std::string& name, std::uint64_t seed) {
  vantage::ExplorationRunOptions options = setup.options(seed);
  const vantage::Pose start = start_in(setup, vantage::Truth(setup.world, kCellM, setup.world.region), seed);
  const Eigen::Vector3d around = Eigen::Vector3d::Constant(kClearM);
  options.declared_clear = {{start.translation() - around, start.translation() + around}};
  vantage::ExplorationRun run(setup.world, setup.sensor, setup.robot, options);
  const vantage::ReachableSpace within_reach(run.truth().map(), *setup.robot, start);
  const auto reachable = std::count_if(setup.victims.begin(), setup.victims.end(),
                                       [&](const Victim& one) { return within_reach.contains(one.before); });

  Score score;
  Eigen::Vector3d place = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  std::vector<bool> found(setup.victims.size(), false);
  const auto planner = planner_of(setup, name, seed);
  const vantage::RunRecord record =
      run.run(*planner, start, [&](const vantage::ViewRecord& view, const vantage::OccupancyMap& map) {
        if ((view.pose.translation() - place).norm() > kCellM) {
          place = view.pose.translation();
          ++score.places;
        }
        for (std::size_t i = 0; i < found.size(); ++i) {
          found[i] = found[i] || is_found(setup.victims[i], map);
        }
        for (std::size_t quarter = 0; quarter < 4; ++quarter) {
          if (view.view <= (quarter + 1) * setup.most_views / 4) {
            score.found[quarter] = static_cast<std::size_t>(std::count(found.begin(), found.end(), true));
            score.metres[quarter] = view.path_length_m;
          }
        }
      });
  std::printf("| %s | %llu |", name.c_str(), static_cast<unsigned long long>(seed));
  for (std::size_t quarter = 0; quarter < 4; ++quarter) {
    std::printf(" %zu in %.1f m |", score.found[quarter], score.metres[quarter]);
  }
  std::printf(" %.2f | %zu | %zu, %s | %zu | %lld |\n", score.per_10_m(), record.collisions, record.views.size(),
              std::string(vantage::to_string(record.outcome)).c_str(), score.places,
              static_cast<long long>(reachable));
  std::fflush(stdout);
  return score;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

std::vector<std::uint64_t> seeds_of(const std::string& text) {
  std::vector<std::uint64_t> seeds;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    seeds.push_back(std::stoull(part));
  }
  if (seeds.empty()) {
    throw std::invalid_argument("there is no seed to start from");
  }
  return seeds;
}

void compare(const Setup& setup, const std::vector<std::string>& planners, const std::vector<std::uint64_t>& seeds) {
  std::printf("%zu victims; found after each quarter of at most %zu views\n\n", setup.victims.size(),
              setup.most_views);
  std::printf(
      "| planner | start | 1/4 | 1/2 | 3/4 | all views | per 10 m | collisions | views | places | in reach |\n");
  std::printf("|---|---|---|---|---|---|---|---|---|---|---|\n");
  std::vector<std::string> medians;
  for (const std::string& planner : planners) {
    std::vector<double> per_10_m;
    for (const std::uint64_t seed : seeds) {
      per_10_m.push_back(search(setup, planner, seed).per_10_m());
    }
    std::ostringstream text;
    text.precision(3);
    text << planner << ": " << median(per_10_m) << " victims per 10 m, the median of the starts\n";
    medians.push_back(text.str());
  }
  std::printf("\n");
  for (const std::string& text : medians) {
    std::printf("%s", text.c_str());
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc < 2) {
      throw std::invalid_argument("victims ARENA.ply [MOST_VIEWS [SEED[,SEED]... [PLANNER[,KEY=VALUE]...]...]]");
    }
    const std::filesystem::path mesh = argv[1];
    const Setup setup{.world = arena_of(mesh),
                      .victims = read_victims(std::filesystem::path(mesh).replace_extension(".victims.csv")),
                      .most_views = argc > 2 ? std::stoul(argv[2]) : 120};
    std::vector<std::string> planners(argv + std::min(argc, 4), argv + argc);
    if (planners.empty()) {
      planners = {"frontier-void,cost_per_m=3", "frontier-void", "frontier-gain,cost_per_m=3", "nearest-frontier",
                  "harmonic"};
    }
    compare(setup, planners, seeds_of(argc > 3 ? argv[3] : "1,2,3"));
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
}
