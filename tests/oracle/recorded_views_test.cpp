// SPDX-License-Identifier: MIT
// Choosing among views that real sensors took: who knows most after few views?
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vantage/evaluation/recorded_views.hpp>
#include <vantage/evaluation/spread.hpp>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/frontier/void_cells.hpp>
#include <vantage/vision/recording.hpp>
#include <vector>

#include "support/qhull.hpp"
#include "support/real_data.hpp"

namespace vantage {
namespace {

struct Source {
  std::string name;
  std::string format;
  std::string folder;
  double cell_m;
  std::optional<Box> object = std::nullopt;
};

const Source kBunny{"bunny", "stanford", "object_scans/stanford_bunny_range", 0.004,
                    Box{{-0.11, -0.08, 0.02}, {0.08, 0.08, 0.20}}};

std::vector<Scan> scans_of(const Recording& recording) {
  std::vector<Scan> scans;
  for (std::size_t i = 0; i < recording.frames().size(); ++i) {
    scans.push_back(recording.read(i).scan.scan);
  }
  return scans;
}

double share_below(const std::vector<double>& areas, double area) {
  return double(std::count_if(areas.begin(), areas.end(), [&](double a) { return a < area; })) / double(areas.size());
}

// The areas under the curves of 100 random orders and of the greedy one, for one measure.
struct Field {
  Field(const RecordedViews& views, std::size_t start, RecordedViews::Measure measure)
      : area(measure == RecordedViews::Measure::Volume ? &ViewOrderCurve::volume_area
                                                       : &ViewOrderCurve::surface_area) {
    greedy = (views.curve("greedy", views.greedy_order(start, measure)).*area)();
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
      random.push_back((views.curve("random", views.random_order(start, seed)).*area)());
    }
  }
  [[nodiscard]] double of_greedy(const ViewOrderCurve& curve) const { return (curve.*area)() / greedy; }
  [[nodiscard]] double above(const ViewOrderCurve& curve) const { return share_below(random, (curve.*area)()); }
  // The 95th of the 100 random areas in ascending order.
  [[nodiscard]] double bound() const {
    std::vector<double> sorted = random;
    std::sort(sorted.begin(), sorted.end());
    return sorted[94];
  }

  double (ViewOrderCurve::*area)() const;
  double greedy = 0.0;
  std::vector<double> random = {};
};

// How one rule does, by case.
struct Standing {
  std::string rule;
  std::vector<double> volume_above;
  std::vector<double> volume_of_greedy;
  std::vector<double> surface_above;
  std::vector<double> surface_of_greedy;

  void add(const ViewOrderCurve& curve, const Field& volume, const Field& surface) {
    volume_above.push_back(volume.above(curve));
    volume_of_greedy.push_back(volume.of_greedy(curve));
    surface_above.push_back(surface.above(curve));
    surface_of_greedy.push_back(surface.of_greedy(curve));
  }
  void print(const std::string& recording) const {
    std::printf("| %s | %s |", recording.c_str(), rule.c_str());
    for (const auto* shares : {&volume_above, &volume_of_greedy, &surface_above, &surface_of_greedy}) {
      std::printf(" %.1f (%.1f, %.1f) |", 100.0 * quantile(*shares, 0.5), 100.0 * quantile(*shares, 0.0),
                  100.0 * quantile(*shares, 1.0));
    }
    std::printf("\n");
  }
};

// Parts of a recording are recordings: all frames, every other one, and each half.
std::vector<std::vector<Scan>> parts_of(const std::vector<Scan>& scans) {
  std::vector<std::vector<Scan>> parts(5);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    parts[0].push_back(scans[i]);
    parts[1 + i % 2].push_back(scans[i]);
    parts[2 * i < scans.size() ? 3 : 4].push_back(scans[i]);
  }
  return parts;
}

// Five parts of a recording, each from its first view and from the one in the middle. What was chosen by looking at
// some of these cases shows on the others whether it carries over.
std::vector<Standing> standings_of(const Source& source) {
  const Recording recording = Recording::open(source.format, test::real_data(source.folder));
  std::vector<Standing> all(3);
  all[0].rule = "evenly spaced";
  all[1].rule = "unknown cells";
  all[2].rule = "expected cells";
  for (const std::vector<Scan>& part : parts_of(scans_of(recording))) {
    const RecordedViews views(part, {.resolution_m = source.cell_m}, source.object);
    for (const std::size_t start : {std::size_t{0}, part.size() / 2}) {
      const Field volume(views, start, RecordedViews::Measure::Volume);
      const Field surface(views, start, RecordedViews::Measure::Surface);
      const auto chosen = [&](const ChooseView& choose) {
        return views.curve("", chosen_order(views, start, choose));
      };
      all[0].add(views.evenly_spaced(""), volume, surface);
      all[1].add(chosen(most_unknown_cells(views, recording.sensor())), volume, surface);
      all[2].add(chosen(most_expected_cells(views, recording.sensor())), volume, surface);
    }
  }
  for (const Standing& standing : all) {
    standing.print(source.name);
  }
  return all;
}

void expect_carries_over(const Source& source) {
  const std::vector<Standing> standings = standings_of(source);
  const Standing& unknown = standings[1];
  const Standing& expected = standings[2];
  EXPECT_EQ(expected.volume_above.size(), 10U);
  EXPECT_GE(quantile(expected.volume_above, 0.5), 0.75);
  EXPECT_GE(quantile(expected.surface_above, 0.5), 0.75);
  EXPECT_GT(quantile(expected.volume_of_greedy, 0.5), quantile(unknown.volume_of_greedy, 0.5));
  EXPECT_GT(quantile(expected.surface_of_greedy, 0.5), quantile(unknown.surface_of_greedy, 0.5));
  EXPECT_GE(quantile(expected.volume_of_greedy, 0.0), 0.9);
  EXPECT_GE(quantile(expected.surface_of_greedy, 0.0), 0.9);
}

TEST(RealViews, ExpectedCellsOnPartsOfTheBunnyScans) {
  VANTAGE_REAL_DATA(folder, kBunny.folder);
  expect_carries_over(kBunny);
}

TEST(RealViews, ExpectedCellsOnPartsOfTheShelfBin) {
  VANTAGE_REAL_DATA(folder, "rgbd/apc_shelf_bin_15");
  expect_carries_over({"shelf bin", "apc", "rgbd/apc_shelf_bin_15", 0.02});
}

TEST(RealViews, ExpectedCellsOnPartsOfTheKitchen) {
  VANTAGE_REAL_DATA(folder, "rgbd/7scenes_redkitchen_40");
  expect_carries_over({"kitchen", "7scenes", "rgbd/7scenes_redkitchen_40", 0.05});
}

TEST(RealViews, ExpectedCellsOnPartsOfTheStreet) {
  VANTAGE_REAL_DATA(folder, "stereo/kitti_odometry_seq1_30");
  expect_carries_over({"street", "kitti-stereo", "stereo/kitti_odometry_seq1_30", 0.2});
}

// All orders of the nine scans after the first: shows whether a second view exists that is good in both measures.
TEST(RealViews, FewOrdersOfTheBunnyScansAreGood) {
  VANTAGE_REAL_DATA(folder, "object_scans/stanford_bunny_range");
  const RecordedViews views(scans_of(Recording::open(kBunny.format, folder)), {.resolution_m = kBunny.cell_m},
                            kBunny.object);
  ASSERT_EQ(views.size(), 10U);
  std::vector<double> volume(512);
  std::vector<double> surface(512);
  for (std::size_t set = 0; set < 512; ++set) {
    std::vector<std::size_t> taken{0};
    for (std::size_t view = 1; view < 10; ++view) {
      if ((set >> (view - 1) & 1U) != 0) {
        taken.push_back(view);
      }
    }
    const ViewOrderCurve curve = views.curve("", std::move(taken));
    volume[set] = curve.volume.back() / 10.0;
    surface[set] = curve.surface.back() / 10.0;
  }
  const ViewOrderCurve even = views.evenly_spaced("");
  const Field of_volume(views, 0, RecordedViews::Measure::Volume);
  const Field of_surface(views, 0, RecordedViews::Measure::Surface);
  const double volume_bound = std::max(of_volume.bound(), even.volume_area());
  const double surface_bound = std::max(of_surface.bound(), even.surface_area());
  std::size_t orders = 0;
  std::vector<std::size_t> good(10, 0);
  std::vector<std::size_t> order{1, 2, 3, 4, 5, 6, 7, 8, 9};
  do {
    double volume_area = volume[0];
    double surface_area = surface[0];
    std::size_t set = 0;
    for (const std::size_t view : order) {
      set |= std::size_t{1} << (view - 1);
      volume_area += volume[set];
      surface_area += surface[set];
    }
    ++orders;
    good[order.front()] += volume_area > volume_bound && surface_area > surface_bound ? 1U : 0U;
  } while (std::next_permutation(order.begin(), order.end()));
  EXPECT_EQ(orders, 362880U);
  std::printf("  orders over both bounds, by the view that comes second:");
  for (std::size_t view = 1; view < 10; ++view) {
    std::printf(" %zu: %zu", view, good[view]);
    EXPECT_EQ(good[view] > 0, view == 3 || view == 5 || view == 9) << view;
  }
  std::printf(", of %zu\n", orders);
}

// Three scans of a wall side by side; the others also see what the middle one sees.
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

// Scans of 60 rays each, of lengths drawn at random, in two groups `apart_m` apart.
std::vector<Scan> drawn_scans(std::uint64_t seed, double apart_m = 0.0) {
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
  scans[0].world_from_sensor.translation().x() += apart_m;
  scans[2].world_from_sensor.translation().x() += apart_m;
  return scans;
}

// Every cell asked on its own, against maps of the scans so far. The last hulls are wide: most of what they hold is
// far from every corner.
TEST(RecordedViews, VoidCellsAreThoseUnknownInTheHullOfAllThatIsHit) {
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 14; ++seed) {
    const bool wide = seed > 12;
    const std::optional<Box> object =
        seed % 3 == 0 && !wide ? std::optional(Box{{-1.0, -1.0, -1.0}, {1.5, 1.0, 0.5}}) : std::nullopt;
    const RecordedViews views(drawn_scans(seed, wide ? 30.0 : 0.0), {.resolution_m = 0.1}, object);
    const OccupancyMapOptions options{.resolution_m = 0.1, .region = object};
    OccupancyMap of_all(options);
    for (const Scan& scan : views.scans()) {
      of_all.insert(scan);
    }
    const test::QhullHull hull = test::qhull_of_occupied(of_all);
    const auto left = [&](const OccupancyMap& map) {
      std::size_t cells = 0;
      for_each_cell(of_all.bounds(), [&](const VoxelIndex& cell) {
        const bool inside = hull.contains(cell) && map.in_region(cell);
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
  EXPECT_EQ(compared, 56);
}

// With an object, the surroundings are free, and nothing is sought beyond them.
TEST(RecordedViews, AroundAnObjectNothingIsLeftToLookFor) {
  int frontier = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Box object{{-0.43, -0.31, -0.25}, {0.52, 0.38, 0.44}};
    const RecordedViews views(drawn_scans(seed), {.resolution_m = 0.1}, object);
    const OccupancyMap map = views.map_before();
    for (const Scan& scan : views.scans()) {
      EXPECT_TRUE(map.in_region(map.frame().cell_of(scan.world_from_sensor.translation()))) << "seed " << seed;
    }
    const Box around{object.min - Eigen::Vector3d::Constant(0.1), object.max + Eigen::Vector3d::Constant(0.1)};
    for_each_cell(*map.region(), [&](const VoxelIndex& cell) {
      const bool beside = around.contains(map.frame().centre_of(cell));
      EXPECT_TRUE(beside || map.at(cell) == Occupancy::Free) << "seed " << seed;
    });
    const Box further{object.min - Eigen::Vector3d::Constant(0.2), object.max + Eigen::Vector3d::Constant(0.2)};
    for (const VoxelIndex& cell : frontier_cells(map)) {
      EXPECT_TRUE(further.contains(map.frame().centre_of(cell))) << "seed " << seed;
      ++frontier;
    }
  }
  EXPECT_GT(frontier, 1000);
}

TEST(RecordedViews, ChoosersTakeTheViewThatShowsMore) {
  const RecordedViews views = three_walls();
  const RangeSensor sensor = RangeSensor::pinhole(40, 40, 0.9, 0.9, 0.0, 3.0);
  const std::vector<std::size_t> best{0, 2, 1};
  EXPECT_EQ(chosen_order(views, 0, most_expected_cells(views, sensor)), best);
  const ChooseView twice = most_unknown_cells(views, sensor);
  for (const std::size_t start : {0U, 1U}) {
    EXPECT_EQ(chosen_order(views, start, twice), chosen_order(views, start, most_unknown_cells(views, sensor)))
        << "another map, perhaps where the first one lay";
  }
  EXPECT_THROW((void)chosen_order(views, 0, [](const auto&, auto, auto) { return std::size_t{0}; }),
               std::logic_error);
  EXPECT_THROW(RecordedViews({}, {}), std::invalid_argument);
  EXPECT_THROW(RecordedViews(views.scans(), {}, Box{}), std::invalid_argument);
}

}  // namespace
}  // namespace vantage
