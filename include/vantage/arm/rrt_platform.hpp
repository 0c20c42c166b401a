// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vantage/compiler.hpp>
#include <vantage/robot/wrapped_platform.hpp>

namespace VANTAGE_EXPORT vantage {

/// Parameters of the random tree of RrtPlatform.
struct RrtOptions {
  double goal_bias = 0.05;          ///< share of the samples that are the goal itself, in [0, 1)
  double step_m = 0.3;              ///< maximum length of a new branch, metres, > 0
  std::size_t iterations = 20'000;  ///< samples before the search fails, > 0
  std::uint64_t seed = 1;           ///< seed of the samples
};

/// A platform that plans paths with a goal-biased rapidly exploring random tree (RRT, from OMPL) in the space of
/// sensor positions. In all other respects it behaves like the wrapped platform. In wide spaces an RRT finds a path
/// faster than a shortest-path search over all cells; through narrow passages it may find none. (LaValle & Kuffner
/// 2001; used by Vasquez-Gomez et al. 2013.)
///
///     const auto robot = std::make_shared<RrtPlatform>(std::make_shared<FreeFlyer>(body));
class RrtPlatform final : public WrappedPlatform {
 public:
  /// Throws std::invalid_argument, which names the invalid option, or if `platform` is null.
  explicit RrtPlatform(std::shared_ptr<const Platform> platform, const RrtOptions& options = {});

  /// The options that were passed to the constructor.
  [[nodiscard]] const RrtOptions& options() const { return options_; }

  [[nodiscard]] VoxelGrid<std::uint8_t> admitted_cells(const OccupancyMap& map, const VoxelBox& box) const override {
    return wrapped().admitted_cells(map, box);
  }
  /// The straight motion if the platform admits it, otherwise the path of the tree after shortcutting. Between the
  /// ends the sensor looks along the path. nullopt if no path is found. Deterministic for equal inputs.
  [[nodiscard]] std::optional<std::vector<Pose>> path(const OccupancyMap& map, const Pose& from,
                                                      const Pose& to) const override;

 private:
  RrtOptions options_;
};

}  // namespace vantage
