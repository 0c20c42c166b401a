// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vantage/geometry/voxel_table.hpp>
#include <vantage/map/brick.hpp>
#include <vantage/map/brick_directory.hpp>
#include <vantage/map/known_map.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/robot/reachable_space.hpp>
#include <vantage/view/tried_views.hpp>
#include <vector>

#include <vantage/map/impl/brick_tree.hpp>
#include <vantage/view/impl/sight_tree.hpp>

namespace vantage::detail {

/// Remembers, from survey to survey, the viewpoint that was found for each cell, until a cell that the search has
/// looked at changes. Its answers are always the same as those of a new memory.
///
///     Block  4 x 4 x 4 cells: one bit each for free and reachable, number of the survey in which one changed
///     Answer viewpoint for a cell (or none), blocks that its search has looked at,
///            boxes that it has skipped because nothing in them was reachable
///
///     follow():       blocks written since the last survey are compared with the stored bits -> Block::changed
///     look_around():  no looked-at block changed after the answer was found, and no skipped box
///                     holds a reachable cell now?   yes: the stored answer    no: search again (SightTree)
///
/// Where all changes are too far away for a search, its answer need not be asked for at all (`may_differ`).
///
/// All blocks are compared if the map is another one. Blocks are stored for a brick of the map where one of their
/// cells is or was free or reachable, or a search has looked at one. So memory follows what can be passed.
class SightMemory {
 public:
  /// `may_face`: for the rays of the searches (SightTree).
  explicit SightMemory(SightTree::MayFace may_face) : may_face_(std::move(may_face)) {}

  /// Updates the free and the reachable cells; resting places (TriedViews) count as not reachable. `reachable` must
  /// be the same object in every call, and must have followed `map` once since the last call. Searches use
  /// `direction_count` rays of length `furthest_m`, metres, level ones if the region of the map is one layer of
  /// cells; if one of these or the cell size changes, all answers are dropped.
  void follow(const OccupancyMap& map, const ReachableSpace& reachable, const TriedViews& tried, double furthest_m,
              std::size_t direction_count);

  [[nodiscard]] double furthest_m() const { return furthest_m_; }
  /// Whether something that an answer to this cell, or to one beside it, depends on may have changed between the last
  /// two calls of `follow`. It does not tell changes of `tried` other than of resting places.
  [[nodiscard]] bool may_differ(const VoxelIndex& cell) const { return all_changed_ || touched_.contains(cell); }
  /// Whether sight passes this cell. During a search, the answer depends on this cell from now on.
  [[nodiscard]] bool is_free(const VoxelIndex& cell);
  /// Whether the platform can bring the sensor to this cell and it does not rest, as of the last `follow`.
  [[nodiscard]] bool is_reachable(const VoxelIndex& cell) const;

  /// Searches along the rays from `cell`: each continues while `passes(cell)`, and ends at the first reachable
  /// cell with `serves(cell)`. Returns the result of the first ray in the order of directions, or the stored answer
  /// if it is still valid. `passes` and `serves` must call `is_free` for every cell that their result depends on.
  /// They may depend on `about`, too, an answer to another number is not valid. If they depend on anything else, pass
  /// `anew` = true: then the search is done, and its result is not kept for later surveys.
  template <class Passes, class Serves>
  [[nodiscard]] std::optional<VoxelIndex> look_around(const VoxelIndex& cell, std::uint32_t about, bool anew,
                                                      const Passes& passes, const Serves& serves);
  /// Deletes the answers that may differ and were not requested since the last `follow`, if there are now twice as
  /// many answers as after the last deletion.
  void forget_others();

 private:
  struct Block {
    std::uint64_t free = 0;       // one bit per cell, in the order of a Brick's words
    std::uint64_t reachable = 0;  // one bit per cell
    std::uint32_t changed = 0;    // last survey in which a bit changed
    std::uint32_t looked_at = 0;  // last search that looked at a cell of this block
  };
  // The blocks of a brick of the map, in the order of its words.
  struct BrickBlocks {
    VoxelIndex brick;
    std::array<Block, Brick::kWords> blocks = {};
  };
  struct Answer {
    VoxelIndex cell = {};
    std::uint32_t about = 0;
    std::optional<VoxelIndex> viewpoint = {};
    bool may_stand = false;                     // may be reused in later surveys
    std::uint32_t found = 0;                    // survey of the search
    std::uint32_t asked = 0;                    // survey of the last request
    std::vector<std::uint32_t> looked_at = {};  // positions of blocks
    std::vector<VoxelBox> without_places = {};  // boxes skipped because nothing in them was reachable
  };

  void begin(const OccupancyMap& map, double furthest_m, std::size_t direction_count);
  void follow_free(const OccupancyMap& map);
  void follow_places(const ReachableSpace& reachable, const TriedViews& tried);
  template <class Member>
  void set(const VoxelIndex& brick, const BrickPlane& cells, Member member);
  // The number of the blocks of a brick, stored if necessary.
  BrickDirectory::Number store(const VoxelIndex& brick);
  // Makes the blocks of a brick, stored if necessary, the last ones.
  void turn_to(const VoxelIndex& brick);
  // Whether any of these cells may be reachable.
  [[nodiscard]] bool may_hold_places(const VoxelBox& cells);
  // The answer of a cell, a new one if there is none. Valid until the next call.
  [[nodiscard]] Answer& answer_of(const VoxelIndex& cell);
  void touch(const VoxelIndex& brick);
  [[nodiscard]] bool stands(const Answer& answer) const;
  static std::uint64_t bit_of(std::size_t offset) { return std::uint64_t{1} << (offset & 63U); }

  static constexpr std::size_t kRemembered = 4096;  // bricks and boxes of the searches of one survey
  static constexpr VoxelIndex kNoBrick{std::numeric_limits<std::int32_t>::max(), 0, 0};

  SightTree::MayFace may_face_;
  double cell_size_m_ = 0.0;
  double furthest_m_ = 0.0;
  std::size_t direction_count_ = 0;
  bool is_level_ = false;
  std::optional<SightTree> tree_;
  KnownMap map_;  // of the last follow
  OccupancyMap::Revision followed_ = 0;
  BrickDirectory directory_;  // index in `bricks_` of each brick with blocks
  std::deque<BrickBlocks> bricks_;
  BrickTree places_;               // bricks with reachable cells, resting or not
  std::vector<VoxelBox> resting_;  // TriedViews::resting of the last follow
  // A brick of an is_free since `follow`; no block moves while others are stored.
  struct Visited {
    VoxelIndex brick = kNoBrick;
    BrickDirectory::Number number = BrickDirectory::kNone;
    BrickBlocks* blocks = nullptr;
  };
  Visited last_;
  std::vector<Visited> visited_;  // by hash of the brick
  struct Asked {
    VoxelBox bricks;
    bool may_hold = false;
  };
  std::vector<Asked> asked_boxes_;  // by hash of the box, since `follow`
  std::uint32_t survey_ = 0;
  VoxelBox touched_;  // around the bricks that were written for this survey, as far as a search looks
  bool all_changed_ = true;
  std::uint32_t question_ = 0;
  Answer* asked_ = nullptr;  // the answer being searched; null outside of a search
  std::vector<Answer> answers_;
  std::size_t kept_answers_ = 0;       // by the last deletion
  VoxelTable<std::uint32_t> numbers_;  // of the answers, by cell
};

inline bool SightMemory::is_free(const VoxelIndex& cell) {
  if (const VoxelIndex brick = Brick::of_cell(cell); brick != last_.brick) {
    turn_to(brick);  // stored even if unknown, so that a later change is noticed
  }
  const std::size_t offset = Brick::offset_of(cell);
  const std::size_t word = offset >> 6U;
  Block& block = last_.blocks->blocks[word];
  if (asked_ != nullptr && std::exchange(block.looked_at, question_) != question_) {
    asked_->looked_at.push_back(static_cast<std::uint32_t>(last_.number * Brick::kWords + word));
  }
  return (block.free & bit_of(offset)) != 0;
}

inline bool SightMemory::is_reachable(const VoxelIndex& cell) const {
  const VoxelIndex brick = Brick::of_cell(cell);
  const BrickBlocks* blocks = last_.blocks;
  if (brick != last_.brick) {
    const BrickDirectory::Number number = directory_.find(brick);
    blocks = number == BrickDirectory::kNone ? nullptr : &bricks_[number];
  }
  const std::size_t offset = Brick::offset_of(cell);
  return blocks != nullptr && (blocks->blocks[offset >> 6U].reachable & bit_of(offset)) != 0;
}

template <class Passes, class Serves>
std::optional<VoxelIndex> SightMemory::look_around(const VoxelIndex& cell, std::uint32_t about, bool anew,
                                                   const Passes& passes, const Serves& serves) {
  Answer& answer = answer_of(cell);
  const bool asked_before = answer.asked == survey_;  // in this survey, from another frontier cell
  answer.asked = survey_;
  if (answer.about == about && (asked_before || (!anew && stands(answer)))) {
    return answer.viewpoint;
  }
  answer.may_stand = false;
  answer.about = about;
  answer.found = survey_;
  answer.looked_at.clear();
  answer.without_places.clear();
  asked_ = &answer;
  ++question_;
  answer.viewpoint = tree_->first(
      cell,
      [&](const VoxelBox& cells) {
        const bool may_hold = may_hold_places(cells);
        if (!may_hold) {
          answer.without_places.push_back(cells);
        }
        return may_hold;
      },
      passes, [&](const VoxelIndex& place) { return is_reachable(place) && serves(place); });
  asked_ = nullptr;
  answer.may_stand = !anew;
  return answer.viewpoint;
}

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/view/impl/sight_memory.ipp>
#endif
