// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/sim/world.hpp>

namespace vantage {

// The two scenes of Dornhege & Kleiner 2011, V-B, on an open floor before a robot that stands at the origin and looks
// along +x. Boxes are made of cells of 2.5 cm with surfaces 2.5 mm inside them; planks lie as they fell.
[[nodiscard]] World crates_open_world();
[[nodiscard]] World crates_closed_world();

}  // namespace vantage
