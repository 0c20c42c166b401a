// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vantage/compiler.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/robot/platform.hpp>
#include <vantage/sim/truth.hpp>

namespace VANTAGE_EXPORT vantage {

/// A lower bound, metres, on any route from `start` that sees every observable cell, for worlds that are too large
/// for watchman_route, whose steps and rules of sight it shares. Takes seconds; usually well below the shortest
/// route.
///
/// The places at a distance of more than t from the start fall apart into pockets. A route has to come into a pocket
/// that holds all the places from which some cell can be seen (the cell is a witness), and out of it again unless it
/// ends there, whatever the order:
///
///     #######################
///     #S          . w     . #     S start, t grows to the right; w witnesses; the dots limit pockets
///     #########   .########.#     the right end of the corridor and the room below are one pocket until the room's
///            #w   . #     #w#     door is passed, then two
///            #######      ###
///
/// The pockets of one t have no way in common, and what a step covers between two values of t it covers in one pocket
/// only. So the sum over t of twice the number of such pockets, less the depth of the deepest one, is a lower bound.
/// It is the length of a tour along a tree, and tells little of places with many ways round.
///
/// Memory: up to 800 bytes per reachable cell, in a plane 150. `stop` ends the search, but not its preparation, with
/// the bound so far. Throws std::invalid_argument unless `threads` > 0 and the platform can be at `start`.
[[nodiscard]] double watchman_bound(const Truth& truth, const Platform& platform, const RangeSensor& sensor,
                                    const Pose& start, int threads = 1, const std::function<bool()>& stop = {});

}  // namespace vantage
