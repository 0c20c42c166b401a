// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vantage/compiler.hpp>
#include <vantage/geometry/ellipsoid.hpp>
#include <vantage/geometry/voxel.hpp>

namespace VANTAGE_EXPORT vantage {

/// Centroid and covariance of a body made of cells, kept while it grows or shrinks (Dornhege & Kleiner 2011, eq. 1).
///
/// Cells are solid cubes here, not points: each has a variance of its own, 1/12 of its edge squared, so that even a
/// single cell has a volume. Sums are integers, so the order in which cells come does not matter.
class CellMoments {
 public:
  /// No cells. Those to come should lie within some ten thousand cells of `origin`, or the sums overflow.
  explicit CellMoments(const VoxelIndex& origin = {}) : origin_(origin) {}

  /// Puts a cell in.
  void add(const VoxelIndex& cell) { count(cell, 1); }
  /// Takes a cell out that is in.
  void remove(const VoxelIndex& cell) { count(cell, -1); }
  /// How many cells are in.
  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(size_); }

  /// The centroid in units of cells, where the centre of cell (x, y, z) is the point (x, y, z). There must be a cell.
  [[nodiscard]] Eigen::Vector3d mean_cells() const {
    return Eigen::Vector3d(origin_.x, origin_.y, origin_.z) + mean_from_origin();
  }
  /// The covariance of the solid body, in squared cells. There must be a cell.
  [[nodiscard]] Eigen::Matrix3d covariance_cells() const;
  /// The solid ellipsoid with the same centroid and covariance. There must be a cell.
  ///
  /// The variance of a solid ellipsoid along an axis of half length a is a^2 / 5, so the half lengths are
  /// sqrt(5 lambda), lambda being the eigenvalues of the covariance.
  [[nodiscard]] Ellipsoid ellipsoid(const VoxelFrame& frame) const;

 private:
  void count(const VoxelIndex& cell, std::int64_t sign);
  [[nodiscard]] Eigen::Vector3d mean_from_origin() const;

  VoxelIndex origin_;
  std::int64_t size_ = 0;
  Eigen::Matrix<std::int64_t, 3, 1> sum_ = Eigen::Matrix<std::int64_t, 3, 1>::Zero();
  // xx yy zz xy xz yz
  Eigen::Matrix<std::int64_t, 6, 1, Eigen::DontAlign> products_ = Eigen::Matrix<std::int64_t, 6, 1>::Zero();
};

}  // namespace vantage
