// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/sim/world.hpp>

namespace vantage {

// Two scenes on an open floor before a robot at the origin that looks along +x. Boxes are made of cells of 2.5 cm
// with surfaces 2.5 mm inside them; planks lie askew. (Dornhege & Kleiner 2011, V-B)
[[nodiscard]] World crates_open_world();
[[nodiscard]] World crates_closed_world();

}  // namespace vantage
