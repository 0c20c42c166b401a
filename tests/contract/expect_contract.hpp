// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <tuple>
#include <vector>

#include "contract/driven_robot.hpp"

namespace vantage::testing {

/// The value of an environment variable.
[[nodiscard]] inline std::uint32_t number_from(const char* variable, std::uint32_t otherwise) {
  const char* const text = std::getenv(variable);
  return text != nullptr ? static_cast<std::uint32_t>(std::strtoul(text, nullptr, 10)) : otherwise;
}

/// Where a run may fall short of the contract.
struct Concessions {
  double least_coverage = 0.99;
  std::size_t left = 0;         // cells that the audit finds
  std::size_t times_views = 3;  // of the perfect host
};

/// Runs to the end. Returns whether the run ended as it must.
inline bool expect_contract(const std::string& planner, Host host, const Scene& scene,
                            const Concessions& concessions = {}) {
  const DrivenRobot run(planner, host, scene);
  const std::string what = ::testing::PrintToString(scene) + ", " + planner + ", " + name_of(host) + ", " +
                           std::to_string(run.plans) + " plans, " + std::string(to_string(run.last.outcome)) + ": " +
                           run.last.reason;
  SCOPED_TRACE(what);
  EXPECT_LT(run.plans, DrivenRobot::kMostPlans) << "it does not end by itself";
  // A robot that is carried elsewhere, or cannot turn, may see no cell in which the body fits, and a person may stand
  // in front of the robot, or close to its body, for as long as it waits. Then the plan says what helps.
  const bool may_lack_space = host == Host::MovedByHand || host == Host::Stuck || run.ends_beside_a_moving_object();
  const bool may_not_move = host == Host::Stuck || !scene.world().is_static();
  if (run.last.outcome == Outcome::Blocked) {
    const auto says = [&](const char* remedy) { return run.last.reason.find(remedy) != std::string::npos; };
    EXPECT_TRUE((may_lack_space && says("assume_free")) || (may_not_move && says("free it")));
  }
  EXPECT_LE(run.misled_by.size(), 3U);
  EXPECT_LE(run.pits_met.size(), host == Host::Inexact ? 1U : 0U) << "columns; a rim may be mapped beside its place";
  EXPECT_EQ(run.refused_ways, 0U) << "motions that the platform does not admit";
  EXPECT_EQ(run.collisions, 0U);
  EXPECT_EQ(run.disagreements, 0U) << "of one and two threads";
  EXPECT_LE(run.asked.most(), 2U) << "the same goal again and again";
  const bool all_is_seen = run.last.outcome == Outcome::Explored ||
                           run.last.reason.find("there is more to see from free space that is cut off") == 0;
  if (all_is_seen) {  // of what can be reached
    const std::vector<VoxelIndex> left = run.left();
    EXPECT_LE(left.size(), concessions.left)
        << "still observable: " << left.front().x << " " << left.front().y << " " << left.front().z;
  }
  // With walls between cells, the map decides which cells are free. A robot that is placed behind bars, or that
  // maps walls where none are, may be cut off and report that. So may one with a rod that has no room to turn.
  const bool maps_walls_twice = host == Host::Inexact && scene.inset == 0.0;
  const bool may_be_cut_off = (host == Host::MovedByHand || host == Host::Outstretched || maps_walls_twice) &&
                              run.last.outcome != Outcome::Explored;
  const bool ended = run.last.outcome != Outcome::Move;
  if (!scene.world().is_static() || scene.building == Building::Sheets || host == Host::Stuck || may_be_cut_off ||
      !ended) {
    return ended;
  }
  // In a window of a real building, a shaft may be free that a level sensor cannot see before it is in it, and
  // slivers may be in sight that hide behind a part of a cell; the audit judges there.
  // Of a floor, one column may be a fiftieth of what is observable.
  if (scene.real == nullptr) {
    EXPECT_GE(run.coverage(), scene.drives ? 0.97 : concessions.least_coverage);
  }
  if (host != Host::Perfect) {
    const DrivenRobot perfect(planner, Host::Perfect, scene);
    if (host == Host::PlansOnItsWay) {
      EXPECT_LE(run.gone_m, 3 * perfect.gone_m + 5 * scene.cell_m) << "the perfect host goes " << perfect.gone_m;
    } else {
      EXPECT_LE(run.plans, concessions.times_views * perfect.plans + 5) << "the perfect host takes " << perfect.plans;
    }
  }
  return ended;
}

using Pair = std::tuple<std::string, Host>;

}  // namespace vantage::testing
