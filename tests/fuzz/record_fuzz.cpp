// SPDX-License-Identifier: MIT
// Decodes one cycle of a record (without its checksum) and applies it to a map.
#include <stdexcept>
#include <vantage/report/recorded_cycle.hpp>

#include "fuzz_target.hpp"
#include "report/cycle_codec.hpp"

std::vector<std::string> vantage::fuzz::seeds() {
  RecordedCycle cycle;
  cycle.view.view = 1;
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
  detail::BrickStates states;
  std::vector<std::string> all{detail::encode(cycle, states)};
  cycle.planned = false;
  all.push_back(detail::encode(cycle, states));
  return all;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  vantage::detail::BrickStates states;
  vantage::OccupancyMap map;
  try {
    const vantage::RecordedCycle cycle = vantage::detail::decode({reinterpret_cast<const char*>(data), size}, states);
    vantage::apply_changes(cycle, map);
  } catch (const std::runtime_error&) {  // documented
  }
  return 0;
}
