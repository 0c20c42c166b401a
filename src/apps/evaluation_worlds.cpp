// SPDX-License-Identifier: MIT
#include "apps/evaluation_worlds.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include <vantage/map/impl/whole_file.hpp>
#include "apps/explore_options.hpp"
#include "apps/run_files.hpp"

namespace vantage::apps {
namespace {

// FILE in the folder sensors, and what it holds.
constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kSensors{{
    {"aerial.json",
     R"({"width": 160, "height": 120, "horizontal_fov_deg": 90, "vertical_fov_deg": 73.7397953, "min_range_m": 0.1,
 "max_range_m": 5, "reports_no_return": true}
)"},
    {"kinect.json",
     R"({"width": 160, "height": 120, "horizontal_fov_deg": 57, "vertical_fov_deg": 43, "min_range_m": 0.4,
 "max_range_m": 4}
)"},
    {"stereo.json",
     R"({"width": 128, "height": 96, "horizontal_fov_deg": 65, "vertical_fov_deg": 51.0771935, "min_range_m": 0.5,
 "max_range_m": 5}
)"},
    {"lidar-4.5m.json",
     R"({"projection": "spherical", "width": 720, "height": 1, "horizontal_fov_deg": 360, "vertical_fov_deg": 1,
 "max_range_m": 4.5, "reports_no_return": true}
)"},
    {"lidar-20m.json",
     R"({"projection": "spherical", "width": 720, "height": 1, "horizontal_fov_deg": 360, "vertical_fov_deg": 1,
 "max_range_m": 20, "reports_no_return": true}
)"},
}};

constexpr const char* kFlyer =
    "--sensor sensors/aerial.json --resolution 0.1 --yaw-only --max-speed 2 --max-acceleration 3 --max-yaw-rate 90 "
    "--scan-rate 15 --max-views 27000";

constexpr std::array<EvaluationClass, 7> kClasses{{
    {"generated",
     "A flying sphere of 0.15 m radius with a panoramic sensor of 20 m, a scan every 0.5 m, cells of 0.2 m.",
     "--sensor panoramic --resolution 0.2"},
    {"narrow",
     "The same sphere with a narrow camera, every fourth pixel both ways: `kinect` 57 x 43 degrees, 0.4 to 4 m; "
     "`stereo` 65 x 51 degrees, 0.5 to 5 m.",
     "--resolution 0.2"},
    {"houses", "Furnished buildings, the same sphere, the same three sensors, cells of 0.2 m.", "--resolution 0.2"},
    {"timed",
     "A level flyer in time: 2 m/s, 3 m/s^2, 90 degrees/s, a depth camera of 90 x 73.7 degrees and 0.1 to 5 m (every "
     "fourth pixel) that scans at 15 Hz, cells of 0.1 m, at most 30 minutes.",
     kFlyer},
    {"timed-generated", "The same flyer in generated worlds, another one for each start.", kFlyer},
    {"floor-plans",
     "A driving disc of 0.15 m radius with a lidar of 360 degrees, a scan every 0.5 m, cells of 0.2 m.",
     "--resolution 0.2 --max-views 30000"},
    {"driven",
     "A driving disc with a stereo camera (65 x 51 degrees, 0.5 to 5 m) explores the plane of the heights 0.2 to "
     "1.4 m, a scan every 0.5 m, cells of 0.1 m.",
     "--band 0.2,1.4 --look-around --sensor stereo --resolution 0.1"},
}};

// The number after --max-views is the budget of a run.
constexpr std::array<EvaluationWorld, 28> kWorlds{{
    {"rooms", "generated", "--world rooms --max-views 1000", BoundWith::Route, true},
    {"office", "generated", "--world office --max-views 2000", BoundWith::Pockets},
    {"maze", "generated", "--world maze --max-views 2000", BoundWith::Pockets, true},
    {"two-storey", "generated", "--world two-storey --max-views 2000", BoundWith::Pockets},

    {"rooms-kinect", "narrow", "--world rooms --sensor sensors/kinect.json --max-views 6000"},
    {"rooms-stereo", "narrow", "--world rooms --sensor sensors/stereo.json --max-views 3000"},

    {"small-house", "houses",
     "--world $VANTAGE_DATA/environments/aws_small_house/small_house_visual.ply --region -9,-5,0.1,9,5,2.4 "
     "--sensor panoramic --max-views 2000"},
    {"small-house-kinect", "houses",
     "--world $VANTAGE_DATA/environments/aws_small_house/small_house_visual.ply --region -9,-5,0.1,9,5,2.4 "
     "--sensor sensors/kinect.json --max-views 6000"},
    {"small-house-stereo", "houses",
     "--world $VANTAGE_DATA/environments/aws_small_house/small_house_visual.ply --region -9,-5,0.1,9,5,2.4 "
     "--sensor sensors/stereo.json --max-views 6000"},
    {"collapsed-house", "houses",
     "--world $VANTAGE_DATA/environments/gazebo/collapsed_house.ply --sensor panoramic --max-views 2000"},
    {"collapsed-house-kinect", "houses",
     "--world $VANTAGE_DATA/environments/gazebo/collapsed_house.ply --sensor sensors/kinect.json --max-views 6000"},
    {"collapsed-house-stereo", "houses",
     "--world $VANTAGE_DATA/environments/gazebo/collapsed_house.ply --sensor sensors/stereo.json --max-views 6000"},
    {"first-office", "houses",
     "--world $VANTAGE_DATA/environments/gazebo/osrf_first_office.ply --sensor panoramic --max-views 3000"},
    {"first-office-kinect", "houses",
     "--world $VANTAGE_DATA/environments/gazebo/osrf_first_office.ply --sensor sensors/kinect.json --max-views 6000"},
    {"first-office-stereo", "houses",
     "--world $VANTAGE_DATA/environments/gazebo/osrf_first_office.ply --sensor sensors/stereo.json --max-views 6000"},

    {"small-maze", "timed", "--world maze --size 6,6", std::nullopt, true},
    {"complex-office", "timed",
     "--world $VANTAGE_DATA/environments/aerial/complex_office.stl --region -15,-15,0,15,15,2"},
    {"maze1", "timed", "--world $VANTAGE_DATA/environments/aerial/maze1.obj --region -20,-20,0,20,20,3"},
    {"maze4", "timed", "--world $VANTAGE_DATA/environments/aerial/maze4.obj --region -10,-20,0,10,20,3"},

    {"timed-office", "timed-generated", "--world office --size 12,8"},
    {"timed-maze", "timed-generated", "--world maze --size 12,12"},

    {"kth-50052748-4.5m", "floor-plans",
     "--world $VANTAGE_DATA/floorplans/kth/50052748.yaml --sensor sensors/lidar-4.5m.json", BoundWith::Pockets},
    {"kth-50052748-20m", "floor-plans",
     "--world $VANTAGE_DATA/floorplans/kth/50052748.yaml --sensor sensors/lidar-20m.json", BoundWith::Pockets},
    {"kth-50052750-4.5m", "floor-plans",
     "--world $VANTAGE_DATA/floorplans/kth/50052750.yaml --sensor sensors/lidar-4.5m.json", BoundWith::Pockets},
    {"kth-50052750-20m", "floor-plans",
     "--world $VANTAGE_DATA/floorplans/kth/50052750.yaml --sensor sensors/lidar-20m.json", BoundWith::Pockets},
    {"kth-50015847-4.5m", "floor-plans",
     "--world $VANTAGE_DATA/floorplans/kth/50015847.yaml --sensor sensors/lidar-4.5m.json", BoundWith::Pockets},
    {"kth-50015847-20m", "floor-plans",
     "--world $VANTAGE_DATA/floorplans/kth/50015847.yaml --sensor sensors/lidar-20m.json", BoundWith::Pockets},

    {"driven-office", "driven", "--world office --size 15,10 --max-views 1500"},
}};

}  // namespace

std::span<const EvaluationClass> evaluation_classes() { return kClasses; }
std::span<const EvaluationWorld> evaluation_worlds() { return kWorlds; }

const EvaluationClass& evaluation_class(std::string_view name) {
  const auto* found = std::find_if(kClasses.begin(), kClasses.end(), [&](const auto& c) { return c.name == name; });
  if (found == kClasses.end()) {
    throw std::logic_error("there is no class of worlds '" + std::string(name) + "'");
  }
  return *found;
}

std::string options_of(const EvaluationWorld& world) {
  return std::string(world.options) + " " + std::string(evaluation_class(world.in_class).options);
}

ExploreRequest request_in(const std::filesystem::path& folder, const std::string& options) {
  ExploreRequest request = explore_request(options);
  constexpr std::string_view kData = "$VANTAGE_DATA";
  if (request.world.starts_with(kData)) {
    const char* data = std::getenv("VANTAGE_DATA");
    request.world.replace(0, kData.size(), data == nullptr ? "" : data);
  }
  if (request.sensor.starts_with("sensors/")) {
    request.sensor = (folder / request.sensor).string();
  }
  return request;
}

void write_evaluation_sensors(const std::filesystem::path& folder) {
  make_folder(folder / "sensors");
  for (const auto& [file, content] : kSensors) {
    detail::write_whole_file(folder / "sensors" / file, content);
  }
}

}  // namespace vantage::apps
