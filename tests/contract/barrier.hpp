// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>

#include "contract/changing_world.hpp"

namespace vantage::testing {

/// What bars a doorway for the body, and lets the sensor see through it.
enum class Barrier : std::uint8_t {
  None,
  Person,  // too little room beside and above
  Fence,   // cells that the host forbids
  Ramp,    // two cells high, in the way of a robot that drives
};

/// Sets the cells of a barrier in the doorway of a building; a fence has none.
inline void set_barrier(ChangingWorld& world, Barrier barrier, std::uint8_t value) {
  const VoxelBox& doorway = world.doorway;
  if (barrier == Barrier::Person) {
    VoxelBox person = doorway;
    person.lo.y = doorway.lo.y + 1;
    person.hi.y = doorway.hi.y - 1;
    person.hi.z = std::max(doorway.lo.z + 1, doorway.hi.z - 1);
    fill_cells(world.solid, person, value);
  } else if (barrier == Barrier::Ramp) {
    const std::int32_t floor = doorway.lo.z;
    for (const std::int32_t height : {1, 2}) {
      VoxelBox step{{doorway.lo.x - 2 + height, doorway.lo.y, floor},
                    {doorway.hi.x + 2 - height, doorway.hi.y, floor + height}};
      fill_cells(world.solid, step, value);
    }
  }
}

}  // namespace vantage::testing
