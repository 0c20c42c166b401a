// SPDX-License-Identifier: MIT
// Decodes one cycle of a record (without its checksum) and applies it to a map.
#include <stdexcept>
#include <vantage/report/recorded_cycle.hpp>

#include "fuzz_target.hpp"
#include "report/cycle_codec.hpp"
#include "support/full_cycle.hpp"

std::vector<std::string> vantage::fuzz::seeds() {
  RecordedCycle cycle = test::full_cycle();
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
