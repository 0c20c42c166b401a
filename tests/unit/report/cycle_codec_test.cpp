// SPDX-License-Identifier: MIT
#include "report/cycle_codec.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

#include "support/full_cycle.hpp"

namespace vantage {
namespace {

using test::full_cycle;

std::string encoded_cycle(const RecordedCycle& cycle) {
  detail::BrickStates states;
  return detail::encode(cycle, states);
}

std::string decode_error(const std::string& bytes) {
  detail::BrickStates states;
  try {
    (void)detail::decode(bytes, states);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(CycleCodec, CutAnywhereIsAnError) {
  const std::string whole = encoded_cycle(full_cycle());
  EXPECT_EQ(decode_error(whole), "");
  ASSERT_GT(whole.size(), 300U);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    EXPECT_NE(decode_error(whole.substr(0, length)), "") << length;
  }
  EXPECT_EQ(decode_error(whole + "x"), "it is longer than what it holds");
}

TEST(CycleCodec, RefusesBricksThatNoMapHolds) {
  const auto with = [](const std::function<void(std::vector<BrickState>&)>& change) {
    RecordedCycle cycle = full_cycle();
    change(cycle.changes);
    return decode_error(encoded_cycle(cycle));
  };
  EXPECT_EQ(with([](auto&) {}), "");
  constexpr std::int32_t kFurthest = kFurthestVoxel / 8;
  EXPECT_EQ(with([](auto& changes) { changes[1].brick = {kFurthest - 1, 0, 4}; }), "");
  EXPECT_EQ(with([](auto& changes) { changes[0].brick = {0, 0, -kFurthest}; }), "");
  const std::string refusal = "a brick lies outside any map, or out of order";
  EXPECT_EQ(with([](auto& changes) { changes[1].brick = {kFurthest, 0, 4}; }), refusal);
  EXPECT_EQ(with([](auto& changes) { changes[0].brick = {0, 0, -kFurthest - 1}; }), refusal);
  EXPECT_EQ(with([](auto& changes) { changes[1].brick = {2'147'483'647, 0, 4}; }), refusal);
  EXPECT_EQ(with([](auto& changes) { std::swap(changes[0], changes[1]); }), refusal);
  EXPECT_EQ(with([](auto& changes) { changes[1] = changes[0]; }), refusal);
}

TEST(CycleCodec, RefusesPosesThatAreNone) {
  for (const double value : {std::nan(""), HUGE_VAL}) {
    RecordedCycle cycle = full_cycle();
    cycle.view.pose.translation().y() = value;
    EXPECT_EQ(decode_error(encoded_cycle(cycle)), "a pose is invalid");
  }
}

}  // namespace
}  // namespace vantage
