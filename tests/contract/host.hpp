// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace vantage::testing {

/// How a host follows plans.
enum class Host : std::uint8_t {
  Perfect,
  StopsShort,      // by up to 0.3 m and 15 degrees
  AbortsSilently,  // one goal in three, half-way
  AbortsAndReports,
  MovedByHand,  // every fifth time
  Inexact,      // 1 cm and half a degree off its estimated pose
  OffCentre,
  InACorner,
  PlansFromACopy,  // a new copy of the map for each plan
  Stuck,           // never moves and does not report it
  PlansOnItsWay,   // after three cells, with a motion model
  Outstretched,    // a rod stands out from its body, against the optical axis
};
inline constexpr std::uint32_t kHosts = 12;

[[nodiscard]] inline std::string name_of(Host host) {
  static constexpr std::array kNames{"perfect",           "stops_short", "aborts_silently",  "aborts_and_reports",
                                     "moved_by_hand",     "inexact",     "off_centre",       "in_a_corner",
                                     "plans_from_a_copy", "stuck",       "plans_on_its_way", "outstretched"};
  static_assert(kNames.size() == kHosts);
  return kNames[static_cast<std::size_t>(host)];
}

}  // namespace vantage::testing
