// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vantage/compiler.hpp>
#include <vantage/planner/frontier_survey.hpp>
#include <vector>

namespace vantage::detail {
class SightMemory;
}

namespace VANTAGE_EXPORT vantage {

/// Surveys a map repeatedly while it changes.
///
/// The result is always the same as that of `survey_frontiers`: the same targets with the same viewpoints. It is only
/// faster, and counts fewer `ray_operations`: the viewpoint found for an unknown cell is kept until a cell that the
/// search has looked at changes.
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

  /// Surveys the map with the sensor at `current` (world_from_sensor). Unknown cells that `tried` has given up are no
  /// targets.
  [[nodiscard]] FrontierSurvey survey(const OccupancyMap& map, const Pose& current, const TriedViews& tried);
  /// As above, with the frontier cells of the map given in raster order (FrontierTracker).
  [[nodiscard]] FrontierSurvey survey(const OccupancyMap& map, const Pose& current, const TriedViews& tried,
                                      std::vector<VoxelIndex> frontier);
  /// As above, with the reachable space given. `admitted` is not updated.
  [[nodiscard]] FrontierSurvey survey(const OccupancyMap& map, ReachableSpace reachable, const TriedViews& tried,
                                      std::vector<VoxelIndex> frontier);

  /// The cells that the platform admitted in the last surveyed map, reachable or not.
  [[nodiscard]] const AdmittedCells& admitted() const { return admitted_; }

 private:
  std::shared_ptr<const Platform> platform_;
  RangeSensor sensor_;
  FrontierSurveyOptions options_;
  AdmittedCells admitted_;
  std::unique_ptr<detail::SightMemory> memory_;
};

}  // namespace vantage
