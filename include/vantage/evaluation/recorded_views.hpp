// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vantage/compiler.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/map/scan.hpp>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// What was known after each of the views of an order, as shares of what is known after all of them.
struct ViewOrderCurve {
  std::string name = {};                ///< who chose
  std::vector<std::size_t> order = {};  ///< numbers of the views
  std::vector<double> volume = {};      ///< cells known (free or occupied), after 1, 2, ... views
  std::vector<double> surface = {};     ///< cells in which a return ended, after 1, 2, ... views
  /// Void cells left, after 1, 2, ... views: unknown, inside the convex hull of all that the views together hit
  /// (Dornhege & Kleiner 2011, IV-B). One hull for all orders: that of the views so far grows with them.
  std::vector<std::size_t> void_cells = {};

  /// Area under the curve of the volume: its mean over the numbers of views.
  [[nodiscard]] double volume_area() const;
  /// The same of the surface.
  [[nodiscard]] double surface_area() const;
  /// The same of the void cells left: their mean over the numbers of views. The less, the better.
  [[nodiscard]] double void_area() const;
};

/// Views that were taken by a real sensor, to be chosen among: how good would another order have been?
///
/// Which cells a scan frees or hits does not depend on the scans before it, so every order ends with the same cells
/// known, and what counts is how soon.
class RecordedViews {
 public:
  /// Inserts every scan into a map of its own. With an `object`, only its cells count and all else is known to be
  /// free, as Vasquez-Gomez et al. have it. Throws std::invalid_argument as OccupancyMap, and if there is no scan,
  /// the object's box is empty, or the cells known are too far apart (2^31 in their box).
  RecordedViews(std::vector<Scan> scans, const OccupancyMapOptions& options,
                const std::optional<Box>& object = std::nullopt);

  /// How many views there are.
  [[nodiscard]] std::size_t size() const { return scans_.size(); }
  /// The scans, by number.
  [[nodiscard]] const std::vector<Scan>& scans() const { return scans_; }
  /// Of the map that they are to be inserted in.
  [[nodiscard]] const OccupancyMapOptions& options() const { return options_; }
  /// The box whose cells count; none: all do.
  [[nodiscard]] const std::optional<Box>& object() const { return object_; }
  /// The map before the first view: nothing known, but for what is known around an object.
  [[nodiscard]] OccupancyMap map_before() const;

  /// Void cells before the first view: all that lie inside the convex hull of what the views together hit, as the map
  /// of all of them has it. None where that hull is empty.
  [[nodiscard]] std::size_t void_cells() const { return void_cells_; }

  /// What an order, each view at most once, would have made known. Throws std::out_of_range for a wrong number.
  [[nodiscard]] ViewOrderCurve curve(std::string name, std::vector<std::size_t> order) const;
  /// The recorded order, from its first view.
  [[nodiscard]] std::vector<std::size_t> recorded_order() const;
  /// For every number of views those spread evenly over the recording, first and last included: each point of the
  /// curve has views of its own, which no order could take one after the other.
  [[nodiscard]] ViewOrderCurve evenly_spaced(std::string name) const;
  /// An order drawn at random behind the first view `start`.
  [[nodiscard]] std::vector<std::size_t> random_order(std::size_t start, std::uint64_t seed) const;
  /// What the greedy order is greedy for: cells known, cells hit, or void cells known.
  enum class Measure : std::uint8_t { Volume, Surface, Void };
  /// The order behind `start` that adds the most at every step, which only who has seen all views can know.
  [[nodiscard]] std::vector<std::size_t> greedy_order(std::size_t start, Measure measure) const;

 private:
  std::vector<Scan> scans_;
  OccupancyMapOptions options_;
  std::optional<Box> object_;
  std::size_t box_cells_ = 0;
  std::size_t void_cells_ = 0;
  std::vector<std::vector<std::uint32_t>> known_;  // by view: numbers of the cells in the common box
  std::vector<std::vector<std::uint32_t>> hit_;
  std::vector<std::vector<std::uint32_t>> inside_;  // of those known, the ones inside the hull
};

/// Chooses one of the views `left` (never empty) for what `map` lacks; `last` is the one taken last. Those made below
/// learn from view to view: each serves one order.
using ChooseView =
    std::function<std::size_t(const OccupancyMap& map, std::size_t last, std::span<const std::size_t> left)>;

/// The order that comes of choosing every next view behind `start` by what the map knows from those before it.
[[nodiscard]] std::vector<std::size_t> chosen_order(const RecordedViews& views, std::size_t start,
                                                    const ChooseView& choose);

/// The next best view of the paper (Vasquez-Gomez et al. 2013, eq. 4): the one that sees most unknown cells, exactly
/// counted. Where a recorded pose lies in unknown space its own cell is all it sees: a robot could not be sent there.
[[nodiscard]] ChooseView most_unknown_cells(const RecordedViews& views, const RangeSensor& sensor,
                                            std::size_t threads = 1);

/// The view that is expected to make most cells known. As far as a ray is unknown, it may go on: with the probability
/// that a return of the views so far came from further away than the cell, given that it came from further than where
/// the unknown began. A cell counts by the most likely ray to reach it.
[[nodiscard]] ChooseView most_expected_cells(const RecordedViews& views, const RangeSensor& sensor);

/// The unknown cells that a view is wanted for, given what `map` knows; `last` is the view taken last.
using SoughtCells = std::function<std::vector<VoxelIndex>(const OccupancyMap& map, std::size_t last)>;

/// What `planner` seeks with its next view (Plan::sought).
[[nodiscard]] SoughtCells sought_next(const RecordedViews& views, ExplorationPlanner& planner);
/// All that planners seek who explore frontiers: the unknown cells beside them.
[[nodiscard]] SoughtCells sought_behind_frontiers();
/// All that a planner seeks who looks into voids: their cells (Dornhege & Kleiner 2011, IV-B).
[[nodiscard]] SoughtCells sought_in_voids();

/// Of the views that are expected to show at least half as many as any of the cells sought, by the same chances, the
/// one that is expected to make most cells known; where none of these can be seen, of all.
[[nodiscard]] ChooseView most_for_what_is_sought(const RecordedViews& views, const RangeSensor& sensor,
                                                 SoughtCells sought);

/// Is told what a planner asked for behind the view `last`, and which view was chosen for it.
using GoalObserver = std::function<void(const Plan& plan, std::size_t last, std::size_t chosen)>;

/// The view nearest to where `planner` wants to look from, a radian off the direction counting as
/// `metres_per_radian`. Where it names no place, the view furthest, by the same measure, from all that were taken:
/// `observer`, if there is one, can tell how often.
[[nodiscard]] ChooseView nearest_to_goal(const RecordedViews& views, ExplorationPlanner& planner,
                                         double metres_per_radian, GoalObserver observer = {});

}  // namespace vantage
