// SPDX-License-Identifier: MIT
#include <stdexcept>
#include <vantage/map/octomap_bridge.hpp>

#include "fuzz_target.hpp"
#include "input_file.hpp"

std::vector<std::string> vantage::fuzz::seeds() {
  OccupancyMap map;
  for (std::int32_t i = 0; i < 20; ++i) {
    map.set({i, i * i % 7, -i}, i % 3 == 0 ? Occupancy::Occupied : Occupancy::Free);
  }
  std::vector<std::string> all;
  for (const char* ending : {".bt", ".ot"}) {
    const InputFile file(nullptr, 0, ending);
    save_octomap(map, file.path());
    std::ifstream in(file.path(), std::ios::binary);
    all.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  return all;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::uint64_t kMostCells = 100'000;  // one byte can encode 2^48 cells
  const vantage::fuzz::InputFile file(data, size, ".ot");
  try {
    (void)vantage::load_octomap(file.path(), {.max_cells = kMostCells});
  } catch (const std::runtime_error&) {  // documented
  }
  return 0;
}
