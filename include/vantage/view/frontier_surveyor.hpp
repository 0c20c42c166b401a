// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vantage/compiler.hpp>
#include <vantage/view/frontier_survey.hpp>
#include <vector>

namespace vantage::detail {
class SightMemory;
}

namespace VANTAGE_EXPORT vantage {

/// Surveys the map once, with the sensor at `current` (world_from_sensor). Unknown cells that `tried` has given up
/// are no targets. For repeated surveys of a changing map, a FrontierSurveyor is faster.
[[nodiscard]] FrontierSurvey survey_frontiers(const OccupancyMap& map, const Platform& platform,
                                              const RangeSensor& sensor, const Pose& current,
                                              const FrontierSurveyOptions& options, const TriedViews& tried);

/// Surveys a map repeatedly while it changes.
///
/// The result is always the same as that of `survey_frontiers`: the same targets with the same viewpoints. It is only
/// faster, and counts fewer `ray_operations`: what was found for a frontier cell is kept while all changes are
/// further away than a search looks, and the viewpoint found for an unknown cell until a cell that the search has
/// looked at changes.
class FrontierSurveyor {
 public:
  /// Makes a surveyor without results. `platform` must not be null, and its answers must depend only on the map.
  FrontierSurveyor(std::shared_ptr<const Platform> platform, const RangeSensor& sensor,
                   const FrontierSurveyOptions& options);
  /// Not copyable.
  FrontierSurveyor(const FrontierSurveyor&) = delete;
  /// Not copyable.
  FrontierSurveyor& operator=(const FrontierSurveyor&) = delete;
  /// Moves the stored results.
  FrontierSurveyor(FrontierSurveyor&& other) noexcept;
  /// Moves the stored results.
  FrontierSurveyor& operator=(FrontierSurveyor&& other) noexcept;
  ~FrontierSurveyor();

  /// Surveys the map with the sensor at `current` (world_from_sensor). `frontier`: the frontier cells of the map in
  /// raster order (FrontierTracker, frontier_cells). Unknown cells that `tried` has given up are no targets.
  [[nodiscard]] FrontierSurvey survey(const OccupancyMap& map, const Pose& current, const TriedViews& tried,
                                      const std::vector<VoxelIndex>& frontier);
  /// Surveys the map for a sensor that can be brought to each of `places`, at least one, and nowhere else.
  [[nodiscard]] FrontierSurvey survey_from(const std::vector<VoxelIndex>& places, const OccupancyMap& map,
                                           const TriedViews& tried, const std::vector<VoxelIndex>& frontier);
  /// After a survey of this map that found no target: the frontier cells with an unknown neighbour that was looked
  /// at, but not closely (TriedViews::looked_closely), and that can be seen along a clear line, edges included, from
  /// a place from which, or from beside which, no such look was taken. In raster order.
  [[nodiscard]] std::vector<FrontierTarget> looks_to_take_closely(const OccupancyMap& map, const TriedViews& tried,
                                                                  const std::vector<VoxelIndex>& frontier);

  /// The cells to which the platform could bring the sensor in the last survey.
  [[nodiscard]] const ReachableSpace& reachable() const { return reachable_; }

 private:
  // What a survey has found for a frontier cell.
  struct Finding {
    VoxelIndex frontier;
    std::optional<FrontierTarget> target = {};
    bool is_lasting = true;  // depends on no evidence of TriedViews
  };
  template <class Search>
  [[nodiscard]] std::vector<Finding> find_each(const TriedViews& tried, const std::vector<VoxelIndex>& frontier,
                                               Search&& search);
  [[nodiscard]] FrontierSurvey find_targets(const OccupancyMap& map, const TriedViews& tried,
                                            const std::vector<VoxelIndex>& frontier);

  std::shared_ptr<const Platform> platform_;
  RangeSensor sensor_;
  FrontierSurveyOptions options_;
  ReachableSpace reachable_;
  std::unique_ptr<detail::SightMemory> memory_;
  std::vector<Finding> findings_;  // of the last survey, in raster order; empty if it was not completed
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/view/impl/frontier_surveyor.ipp>
#endif
