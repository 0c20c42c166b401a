// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <vantage/geometry/raster_order.hpp>
#include <vantage/planner/make_planner.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/robot/ground_robot.hpp>
#include <vantage/sim/audit.hpp>
#include <vantage/sim/exploration_run.hpp>
#include <vector>

namespace vantage {
namespace {

// A free room with occupied walls; each test adds unknown cells.
OccupancyMap audited_room() {
  OccupancyMap map({.resolution_m = 0.1});
  for_each_cell(VoxelBox{{-1, -1, -1}, {21, 11, 11}}, [&](const VoxelIndex& cell) {
    const bool inside = cell.x >= 0 && cell.x < 20 && cell.y >= 0 && cell.y < 10 && cell.z >= 0 && cell.z < 10;
    map.set(cell, inside ? Occupancy::Free : Occupancy::Occupied);
  });
  return map;
}

RangeSensor audited_lidar(double max_range_m) {
  RangeSensor sensor = RangeSensor::spherical(360, 180, 6.28318, 3.14159, 0.0, max_range_m);
  sensor.reports_no_return = true;
  return sensor;
}

const Pose kInTheRoom = pose_looking({0.25, 0.45, 0.45}, 0.0);

TEST(Audit, FindsTheCellThatCouldStillBeSeen) {
  OccupancyMap map = audited_room();
  const FreeFlyer robot({.radius_m = 0.05});
  EXPECT_EQ(audit(map, robot, audited_lidar(20.0), kInTheRoom, {}).cells_checked, 0U);
  map.set({20, 5, 5}, Occupancy::Unknown);
  const AuditResult found = audit(map, robot, audited_lidar(20.0), kInTheRoom, {});
  EXPECT_EQ(found.cells_checked, 1U);
  EXPECT_EQ(found.observable_left, 1U);
  ASSERT_EQ(found.left.size(), 1U);
  EXPECT_EQ(found.left[0].unknown, (VoxelIndex{20, 5, 5}));
}

TEST(Audit, CountsOnlyWhatRangeHeightAndBodyLetTheSensorSee) {
  OccupancyMap map = audited_room();
  map.set({20, 5, 5}, Occupancy::Unknown);
  const auto left = [&](const Platform& robot, const RangeSensor& sensor) {
    return audit(map, robot, sensor, kInTheRoom, {}).observable_left;
  };
  // Below: a wall across x = 3 with a hole of one cell.
  const FreeFlyer low({.radius_m = 0.0, .max_height_m = 1.0, .margin_m = 0.0});
  for_each_cell(VoxelBox{{3, 0, 0}, {4, 10, 10}}, [&](const VoxelIndex& cell) {
    if (cell != VoxelIndex{3, 5, 5}) {
      map.set(cell, Occupancy::Occupied);
    }
  });
  const FreeFlyer thick({.radius_m = 0.12});
  EXPECT_EQ(left(low, audited_lidar(0.5)), 1U) << "it passes the hole";
  EXPECT_EQ(left(thick, audited_lidar(20.0)), 1U) << "it looks through the hole";
  EXPECT_EQ(left(thick, audited_lidar(1.5)), 0U) << "out of range";
  map.set({3, 5, 5}, Occupancy::Occupied);
  EXPECT_EQ(left(low, audited_lidar(20.0)), 0U) << "behind a wall";

  OccupancyMap above = audited_room();
  above.set({10, 5, 10}, Occupancy::Unknown);
  const FreeFlyer level({.radius_m = 0.05, .max_height_m = 0.5, .yaw_only = true});
  const FreeFlyer tilting({.radius_m = 0.05, .max_height_m = 0.5});
  const RangeSensor narrow = RangeSensor::pinhole(64, 48, 1.0, 0.6, 0.0, 0.9);
  EXPECT_EQ(audit(above, level, narrow, kInTheRoom, {}).observable_left, 0U);
  EXPECT_EQ(audit(above, tilting, narrow, kInTheRoom, {}).observable_left, 1U);
}

TEST(Audit, TellsApartWhatWasLookedAtInVain) {
  OccupancyMap map = audited_room();
  map.set({20, 5, 5}, Occupancy::Unknown);
  const FreeFlyer robot({.radius_m = 0.05});
  const Pose other = pose_looking({0.55, 0.25, 0.45}, 0.0);
  const Pose away = pose_looking({0.55, 0.25, 0.45}, 3.14159);
  const RangeSensor narrow = RangeSensor::pinhole(64, 48, 1.0, 0.6, 0.0, 20.0);
  const auto in_vain = [&](std::vector<Pose> looked_from) {
    const AuditResult found = audit(map, robot, narrow, kInTheRoom, looked_from);
    EXPECT_EQ(found.observable_left + found.looked_at_in_vain, 1U);
    EXPECT_EQ(found.left.size(), found.observable_left);
    return found.looked_at_in_vain;
  };
  EXPECT_EQ(in_vain({}), 0U);
  EXPECT_EQ(in_vain({kInTheRoom, kInTheRoom}), 0U) << "from one place only";
  EXPECT_EQ(in_vain({kInTheRoom, away}), 0U) << "the second looks elsewhere";
  EXPECT_EQ(in_vain({kInTheRoom, other}), 1U);
}

TEST(Audit, OneLookIsEnoughWhereNoOtherPlaceSeesTheCell) {
  OccupancyMap map({.resolution_m = 0.1});
  const auto corridor = [](std::int32_t x) { return VoxelIndex{x, 5, 5}; };
  for_each_cell(VoxelBox{corridor(-1), corridor(20) + VoxelIndex{1, 1, 1}}.grown(1),
                [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Occupied); });
  for (std::int32_t x = 0; x < 20; ++x) {
    map.set(corridor(x), Occupancy::Free);
  }
  map.set(corridor(20), Occupancy::Unknown);
  const FreeFlyer robot({.radius_m = 0.05, .margin_m = 0.0});
  const Pose at_the_end = pose_looking(map.frame().centre_of(corridor(19)), 0.0);
  const auto in_vain = [&](double range_m, const std::vector<Pose>& looked_from) {
    const AuditResult found = audit(map, robot, audited_lidar(range_m), at_the_end, looked_from);
    EXPECT_EQ(found.observable_left + found.looked_at_in_vain, 1U);
    return found.looked_at_in_vain;
  };
  EXPECT_EQ(in_vain(0.25, {}), 0U);
  EXPECT_EQ(in_vain(0.25, {at_the_end}), 1U) << "else it is seen from the cell beside this one only";
  EXPECT_EQ(in_vain(0.35, {at_the_end}), 0U) << "the third cell sees it, too";
}

// Whether the straight line between two cell centres touches this cell, by its distances along the axes.
bool line_touches(const VoxelIndex& a, const VoxelIndex& b, const VoxelIndex& cell) {
  double enter = 0.0;
  double leave = 1.0;
  for (const auto& [from, to, at] : {std::array<double, 3>{a.x + 0.5, b.x + 0.5, double(cell.x)},
                                     {a.y + 0.5, b.y + 0.5, double(cell.y)},
                                     {a.z + 0.5, b.z + 0.5, double(cell.z)}}) {
    if (from == to) {
      if (from < at || from > at + 1.0) {
        return false;
      }
      continue;
    }
    const double low = (at - from) / (to - from);
    const double high = (at + 1.0 - from) / (to - from);
    enter = std::max(enter, std::min(low, high));
    leave = std::min(leave, std::max(low, high));
  }
  return enter <= leave + 1e-9;
}

// Compares with the definition in a map small enough to test every cell with every line.
TEST(Audit, AgreesWithItsDefinitionInRandomMaps) {
  std::mt19937_64 engine(3);
  const VoxelBox box{{-3, 2, -2}, {4, 9, 3}};
  const FreeFlyer robot({.radius_m = 0.0, .margin_m = 0.0});
  const RangeSensor sensor = audited_lidar(0.52);
  std::size_t left = 0;
  std::size_t hidden = 0;
  for (int world = 0; world < 60; ++world) {
    OccupancyMap map({.resolution_m = 0.1});
    for_each_cell(box, [&](const VoxelIndex& cell) {
      const auto drawn = engine() % 20;
      map.set(cell, drawn < 11 ? Occupancy::Free : drawn < 16 ? Occupancy::Occupied : Occupancy::Unknown);
    });
    const VoxelIndex start{0, 5, 0};
    map.set(start, Occupancy::Free);
    std::vector<VoxelIndex> reached{start};
    VoxelGrid<std::uint8_t> seen(box, 0);
    seen[start] = 1;
    for (std::size_t next = 0; next < reached.size(); ++next) {
      for (const VoxelIndex& step : kFaceNeighbours) {
        const VoxelIndex cell = reached[next] + step;
        if (map.at(cell) == Occupancy::Free && seen[cell] == 0) {
          seen[cell] = 1;
          reached.push_back(cell);
        }
      }
    }
    const AuditResult found =
        audit(map, robot, sensor, pose_looking(map.frame().centre_of(start), 0.0), {}, 1 + world % 3);
    std::vector<VoxelIndex> expected;
    for_each_cell(box.grown(1), [&](const VoxelIndex& unknown) {
      if (map.at(unknown) != Occupancy::Unknown ||
          std::none_of(kFaceNeighbours.begin(), kFaceNeighbours.end(),
                       [&](const VoxelIndex& step) { return map.at(unknown + step) == Occupancy::Free; })) {
        return;
      }
      const bool observable = std::any_of(reached.begin(), reached.end(), [&](const VoxelIndex& place) {
        bool clear = (map.frame().centre_of(unknown) - map.frame().centre_of(place)).norm() <= sensor.max_range_m;
        for_each_cell(box.grown(1), [&](const VoxelIndex& cell) {
          clear =
              clear && (cell == unknown || map.at(cell) == Occupancy::Free || !line_touches(place, unknown, cell));
        });
        return clear;
      });
      if (observable) {
        expected.push_back(unknown);
      }
      ++(observable ? left : hidden);
    });
    std::vector<VoxelIndex> cells;
    for (const ObservableCell& cell : found.left) {
      cells.push_back(cell.unknown);
    }
    EXPECT_EQ(cells, expected) << "in world " << world;
  }
  EXPECT_GT(left, 600U);
  EXPECT_GT(hidden, 100U);
}

// A complete run leaves nothing, the same run cut short leaves something.
TEST(Audit, OfARunThatExploredFindsNothing) {
  GroundPlan plan{.pixel_m = 0.2};
  plan.solid = VoxelGrid<std::uint8_t>({{0, 0, 0}, {40, 30, 1}}, 0);
  for_each_cell(plan.solid.box(), [&](const VoxelIndex& pixel) {
    const bool wall = pixel.x == 13 || pixel.x == 26 || (pixel.y == 15 && pixel.x > 13);
    const bool door = pixel.y % 14 < 5 && pixel.x % 7 < 6;
    plan.solid[pixel] = wall && !door ? 1 : 0;
  });
  const World world = World::from_plan("rooms of a floor", plan);
  const RangeSensor sensor = in_plane(RangeSensor::preset("lidar"));
  const auto robot = std::make_shared<const GroundRobot>(GroundRobotOptions{.radius_m = 0.2});
  for (const bool cut_short : {false, true}) {
    ExplorationRun run(world, sensor, robot,
                       {.map = {.resolution_m = 0.2}, .max_views = cut_short ? 2U : 500U, .measure_coverage = false});
    const auto planner = make_planner("nearest-frontier", {.sensor = sensor, .platform = robot}, {});
    const RunRecord record = run.run(*planner, *run.truth().draw_start(*robot, 1));
    std::vector<Pose> looked_from;
    for (const ViewRecord& view : record.views) {
      looked_from.push_back(view.pose);
    }
    const AuditResult found = audit(run.known(), *robot, sensor, looked_from.back(), looked_from);
    EXPECT_EQ(record.outcome == RunOutcome::Explored, !cut_short) << record.reason;
    EXPECT_EQ(found.observable_left == 0, !cut_short)
        << found.observable_left << " left, " << found.looked_at_in_vain << " in vain, of " << found.cells_checked;
  }
}

TEST(Audit, RefusesWhatIsNoPose) {
  const OccupancyMap map = audited_room();
  Pose skewed = kInTheRoom;
  skewed.linear() *= 2.0;
  const FreeFlyer robot;
  EXPECT_THROW((void)audit(map, robot, audited_lidar(5.0), skewed, {}), std::invalid_argument);
  EXPECT_THROW((void)audit(map, robot, audited_lidar(5.0), kInTheRoom, std::vector<Pose>{skewed}),
               std::invalid_argument);
  EXPECT_THROW((void)audit(map, robot, audited_lidar(5.0), kInTheRoom, {}, 0), std::invalid_argument);
  Pose far_away = kInTheRoom;
  far_away.translation().x() = 1e12;
  EXPECT_EQ(audit(map, robot, audited_lidar(5.0), far_away, {}).observable_left, 0U);
}

}  // namespace
}  // namespace vantage
