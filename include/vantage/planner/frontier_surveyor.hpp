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

/// Surveys a map again and again, as it changes.
///
/// A survey is that of `survey_frontiers`, whatever was surveyed before: the same targets, seen from the same places.
/// Only its price differs, and its `ray_operations` with it: what looking around an unknown cell has found stands
/// until something changes where it was looked for.
class FrontierSurveyor {
 public:
  /// For a platform, which must not be null, that always admits and faces alike.
  FrontierSurveyor(std::shared_ptr<const Platform> platform, const RangeSensor& sensor,
                   const FrontierSurveyOptions& options);
  /// One memory, one owner.
  FrontierSurveyor(const FrontierSurveyor&) = delete;
  /// One memory, one owner.
  FrontierSurveyor& operator=(const FrontierSurveyor&) = delete;
  /// Takes the memory along.
  FrontierSurveyor(FrontierSurveyor&& other) noexcept;
  /// Takes the memory along.
  FrontierSurveyor& operator=(FrontierSurveyor&& other) noexcept;
  ~FrontierSurveyor();

  /// Surveys the map from `current`. Targets that `tried` has given up count as unobservable.
  [[nodiscard]] FrontierSurvey survey(const OccupancyMap& map, const Pose& current, const TriedViews& tried);
  /// The same for those who know the frontier cells of the map already (FrontierTracker), in raster order.
  [[nodiscard]] FrontierSurvey survey(const OccupancyMap& map, const Pose& current, const TriedViews& tried,
                                      std::vector<VoxelIndex> frontier);
  /// The same from a space in which the platform may be anywhere.
  [[nodiscard]] FrontierSurvey survey(const OccupancyMap& map, ReachableSpace reachable, const TriedViews& tried,
                                      std::vector<VoxelIndex> frontier);

  /// The cells that the platform admits in the map that was surveyed last, reachable or not.
  [[nodiscard]] const AdmittedCells& admitted() const { return admitted_; }

 private:
  std::shared_ptr<const Platform> platform_;
  RangeSensor sensor_;
  FrontierSurveyOptions options_;
  AdmittedCells admitted_;
  std::unique_ptr<detail::SightMemory> memory_;
};

}  // namespace vantage
