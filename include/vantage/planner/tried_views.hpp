// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <unordered_map>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/known_map.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// A way's length in metres plus its turn in radians: what shrinks while a robot follows it.
[[nodiscard]] double way_of(const std::vector<Pose>& path);

/// When a goal counts as reached, and when evidence suffices.
struct TriedViewsOptions {
  double goal_tolerance_m = 0.3;     ///< how far from the goal a robot may stop, metres, >= 0
  double goal_tolerance_rad = 0.35;  ///< how far its optical axis may be turned from the goal's, radians, >= 0
  int patience = 2;                  ///< places that differ from which a cell is looked at in vain, >= 1
};

/// What the sensor has tried, and what came of it: the only memory of a planner beside the map, so that it neither
/// stares at what its sensor cannot measure nor sends the robot for ever where the robot cannot go.
///
/// **Looked at in vain.** An unknown cell was looked at in vain from a place if it is still unknown after a scan from
/// there that should have resolved it: it was what a plan sought, or in plain sight and near enough. It is given up
/// after `patience` such looks from places that differ. Two places differ, as seen from a cell, if they are further
/// apart than half of the shorter distance to the cell: another direction, or half as far. The evidence ends when the
/// cell becomes known, or one more of its face neighbours does.
///
/// This alone ends runs where a surface wears away and comes back: rays that meet it at a small angle clear some of
/// its cells, and unknown cells inside of it become targets until a view from the front closes it again. Each such
/// cell takes part in at most `patience` looks, and no more after that, whatever its neighbours' states do: what is
/// known only grows, so a cell gets at most six further chances.
///
/// **Places that could not be reached.** A goal that the robot failed to reach (GoalResult::Failed, or it came no
/// nearer while the map has grown twice) rests, with the places within the goal tolerance of it, for 8 plans, twice
/// as long after every further failure. When nothing else is left to go for, it is tried again, three times in all.
///
/// All of it belongs to one map, and is bounded: the oldest evidence is dropped first.
class TriedViews {
 public:
  /// Throws std::invalid_argument naming the option at fault.
  explicit TriedViews(const RangeSensor& sensor, const TriedViewsOptions& options = {});

  // --- what the planner tells
  /// A view from `goal` was asked for, at the end of a way of `way` (see way_of). It
  /// is to resolve the cells `sought`, and may resolve some of `hoped`: these are looked at in vain, too, if it
  /// resolves none of them.
  void expect(const OccupancyMap& map, const Pose& goal, double way, std::vector<VoxelIndex> sought,
              std::vector<VoxelIndex> hoped = {});
  /// How following the plan ended, if the host tells.
  void report(GoalResult result) { reported_ = result; }
  /// Looks at the map now, with the sensor at `current`, and at what became of the view that was asked for last.
  /// Returns whether a scan was taken since the last call, so that what is in sight of `current` is evidence. A
  /// second call without a change of the map does nothing.
  bool review(const OccupancyMap& map, const Pose& current);
  /// This cell was in plain sight of `place`, near enough to be resolved, and is unknown after the scan.
  void in_vain(const OccupancyMap& map, const VoxelIndex& unknown, const VoxelIndex& place);
  /// Lets places be tried again that rest after fewer than three failures. Returns whether there were any.
  bool try_resting_again();

  // --- what it knows
  /// Whether any view of this unknown cell was in vain.
  [[nodiscard]] bool tried(const VoxelIndex& unknown) const { return looks_at(unknown) != nullptr; }
  /// Whether one was from here, or from a place that does not differ.
  [[nodiscard]] bool tried_from(const VoxelIndex& unknown, const VoxelIndex& place) const;
  /// Whether the evidence suffices.
  [[nodiscard]] bool gave_up(const VoxelIndex& unknown) const;
  /// Whether the robot failed to get to this place, and it is not to be tried now.
  [[nodiscard]] bool rests(const VoxelIndex& place) const;
  /// Whether any place rests.
  [[nodiscard]] bool any_rests() const { return !resting_.empty(); }
  /// Places that the robot failed three times to get to.
  [[nodiscard]] std::size_t places_given_up() const;
  /// The poses of the latest scans, the latest last.
  [[nodiscard]] const std::deque<Pose>& scanned_from() const { return scanned_from_; }
  /// How many cells were looked at in vain at least once.
  [[nodiscard]] std::size_t size() const { return looks_.size(); }
  /// The options it was made with.
  [[nodiscard]] const TriedViewsOptions& options() const { return options_; }

 private:
  struct Expectation {
    Pose goal;
    OccupancyMap::Revision revision;
    std::vector<VoxelIndex> sought;
    std::vector<VoxelIndex> hoped;
  };
  // At one unknown cell.
  struct Looks {
    std::vector<VoxelIndex> in_vain;  // places that differ
    std::vector<VoxelIndex> missed;   // goals from which the cell was sought, but not in view when the robot stopped
    int known_neighbours = 0;         // when the latest look was taken
    std::uint64_t latest = 0;         // its plan
  };
  // A goal that was asked for.
  struct Place {
    VoxelIndex cell;
    double nearest_way = 0.0;  // of all times it was asked for
    int no_nearer = 0;         // times in a row that the map had grown, but the way was no shorter
    int failures = 0;
    std::uint64_t rests_until = 0;  // this plan
    OccupancyMap::Revision revision = 0;
  };
  // Planners ask millions of times and hardly any cell was looked at in vain: a bit that all cells share whose
  // coordinates are the same modulo its size answers for most.
  class MayHold {
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

    std::vector<std::uint64_t> bits_;  // none until there is a cell
  };

  [[nodiscard]] const Looks* looks_at(const VoxelIndex& unknown) const;
  Looks& new_look_at(const OccupancyMap& map, const VoxelIndex& unknown);
  void forget(const OccupancyMap& map);
  void evaluate(const OccupancyMap& map, const Pose& current);
  void settle(const VoxelIndex& goal, double off_m);
  void fail(const VoxelIndex& goal);
  void rest_now();
  Place& place_of(const VoxelIndex& cell);
  [[nodiscard]] bool arrived(const Pose& current) const;
  [[nodiscard]] bool was_in_view(const OccupancyMap& map, const Pose& pose, const VoxelIndex& unknown) const;

  RangeSensor sensor_;
  TriedViewsOptions options_;
  KnownMap map_;  // that was reviewed last
  double cell_m_ = 0.0;
  OccupancyMap::Revision reviewed_ = 0;
  std::uint64_t plans_ = 0;  // reviewed after a change of the map
  std::optional<Expectation> expected_;
  std::optional<GoalResult> reported_;
  std::unordered_map<VoxelIndex, Looks> looks_;
  MayHold may_hold_;
  std::deque<Place> places_;  // goals asked for, the latest last
  std::vector<VoxelIndex> resting_;
  std::deque<Pose> scanned_from_;
};

}  // namespace vantage
