// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <unordered_map>
#include <vantage/map/brick.hpp>
#include <vector>

namespace vantage {

/// One bit per cell: which cells of a brick the rays of a scan pass, and in which they end. Words as in Brick.
struct BrickMarks {
  std::array<std::uint64_t, Brick::kWords> passed{};
  std::array<std::uint64_t, Brick::kWords> hit{};
};

/// The cells that a scan touches, as bit planes in the layout of bricks: a dense window around the scan, in which a
/// cell is found by three table look-ups, and a hash table for what a few far rays touch outside of it.
class ScanMarks {
 public:
  /// The largest window, in cells: one plane of it takes 128 MiB of address space, of which only what is touched counts.
  static constexpr std::size_t kMaxWindow = std::size_t{1} << 30U;

  /// A window over `cells`, or as much of it around `origin` as may be.
  ScanMarks(const VoxelBox& cells, const VoxelIndex& origin);

  /// The cells of the window.
  [[nodiscard]] const VoxelBox& window() const { return window_; }
  [[nodiscard]] bool in_window(const VoxelIndex& cell) const { return window_.contains(cell); }
  /// Position of a cell of the window: word * 64 + bit is the sum of one entry for each axis, at (cell - window().lo).
  [[nodiscard]] std::size_t position_of(const VoxelIndex& cell) const {
    const VoxelIndex at = cell - window_.lo;
    return std::size_t{along_[0][static_cast<std::size_t>(at.x)]} + along_[1][static_cast<std::size_t>(at.y)] +
           along_[2][static_cast<std::size_t>(at.z)];
  }
  [[nodiscard]] const std::uint32_t* along(std::size_t axis) const { return along_[axis].data(); }
  [[nodiscard]] std::uint64_t* passed() { return passed_.get(); }
  [[nodiscard]] std::uint64_t* hit() { return hit_.get(); }

  void mark_passed(const VoxelIndex& cell) { mark(cell, passed_.get(), &BrickMarks::passed); }
  /// Whether the mark is new.
  bool mark_hit(const VoxelIndex& cell) { return mark(cell, hit_.get(), &BrickMarks::hit); }

  /// Calls `visit(brick address, passed words, hit words)` for each brick that holds a mark, always in the same order.
  template <class Visit>
  void for_each_marked_brick(Visit&& visit) const {
    const std::uint64_t* passed = passed_.get();
    const std::uint64_t* hit = hit_.get();
    for_each_cell(bricks_, [&](const VoxelIndex& brick) {
      std::uint64_t any = 0;
      for (std::size_t word = 0; word < Brick::kWords; ++word) {
        any |= passed[word] | hit[word];
      }
      if (any != 0) {
        visit(brick, passed, hit);
      }
      passed += Brick::kWords;
      hit += Brick::kWords;
    });
    for (const VoxelIndex& brick : far_order_) {
      const BrickMarks& marks = far_.at(brick);
      visit(brick, marks.passed.data(), marks.hit.data());
    }
  }

 private:
  struct Free {
    void operator()(std::uint64_t* words) const { std::free(words); }
  };
  using Plane = std::unique_ptr<std::uint64_t[], Free>;

  static Plane zeros(std::size_t words);
  BrickMarks& far_brick(const VoxelIndex& brick);
  bool mark(const VoxelIndex& cell, std::uint64_t* plane, std::array<std::uint64_t, Brick::kWords> BrickMarks::*far_plane) {
    const bool near = in_window(cell);
    const std::size_t position = near ? position_of(cell) : Brick::offset_of(cell);
    std::uint64_t& word = near ? plane[position >> 6U] : (far_brick(Brick::of_cell(cell)).*far_plane)[position >> 6U];
    const std::uint64_t bit = std::uint64_t{1} << (position & 63U);
    const bool is_new = (word & bit) == 0;
    word |= bit;
    return is_new;
  }

  VoxelBox bricks_;
  VoxelBox window_;
  std::array<std::vector<std::uint32_t>, 3> along_;
  Plane passed_;
  Plane hit_;
  std::unordered_map<VoxelIndex, BrickMarks> far_;
  std::vector<VoxelIndex> far_order_;
};

}  // namespace vantage
