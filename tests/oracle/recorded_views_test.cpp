// SPDX-License-Identifier: MIT
// Choosing among views that real sensors took: who knows most after few views?
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vantage/evaluation/recorded_views.hpp>
#include <vantage/frontier/void_cells.hpp>
#include <vantage/planner/make_planner.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/vision/recording.hpp>
#include <vector>

#include "support/qhull.hpp"
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

// The areas under the curves of 100 random orders and of the greedy one, for one measure.
struct Field {
  Field(const RecordedViews& views, RecordedViews::Measure measure) {
    const auto area =
        measure == RecordedViews::Measure::Volume ? &ViewOrderCurve::volume_area : &ViewOrderCurve::surface_area;
    greedy = (views.curve("greedy", views.greedy_order(0, measure)).*area)();
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
      random.push_back((views.curve("random", views.random_order(0, seed)).*area)());
    }
  }
  // An area as a share of that of greedy, and the share of random orders below it.
  [[nodiscard]] double of_greedy(double area) const { return area / greedy; }
  [[nodiscard]] double above(double area) const { return share_below(random, area); }
  // The 95th of the 100 random areas in ascending order.
  [[nodiscard]] double bound() const {
    std::vector<double> sorted = random;
    std::sort(sorted.begin(), sorted.end());
    return sorted[94];
  }

  double greedy = 0.0;
  std::vector<double> random = {};
};

// The minimum quality of a choice: better than evenly spaced views, at least 90 % of the random orders below it, and
// at least 90 % of greedy.
class Bar {
 public:
  explicit Bar(const RecordedViews& views)
      : even_(views.evenly_spaced("evenly spaced")),
        volume_(views, RecordedViews::Measure::Volume),
        surface_(views, RecordedViews::Measure::Surface) {
    print(even_);
  }

  void print(const ViewOrderCurve& curve) const {
    std::printf("  %-26s", curve.name.c_str());
    print_area("volume", curve.volume_area(), volume_);
    print_area("  surface", curve.surface_area(), surface_);
    std::printf("\n");
  }
  void expect_over(const ViewOrderCurve& chosen) const {
    print(chosen);
    expect_over(chosen.volume_area(), even_.volume_area(), volume_, chosen.name + ", volume");
    expect_over(chosen.surface_area(), even_.surface_area(), surface_, chosen.name + ", surface");
  }
  [[nodiscard]] double volume_bound() const { return std::max(volume_.bound(), even_.volume_area()); }
  [[nodiscard]] double surface_bound() const { return std::max(surface_.bound(), even_.surface_area()); }

 private:
  static void print_area(const char* measure, double area, const Field& field) {
    std::printf("%s %.4f, %.1f %% of greedy, above %.0f %%", measure, area, 100.0 * field.of_greedy(area),
                100.0 * field.above(area));
  }
  static void expect_over(double area, double even, const Field& field, const std::string& who) {
    EXPECT_GT(area, even) << who;
    EXPECT_GE(field.above(area), 0.9) << who;
    EXPECT_GE(field.of_greedy(area), 0.9) << who;
    EXPECT_LE(field.of_greedy(area), 1.05) << who << ": greedy is near the best there is";
  }

  ViewOrderCurve even_;
  Field volume_;
  Field surface_;
};

ViewOrderCurve chosen_curve(const Dataset& data, const char* name, const ChooseView& choose) {
  return data.views.curve(name, chosen_order(data.views, 0, choose));
}

// Tests the choices by expected gain, by the cells that all planners seek, and by those that `planners` seek next.
void expect_good_choice(const Dataset& data, const std::vector<const char*>& planners) {
  std::printf("%s\n", data.name.c_str());
  const Bar bar(data.views);
  const auto most_for = [&](SoughtCells sought) {
    return most_for_what_is_sought(data.views, data.sensor, std::move(sought));
  };
  bar.print(chosen_curve(data, "next-best-view", most_unknown_cells(data.views, data.sensor)));
  bar.expect_over(chosen_curve(data, "expected cells", most_expected_cells(data.views, data.sensor)));
  bar.expect_over(chosen_curve(data, "behind all frontiers", most_for(sought_behind_frontiers())));
  bar.expect_over(chosen_curve(data, "in all voids", most_for(sought_in_voids())));
  const auto nowhere_wide = std::make_shared<const FreeFlyer>(FreeFlyerOptions{.radius_m = 0.0});
  for (const char* name : planners) {
    const auto planner = make_planner(name, {.sensor = data.sensor, .platform = nowhere_wide});
    bar.expect_over(chosen_curve(data, name, most_for(sought_next(data.views, *planner))));
  }
}

const Box kBunny{{-0.11, -0.08, 0.02}, {0.08, 0.08, 0.20}};

TEST(RealViews, BunnyScans) {
  VANTAGE_REAL_DATA(folder, "object_scans/stanford_bunny_range");
  expect_good_choice(recorded("stanford", folder, 0.004, kBunny), {});
}

// All orders of the nine scans after the first: shows whether a second view exists that is good in both measures.
TEST(RealViews, FewOrdersOfTheBunnyScansAreGood) {
  VANTAGE_REAL_DATA(folder, "object_scans/stanford_bunny_range");
  const RecordedViews views = recorded("stanford", folder, 0.004, kBunny).views;
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
  const Bar bar(views);
  bar.print(views.curve("greedy by volume", views.greedy_order(0, RecordedViews::Measure::Volume)));
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
    good[order.front()] += volume_area > bar.volume_bound() && surface_area > bar.surface_bound() ? 1U : 0U;
  } while (std::next_permutation(order.begin(), order.end()));
  EXPECT_EQ(orders, 362880U);
  std::printf("  orders over both bounds, by the view that comes second:");
  for (std::size_t view = 1; view < 10; ++view) {
    std::printf(" %zu: %zu", view, good[view]);
    EXPECT_EQ(good[view] > 0, view == 3 || view == 5 || view == 9) << view;
  }
  std::printf(", of %zu\n", orders);
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

// A view that shows little else is chosen if it is the only one that shows a sought cell.
TEST(RecordedViews, WhatIsSoughtComesBeforeWhatIsExpected) {
  const RecordedViews views = three_walls();
  const RangeSensor sensor = RangeSensor::pinhole(40, 40, 0.9, 0.9, 0.0, 3.0);
  const auto second = [&](const Eigen::Vector3d& place) {
    const SoughtCells sought = [&](const OccupancyMap& map, std::size_t) {
      std::vector<VoxelIndex> cells;
      for_each_cell({map.frame().cell_of(place), map.frame().cell_of(place) + VoxelIndex{1, 4, 4}},
                    [&](const VoxelIndex& cell) { cells.push_back(cell); });
      return cells;
    };
    return chosen_order(views, 0, most_for_what_is_sought(views, sensor, sought))[1];
  };
  EXPECT_EQ(second({2.5, 0.0, 1.5}), 2U);   // only the last view sees it
  EXPECT_EQ(second({0.95, 0.0, 1.6}), 1U);  // the middle view sees it, although it shows less
  EXPECT_EQ(second({9.0, 0.0, 1.5}), 2U);   // no view sees it
}

// Tests every cell separately.
TEST(RecordedViews, BehindFrontiersIsWhatIsUnknownBesideAFreeCell) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const std::optional<Box> region =
        seed % 3 == 0 ? std::optional(Box{{-1.0, -1.0, -1.0}, {1.5, 1.0, 0.5}}) : std::nullopt;
    OccupancyMap map({.resolution_m = 0.1, .region = region});
    for (const Scan& scan : drawn_scans(seed)) {
      map.insert(scan);
    }
    const std::vector<VoxelIndex> sought = sought_behind_frontiers()(map, 0);
    std::set<std::tuple<int, int, int>> cells;
    for (const VoxelIndex& cell : sought) {
      cells.emplace(cell.x, cell.y, cell.z);
    }
    const VoxelIndex one{1, 1, 1};
    for_each_cell({map.bounds().lo - one, map.bounds().hi + one}, [&](const VoxelIndex& cell) {
      const bool beside = std::any_of(kFaceNeighbours.begin(), kFaceNeighbours.end(),
                                      [&](const VoxelIndex& step) { return map.at(cell + step) == Occupancy::Free; });
      const bool expected = beside && map.in_region(cell) && map.at(cell) == Occupancy::Unknown;
      EXPECT_EQ(cells.count({cell.x, cell.y, cell.z}) == 1U, expected) << "seed " << seed;
      found += expected ? 1 : 0;
    });
  }
  EXPECT_GT(found, 10000);
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
    for (const VoxelIndex& cell : sought_behind_frontiers()(map, 0)) {
      EXPECT_TRUE(around.contains(map.frame().centre_of(cell))) << "seed " << seed;
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
  EXPECT_EQ(chosen_order(views, 0, most_for_what_is_sought(views, sensor, sought_in_voids())), best)
      << "a wall has no void: of all views the one that makes most known";
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
