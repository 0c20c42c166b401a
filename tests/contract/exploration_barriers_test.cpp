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

#include "contract/driven_robot.hpp"
#include "support/every_planner.hpp"

namespace vantage {
namespace {

using testing::Barrier;
using testing::Building;
using testing::DrivenRobot;
using testing::Host;
using testing::Scene;

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

void expect_honest_end(const std::string& planner, const Scene& scene) {
  DrivenRobot run(planner, Host::Perfect, scene);
  SCOPED_TRACE(::testing::PrintToString(scene) + ", barrier " + std::to_string(static_cast<int>(scene.barrier)) +
               ", " + planner + ", " + std::to_string(run.plans) + " plans, " +
               std::string(to_string(run.last.outcome)) + ": " + run.last.reason);
  const bool sees_room = run.last.outcome == Outcome::Unreachable;
  const auto place = place_named(run.last.reason, run.known().frame());
  if (scene.barrier == Barrier::Ramp && !sees_room) {
    EXPECT_EQ(run.last.outcome, Outcome::Explored);
    EXPECT_GT(run.last.leftover.unreachable, 0U) << "what is seen behind the ramp is left";
  } else {
    EXPECT_TRUE(sees_room && place && place->x > run.world().doorway.lo.x) << "names no place behind the barrier";
  }
  const double least = scene.drives ? 0.97 : 0.99;  // of a floor, one column may be a fiftieth
  EXPECT_EQ(run.left().size(), 0U) << "still observable from this side";
  EXPECT_GE(run.coverage(), least) << "of this side";
  if (scene.barrier == Barrier::Ramp) {  // it stays
    return;
  }
  run.open();
  EXPECT_TRUE(run.last.outcome == Outcome::Explored || (scene.drives && run.last.outcome == Outcome::Unreachable))
      << to_string(run.last.outcome) << ": " << run.last.reason;
  EXPECT_GE(run.coverage(), least);
  EXPECT_EQ(run.collisions, 0U);
  EXPECT_EQ(run.misled_by.size(), 0U);
}

using Barred = std::tuple<std::string, Barrier>;
class ExplorationBehindABarrier : public ::testing::TestWithParam<Barred> {};

TEST_P(ExplorationBehindABarrier, IsUnreachableUntilItOpens) {
  const auto& [planner, barrier] = GetParam();
  std::size_t tried = 0;
  for (std::uint32_t number = 1; tried < 4; ++number) {
    const Scene scene = scene_with(barrier, number);
    if (opens_wide(scene.world())) {
      expect_honest_end(planner, scene);
      ++tried;
    }
  }
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
