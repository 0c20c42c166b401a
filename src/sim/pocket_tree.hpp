// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/shortest_visit.hpp"

namespace vantage {

/// The pockets of a space: for each t, the connected sets of places further than t from the start (place 0). A place
/// stands for the pocket that it closes: itself and what is connected with it and at least as far. Its parent stands
/// for the next larger pocket.
///
///     tree of        0 -- 1 -- 2 -- 3 -- 4        5, 6: a branch from 2. Pocket 3 is {3, 4}, pocket 5 is {5, 6},
///     parents                  +-- 5 -- 6         pocket 2 is all beyond 1
///
/// A route that enters pockets and leaves them again covers each way of the tree twice, except on the last way back.
class PocketTree {
 public:
  explicit PocketTree(const StepGraph& graph);

  /// Distance of a place from the start, in cells.
  [[nodiscard]] float depth(std::uint32_t place) const { return depth_[place]; }
  /// Whether routes have to enter the pocket of this place.
  [[nodiscard]] bool is_due(std::uint32_t place) const { return due_[place] != 0; }
  /// The smallest pocket that holds all the places, at least one. If it is due, some pocket that is due.
  [[nodiscard]] std::uint32_t pocket_of(std::span<const std::uint32_t> places) const;
  /// By how much the pocket is deeper than the smallest pocket about it that is due, in cells.
  [[nodiscard]] double gain(std::uint32_t pocket) const;
  /// Routes have to enter this pocket, and so all that hold it.
  void make_due(std::uint32_t pocket);
  /// Lower bound on the length of a route into all due pockets, in cells.
  [[nodiscard]] double bound() const { return 2.0 * length_ - static_cast<double>(deepest_); }

 private:
  std::vector<float> depth_;
  std::vector<std::uint32_t> parent_;
  std::vector<std::uint32_t> furthest_first_;  // the places in the order of depth
  std::vector<std::uint32_t> rank_;            // by place, its position there
  std::vector<std::uint8_t> due_;
  double length_ = 0.0;  // of the tree of due pockets
  float deepest_ = 0.0F;
};

}  // namespace vantage
