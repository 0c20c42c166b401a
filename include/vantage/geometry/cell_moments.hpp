// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vantage/compiler.hpp>
#include <vantage/geometry/ellipsoid.hpp>
#include <vantage/geometry/voxel.hpp>

namespace VANTAGE_EXPORT vantage {

/// Centroid and covariance of a body made of cells, updated as cells are added and removed.
///
/// Cells are solid cubes, not points: each has a variance of 1/12 of its squared edge, so even a single cell has a
/// volume. The sums are integers, so the result does not depend on the order of the cells. (Dornhege & Kleiner 2011,
/// eq. 1.)
class CellMoments {
 public:
  /// Creates an empty body. The cells should lie within about ten thousand cells of `origin`, or the sums may
  /// overflow.
  explicit CellMoments(const VoxelIndex& origin = {}) : origin_(origin) {}

  /// Adds a cell.
  void add(const VoxelIndex& cell) { count(cell, 1); }
  /// Removes a cell that was added before.
  void remove(const VoxelIndex& cell) { count(cell, -1); }
  /// The number of cells.
  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(size_); }

  /// The centroid in units of cells; the centre of cell (x, y, z) is the point (x, y, z). Requires at least one cell.
  [[nodiscard]] Eigen::Vector3d mean_cells() const {
    return Eigen::Vector3d(origin_.x, origin_.y, origin_.z) + mean_from_origin();
  }
  /// The covariance of the solid body, in squared cells. Requires at least one cell.
  [[nodiscard]] Eigen::Matrix3d covariance_cells() const;
  /// The solid ellipsoid with the same centroid and covariance, in metres. Requires at least one cell.
  ///
  /// A solid ellipsoid has the variance a^2 / 5 along a half axis of length a. So the half axes are sqrt(5 lambda),
  /// where lambda are the eigenvalues of the covariance.
  [[nodiscard]] Ellipsoid ellipsoid(const VoxelFrame& frame) const;

 private:
  void count(const VoxelIndex& cell, std::int64_t sign);
  [[nodiscard]] Eigen::Vector3d mean_from_origin() const;

  VoxelIndex origin_;
  std::int64_t size_ = 0;
  Eigen::Matrix<std::int64_t, 3, 1> sum_ = Eigen::Matrix<std::int64_t, 3, 1>::Zero();
  // order: xx yy zz xy xz yz
  Eigen::Matrix<std::int64_t, 6, 1, Eigen::DontAlign> products_ = Eigen::Matrix<std::int64_t, 6, 1>::Zero();
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/geometry/impl/cell_moments.ipp>
#endif
