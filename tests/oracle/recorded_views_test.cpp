// SPDX-License-Identifier: MIT
// Choosing among views that real sensors took: who knows most, soonest?
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vantage/frontier/void_cells.hpp>
#include <vantage/planner/make_planner.hpp>
#include <vantage/planner/recorded_views.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/vision/recording.hpp>
#include <vector>

#include "support/real_data.hpp"

namespace vantage {
namespace {

struct Dataset {
  std::string name;
  RecordedViews views;
  RangeSensor sensor;
};

Dataset recorded(const std::string& format, const std::filesystem::path& folder, double cell_m,
                 const std::optional<Box>& object = std::nullopt) {
  const Recording recording = Recording::open(format, folder);
  std::vector<Scan> scans;
  for (std::size_t i = 0; i < recording.frames().size(); ++i) {
    scans.push_back(recording.read(i).scan.scan);
  }
  return {format, RecordedViews(std::move(scans), {.resolution_m = cell_m}, object), recording.sensor()};
}

double share_below(const std::vector<double>& areas, double area) {
  return double(std::count_if(areas.begin(), areas.end(), [&](double a) { return a < area; })) / double(areas.size());
}

// Areas of 100 random orders, and what a chooser makes of the same views.
struct Field {
  explicit Field(const Dataset& data)
      : views(data.views),
        greedy(views.curve("greedy", views.greedy_order(0, RecordedViews::Measure::Volume)).volume_area()) {
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
      random.push_back(views.curve("random", views.random_order(0, seed)).volume_area());
    }
  }
  void print(const ViewOrderCurve& curve) const {
    std::printf("  %-16s volume %.4f, %.1f %% of greedy, above %.0f %% of random; surface %.4f\n", curve.name.c_str(),
                curve.volume_area(), 100.0 * curve.volume_area() / greedy,
                100.0 * share_below(random, curve.volume_area()), curve.surface_area());
  }

  const RecordedViews& views;
  double greedy;
  std::vector<double> random = {};
};

// The bounds are what a chooser among recorded views is to reach.
void expect_good(const ViewOrderCurve& chosen, const ViewOrderCurve& even, const Field& field) {
  EXPECT_GT(chosen.volume_area(), even.volume_area()) << chosen.name;
  EXPECT_GT(chosen.surface_area(), even.surface_area()) << chosen.name;
  EXPECT_GE(share_below(field.random, chosen.volume_area()), 0.95) << chosen.name;
  EXPECT_GE(chosen.volume_area(), 0.9 * field.greedy) << chosen.name;
  EXPECT_LE(chosen.volume_area(), field.greedy * 1.05) << "greedy is near the best there is";
}

// The next best view by what is expected of it, and `planners` by what they seek.
void expect_good_choice(const Dataset& data, const std::vector<const char*>& planners) {
  const Field field(data);
  const ViewOrderCurve even = data.views.evenly_spaced("evenly spaced");
  const ViewOrderCurve paper =
      data.views.curve("next-best-view", chosen_order(data.views, 0, most_unknown_cells(data.views, data.sensor)));
  const ViewOrderCurve expected =
      data.views.curve("expected cells", chosen_order(data.views, 0, most_expected_cells(data.views, data.sensor)));
  std::printf("%s\n", data.name.c_str());
  for (const ViewOrderCurve* curve : {&even, &paper, &expected}) {
    field.print(*curve);
  }
  expect_good(expected, even, field);
  const auto nowhere_wide = std::make_shared<const FreeFlyer>(FreeFlyerOptions{.radius_m = 0.0});
  for (const char* name : planners) {
    const auto planner = make_planner(name, {.sensor = data.sensor, .platform = nowhere_wide});
    const ViewOrderCurve aimed = data.views.curve(
        name, chosen_order(data.views, 0, most_for_what_is_sought(data.views, data.sensor, *planner)));
    field.print(aimed);
    expect_good(aimed, even, field);
  }
}

TEST(RealViews, BunnyScans) {
  VANTAGE_REAL_DATA(folder, "object_scans/stanford_bunny_range");
  expect_good_choice(recorded("stanford", folder, 0.004, Box{{-0.11, -0.08, 0.02}, {0.08, 0.08, 0.20}}), {});
}

TEST(RealViews, ShelfBin) {
  VANTAGE_REAL_DATA(folder, "rgbd/apc_shelf_bin_15");
  const Dataset data = recorded("apc", folder, 0.02);
  expect_good_choice(data, {"harmonic", "frontier-void"});
}

TEST(RealViews, Kitchen) {
  VANTAGE_REAL_DATA(folder, "rgbd/7scenes_redkitchen_40");
  expect_good_choice(recorded("7scenes", folder, 0.05), {"harmonic"});
}

// Three scans of a wall side by side, the middle one of what the others see already.
RecordedViews three_walls() {
  std::vector<Scan> scans;
  for (const double x : {0.0, 0.5, 2.0}) {
    Scan scan;
    scan.world_from_sensor.translation().x() = x;
    for (float u = -0.5F; u <= 0.5F; u += 0.02F) {
      for (float v = -0.5F; v <= 0.5F; v += 0.02F) {
        scan.points.emplace_back(2.0F * u, 2.0F * v, 2.0F);
      }
    }
    scans.push_back(scan);
  }
  return {std::move(scans), {.resolution_m = 0.1}};
}

TEST(RecordedViews, EveryOrderEndsWithTheSameCells) {
  const RecordedViews views = three_walls();
  const ViewOrderCurve curve = views.curve("there", {0, 1, 2});
  EXPECT_DOUBLE_EQ(curve.volume.back(), 1.0);
  EXPECT_DOUBLE_EQ(views.curve("back", {2, 1, 0}).surface.back(), 1.0);
  EXPECT_LT(curve.volume[0], curve.volume[1]);
  EXPECT_EQ(views.greedy_order(0, RecordedViews::Measure::Volume), (std::vector<std::size_t>{0, 2, 1}));
  EXPECT_EQ(views.evenly_spaced("even").volume[1], views.curve("ends", {0, 2}).volume[1]);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    std::vector<std::size_t> order = views.random_order(1, seed);
    EXPECT_EQ(order.front(), 1U);
    EXPECT_EQ(order, views.random_order(1, seed));
    std::sort(order.begin(), order.end());
    EXPECT_EQ(order, views.recorded_order());
  }
}

// Scans of 60 rays each, of lengths drawn at random.
std::vector<Scan> drawn_scans(std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  const auto draw = [&](double lo, double hi) {
    return lo + (hi - lo) * (static_cast<double>(engine() >> 11U) * 0x1p-53);
  };
  std::vector<Scan> scans(4);
  for (Scan& scan : scans) {
    scan.world_from_sensor = pose_looking({draw(-1.0, 1.0), draw(-1.0, 1.0), draw(-1.0, 1.0)}, draw(-3.0, 3.0));
    for (int ray = 0; ray < 60; ++ray) {
      const double range_m = draw(0.5, 2.0);
      scan.points.push_back(Eigen::Vector3d(draw(-range_m, range_m), draw(-range_m, range_m), range_m).cast<float>());
    }
  }
  return scans;
}

// Every cell asked on its own, against maps of the scans so far.
TEST(RecordedViews, VoidCellsAreThoseUnknownInTheHullOfAllThatIsHit) {
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const std::optional<Box> object =
        seed % 3 == 0 ? std::optional(Box{{-1.0, -1.0, -1.0}, {1.5, 1.0, 0.5}}) : std::nullopt;
    const RecordedViews views(drawn_scans(seed), {.resolution_m = 0.1}, object);
    const OccupancyMapOptions options{.resolution_m = 0.1, .region = object};
    OccupancyMap of_all(options);
    for (const Scan& scan : views.scans()) {
      of_all.insert(scan);
    }
    const ConvexHull hull = occupied_hull(of_all);
    const auto left = [&](const OccupancyMap& map) {
      std::size_t cells = 0;
      for_each_cell(of_all.bounds(), [&](const VoxelIndex& cell) {
        const bool inside = hull.contains(Eigen::Vector3d(cell.x, cell.y, cell.z), 1e-6) && map.in_region(cell);
        cells += inside && map.at(cell) == Occupancy::Unknown ? 1U : 0U;
      });
      return cells;
    };
    const ViewOrderCurve curve = views.curve("", views.random_order(seed % 4, seed));
    OccupancyMap map(options);
    EXPECT_EQ(views.void_cells(), left(map)) << "seed " << seed;
    for (std::size_t view = 0; view < 4; ++view, ++compared) {
      map.insert(views.scans()[curve.order[view]]);
      EXPECT_EQ(curve.void_cells[view], left(map)) << "seed " << seed << ", view " << view;
    }
    EXPECT_LT(curve.void_cells.back(), views.void_cells()) << "seed " << seed;
  }
  EXPECT_EQ(compared, 48);
}

TEST(RecordedViews, ChoosersTakeTheViewThatShowsMore) {
  const RecordedViews views = three_walls();
  const RangeSensor sensor = RangeSensor::pinhole(40, 40, 0.9, 0.9, 0.0, 3.0);
  const std::vector<std::size_t> best{0, 2, 1};
  EXPECT_EQ(chosen_order(views, 0, most_expected_cells(views, sensor)), best);
  EXPECT_THROW((void)chosen_order(views, 0, [](const auto&, auto, auto) { return std::size_t{0}; }),
               std::logic_error);
  EXPECT_THROW(RecordedViews({}, {}), std::invalid_argument);
  EXPECT_THROW(RecordedViews(views.scans(), {}, Box{}), std::invalid_argument);
}

}  // namespace
}  // namespace vantage
