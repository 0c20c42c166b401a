// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/robot/reachable_space.hpp>
#include <vector>

#include "geometry/block_counts.hpp"
#include "geometry/cell_rows.hpp"
#include "planner/sight_tree.hpp"

namespace vantage::detail {

/// Where sight passes and where the platform can go, from survey to survey, and what looking around unknown cells has
/// found there: an answer stands until something changes where it was looked for.
///
/// Changes are found by comparing the cells with those of the survey before, word by word, so it does not matter by
/// which way a map came to be as it is, nor whether it is the same map. Which cells an answer has looked at is kept
/// by blocks of 4 x 4 x 4: a change in any of them makes it be looked for anew. An answer is that of a memory that
/// begins now, always.
class SightMemory {
 public:
  /// Takes over what is clear and what is reachable now. Lines of sight are `direction_count` rays of `furthest_m`.
  void follow(const OccupancyMap& map, const ReachableSpace& reachable, double furthest_m,
              std::size_t direction_count);

  [[nodiscard]] const CellRows& clear() const { return clear_; }
  [[nodiscard]] const CellRows& reachable() const { return reachable_; }
  [[nodiscard]] double furthest_m() const { return furthest_m_; }

  /// The first reachable cell on the first ray from `unknown` through clear cells that `serves` takes, which may ask
  /// `passes` whether further cells are clear, and says so by `look_at`. As it was found last time if nothing that
  /// mattered has changed; `serves` must answer alike where the same cells are clear, unless it is asked `anew`.
  template <class Passes, class Serves>
  [[nodiscard]] std::optional<VoxelIndex> look_around(const VoxelIndex& unknown, bool anew, const Passes& passes,
                                                      const Serves& serves);
  /// The answer that is being looked for depends on whether this cell is clear.
  void look_at(const VoxelIndex& cell);
  /// Forgets the answers that were not asked for since the last `follow`.
  void forget_others();

 private:
  struct Answer {
    std::optional<VoxelIndex> viewpoint = {};
    bool may_stand = false;                     // found, and not for once only
    std::uint32_t found = 0;                    // in which survey
    std::uint32_t asked = 0;                    // in which survey it was last asked for
    std::vector<std::uint32_t> looked_at = {};  // offsets of blocks
    std::vector<VoxelBox> without_places = {};  // was not looked into, for nothing in it was reachable
  };

  void begin(const OccupancyMap& map, double furthest_m, std::size_t direction_count);
  void make_room(const OccupancyMap& map);
  void mark_changes(const CellRows& before, const CellRows& now);
  [[nodiscard]] bool stands(const Answer& answer) const;
  static VoxelIndex block_of(const VoxelIndex& cell) { return {cell.x >> 2, cell.y >> 2, cell.z >> 2}; }

  double cell_size_m_ = 0.0;
  double furthest_m_ = 0.0;
  std::size_t direction_count_ = 0;
  std::optional<SightTree> tree_;
  VoxelBox cells_;  // that the rows and blocks below reach; grows in leaps
  CellRows clear_;
  CellRows reachable_;
  std::optional<BlockCounts> places_;  // that are reachable
  std::uint32_t survey_ = 0;
  VoxelGrid<std::uint32_t> changed_;    // the last survey in which a cell of the block had changed
  VoxelGrid<std::uint32_t> looked_at_;  // the last question for which a cell of the block was looked at
  std::uint32_t question_ = 0;
  Answer* asked_ = nullptr;  // the answer that is being looked for
  std::unordered_map<VoxelIndex, Answer> answers_;
};

inline void SightMemory::look_at(const VoxelIndex& cell) {
  if (asked_ == nullptr || !cells_.contains(cell)) {
    return;  // beyond the cells nothing is clear, and where they grow all answers are forgotten
  }
  const std::size_t block = looked_at_.offset_of(block_of(cell));
  if (std::exchange(looked_at_.values()[block], question_) != question_) {
    asked_->looked_at.push_back(static_cast<std::uint32_t>(block));
  }
}

template <class Passes, class Serves>
std::optional<VoxelIndex> SightMemory::look_around(const VoxelIndex& unknown, bool anew, const Passes& passes,
                                                   const Serves& serves) {
  Answer& answer = answers_[unknown];
  const bool asked_before = answer.asked == survey_;  // in this survey, from another frontier cell
  answer.asked = survey_;
  if (asked_before || (!anew && stands(answer))) {
    return answer.viewpoint;
  }
  answer = {.found = survey_, .asked = survey_};
  asked_ = &answer;
  ++question_;
  answer.viewpoint = tree_->first(
      unknown,
      [&](const VoxelBox& cells) {
        const bool may_hold = places_->may_hold(cells);
        if (!may_hold) {
          answer.without_places.push_back(cells);
        }
        return may_hold;
      },
      passes, [&](const VoxelIndex& cell) { return reachable_.contains(cell) && serves(cell); });
  asked_ = nullptr;
  answer.may_stand = !anew;
  return answer.viewpoint;
}

}  // namespace vantage::detail
