// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <unordered_map>
#include <vantage/geometry/voxel.hpp>
#include <vantage/map/scan.hpp>
#include <vector>

namespace vantage {

/// Tells which points of a surface have been measured: those with a return within a gap, metres. Unmeasured points
/// are kept in a hash of cells as wide as the gap.
class SurfaceCoverage {
 public:
  SurfaceCoverage(const std::vector<Eigen::Vector3d>& samples, double gap_m);

  /// Adds the returns of a scan.
  void add(const Scan& scan);
  /// Share of the samples measured so far, in [0, 1]; 1 if there are none.
  [[nodiscard]] double share() const {
    return total_ == 0 ? 1.0 : static_cast<double>(measured_) / static_cast<double>(total_);
  }

 private:
  VoxelFrame frame_;
  double squared_gap_;
  std::size_t total_;
  std::size_t measured_ = 0;
  std::unordered_map<VoxelIndex, std::vector<Eigen::Vector3d>> left_;
};

}  // namespace vantage
