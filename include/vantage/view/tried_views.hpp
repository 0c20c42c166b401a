// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/known_map.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/view/goal_result.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// When a goal counts as reached, and when a cell is given up.
struct TriedViewsOptions {
  double goal_tolerance_m = 0.3;     ///< allowed distance from the goal, metres, >= 0
  double goal_tolerance_rad = 0.35;  ///< allowed angle between the optical axes, radians, >= 0
  int patience = 2;  ///< different places from which a cell is looked at in vain before it is given up, >= 1
};

/// Remembers which views were tried and what they resolved. This is the only state of a planner beside the map. With
/// it, a planner does not look forever at cells that its sensor cannot measure, and does not send the robot forever
/// to places that it cannot reach.
///
/// **Evidence about an unknown cell.** A cell was looked at in vain from a place if it is still unknown after a scan
/// there that should have resolved it: it was in the field of view and in clear line of sight, and the plan sought it
/// or it was near enough. A line that touches a cell that is not free, even at an edge, is not clear: hardly a ray
/// of a sensor passes there.
///
///       cell becomes known, or one more face neighbour does: evidence is deleted
///        <----------------------------------------------------------+
///        |                                                          |
///     no evidence --- look in vain ---> tried --- `patience` looks from different places ---> given up
///
/// Two places differ, as seen from a cell, if the distance between them is more than half of the shorter distance to
/// the cell. A goal from which the cell was sought is stored as missed if the robot stopped at a place that differs,
/// or if its look was no new evidence: the cell is not sought from there again, and it is also given up after 2 *
/// `patience` looks and misses together.
///
/// **Before a run ends**, a stricter rule holds (`looked_closely`): `patience` looks along lines that are clear,
/// edges included, from cells of which none touches another. Otherwise a surface that was found beside a cell may
/// have cut off all looks at it, or all places that see the cell may lie close to the only one that looked. The rule
/// also ends after 4 * `patience` such looks, or 4 * `patience` looks in vain and misses together.
///
/// This ends runs in which a surface wears away: rays at a small angle clear some of its cells, and unknown cells
/// behind them become targets until a view from the front closes the surface again. The number of known neighbours
/// only grows, whatever their states, so a cell gets at most six further chances.
///
/// **A contested cell** is looked at from distances that differ. Every such look is stored, whatever came of it: a
/// cell that changes back and forth gets no look more.
///
/// **Places that could not be reached.** A place fails if the host reports GoalResult::Failed, or if it would be
/// asked for a third time although the robot came no nearer: the rest of the path is no shorter or, within the goal
/// tolerance, the rest of the turn is no smaller.
///
///     asked for --- fails ---> rests 8 plans ---> may be asked for again
///                                |                (then rests 64, 512, 4096; if it does not report, 16, 32, ...)
///                                |
///                                +--- reported, and no other target is left: allowed again at once, until the
///                                     third failure; if the robot came nearer, only the latest one counts
///
/// A place rests together with all places within the goal tolerance. Once all that a view sought is known, only the
/// places that have failed are remembered. If three places rest and the robot still is where it was when they were
/// asked for, planners ask for goals in other directions first (`refused_directions`). If none is left, it does not
/// move at all (`is_stuck`).
///
/// The memory belongs to one map and its copies, and is bounded: the oldest entries are dropped first, places without
/// a failure before others. As text it can be saved with the map.
class TriedViews {
 public:
  /// Throws std::invalid_argument, which names the invalid option.
  explicit TriedViews(const RangeSensor& sensor, const TriedViewsOptions& options = {});

  // --- input from the planner
  /// Stores that a view at the end of `path` (poses world_from_sensor, at least one) is planned. It is to resolve the
  /// cells `sought`, all unknown or all contested (OccupancyMap::contested). It may resolve some of `hoped`: they
  /// count as looked at in vain only if it resolves none of them. Returns false if the place was asked for twice and
  /// the robot came no nearer: then the place rests, and the planner must choose another view.
  [[nodiscard]] bool expect(const OccupancyMap& map, const std::vector<Pose>& path, std::vector<VoxelIndex> sought,
                            std::vector<VoxelIndex> hoped = {});
  /// Stores how following the plan ended, if the host reports it. Used by the next `review`.
  void report(GoalResult result) { reported_ = result; }
  /// Stores that no path leads to a view from this cell: the place rests as if the robot came no nearer to it.
  void no_way_to(const VoxelIndex& cell);
  /// Compares the current map, with the sensor at `current` (world_from_sensor), with what the last view was to
  /// resolve. Starts with an empty memory if the map is another one. Returns whether a scan was taken in the same map
  /// since the last call, so that unknown cells in sight of `current` are evidence. Without a change of the map, a
  /// call has an effect only after GoalResult::Failed.
  bool review(const OccupancyMap& map, const Pose& current);
  /// Stores evidence: the cell was in clear line of sight of `place` and near enough, and is unknown after the scan.
  void in_vain(const OccupancyMap& map, const VoxelIndex& unknown, const VoxelIndex& place);
  /// Replaces the memory by one that `text` returned, for this map: the map of then, or one that was loaded from its
  /// file. Throws std::runtime_error, which names the line, if the text is no such memory or is of cells of another
  /// size; the memory is then unchanged.
  void recall(const OccupancyMap& map, std::string_view text);
  /// Ends the rest of every place, except those that are given up (places_given_up). Returns whether any rested.
  bool try_resting_again();
  /// Limits the rest of every place to 8 further plans. Called before a plan that is no Move, so that a host that
  /// waits and plans again soon gets goals again.
  void end_run();

  // --- queries
  /// The goal (world_from_sensor) of the last planned view, if at the last `review` the robot was still moving to
  /// it and some of the cells that it is to resolve were unknown.
  [[nodiscard]] std::optional<Pose> goal_ahead() const {
    return expected_ ? std::optional(expected_->goal) : std::nullopt;
  }
  /// Whether there is any evidence about this unknown cell.
  [[nodiscard]] bool tried(const VoxelIndex& unknown) const { return looks_at(unknown) != nullptr; }
  /// Whether the cell was looked at in vain from this place or one that does not differ, or missed from here.
  [[nodiscard]] bool tried_from(const VoxelIndex& unknown, const VoxelIndex& place) const;
  /// Whether a view from this place should not hope for the cell: `gave_up` or `tried_from`, or hoped for in vain
  /// from this place or from 2 * `patience` places.
  [[nodiscard]] bool hoped_in_vain(const VoxelIndex& unknown, const VoxelIndex& place) const;
  /// Whether the evidence suffices to give the cell up.
  [[nodiscard]] bool gave_up(const VoxelIndex& unknown) const;
  /// Whether the evidence suffices to end a run: the stricter rule above, for lines that are clear in this map.
  [[nodiscard]] bool looked_closely(const OccupancyMap& map, const VoxelIndex& unknown) const;
  /// Whether a look at the cell, along a line that is clear in this map, was taken from this place or one that
  /// touches it, or the cell was missed from this place.
  [[nodiscard]] bool looked_from_beside(const OccupancyMap& map, const VoxelIndex& unknown,
                                        const VoxelIndex& place) const;
  /// Whether the cell was looked at because it was contested, from about the distance of this place: the longer of
  /// the two distances is less than twice the shorter one.
  [[nodiscard]] bool tried_at_distance(const VoxelIndex& cell, const VoxelIndex& place) const;
  /// Whether this place rests: the robot failed to reach it, or a place within the goal tolerance.
  [[nodiscard]] bool rests(const VoxelIndex& place) const;
  /// Whether any place rests.
  [[nodiscard]] bool any_rests() const { return !resting_.empty(); }
  /// Boxes of cells that contain all resting places, one for each goal that rests, in raster order of the goals.
  [[nodiscard]] std::vector<VoxelBox> resting() const;
  /// The number of resting places that failed three times, to which the robot came no nearer, or to which no path
  /// leads.
  [[nodiscard]] std::size_t places_given_up() const;
  /// The directions (unit vectors, world) from `current` (world_from_sensor) to the goals that failed from there and
  /// rest: they are further away than the goal tolerance, and the robot is within half of it of where it was when
  /// they were asked for. Empty if there are fewer than three.
  [[nodiscard]] std::vector<Eigen::Vector3d> refused_directions(const Pose& current) const;
  /// Whether a robot at `current` does not move, as far as the goals in refused directions tell: it came no nearer to
  /// three of them, or to 24 if all lie in one half of the compass; or goals in both halves failed 150 times.
  [[nodiscard]] bool is_stuck(const Pose& current) const;
  /// The sensor poses (world_from_sensor) of the latest scans, at most 64, the newest last.
  [[nodiscard]] const std::deque<Pose>& scanned_from() const { return scanned_from_; }
  /// The number of cells with evidence.
  [[nodiscard]] std::size_t size() const { return looks_.size(); }
  /// The options of the constructor.
  [[nodiscard]] const TriedViewsOptions& options() const { return options_; }
  /// The memory as text, to be saved beside the map. The last planned view is not part of it.
  [[nodiscard]] std::string text() const;

 private:
  struct Expectation {
    Pose goal;
    OccupancyMap::Revision revision;
    std::vector<VoxelIndex> sought;
    std::vector<VoxelIndex> hoped;
    bool of_contested;  // whether what is sought was contested, not unknown
  };
  // Evidence about one cell.
  struct Looks {
    std::vector<VoxelIndex> in_vain;    // places that differ
    std::vector<VoxelIndex> clear;      // places of looks along lines that were clear; none touches another
    std::vector<VoxelIndex> missed;     // goals from which the cell was sought without new evidence, or far from them
    std::vector<VoxelIndex> contested;  // places of looks because it was contested, and their goals
    std::vector<VoxelIndex> hoped;  // goals from which a view hoped for the cell, but resolved nothing it hoped for
    int known_neighbours = 0;       // at the latest look
    std::uint64_t latest = 0;       // number of the plan of the latest look
  };
  // The lists of places of Looks, by their words in the text.
  static constexpr std::array<std::pair<const char*, std::vector<VoxelIndex> Looks::*>, 5> kPlaceLists{
      {{"in-vain", &Looks::in_vain},
       {"clear", &Looks::clear},
       {"missed", &Looks::missed},
       {"hoped", &Looks::hoped},
       {"contested", &Looks::contested}}};
  // A goal that was planned.
  struct Place {
    VoxelIndex cell;
    double nearest_way = 0.0;             // shortest way_to_go of all plans to it
    std::optional<Pose> asked_from = {};  // where the robot was at the latest plan; unknown after `recall`
    int no_nearer = 0;                    // consecutive plans after a change of the map in which it was no shorter
    int failures = 0;
    std::uint64_t rests_until = 0;        // number of a plan
    OccupancyMap::Revision revision = 0;  // of the latest plan to it; 0: the next one is the first
  };
  // A filter in front of the hash map, because planners ask millions of times and few cells have evidence: one bit
  // for all cells with the same coordinates modulo 128 x 128 x 64.
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
    static constexpr std::size_t kWords = std::size_t{2} * 128 * 64;  // 128 x 128 x 64 bits
    static std::size_t word_of(const VoxelIndex& cell) {
      return (static_cast<std::size_t>(cell.z & 63) * 128 + static_cast<std::size_t>(cell.y & 127)) * 2 +
             static_cast<std::size_t>(cell.x >> 6 & 1);
    }
    static std::uint64_t bit_of(const VoxelIndex& cell) { return std::uint64_t{1} << (cell.x & 63); }

    std::vector<std::uint64_t> bits_;  // empty until the first cell is inserted
  };

  [[nodiscard]] double rest_reach() const;
  [[nodiscard]] VoxelBox box_of_rest(const VoxelIndex& goal) const;
  [[nodiscard]] VoxelIndex rest_block(const VoxelIndex& cell) const;
  [[nodiscard]] std::vector<const Place*> failed_from(const Pose& current) const;
  [[nodiscard]] Eigen::Vector3d direction_of(const Place& place, const Pose& current) const;
  [[nodiscard]] const Looks* looks_at(const VoxelIndex& unknown) const;
  Looks& new_look_at(const OccupancyMap& map, const VoxelIndex& unknown);
  void forget(const OccupancyMap& map);
  void evaluate(const OccupancyMap& map, const Pose& current);
  void fail(Place& place);
  [[nodiscard]] bool given_up(const Place& place) const;
  [[nodiscard]] double tolerance_m() const;
  [[nodiscard]] double way_to_go(const std::vector<Pose>& path) const;
  void rest_now();
  Place& place_of(const VoxelIndex& cell);
  void remember_scan(const Pose& pose);
  [[nodiscard]] bool arrived(const Pose& current) const;
  bool add_clear_look(const OccupancyMap& map, Looks& looks, const VoxelIndex& unknown,
                      const VoxelIndex& place) const;
  [[nodiscard]] bool was_in_view(const OccupancyMap& map, const Pose& pose, const VoxelIndex& unknown) const;

  RangeSensor sensor_;
  TriedViewsOptions options_;
  KnownMap map_;  // of the last review
  double cell_m_ = 0.0;
  OccupancyMap::Revision reviewed_ = 0;
  std::uint64_t plans_ = 0;  // number of reviews after a change of the map or a reported failure
  std::optional<Expectation> expected_;
  std::optional<GoalResult> reported_;
  std::unordered_map<VoxelIndex, Looks> looks_;
  MayHold may_hold_;
  std::deque<Place> places_;         // planned goals, the newest last
  std::vector<VoxelIndex> resting_;  // in raster order
  // The same by blocks of cells: all that are near enough to a cell of the block for it to rest.
  std::unordered_map<VoxelIndex, std::vector<VoxelIndex>> rest_blocks_;
  std::deque<Pose> scanned_from_;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/view/impl/tried_views.ipp>
#include <vantage/view/impl/tried_views_places.ipp>
#include <vantage/view/impl/tried_views_text.ipp>
#endif
