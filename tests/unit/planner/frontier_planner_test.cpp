// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vantage/planner/frontier_planner.hpp>
#include <vantage/planner/make_planner.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/robot/wrapped_platform.hpp>
#include <vector>

namespace vantage {
namespace {

// A body for which every cell has room, and that follows no path beyond a line.
class Tethered final : public WrappedPlatform {
 public:
  using WrappedPlatform::WrappedPlatform;
  [[nodiscard]] bool admits_motion(const OccupancyMap& map, const Pose& from, const Pose& to) const override {
    return to.translation().x() < 1.2 && wrapped().admits_motion(map, from, to);
  }
  [[nodiscard]] std::optional<std::vector<Pose>> path(const OccupancyMap& /*map*/, const Pose& /*from*/,
                                                      const Pose& /*to*/) const override {
    return std::nullopt;
  }
};

class Chooser final : public FrontierPlanner {
 public:
  Chooser(const PlannerSetup& setup, std::function<Choice(const Situation&)> rule)
      : FrontierPlanner(setup), rule_(std::move(rule)) {}
  [[nodiscard]] std::string_view name() const override { return "chooser"; }
  std::size_t asked = 0;

 private:
  [[nodiscard]] Choice choose(const Situation& situation) override {
    ++asked;
    Choice choice = rule_(situation);
    choice.statistics.views_scored = 1;
    return choice;
  }
  std::function<Choice(const Situation&)> rule_;
};

// A room of which the far half is unknown.
OccupancyMap half_a_room() {
  constexpr VoxelBox kRoom{{0, 0, 0}, {30, 30, 7}};
  OccupancyMap map({.resolution_m = 0.2, .region = VoxelFrame{0.2}.box_of(kRoom)});
  for_each_cell(VoxelBox{kRoom.lo, {15, 30, 7}}, [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Free); });
  return map;
}

Pose start() { return pose_looking({0.7, 1.5, 0.7}, 0.0); }

PlannerSetup tethered() {
  RangeSensor sensor = RangeSensor::spherical(90, 45, 2 * std::numbers::pi, std::numbers::pi, 0.0, 1.2);
  return {.sensor = sensor,
          .platform = std::make_shared<Tethered>(std::make_shared<FreeFlyer>(FreeFlyerOptions{.radius_m = 0.2}))};
}

// A strategy may ignore which places rest, or insist on one view.
TEST(FrontierPlanner, EndsWhateverAStrategyChoosesIfNoPathLeadsToAView) {
  const OccupancyMap map = half_a_room();
  std::optional<TargetView> same;
  const auto always_the_same = [&](const Situation& situation) {
    std::uint64_t operations = 0;
    if (!same) {
      same = view_of_target(situation.surveyed(), situation.survey().targets.front(), operations);
    }
    return Choice{.view = same};
  };
  const auto the_first = [](const Situation& situation) {
    std::uint64_t operations = 0;
    return Choice{.view = view_of_target(situation.surveyed(), situation.survey().targets.front(), operations)};
  };
  for (const std::function<Choice(const Situation&)>& rule :
       {std::function<Choice(const Situation&)>(always_the_same),
        std::function<Choice(const Situation&)>(the_first)}) {
    Chooser planner(tethered(), rule);
    const Plan plan = planner.plan(map, start());
    EXPECT_NE(plan.outcome, Outcome::Move) << plan.reason;
    EXPECT_NE(plan.outcome, Outcome::Explored) << plan.reason;
    EXPECT_FALSE(plan.reason.empty());
    EXPECT_GT(planner.asked, 0U);
    EXPECT_EQ(plan.statistics.views_scored, planner.asked) << "every choice counts";
  }
}

TEST(FrontierPlanner, EveryPlannerEndsIfNoPathLeadsToAView) {
  const OccupancyMap map = half_a_room();
  for (const std::string name :
       {"harmonic", "frontier-void", "next-best-view", "frontier-gain", "nearest-frontier", "tour"}) {
    const Plan plan = make_planner(name, tethered())->plan(map, start());
    EXPECT_NE(plan.outcome, Outcome::Move) << name << ": " << plan.reason;
    EXPECT_NE(plan.outcome, Outcome::Explored) << name << ": " << plan.reason;
  }
}

TEST(FrontierPlanner, SaysThatAStrategyChoseNoView) {
  const OccupancyMap map = half_a_room();
  Chooser silent(tethered(), [](const Situation&) { return Choice{}; });
  const Plan plan = silent.plan(map, start());
  EXPECT_EQ(plan.outcome, Outcome::Blocked);
  EXPECT_EQ(plan.reason, "the strategy chose no view");
}

}  // namespace
}  // namespace vantage
