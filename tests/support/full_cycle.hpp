// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/report/recorded_cycle.hpp>

namespace vantage::test {

/// A cycle of a record in which nothing is empty.
[[nodiscard]] inline RecordedCycle full_cycle() {
  RecordedCycle cycle;
  cycle.view.view = 3;
  cycle.view.coverage = 0.5;
  cycle.view.passed = {{0, 0, 0}, {1, 2, 3}};
  cycle.planned = true;
  cycle.reason = "there is more to see";
  cycle.path = {Pose::Identity(), Pose::Identity()};
  cycle.candidates.emplace_back();
  cycle.field = {{{1, 2, 3}, {0, 0, 1}, 0.5F}};
  BrickState brick{.brick = {1, 2, 3}};
  brick.known = {0xFFFF, 7};
  brick.occupied = {0xF0, 1};
  cycle.changes = {brick, {.brick = {2, 2, 3}}};
  return cycle;
}

}  // namespace vantage::test
