// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <set>
#include <stdexcept>
#include <vantage/planner/make_planner.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/sim/exploration_run.hpp>
#include <vantage/sim/truth.hpp>
#include <vantage/sim/world.hpp>

namespace vantage {
namespace {

FreeFlyer small_flyer() { return FreeFlyer(FreeFlyerOptions{.radius_m = 0.25}); }

RangeSensor coarse_panoramic() {
  RangeSensor sensor = RangeSensor::preset("panoramic");
  sensor.width = 180;
  sensor.height = 90;
  return sensor;
}

World two_rooms() {
  VoxelGrid<std::uint8_t> solid({{0, 0, 0}, {20, 12, 12}}, 1);
  const auto carve = [&](const VoxelIndex& lo, const VoxelIndex& hi) {
    for_each_cell({lo, hi}, [&](const VoxelIndex& cell) { solid[cell] = 0; });
  };
  carve({1, 1, 1}, {9, 11, 11});
  carve({10, 1, 1}, {19, 11, 11});
  carve({9, 3, 1}, {10, 9, 9});
  return {"two rooms", surface_of_cells(solid, {0.2}, 0.01), {{0, 0, 0}, {4.0, 2.4, 2.4}}};
}

// Compares random triangles with densely sampled points, each in its cell.
TEST(Truth, RasterisesEveryCellThatATrianglePasses) {
  std::mt19937 engine(8);
  std::uniform_real_distribution<float> metre(0.05F, 1.95F);
  std::size_t sampled = 0;
  std::size_t tight = 0;
  for (int world = 0; world < 30; ++world) {
    World one{"one", {}, {{0, 0, 0}, {2, 2, 2}}};
    for (int i = 0; i < 3; ++i) {
      one.mesh.vertices.emplace_back(metre(engine), metre(engine), metre(engine));
    }
    one.mesh.triangles.push_back({0, 1, 2});
    const Truth truth(one, 0.1, one.region);
    std::set<VoxelIndex> hit;
    const auto corner = [&](std::size_t i) { return Eigen::Vector3d(one.mesh.vertices[i].cast<double>()); };
    constexpr int kSteps = 150;
    for (int u = 0; u <= kSteps; ++u) {
      for (int v = 0; u + v <= kSteps; ++v) {
        const Eigen::Vector3d point =
            corner(0) + u / double{kSteps} * (corner(1) - corner(0)) + v / double{kSteps} * (corner(2) - corner(0));
        hit.insert(truth.map().frame().cell_of(point));
        ASSERT_NE(truth.at(truth.map().frame().cell_of(point)), CellTruth::Free);
        ++sampled;
      }
    }
    std::size_t occupied = 0;
    for_each_cell(*truth.map().region(),
                  [&](const VoxelIndex& cell) { occupied += truth.at(cell) == CellTruth::Occupied ? 1U : 0U; });
    tight += occupied <= hit.size() + hit.size() / 10 + 3 ? 1U : 0U;
  }
  EXPECT_GT(sampled, 300'000U);
  EXPECT_GE(tight, 28U) << "hardly more cells than the samples found";
}

TEST(Truth, ASurfaceOnABorderIsGrazedOnBothSides) {
  World one{"one", {}, {{0, 0, 0}, {1, 1, 1}}};
  one.mesh.add_quad({0, 0, 0.5}, {1, 0, 0.5}, {1, 1, 0.5}, {0, 1, 0.5});
  const Truth truth(one, 0.1, one.region);
  EXPECT_EQ(truth.at({3, 3, 4}), CellTruth::Grazed);
  EXPECT_EQ(truth.at({3, 3, 5}), CellTruth::Grazed);
  EXPECT_EQ(truth.at({3, 3, 6}), CellTruth::Free);
  EXPECT_EQ(truth.map().at({3, 3, 5}), Occupancy::Occupied);
  OccupancyMap map({.resolution_m = 0.1});
  const std::vector<VoxelIndex> cells{{3, 3, 4}, {3, 3, 5}, {3, 3, 6}, {3, 3, 7}};
  EXPECT_EQ(truth.coverage(map, cells), 0.0);
  map.set({3, 3, 4}, Occupancy::Free);
  map.set({3, 3, 5}, Occupancy::Occupied);
  map.set({3, 3, 6}, Occupancy::Occupied);
  EXPECT_EQ(truth.coverage(map, cells), 0.5);
}

// Asks every cell on its own.
TEST(Truth, TellsWhatDoesNotTouchABox) {
  std::mt19937 engine(4);
  const auto draw = [&] { return -1.0 + 2.0 * static_cast<double>(engine()) * 0x1p-32; };
  std::size_t told = 0;
  std::size_t kept = 0;
  for (int i = 0; i < 20; ++i) {
    World world;
    world.region = {{-1.0, -1.05, -0.9}, {1.1, 1.0, 1.0}};
    world.mesh.add_box({{-0.3, -0.3, -0.3}, {0.3, 0.4, 0.2}});
    const Truth truth(world, 0.1, world.region);
    Box unknown{{draw(), draw(), draw()}, {draw(), draw(), draw()}};
    const Eigen::Vector3d lo = unknown.min.cwiseMin(unknown.max);
    unknown = {lo, lo + (unknown.max - unknown.min).cwiseAbs()};
    if (i % 2 == 0) {  // its faces are those of cells
      unknown = truth.map().frame().box_of(truth.map().frame().cells_touched_by(unknown));
    }
    OccupancyMap map(truth.map().options());
    truth.tell_around(unknown, map);
    truth.map().for_each_known([&](const VoxelIndex& cell, Occupancy state) {
      const Box box = map.frame().box_of(cell);
      const bool apart =
          (box.max.array() <= unknown.min.array()).any() || (box.min.array() >= unknown.max.array()).any();
      ASSERT_EQ(map.at(cell), apart ? state : Occupancy::Unknown);
      ++(apart ? told : kept);
    });
  }
  EXPECT_GT(told, 50'000U);
  EXPECT_GT(kept, 2'000U);
}

TEST(Truth, RefusesWhatItCannotRasterise) {
  const World world = two_rooms();
  EXPECT_THROW(Truth(world, 0.0, world.region), std::invalid_argument);
  EXPECT_THROW(Truth(world, 0.2, Box{}), std::invalid_argument);
}

/// Two rooms and what a flying robot can observe in them.
class TruthOfTwoRooms : public testing::Test {
 protected:
  [[nodiscard]] std::vector<VoxelIndex> seen_by(int threads) const {
    return truth.observable(flyer, RangeSensor::preset("panoramic"), start, threads);
  }
  const World world = two_rooms();
  const Truth truth{world, 0.2, world.region};
  const FreeFlyer flyer = small_flyer();
  const Pose start = truth.draw_start(flyer, 1).value();
  const std::vector<VoxelIndex> seen = seen_by(1);
};

TEST_F(TruthOfTwoRooms, StartsAreDrawnFromTheSeedWhereThePlatformIsAdmitted) {
  std::size_t different = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Pose drawn = truth.draw_start(flyer, seed).value();
    EXPECT_TRUE(flyer.admits(truth.map(), drawn));
    EXPECT_EQ(drawn.matrix(), truth.draw_start(flyer, seed)->matrix());
    different += drawn.translation() != truth.draw_start(flyer, seed + 1)->translation() ? 1U : 0U;
  }
  EXPECT_GT(different, 40U);
  EXPECT_FALSE(truth.draw_start(FreeFlyer(FreeFlyerOptions{.radius_m = 3.0}), 1).has_value());
}

TEST_F(TruthOfTwoRooms, ObservableIsTheInsideAndItsWallsWhateverTheThreads) {
  EXPECT_EQ(seen, seen_by(4));
  std::size_t free = 0;
  for (const VoxelIndex& cell : seen) {
    free += truth.at(cell) == CellTruth::Free ? 1U : 0U;
  }
  constexpr std::size_t kEmpty = 8U * 100 + 9U * 100 + 48U;
  EXPECT_LE(free, kEmpty);
  EXPECT_GE(free, kEmpty - 4) << "all but what an edge of the door frame grazes";
  EXPECT_GT(seen.size(), free + 700U);
}

// The measure can be reached: scans from all places of a lattice know nearly all observable cells.
TEST_F(TruthOfTwoRooms, AnExhaustiveScanCoversNearlyEverythingObservable) {
  OccupancyMap map({.resolution_m = 0.2, .region = world.region});
  SimulatedSensor simulated(TriangleScene(world.mesh), coarse_panoramic());
  for (const VoxelIndex& cell : truth.lattice(flyer, start)) {
    map.insert(simulated.scan(pose_looking(map.frame().centre_of(cell), 0.0)));
  }
  EXPECT_GT(truth.coverage(map, seen), 0.99);
}

// A wall 60 m away tells a sensor of long range, which does not report rays without return, what lies before it.
TEST(Truth, KeepsTheSurfacesThatTheSensorsRangeReaches) {
  World world{"far wall", {}, {{0, 0, 0}, {2, 2, 2}}};
  world.mesh.add_quad({60, -10, -10}, {60, 14, -10}, {60, 14, 14}, {60, -10, 14});
  const auto flyer = std::make_shared<const FreeFlyer>(FreeFlyerOptions{.radius_m = 0.25});
  RangeSensor sensor = RangeSensor::pinhole(64, 64, 1.0, 1.0, 0.0, 100.0);
  sensor.reports_no_return = false;
  ExplorationRunOptions options;
  options.map.resolution_m = 0.2;
  const ExplorationRun run(world, sensor, flyer, options);
  const Pose start = run.truth().draw_start(*flyer, 1).value();
  const std::size_t poses = run.truth().lattice(*flyer, start).size();
  EXPECT_GT(run.truth().observable(*flyer, sensor, start).size(), 3 * poses);
  const Truth near(world, 0.2, world.region);
  EXPECT_THROW((void)near.observable(*flyer, sensor, start), std::invalid_argument);
  sensor.max_range_m = 25.0;
  EXPECT_LT(near.observable(*flyer, sensor, start).size(), poses + 1) << "the cells of the poses";
  sensor.max_range_m = 100.0;
  sensor.reports_no_return = true;
  EXPECT_EQ(near.observable(*flyer, sensor, start).size(), 1000U) << "the whole region";
  EXPECT_THROW(Truth(world, 0.2, world.region, -1.0), std::invalid_argument);
  EXPECT_THROW(Truth(world, 1e-4, world.region), std::invalid_argument) << "too many cells";
}

// Moves to and fro between two places a given number of times.
class Shuttle final : public ExplorationPlanner {
 public:
  Shuttle(Pose a, Pose b, int trips) : a_(a), b_(b), trips_(trips) {}
  std::string_view name() const override { return "shuttle"; }
  Plan plan(const OccupancyMap&, const Pose& current) override {
    Plan plan;
    if (trips_-- == 0) {
      plan.outcome = Outcome::Explored;
      plan.reason = "enough";
      return plan;
    }
    plan.outcome = Outcome::Move;
    plan.goal.pose = current.translation().isApprox(a_.translation()) ? b_ : a_;
    plan.path = {current, plan.goal.pose};
    return plan;
  }

 private:
  Pose a_;
  Pose b_;
  int trips_;
};

ExplorationRunOptions run_options() {
  ExplorationRunOptions options;
  options.map.resolution_m = 0.2;
  return options;
}

TEST(ExplorationRun, ScansOnTheWayAndCountsWhatItTravels) {
  const World world = two_rooms();
  const auto flyer = std::make_shared<const FreeFlyer>(FreeFlyerOptions{.radius_m = 0.25});
  ExplorationRun run(world, coarse_panoramic(), flyer, run_options());
  const Pose a = pose_looking({0.9, 0.9, 1.1}, 0.0);
  const Pose b = pose_looking({0.9, 1.5, 1.1}, 1.0);
  Shuttle shuttle(a, b, 2);
  std::size_t told = 0;
  const RunRecord record = run.run(shuttle, a, [&](const ViewRecord& view, const OccupancyMap& map) {
    EXPECT_EQ(view.view, ++told);
    EXPECT_GT(map.counts().free, 0U);
  });
  EXPECT_EQ(record.outcome, RunOutcome::Explored);
  EXPECT_EQ(record.reason, "enough");
  EXPECT_EQ(told, record.views.size());
  ASSERT_EQ(record.views.size(), 5U) << "start, 0.5 m, goal, 0.5 m, goal";
  EXPECT_NEAR(record.views[1].path_length_m, 0.5, 1e-9);
  EXPECT_NEAR(record.path_length_m(), 1.2, 1e-9);
  EXPECT_EQ(record.collisions, 0U);
  EXPECT_GT(record.coverage.value(), 0.4);
  EXPECT_GT(record.peak_memory_mb, 1.0);

  ExplorationRunOptions at_goals = run_options();
  at_goals.scan_spacing_m = 0.0;
  Shuttle again(a, b, 2);
  const RunRecord spared = ExplorationRun(world, coarse_panoramic(), flyer, at_goals).run(again, a);
  EXPECT_EQ(spared.views.size(), 3U) << "start, goal, goal";
  EXPECT_NEAR(spared.path_length_m(), 1.2, 1e-9);
}

TEST(ExplorationRun, CountsCollisionsWithTheTrueWorldAndStopsAtTheBudget) {
  const World world = two_rooms();
  const auto flyer = std::make_shared<const FreeFlyer>(FreeFlyerOptions{.radius_m = 0.25});
  ExplorationRunOptions options = run_options();
  options.scan_spacing_m = 0.0;
  options.max_views = 6;
  ExplorationRun run(world, coarse_panoramic(), flyer, options);
  const Pose a = pose_looking({0.9, 0.9, 2.1 - 0.3}, 0.0);
  const Pose through_the_wall = pose_looking({2.9, 0.5, 1.9}, 0.0);
  Shuttle shuttle(a, through_the_wall, 1000);
  const RunRecord record = run.run(shuttle, a);
  EXPECT_EQ(record.outcome, RunOutcome::Budget);
  EXPECT_EQ(record.views.size(), 6U);
  EXPECT_EQ(record.collisions, 5U);
  EXPECT_THROW(run.run(shuttle, pose_looking({-3, 0, 0}, 0.0)), std::invalid_argument);
  EXPECT_THROW(run.run(shuttle, pose_looking({1.9, 0.3, 1.0}, 0.0)), std::invalid_argument);
  options.max_views = 0;
  EXPECT_THROW(ExplorationRun(world, coarse_panoramic(), flyer, options), std::invalid_argument);
}

// Along a wall at 0.35 m: within the planning margin, but out of contact.
TEST(ExplorationRun, WhatPlanningKeepsOffAsAMarginIsNoCollision) {
  const World world = two_rooms();
  const auto flyer = std::make_shared<const FreeFlyer>(FreeFlyerOptions{.radius_m = 0.25, .margin_m = 0.2});
  const Pose start = pose_looking({1.0, 1.1, 1.1}, 0.0);
  const Pose beside_the_wall = pose_looking({1.0, 0.55, 1.1}, 0.0);
  ExplorationRunOptions options = run_options();
  options.scan_spacing_m = 0.0;
  options.body_radius_m = flyer->options().radius_m;
  Shuttle there_and_back(start, beside_the_wall, 4);
  EXPECT_EQ(ExplorationRun(world, coarse_panoramic(), flyer, options).run(there_and_back, start).collisions, 0U);
  options.body_radius_m = 0.4;
  Shuttle again(start, beside_the_wall, 4);
  EXPECT_EQ(ExplorationRun(world, coarse_panoramic(), flyer, options).run(again, start).collisions, 4U);
}

TEST(ExplorationRun, APlannerExploresTwoRoomsTheSameWayEveryTime) {
  const World world = two_rooms();
  const auto flyer = std::make_shared<const FreeFlyer>(FreeFlyerOptions{.radius_m = 0.25});
  const RangeSensor sensor = coarse_panoramic();
  ExplorationRunOptions options = run_options();
  options.noise = {.axial = 1.0, .dropped_share = 0.05};
  options.max_views = 60;
  ExplorationRun run(world, sensor, flyer, options);
  const Pose start = run.truth().draw_start(*flyer, 3).value();
  std::vector<RunRecord> records;
  for (int i = 0; i < 2; ++i) {
    const auto planner = make_planner("nearest-frontier", {.sensor = sensor, .platform = flyer});
    records.push_back(run.run(*planner, start));
    EXPECT_NE(records.back().outcome, RunOutcome::Budget);
    EXPECT_GT(records.back().coverage.value(), 0.95);
    EXPECT_EQ(records.back().collisions, 0U);
  }
  ASSERT_EQ(records[0].views.size(), records[1].views.size());
  for (std::size_t i = 0; i < records[0].views.size(); ++i) {
    EXPECT_EQ(records[0].views[i].pose.matrix(), records[1].views[i].pose.matrix());
    EXPECT_EQ(records[0].views[i].coverage, records[1].views[i].coverage);
  }
}

}  // namespace
}  // namespace vantage
