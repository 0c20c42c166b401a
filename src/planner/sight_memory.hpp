// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vantage/map/brick_grid.hpp>
#include <vantage/map/known_map.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/robot/reachable_space.hpp>
#include <vector>

#include "map/brick_tree.hpp"
#include "planner/sight_tree.hpp"

namespace vantage::detail {

/// Where sight passes and where the platform can go, from survey to survey, and what looking around unknown cells has
/// found there: an answer stands until something changes where it was looked for.
///
/// Cells are kept in blocks of 4 x 4 x 4. Changes are found by comparing blocks that were written to, all of them
/// where the map is another one, with what they were in the survey before. A change in a block that an answer has
/// looked at makes it be looked for anew. An answer is that of a memory that begins now, always. Memory follows what
/// is known, never the box around it.
class SightMemory {
 public:
  /// Takes over what is clear and what is reachable now. Lines of sight are `direction_count` rays of `furthest_m`.
  void follow(const OccupancyMap& map, const ReachableSpace& reachable, double furthest_m,
              std::size_t direction_count);

  [[nodiscard]] double furthest_m() const { return furthest_m_; }
  /// Whether sight passes this cell. The answer that is being looked for depends on it from now on.
  [[nodiscard]] bool is_clear(const VoxelIndex& cell);
  /// Whether the platform can bring the sensor to this cell.
  [[nodiscard]] bool is_reachable(const VoxelIndex& cell) const;

  /// The first reachable cell on the first ray from `unknown` through cells that `passes` lets through which `serves`
  /// takes; both ask `is_clear` of whatever their answer depends on. As it was found last time if nothing that
  /// mattered has changed; `serves` must answer alike where the same cells are clear, unless it is asked `anew`.
  template <class Passes, class Serves>
  [[nodiscard]] std::optional<VoxelIndex> look_around(const VoxelIndex& unknown, bool anew, const Passes& passes,
                                                      const Serves& serves);
  /// Forgets the answers that were not asked for since the last `follow`.
  void forget_others();

 private:
  struct Block {
    std::uint64_t clear = 0;      // a bit a cell, in the order of a Brick's words
    std::uint64_t reachable = 0;  // the same
    std::uint32_t changed = 0;    // the last survey in which a cell had changed
    std::uint32_t looked_at = 0;  // the last question for which a cell was looked at
  };
  struct Answer {
    std::optional<VoxelIndex> viewpoint = {};
    bool may_stand = false;                     // found, and not for once only
    std::uint32_t found = 0;                    // in which survey
    std::uint32_t asked = 0;                    // in which survey it was last asked for
    std::vector<std::uint32_t> looked_at = {};  // positions of blocks
    std::vector<VoxelBox> without_places = {};  // was not looked into, for nothing in it was reachable
  };

  void begin(const OccupancyMap& map, double furthest_m, std::size_t direction_count);
  void follow_clear(const OccupancyMap& map);
  void follow_places(const ReachableSpace& reachable);
  template <class Member>
  void set(const VoxelIndex& brick, const BrickPlane& cells, Member member);
  [[nodiscard]] bool stands(const Answer& answer) const;
  static VoxelIndex block_of(const VoxelIndex& cell) { return {cell.x >> 2, cell.y >> 2, cell.z >> 2}; }
  static std::uint64_t bit_of(const VoxelIndex& cell) { return std::uint64_t{1} << (Brick::offset_of(cell) & 63U); }

  double cell_size_m_ = 0.0;
  double furthest_m_ = 0.0;
  std::size_t direction_count_ = 0;
  std::optional<SightTree> tree_;
  KnownMap map_;  // that was followed last
  OccupancyMap::Revision followed_ = 0;
  BrickGrid<Block> blocks_;          // by their addresses, as if they were cells
  std::vector<VoxelIndex> reached_;  // the bricks of the map with places, in the survey before
  BrickTree places_;                 // that are reachable
  VoxelIndex last_brick_;            // of blocks, that was looked at last
  std::uint32_t last_number_ = BrickDirectory::kNone;
  std::uint32_t survey_ = 0;
  std::uint32_t question_ = 0;
  Answer* asked_ = nullptr;  // the answer that is being looked for
  std::unordered_map<VoxelIndex, Answer> answers_;
};

inline bool SightMemory::is_clear(const VoxelIndex& cell) {
  const VoxelIndex address = block_of(cell);
  const VoxelIndex brick = Brick::of_cell(address);
  if (last_number_ == BrickDirectory::kNone || brick != last_brick_) {
    last_brick_ = brick;
    last_number_ = blocks_.store(brick);  // so that an answer can tell when it becomes known
  }
  const std::size_t offset = Brick::offset_of(address);
  Block& block = blocks_.values(last_number_)[offset];
  if (asked_ != nullptr && std::exchange(block.looked_at, question_) != question_) {
    asked_->looked_at.push_back(static_cast<std::uint32_t>(last_number_ * Brick::kCells + offset));
  }
  return (block.clear & bit_of(cell)) != 0;
}

inline bool SightMemory::is_reachable(const VoxelIndex& cell) const {
  const VoxelIndex address = block_of(cell);
  const bool near = last_number_ != BrickDirectory::kNone && Brick::of_cell(address) == last_brick_;
  const Block& block = near ? blocks_.values(last_number_)[Brick::offset_of(address)] : blocks_[address];
  return (block.reachable & bit_of(cell)) != 0;
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
        const bool may_hold = places_.touches(cells);
        if (!may_hold) {
          answer.without_places.push_back(cells);
        }
        return may_hold;
      },
      passes, [&](const VoxelIndex& cell) { return is_reachable(cell) && serves(cell); });
  asked_ = nullptr;
  answer.may_stand = !anew;
  return answer.viewpoint;
}

}  // namespace vantage::detail
