// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vantage/geometry/voxel_grid.hpp>
#include <vector>

#include <vantage/geometry/impl/box_around.hpp>

namespace vantage::detail {

/// The cells of one layer that a sensor may look from. A query meets only those to which a clear line may lead, so a
/// cell that none of them sees costs what lies open around it, not all of them. The lines from a cell start as beams
/// towards its four sides; each solid cell takes out the slopes of the lines through it:
///
///     j = 2    .  .  .  -  -
///         1    .  .  #  -  -     #  solid
///         0    o  .  .  .  .     -  hidden by it: no beam holds a line to them any more
///       k =    0  1  2  3  4     o  the cell; a beam holds the lines of slopes j / k from `lo` to `hi`
///
/// Along a column, a beam goes from solid cell or pose to the next one, so free space costs next to nothing.
class PosePlane {
 public:
  /// Whether the region is one layer, and all poses lie in it.
  [[nodiscard]] static bool holds(const std::vector<VoxelIndex>& poses, const VoxelBox& region) {
    return region.extent().z == 1 &&
           std::all_of(poses.begin(), poses.end(), [&](const VoxelIndex& pose) { return pose.z == region.lo.z; });
  }
  /// At least one pose; all in the layer of `region`. Queries are for cells of the region.
  template <class IsSolid>
  PosePlane(const std::vector<VoxelIndex>& poses, const VoxelBox& region, const IsSolid& is_solid)
      : contents_(box_around(box_around(poses), region), Content::Free),
        along_x_(contents_.box(), 0),
        along_y_(contents_.box(), 0) {
    for_each_cell(contents_.box(),
                  [&](const VoxelIndex& cell) { contents_[cell] = is_solid(cell) ? Content::Solid : Content::Free; });
    for (const VoxelIndex& pose : poses) {
      contents_[pose] = Content::Pose;
    }
    for (std::size_t at = contents_.size(); at-- > 0;) {
      const VoxelIndex cell = contents_.cell_at(at);
      const bool is_free = contents_[cell] == Content::Free;
      along_x_[cell] = is_free ? along_x_.value_or(cell + VoxelIndex{1, 0, 0}, kNone) + 1 : 0;
      along_y_[cell] = is_free ? along_y_.value_or(cell + VoxelIndex{0, 1, 0}, kNone) + 1 : 0;
    }
  }

  /// Calls `ask(pose)` for poses, nearer columns first, until one returns true; returns whether one did. Skips poses
  /// whose columns are further from `cell` than `furthest_cells`, and those that solid cells hide.
  template <class Ask>
  bool any(const VoxelIndex& cell, double furthest_cells, const Ask& ask) const {
    if (contents_[cell] == Content::Pose && ask(cell)) {
      return true;
    }
    std::array<std::vector<Beam>, 4> sides;
    sides.fill({{-1.0, 1.0}});
    const auto is_over = [](const std::vector<Beam>& beams) { return beams.empty(); };
    for (std::int32_t k = 1; k <= furthest_cells + kTie && !std::all_of(sides.begin(), sides.end(), is_over); ++k) {
      for (std::size_t side = 0; side < sides.size(); ++side) {
        const std::vector<Beam> beams = std::exchange(sides[side], {});
        const Column column{cell, side, k};
        if (contents_.contains(column.at(0)) && std::any_of(beams.begin(), beams.end(), [&](const Beam& beam) {
              return meets(beam, column, ask, sides[side]);
            })) {
          return true;
        }
      }
    }
    return false;
  }

 private:
  // Lines that pass an edge or a corner of a cell are left in the beams, for `ask` to judge.
  static constexpr double kTie = 1e-9;
  static constexpr std::int32_t kNone = 1 << 30;  // more steps than a row has cells

  enum class Content : std::uint8_t { Free, Solid, Pose };
  struct Beam {
    double lo;
    double hi;
  };
  // The cells at a distance of k towards one side.
  struct Column {
    VoxelIndex from;
    std::size_t side;
    std::int32_t k;

    [[nodiscard]] bool is_along_y() const { return side < 2; }
    [[nodiscard]] VoxelIndex at(std::int32_t j) const {
      const std::int32_t ahead = side % 2 == 0 ? k : -k;
      return from + (is_along_y() ? VoxelIndex{ahead, j, 0} : VoxelIndex{j, ahead, 0});
    }
    // The distance across at which a line enters or leaves the column, whichever is further down, or further up.
    [[nodiscard]] double lowest(double slope) const { return slope * (slope < 0.0 ? k + 0.5 : k - 0.5); }
    [[nodiscard]] double highest(double slope) const { return slope * (slope < 0.0 ? k - 0.5 : k + 0.5); }
    // The slopes of the lines through the cell j.
    [[nodiscard]] Beam through(std::int32_t j) const {
      const double below = j - 0.5;
      const double above = j + 0.5;
      return {below / (below < 0.0 ? k - 0.5 : k + 0.5), above / (above < 0.0 ? k + 0.5 : k - 0.5)};
    }
  };

  // Follows a beam through a column. What is left of it is added to `behind`. A line that leaves the box does not
  // come back, so cells outside of it do not matter.
  template <class Ask>
  bool meets(const Beam& beam, const Column& column, const Ask& ask, std::vector<Beam>& behind) const {
    const VoxelBox& box = contents_.box();
    const bool along_y = column.is_along_y();
    const std::int32_t least = along_y ? box.lo.y - column.from.y : box.lo.x - column.from.x;
    const std::int32_t most = (along_y ? box.hi.y - column.from.y : box.hi.x - column.from.x) - 1;
    const auto first = std::max(least, static_cast<std::int32_t>(std::floor(column.lowest(beam.lo) + 0.5 - kTie)));
    const auto last = std::min(most, static_cast<std::int32_t>(std::floor(column.highest(beam.hi) + 0.5 + kTie)));
    if (first > last) {
      return false;
    }
    const VoxelGrid<std::int32_t>& steps = along_y ? along_y_ : along_x_;
    double lo = beam.lo;
    for (std::int32_t j = first + steps[column.at(first)]; j <= last && lo <= beam.hi;) {
      const VoxelIndex cell = column.at(j);
      const double slope = static_cast<double>(j) / column.k;
      if (contents_[cell] == Content::Solid) {
        const Beam blocked = column.through(j);
        if (blocked.lo + kTie >= lo) {
          behind.push_back({lo, std::min(blocked.lo + kTie, beam.hi)});
        }
        lo = std::max(lo, blocked.hi - kTie);
      } else if (slope >= beam.lo - kTie && slope <= beam.hi + kTie && ask(cell)) {
        return true;
      }
      j += j < last ? 1 + steps[column.at(j + 1)] : 1;
    }
    if (lo <= beam.hi) {
      behind.push_back({lo, beam.hi});
    }
    return false;
  }

  VoxelGrid<Content> contents_;
  // Steps from a cell to the next one in its row that is not free; kNone or more if there is none.
  VoxelGrid<std::int32_t> along_x_;
  VoxelGrid<std::int32_t> along_y_;
};

}  // namespace vantage::detail
