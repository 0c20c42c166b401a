// SPDX-License-Identifier: MIT
#include "sim/rasterise.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include <vantage/geometry/impl/box_overlap.hpp>

namespace vantage {
namespace {

// Overlap test of a triangle and a box by 13 separating axes. `half` is half the edge of the box. (Akenine-Moeller
// 2001)
class TriangleCellTest {
 public:
  explicit TriangleCellTest(const std::array<Eigen::Vector3d, 3>& corners) : corners_(corners) {
    std::size_t count = 0;
    const std::array<Eigen::Vector3d, 3> edges{corners[1] - corners[0], corners[2] - corners[1],
                                               corners[0] - corners[2]};
    axes_[count++] = edges[0].cross(edges[1]);
    for (int axis = 0; axis < 3; ++axis) {
      axes_[count++] = Eigen::Vector3d::Unit(axis);
      for (const Eigen::Vector3d& edge : edges) {
        axes_[count++] = Eigen::Vector3d::Unit(axis).cross(edge);
      }
    }
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      const Eigen::Vector3d along(axes_[i].dot(corners[0]), axes_[i].dot(corners[1]), axes_[i].dot(corners[2]));
      lowest_[i] = along.minCoeff();
      highest_[i] = along.maxCoeff();
      reach_[i] = axes_[i].cwiseAbs().sum();
    }
  }

  bool overlaps(const Eigen::Vector3d& centre, double half) const {
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      const double at = axes_[i].dot(centre);
      if (lowest_[i] > at + half * reach_[i] || highest_[i] < at - half * reach_[i]) {
        return false;
      }
    }
    return true;
  }

 private:
  std::array<Eigen::Vector3d, 3> corners_;
  std::array<Eigen::Vector3d, 13> axes_;
  std::array<double, 13> lowest_{};
  std::array<double, 13> highest_{};
  std::array<double, 13> reach_{};
};

}  // namespace

void rasterise(const TriangleMesh& mesh, const VoxelFrame& frame, double grazed_share, TrueCells& cells) {
  constexpr double kRoundingM = 1e-6;
  const Eigen::Vector3d rounding = Eigen::Vector3d::Constant(kRoundingM);
  const VoxelBox& limits = cells.box();
  const Box metres = frame.box_of(limits);
  for (const auto& triangle : mesh.triangles) {
    std::array<Eigen::Vector3d, 3> corners;
    Box bounds;
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = mesh.vertices[triangle[i]].cast<double>();
      bounds.extend(corners[i]);
    }
    bounds.min = (bounds.min - rounding).cwiseMax(metres.min);
    bounds.max = (bounds.max + rounding).cwiseMin(metres.max);
    if ((bounds.min.array() > bounds.max.array()).any()) {
      continue;
    }
    const VoxelBox box =
        detail::box_overlap({frame.cell_of(bounds.min), frame.cell_of(bounds.max) + VoxelIndex{1, 1, 1}}, limits);
    const TriangleCellTest test(corners);
    for_each_cell(box, [&](const VoxelIndex& cell) {
      if (cells[cell] == CellTruth::Occupied) {
        return;
      }
      const Eigen::Vector3d centre = frame.centre_of(cell);
      if (test.overlaps(centre, frame.size_m * (0.5 - grazed_share))) {
        cells.set(cell, CellTruth::Occupied);
      } else if (test.overlaps(centre, 0.5 * frame.size_m + kRoundingM)) {
        cells.set(cell, CellTruth::Grazed);
      }
    });
  }
}

}  // namespace vantage
