// SPDX-License-Identifier: MIT
// A map of nav2: its files (input_folder.hpp), of which room.yaml is read.
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <vantage/sim/nav2_map_file.hpp>

#include "fuzz_target.hpp"
#include "input_folder.hpp"

std::vector<std::string> vantage::fuzz::seeds() {
  const std::string yaml =
      "@@ room.yaml\nimage: room.pgm\nmode: trinary\nresolution: 0.05\norigin: [-1.5, 2, 0.5]\nnegate: 0\n"
      "occupied_thresh: 0.65\nfree_thresh: 0.196\n";
  return {yaml + "@@ room.pgm\nP5\n# made by hand\n3 2\n255\n" + "\xFE\xCD\x01\x01\xFE\xFE",
          yaml + "@@ room.pgm\nP2\n3 2\n9\n9 7 0\n1 9 9\n"};
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const vantage::fuzz::InputFolder folder(std::string_view(reinterpret_cast<const char*>(data), size));
  try {
    const vantage::GroundPlan plan = vantage::read_nav2_map(folder.path() / "room.yaml");
    if (plan.solid.box().empty() || !(plan.pixel_m > 0.0) || !plan.bounds().min.allFinite()) {
      std::abort();
    }
  } catch (const std::runtime_error&) {  // documented
  }
  return 0;
}
