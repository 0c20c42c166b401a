// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <vantage/robot/capability_map.hpp>

#include "fuzz_target.hpp"
#include "input_file.hpp"

std::vector<std::string> vantage::fuzz::seeds() {
  const auto forward = [](std::span<const double> joints) {
    return std::optional(vantage::pose_looking({std::cos(joints[0]), std::sin(joints[0]), joints[1]}, joints[0]));
  };
  const vantage::JointRange ranges[] = {{-1.0, 1.0}, {0.0, 0.5}};
  const InputFile file(nullptr, 0, ".seed");
  vantage::CapabilityMap(forward, ranges, {.cell_m = 0.25, .direction_bins_per_edge = 2, .samples = 500})
      .save(file.path());
  std::ifstream in(file.path(), std::ios::binary);
  return {std::string(std::istreambuf_iterator<char>(in), {})};
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const vantage::fuzz::InputFile file(data, size, ".map");
  try {
    const auto map = vantage::CapabilityMap::load(file.path());
    for (std::size_t bin = 0; bin < map.bin_count(); ++bin) {
      (void)map.contains(map.frame().centre_of(map.cells().lo), map.middle_of(bin));
    }
    if (map.reachable_cells() > map.cells().size() || !map.directions_at(map.cells().hi).empty()) {
      std::abort();
    }
  } catch (const std::runtime_error&) {  // documented
  }
  return 0;
}
