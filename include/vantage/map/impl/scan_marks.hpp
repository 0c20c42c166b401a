// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <deque>
#include <memory>
#include <optional>
#include <vantage/map/brick.hpp>
#include <vantage/map/brick_directory.hpp>

namespace vantage::detail {

/// Marks of one brick: the cells that rays pass, and the cells in which they end. Words as in Brick.
struct BrickMarks {
  std::array<std::uint64_t, Brick::kWords> passed{};
  std::array<std::uint64_t, Brick::kWords> hit{};
};

/// The cells that a scan touches, as bit planes in the layout of bricks: a dense window around the scan, and a sparse
/// directory for what few far rays touch outside it.
///
/// The position of a cell in the window, word * 64 + bit, is the sum of one part per axis. The parts share no bits,
/// because rows and columns of bricks are padded to powers of two.
class ScanMarks {
 public:
  /// Largest window, in cells. One plane then takes 128 MiB of address space; only touched pages use memory.
  static constexpr std::size_t kMaxWindow = std::size_t{1} << 30U;
  /// Largest number of bricks outside the window. Marks in further bricks are dropped and counted.
  static constexpr std::size_t kMaxFarBricks = std::size_t{1} << 21U;

  /// Creates a window over `cells`, or over as much of it around `origin` as kMaxWindow allows.
  ScanMarks(const VoxelBox& cells, const VoxelIndex& origin);
  /// Creates marks for the cells of `clip` only, which must not be empty. Other cells are ignored.
  [[nodiscard]] static ScanMarks clipped_to(const VoxelBox& clip, const VoxelIndex& origin);

  /// The cells of the window.
  [[nodiscard]] const VoxelBox& window() const { return window_; }
  [[nodiscard]] bool in_window(const VoxelIndex& cell) const { return window_.contains(cell); }
  /// Whether the window holds every cell that may be marked, without a clip.
  [[nodiscard]] bool holds_all() const { return holds_all_ && !clip_; }
  /// Whether the marks are clipped and the window holds all of the clip.
  [[nodiscard]] bool holds_clip() const { return holds_all_ && clip_; }
  /// Whether marks of this cell are ignored.
  [[nodiscard]] bool leaves_out(const VoxelIndex& cell) const { return clip_ && !clip_->contains(cell); }
  /// The number of marks dropped for lack of space.
  [[nodiscard]] std::size_t dropped() const { return dropped_; }
  /// The part of a position that stands for a coordinate of a cell in the window.
  [[nodiscard]] std::uint64_t part(std::size_t axis, std::int32_t coordinate) const {
    const std::array<std::int32_t, 3> lo{window_.lo.x, window_.lo.y, window_.lo.z};
    const auto at = static_cast<std::uint64_t>(coordinate - lo[axis]);
    return (at & 3U) << 2U * axis | (at >> 2U & 1U) << (6U + axis) | at >> 3U << shift_[axis];
  }
  /// The bits of a position that belong to an axis.
  [[nodiscard]] std::uint64_t mask(std::size_t axis) const {
    const std::uint64_t bricks =
        axis == 2 ? ~std::uint64_t{0} : (std::uint64_t{1} << (shift_[axis + 1] - shift_[axis])) - 1;
    return std::uint64_t{3} << 2U * axis | std::uint64_t{1} << (6U + axis) | bricks << shift_[axis];
  }
  [[nodiscard]] std::uint64_t position_of(const VoxelIndex& cell) const {
    return part(0, cell.x) | part(1, cell.y) | part(2, cell.z);
  }
  /// A position after the window, for marks that nobody reads.
  [[nodiscard]] std::uint64_t nowhere() const { return words_ * 64; }
  [[nodiscard]] std::uint64_t* passed() { return passed_.get(); }
  [[nodiscard]] std::uint64_t* hit() { return hit_.get(); }

  /// Whether all cells of a box have a mark of either kind. The box must not be empty and must lie in the window.
  [[nodiscard]] bool all_marked(const VoxelBox& cells) const;

  void mark_passed(const VoxelIndex& cell) { mark(cell, passed_.get(), &BrickMarks::passed); }
  /// Removes the mark of a passed cell.
  void unmark_passed(const VoxelIndex& cell);
  /// Whether a ray ends in the cell with a return.
  [[nodiscard]] bool is_hit(const VoxelIndex& cell) const {
    if (in_window(cell)) {
      const std::uint64_t position = position_of(cell);
      return (hit_[position >> 6U] >> (position & 63U) & 1U) != 0;
    }
    const BrickDirectory::Number number = far_numbers_.find(Brick::of_cell(cell));
    const std::uint64_t offset = Brick::offset_of(cell);
    return number != BrickDirectory::kNone && (far_[number].marks.hit[offset >> 6U] >> (offset & 63U) & 1U) != 0;
  }
  /// Marks a hit cell. Returns whether the mark is new.
  bool mark_hit(const VoxelIndex& cell) { return mark(cell, hit_.get(), &BrickMarks::hit); }

  /// Calls `visit(brick address, passed words, hit words)` for each brick with a mark, in a deterministic order.
  template <class Visit>
  void for_each_marked_brick(Visit&& visit) const {
    for_each_cell(bricks_, [&](const VoxelIndex& brick) {
      const std::uint64_t first = position_of(Brick::first_cell(brick)) >> 6U;
      const std::uint64_t* passed = &passed_[first];
      const std::uint64_t* hit = &hit_[first];
      std::uint64_t any = 0;
      for (std::size_t word = 0; word < Brick::kWords; ++word) {
        any |= passed[word] | hit[word];
      }
      if (any != 0) {
        visit(brick, passed, hit);
      }
    });
    for (const FarBrick& brick : far_) {
      visit(brick.address, brick.marks.passed.data(), brick.marks.hit.data());
    }
  }

 private:
  struct FarBrick {
    BrickMarks marks;
    VoxelIndex address;
  };
  struct Free {
    void operator()(std::uint64_t* words) const { std::free(words); }
  };
  using Plane = std::unique_ptr<std::uint64_t[], Free>;

  static Plane zeros(std::size_t words);
  // Null if there is no space for another brick.
  BrickMarks* far_brick(const VoxelIndex& brick);
  bool mark(const VoxelIndex& cell, std::uint64_t* plane,
            std::array<std::uint64_t, Brick::kWords> BrickMarks::*far_plane) {
    const bool near = in_window(cell);
    BrickMarks* const far = near ? nullptr : far_brick(Brick::of_cell(cell));
    if (!near && far == nullptr) {
      ++dropped_;
      return false;
    }
    const std::uint64_t position = near ? position_of(cell) : Brick::offset_of(cell);
    std::uint64_t& word = near ? plane[position >> 6U] : (far->*far_plane)[position >> 6U];
    const std::uint64_t bit = std::uint64_t{1} << (position & 63U);
    const bool is_new = (word & bit) == 0;
    word |= bit;
    return is_new;
  }

  VoxelBox bricks_;
  VoxelBox window_;
  bool holds_all_;
  std::optional<VoxelBox> clip_;
  std::size_t dropped_ = 0;
  std::array<unsigned, 3> shift_{};  // position of the first bit of each axis's brick coordinate
  std::size_t words_ = 0;
  Plane passed_;
  Plane hit_;
  BrickDirectory far_numbers_;
  std::deque<FarBrick> far_;
  FarBrick* last_far_ = nullptr;
};

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/map/impl/scan_marks.ipp>
#endif
