// SPDX-License-Identifier: MIT
// A doorway that the sensor sees through and the body cannot pass: a person in it, a fence, a ramp. What lies behind
// it is not explored, the plan says where it is, and the run goes on when the way is open.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <ostream>
#include <string>
#include <tuple>
#include <vector>

#include "contract/expect_contract.hpp"
#include "support/every_planner.hpp"
#include "support/sanitized.hpp"

namespace vantage {
namespace {

using testing::Barrier;
using testing::Building;
using testing::DrivenRobot;
using testing::Host;
using testing::Scene;

constexpr std::uint32_t kScenes = test::kSanitized ? 1 : 4;  // of every barrier, for each world that is asked for

/// Rooms with a barrier; a ramp stands in a band of heights, the others in space, in a plane or in a band. A ramp
/// hides in the plane what a robot sees above it, so no camera is turned there.
Scene scene_with(Barrier barrier, std::uint32_t number) {
  const std::size_t sensor = barrier == Barrier::Ramp ? 0 : number % 3;
  Scene scene{Building::Rooms, number, sensor, std::array{0.1, 0.2, 0.4}[number / 3 % 3]};
  scene.flat = barrier != Barrier::Ramp && number % 2 == 1;
  scene.drives = barrier == Barrier::Ramp || number % 4 == 2;
  scene.barrier = barrier;
  return scene;
}

/// Whether the doorway is as wide behind the wall: no other wall ends there.
bool opens_wide(const testing::ChangingWorld& world) {
  VoxelBox behind = world.doorway;
  behind.lo.x += 2;
  behind.hi.x += 2;
  bool open = true;
  for_each_cell(behind, [&](const VoxelIndex& cell) { open = open && world.solid[cell] == 0; });
  return open;
}

/// The column that the reason of a plan names. None if it names no place.
std::optional<VoxelIndex> place_named(const std::string& reason, const VoxelFrame& frame) {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  const std::size_t place = reason.find("around (");
  return place != std::string::npos &&
                 std::sscanf(reason.c_str() + place, "around (%lf, %lf, %lf)", &at.x(), &at.y(), &at.z()) == 3
             ? std::optional(frame.cell_of(at))
             : std::nullopt;
}

// Whether the map still holds a part of what stood in the doorway: a cell that touches the floor or a wall is not
// cleared by rays that end beside it.
bool holds_what_is_gone(const DrivenRobot& run) {
  bool holds = false;
  for_each_cell(run.world().doorway,
                [&](const VoxelIndex& cell) { holds = holds || run.known().at(cell) == Occupancy::Occupied; });
  return holds;
}

struct End {
  bool names_a_place = false;  // behind the barrier
  bool goes_on = false;        // when the barrier is gone
};

End expect_honest_end(const std::string& planner, const Scene& scene) {
  DrivenRobot run(planner, Host::Perfect, scene);
  SCOPED_TRACE(::testing::PrintToString(scene) + ", barrier " + std::to_string(static_cast<int>(scene.barrier)) +
               ", " + planner + ", " + std::to_string(run.plans) + " plans, " +
               std::string(to_string(run.last.outcome)) + ": " + run.last.reason);
  End end{.names_a_place = run.last.outcome == Outcome::Unreachable};
  const auto place = place_named(run.last.reason, run.known().frame());
  if (scene.barrier == Barrier::Ramp && !end.names_a_place) {
    EXPECT_EQ(run.last.outcome, Outcome::Explored);
    EXPECT_GT(run.last.leftover.unreachable, 0U) << "what is seen behind the ramp is left";
  } else {
    EXPECT_TRUE(end.names_a_place && place && place->x > run.world().doorway.lo.x) << "no place behind the barrier";
  }
  // Of what is seen through a crack, a few cells may be seen too little of.
  EXPECT_EQ(run.left().size(), 0U) << "still observable from this side";
  EXPECT_GE(run.coverage(), 0.97) << "of this side";
  if (scene.barrier != Barrier::Ramp) {  // that stays
    run.open();
    end.goes_on = !holds_what_is_gone(run);
    EXPECT_NE(run.last.outcome, Outcome::Blocked) << run.last.reason;
    if (end.goes_on) {
      EXPECT_GE(run.coverage(), 0.97) << run.last.reason;  // of both sides
    }
  }
  EXPECT_EQ(run.collisions, 0U);
  EXPECT_LE(run.misled_by.size(), 3U);
  return end;
}

using Barred = std::tuple<std::string, Barrier>;
class ExplorationBehindABarrier : public ::testing::TestWithParam<Barred> {};

TEST_P(ExplorationBehindABarrier, IsUnreachableUntilItOpens) {
  const auto& [planner, barrier] = GetParam();
  const std::uint32_t scenes = kScenes * testing::number_from("VANTAGE_CONTRACT_SEEDS", 1);
  std::uint32_t tried = 0;
  std::uint32_t named = 0;
  std::uint32_t opened = 0;
  for (std::uint32_t number = testing::number_from("VANTAGE_CONTRACT_FIRST_SEED", 1); tried < scenes; ++number) {
    const Scene scene = scene_with(barrier, number);
    if (opens_wide(scene.world())) {
      const End end = expect_honest_end(planner, scene);
      named += end.names_a_place ? 1U : 0U;
      opened += end.goes_on ? 1U : 0U;
      ++tried;
    }
  }
  // Behind a ramp, in half of the worlds nothing is seen into which the body would fit.
  EXPECT_GE(named, barrier == Barrier::Ramp ? scenes / 4 : scenes);
  EXPECT_GE(opened, barrier == Barrier::Ramp ? 0 : scenes - scenes / 4);
}

std::string name_of_barred(const ::testing::TestParamInfo<Barred>& barred) {
  static const std::vector<std::string> names{"none", "person", "fence", "ramp"};
  return test::test_name(std::get<0>(barred.param) + "_" +
                         names[static_cast<std::size_t>(std::get<1>(barred.param))]);
}

INSTANTIATE_TEST_SUITE_P(Every, ExplorationBehindABarrier,
                         ::testing::Combine(::testing::ValuesIn(test::every_planner()),
                                            ::testing::Values(Barrier::Person, Barrier::Fence, Barrier::Ramp)),
                         name_of_barred);

}  // namespace
}  // namespace vantage
