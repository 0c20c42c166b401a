// SPDX-License-Identifier: MIT
// A host may have set any locale. What the library reads and writes must not depend on it.
#include <gtest/gtest.h>

#include <bit>
#include <clocale>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <locale>
#include <memory>
#include <sstream>
#include <string>
#include <vantage/map/octomap_bridge.hpp>
#include <vantage/planner/make_planner.hpp>
#include <vantage/report/map_export.hpp>
#include <vantage/report/report_json.hpp>
#include <vantage/report/run_recorder.hpp>
#include <vantage/report/sensor_file.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/sim/mesh_file.hpp>
#include <vantage/sim/nav2_map_file.hpp>
#include <vantage/sim/object_scene.hpp>
#include <vantage/sim/world.hpp>

#include "support/read_all.hpp"
#include "support/temporary_folder.hpp"

namespace vantage {
namespace {

// Writes 1234.5 as 1.234,5.
class Comma : public std::numpunct<char> {
 protected:
  [[nodiscard]] char do_decimal_point() const override { return ','; }
  [[nodiscard]] char do_thousands_sep() const override { return '.'; }
  [[nodiscard]] std::string do_grouping() const override { return "\3"; }
};

// Sets the locale of C++ streams and, if the machine has one, that of C functions for as long as it lives.
class InCommaLocale {
 public:
  InCommaLocale() : before_(std::locale::global(std::locale(std::locale::classic(), new Comma))) {
    (void)std::setlocale(LC_ALL, "de_DE.UTF-8");
  }
  InCommaLocale(const InCommaLocale&) = delete;
  InCommaLocale(InCommaLocale&&) = delete;
  InCommaLocale& operator=(const InCommaLocale&) = delete;
  InCommaLocale& operator=(InCommaLocale&&) = delete;
  ~InCommaLocale() {
    std::locale::global(before_);
    (void)std::setlocale(LC_ALL, "C");
  }

 private:
  std::locale before_;
};

std::string bits_of(double value) { return std::to_string(std::bit_cast<std::uint64_t>(value)); }

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

// A slab with steps, so that exports hold thousands of vertices.
OccupancyMap stepped_map() {
  OccupancyMap map({.resolution_m = 0.125});
  for (std::int32_t x = 0; x < 60; ++x) {
    for (std::int32_t y = 0; y < 60; ++y) {
      map.set({x, y, (x * 7 + y * 3) % 5}, Occupancy::Occupied);
      map.set({x, y, 6}, Occupancy::Free);
    }
  }
  return map;
}

// All that is written and read, as one text.
std::string all_there_is(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder / "paraview");
  const OccupancyMap map = stepped_map();
  std::string text;
  const auto add_file = [&](const std::filesystem::path& file) { text += test::read_all(file); };
  for (const char* name : {"map.ot", "map.bt"}) {
    save_octomap(map, folder / name);
    add_file(folder / name);
    text += std::to_string(load_octomap(folder / name).map.counts().occupied);
  }
  write_ply_mesh(map, folder / "mesh.ply");
  add_file(folder / "mesh.ply");
  write_ply_points(map, folder / "points.ply");
  add_file(folder / "points.ply");
  const TriangleMesh mesh = read_mesh_file(folder / "mesh.ply");
  text += bits_of(mesh.bounds().max.x());

  write_text(
      folder / "sensor.json",
      R"({"width": 1280, "height": 720, "horizontal_fov_deg": 60.5, "vertical_fov_deg": 40.5, "max_range_m": 3.5})");
  text += bits_of(load_sensor(folder / "sensor.json").max_range_m);
  {
    RunRecorder recorder(folder / "run.record", {.sensor = RangeSensor::preset("kinect")});
    recorder.record(map, pose_looking({1.5, 1.5, 0.8}, 0.5), Plan{}, 1.5, 2.5);
    recorder.finish(RunOutcome::Explored, "an end");
  }
  add_file(folder / "run.record");
  for (const std::filesystem::path& file : write_paraview(folder / "run.record", folder / "paraview")) {
    add_file(file);
  }
  for (const auto& part : std::filesystem::recursive_directory_iterator(folder / "paraview")) {
    text += part.is_regular_file() ? test::read_all(part.path()) : "";
  }
  RunRecord run;
  run.resolution_m = 0.125;
  run.observable_cells = 1'234'567;
  run.coverage = 0.75;
  text += report_json(run);

  write_text(folder / "plan.pgm", "P2\n3 2\n255\n0 254 254\n254 254 0\n");
  write_text(folder / "plan.yaml",
             "image: plan.pgm\nresolution: 0.05\norigin: [-1.5, 2.25, 0.0]\nnegate: 0\n"
             "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
  const GroundPlan plan = read_nav2_map(folder / "plan.yaml");
  text += bits_of(plan.pixel_m) + bits_of(plan.x_m);

  const RangeSensor kinect = RangeSensor::preset("kinect");
  const ObjectScene scene = object_scene(mesh, kinect, {.radii_m = {1.25, 1500.5}});
  for (const auto& [name, value] : planner_settings(scene)) {
    text.append(name).append("=").append(value).append("\n");
  }
  (void)make_planner("frontier-gain", {.sensor = kinect, .platform = std::make_shared<const FreeFlyer>()},
                     {{"cost_per_m", "2.5"}, {"hypotheses", "1000"}});
  return text;
}

TEST(CommaLocale, NothingThatIsReadOrWrittenDependsOnIt) {
  const test::TemporaryFolder folder;
  const std::string plain = all_there_is(folder / "plain");
  const InCommaLocale comma;
  std::ostringstream shown;
  shown << 1234.5;
  ASSERT_EQ(shown.str(), "1.234,5");
  const std::string same = all_there_is(folder / "comma");
  EXPECT_GT(plain.size(), 100'000U);
  ASSERT_EQ(same.size(), plain.size());
  std::size_t at = 0;
  while (at < plain.size() && plain[at] == same[at]) {
    ++at;
  }
  EXPECT_EQ(at, plain.size()) << plain.substr(at > 60 ? at - 60 : 0, 120) << "\n---\n"
                              << same.substr(at > 60 ? at - 60 : 0, 120);
}

}  // namespace
}  // namespace vantage
