// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/known_map.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Remembers what the sensor has looked at without resolving it, so that no planner stares forever at what its sensor
/// cannot measure: a surface without texture, the open sky, the inside of a wall that rays at a grazing angle have
/// worn away in the map. A planner's only memory beside the map; without it a resumed planner merely tries once more.
///
/// An unknown cell is given up after views from `patience` different cells that were meant for it; a cell from which
/// a view of it has failed is no viewpoint for it again. The memory decays: when one more of the unknown cell's face
/// neighbours becomes known, it gets another chance.
class FailedViews {
 public:
  /// Throws std::invalid_argument unless `patience` > 0.
  explicit FailedViews(int patience = 2);

  /// Announces that a view from `goal` is meant to resolve the cells `sought`, and may resolve some of `hoped`: these
  /// fail, too, if it resolves none of them.
  void expect(const OccupancyMap& map, const Pose& goal, std::vector<VoxelIndex> sought,
              std::vector<VoxelIndex> hoped = {});
  /// Looks at the map now. If it has changed since `expect` and `current` is the goal, to within a cell and ten
  /// degrees, every cell sought that is still unknown counts a failure. A second call without a change of the map
  /// does nothing.
  void review(const OccupancyMap& map, const Pose& current);
  /// Whether a view from this cell has failed to resolve `unknown`.
  [[nodiscard]] bool failed_from(const VoxelIndex& unknown, const VoxelIndex& viewpoint) const;
  /// Whether one has failed from there, or from anywhere else in nearly the same direction: at most `within_rad`
  /// between the lines from the unknown cell.
  [[nodiscard]] bool failed_towards(const VoxelIndex& unknown, const VoxelIndex& viewpoint, double within_rad) const;
  /// Whether any view of this unknown cell has failed.
  [[nodiscard]] bool failed(const VoxelIndex& unknown) const { return failures_of(unknown) != nullptr; }
  /// Whether views of this unknown cell have failed too often.
  [[nodiscard]] bool gave_up(const VoxelIndex& unknown) const;
  /// The views from within this cell that left some of what they sought unresolved. What a sensor had in view there
  /// and did not resolve, it will not resolve from there next time.
  [[nodiscard]] std::span<const Pose> views_from(const VoxelIndex& viewpoint) const;
  /// How many cells have failed at least once.
  [[nodiscard]] std::size_t size() const { return failures_.size(); }

 private:
  void fail(const OccupancyMap& map, const VoxelIndex& viewpoint, const std::vector<VoxelIndex>& cells);
  struct Expectation {
    Pose goal;
    OccupancyMap::Revision revision;
    std::vector<VoxelIndex> sought;
    std::vector<VoxelIndex> hoped;
  };
  struct Failures {
    std::vector<VoxelIndex> viewpoints;
    int known_neighbours = 0;  // when the latest of them failed
  };
  // Planners ask millions of times and hardly any cell has failed: a bit that all cells share whose coordinates are
  // the same modulo its size answers for most.
  class MayHaveFailed {
   public:
    void insert(const VoxelIndex& cell) {
      bits_.resize(kWords);
      bits_[word_of(cell)] |= bit_of(cell);
    }
    void clear() { bits_.clear(); }
    [[nodiscard]] bool contains(const VoxelIndex& cell) const {
      return !bits_.empty() && (bits_[word_of(cell)] & bit_of(cell)) != 0;
    }

   private:
    static constexpr std::size_t kWords = std::size_t{2} * 128 * 64;  // 128 x 128 x 64 cells
    static std::size_t word_of(const VoxelIndex& cell) {
      return (static_cast<std::size_t>(cell.z & 63) * 128 + static_cast<std::size_t>(cell.y & 127)) * 2 +
             static_cast<std::size_t>(cell.x >> 6 & 1);
    }
    static std::uint64_t bit_of(const VoxelIndex& cell) { return std::uint64_t{1} << (cell.x & 63); }

    std::vector<std::uint64_t> bits_;  // none until one has failed
  };
  // Null where none have.
  [[nodiscard]] const Failures* failures_of(const VoxelIndex& unknown) const;

  int patience_;
  std::optional<Expectation> expected_;
  KnownMap map_;  // that was reviewed last
  OccupancyMap::Revision reviewed_ = 0;
  std::unordered_map<VoxelIndex, Failures> failures_;
  MayHaveFailed may_have_failed_;
  std::unordered_map<VoxelIndex, std::vector<Pose>> views_;  // that failed, by place
};

}  // namespace vantage
