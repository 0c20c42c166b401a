// SPDX-License-Identifier: MIT
#include "sim/surface_coverage.hpp"

namespace vantage {

SurfaceCoverage::SurfaceCoverage(const std::vector<Eigen::Vector3d>& samples, double gap_m)
    : frame_{gap_m}, squared_gap_(gap_m * gap_m), total_(samples.size()) {
  for (const Eigen::Vector3d& sample : samples) {
    left_[frame_.cell_of(sample)].push_back(sample);
  }
}

void SurfaceCoverage::add(const Scan& scan) {
  for (const Eigen::Vector3f& in_sensor : scan.points) {
    if (left_.empty()) {
      return;
    }
    if (!in_sensor.allFinite()) {
      continue;
    }
    const Eigen::Vector3d point = scan.world_from_sensor * in_sensor.cast<double>();
    const VoxelIndex home = frame_.cell_of(point);
    for_each_cell(VoxelBox{home, home + VoxelIndex{1, 1, 1}}.grown(1), [&](const VoxelIndex& cell) {
      const auto samples = left_.find(cell);
      if (samples == left_.end()) {
        return;
      }
      measured_ += std::erase_if(samples->second, [&](const Eigen::Vector3d& sample) {
        return (sample - point).squaredNorm() <= squared_gap_;
      });
      if (samples->second.empty()) {
        left_.erase(samples);
      }
    });
  }
}

}  // namespace vantage
