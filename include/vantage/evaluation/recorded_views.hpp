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
#include <vantage/raytrace/range_sensor.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// What is known after each view of an order. `volume` and `surface` are shares of what is known after all views.
struct ViewOrderCurve {
  std::string name = {};                ///< name of the rule that chose the order
  std::vector<std::size_t> order = {};  ///< numbers of the views
  std::vector<double> volume = {};      ///< known cells (free or occupied) after 1, 2, ... views
  std::vector<double> surface = {};     ///< cells in which a return ended, after 1, 2, ... views
  /// Number of void cells left after 1, 2, ... views: unknown cells inside the convex hull of everything that the
  /// views together hit. The hull is the same for all orders. (Dornhege & Kleiner 2011, IV-B)
  std::vector<std::size_t> void_cells = {};

  /// Area under the curve of the volume: its mean over the numbers of views, in [0, 1].
  [[nodiscard]] double volume_area() const;
  /// Area under the curve of the surface: its mean over the numbers of views, in [0, 1].
  [[nodiscard]] double surface_area() const;
  /// The mean number of void cells left; less is better.
  [[nodiscard]] double void_area() const;
};

/// The scans of a real sensor as candidate views, to compare their recorded order with other orders.
///
/// Which cells a scan frees or hits does not depend on the scans before it. So every order ends with the same
/// known cells; orders differ in how soon these become known.
class RecordedViews {
 public:
  /// Inserts every scan into a map of its own. With an `object` (metres, world frame) only its cells count, and
  /// everything else is known to be free. Throws std::invalid_argument as OccupancyMap, if there is no scan, if
  /// the box is empty, and if the box of the known cells has more than 2^31 cells.
  RecordedViews(std::vector<Scan> scans, const OccupancyMapOptions& options,
                const std::optional<Box>& object = std::nullopt);

  /// Number of views.
  [[nodiscard]] std::size_t size() const { return scans_.size(); }
  /// The scans. The number of a view is its index here.
  [[nodiscard]] const std::vector<Scan>& scans() const { return scans_; }
  /// Options of the map for the scans.
  [[nodiscard]] const OccupancyMapOptions& options() const { return options_; }
  /// The box whose cells count, world frame, metres; none: all cells.
  [[nodiscard]] const std::optional<Box>& object() const { return object_; }
  /// The map before the first view: empty, except for what is known around an object.
  [[nodiscard]] OccupancyMap map_before() const;

  /// Whether any view makes a cell known that counts.
  [[nodiscard]] bool show_any() const;

  /// Void cells before the first view: all cells inside the convex hull of what the views together hit. 0 if that
  /// hull is empty.
  [[nodiscard]] std::size_t void_cells() const { return void_cells_; }

  /// The curve of an order with each view at most once. Throws std::out_of_range for a wrong number.
  [[nodiscard]] ViewOrderCurve curve(std::string name, std::vector<std::size_t> order) const;
  /// The recorded order.
  [[nodiscard]] std::vector<std::size_t> recorded_order() const;
  /// For every number of views, those spread evenly over the recording, first and last included. Each point of the
  /// curve has its own views, so no single order has this curve.
  [[nodiscard]] ViewOrderCurve evenly_spaced(std::string name) const;
  /// A random order that starts with `start`.
  [[nodiscard]] std::vector<std::size_t> random_order(std::size_t start, std::uint64_t seed) const;
  /// What a greedy order maximises: known cells, hit cells, or known void cells.
  enum class Measure : std::uint8_t { Volume, Surface, Void };
  /// The order after `start` that adds most at every step, with full knowledge of all views.
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

/// Chooses one of the views `left` (never empty) for the map so far; `last` is the view taken last. The functions
/// made below keep state from view to view, so each serves one order.
using ChooseView =
    std::function<std::size_t(const OccupancyMap& map, std::size_t last, std::span<const std::size_t> left)>;

/// The order in which `choose` takes the views after `start`, each chosen by the map of those before it.
[[nodiscard]] std::vector<std::size_t> chosen_order(const RecordedViews& views, std::size_t start,
                                                    const ChooseView& choose);

/// Chooses the view that sees most unknown cells, exactly counted. A pose in an unknown cell sees only that cell,
/// so the rule is poor where recorded poses lie in unknown space. (Vasquez-Gomez et al. 2013, eq. 4)
[[nodiscard]] ChooseView most_unknown_cells(const RecordedViews& views, const RangeSensor& sensor,
                                            std::size_t threads = 1);

/// Chooses the view that is expected to make most cells known. A ray whose first unknown cell is at the range r0
/// reaches an unknown cell at the range r with the probability n(r) / n(r0), where n(x) is the number of earlier
/// returns from beyond x. If several rays pass a cell, the highest probability counts.
[[nodiscard]] ChooseView most_expected_cells(const RecordedViews& views, const RangeSensor& sensor);

}  // namespace vantage
