// SPDX-License-Identifier: MIT
// A robot that never stops: it explores a building in which a person walks and of which it forgets a part whenever
// nothing is left to do. Neither memory nor the time of a plan may grow, and no goal may come again and again.
// VANTAGE_SOAK_CYCLES: number of scans and plans of each planner.
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vantage/planner/assume_free.hpp>
#include <vantage/planner/make_planner.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vector>

#include "contract/asked_goals.hpp"
#include "contract/changing_world.hpp"
#include "support/every_planner.hpp"

namespace vantage {
namespace {

using testing::Building;
using testing::ChangingWorld;

constexpr std::size_t kWindows = 10;
constexpr std::size_t kLongRun = 10'000;  // cycles from which the time of a plan is judged, too
constexpr double kBodyCells = 0.7;

std::size_t bytes_in_use() {
  const struct mallinfo2 info = ::mallinfo2();
  return info.uordblks + info.hblkhd;
}

/// What was measured in a tenth of the cycles.
struct Window {
  std::size_t most_bytes = 0;
  double plan_s = 0.0;
  std::size_t plans = 0;

  [[nodiscard]] double plan_ms() const { return 1e3 * plan_s / static_cast<double>(std::max<std::size_t>(plans, 1)); }
};

class TirelessRobot {
 public:
  explicit TirelessRobot(const std::string& planner)
      : world_(testing::make_changing_world(Building::Walker, 3, 0.2, false)),
        sensor_(RangeSensor::spherical(90, 45, 2 * std::numbers::pi, std::numbers::pi, 0.0, 3.0)),
        platform_(std::make_shared<FreeFlyer>(FreeFlyerOptions{.radius_m = kBodyCells * 0.2})),
        map_({.resolution_m = 0.2, .region = world_.frame.box_of(world_.solid.box())}),
        pose_(pose_looking(world_.frame.centre_of({3, 3, 3}), 0.3)) {
    sensor_.reports_no_return = true;
    planner_ = make_planner(planner, {sensor_, platform_, 7, 1});
    assume_free(map_, *platform_, pose_);
  }

  void run(std::size_t cycles) {
    for (std::size_t cycle = 0; cycle < cycles; ++cycle) {
      map_.insert(testing::scan_of(world_, sensor_, pose_));
      world_.tick(pose_.translation());
      const std::clock_t start = std::clock();
      const Plan plan = planner_->plan(map_, pose_);
      Window& window = windows[cycle * kWindows / cycles];
      window.plan_s += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
      ++window.plans;
      if (plan.outcome == Outcome::Move) {
        ++moves;
        asked.count(plan, pose_, map_);
        follow(plan);
      } else {
        blocked += plan.outcome == Outcome::Blocked ? 1U : 0U;
        forget();
      }
      window.most_bytes = std::max(window.most_bytes, bytes_in_use());
    }
  }

  std::array<Window, kWindows> windows;
  std::size_t moves = 0;
  std::size_t blocked = 0;
  testing::AskedGoals asked;

 private:
  // Goes from pose to pose of the path, and stops before the person.
  void follow(const Plan& plan) {
    for (const Pose& next : plan.path) {
      const VoxelIndex at = world_.frame.cell_of(next.translation());
      if (world_.person && world_.person->grown(1).contains(at)) {
        return;
      }
      pose_ = next;
    }
  }
  void forget() {
    const auto draw = [this](std::int32_t below) {
      return static_cast<std::int32_t>(engine_() % static_cast<std::uint32_t>(below));
    };
    const VoxelIndex extent = world_.solid.box().extent();
    const VoxelIndex lo{draw(extent.x - 5), draw(extent.y - 5), draw(extent.z - 4)};
    const VoxelIndex at = world_.frame.cell_of(pose_.translation());
    for_each_cell(VoxelBox{lo, lo + VoxelIndex{5, 5, 4}}, [&](const VoxelIndex& cell) {
      if (!(VoxelBox{at, at + VoxelIndex{1, 1, 1}}.grown(2).contains(cell))) {
        map_.set(cell, Occupancy::Unknown);
      }
    });
    asked.begin_again();
  }

  ChangingWorld world_;
  RangeSensor sensor_;
  std::shared_ptr<const Platform> platform_;
  OccupancyMap map_;
  Pose pose_;
  std::unique_ptr<ExplorationPlanner> planner_;
  std::mt19937 engine_{5};
};

class Soak : public ::testing::TestWithParam<std::string> {};

TEST_P(Soak, MemoryAndTimeStayAsTheyAreAndNoGoalComesAgainAndAgain) {
  const char* const text = std::getenv("VANTAGE_SOAK_CYCLES");
  const std::size_t cycles = text != nullptr ? std::strtoul(text, nullptr, 10) : 600;
  TirelessRobot robot(GetParam());
  robot.run(cycles);
  std::string bytes;
  std::string times;
  for (const Window& window : robot.windows) {
    std::array<char, 32> number{};
    std::snprintf(number.data(), number.size(), " %.2f", 1e-6 * static_cast<double>(window.most_bytes));
    bytes += number.data();
    std::snprintf(number.data(), number.size(), " %.2f", window.plan_ms());
    times += number.data();
  }
  std::printf("%s: %zu cycles, %zu moves, at most %zu plans in a row for one goal\n  MB in use%s\n  ms a plan%s\n",
              GetParam().c_str(), cycles, robot.moves, robot.asked.most(), bytes.c_str(), times.c_str());
  EXPECT_GT(robot.moves, cycles / 10);
  EXPECT_LE(robot.blocked, cycles / 100);
  EXPECT_LE(robot.asked.most(), 2U) << "the same goal again and again";
  // Warm from the fourth tenth on; from there on nothing may pile up.
  std::size_t warm = 0;
  for (std::size_t i = 3; i < 6; ++i) {
    warm = std::max(warm, robot.windows[i].most_bytes);
  }
  EXPECT_LE(static_cast<double>(robot.windows.back().most_bytes), 1.05 * static_cast<double>(warm) + 100'000.0);
  if (cycles >= kLongRun) {
    EXPECT_LE(robot.windows.back().plan_ms(), 1.5 * robot.windows[1].plan_ms() + 0.1);
  }
}

INSTANTIATE_TEST_SUITE_P(Every, Soak, ::testing::ValuesIn(test::every_planner()), test::name_of_planner);

}  // namespace
}  // namespace vantage
