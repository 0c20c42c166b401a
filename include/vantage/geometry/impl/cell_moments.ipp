// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Eigenvalues>
#include <vantage/geometry/cell_moments.hpp>

namespace vantage {

VANTAGE_INLINE void CellMoments::count(const VoxelIndex& cell, std::int64_t sign) {
  const VoxelIndex from_origin = cell - origin_;
  const std::int64_t x = from_origin.x;
  const std::int64_t y = from_origin.y;
  const std::int64_t z = from_origin.z;
  size_ += sign;
  sum_ += sign * Eigen::Matrix<std::int64_t, 3, 1>(x, y, z);
  Eigen::Matrix<std::int64_t, 6, 1> products;
  products << x * x, y * y, z * z, x * y, x * z, y * z;
  products_ += sign * products;
}

VANTAGE_INLINE Eigen::Vector3d CellMoments::mean_from_origin() const {
  return sum_.cast<double>() / static_cast<double>(size_);
}

VANTAGE_INLINE Eigen::Matrix3d CellMoments::covariance_cells() const {
  const Eigen::Vector3d mean = mean_from_origin();
  const Eigen::Matrix<double, 6, 1> p = products_.cast<double>() / static_cast<double>(size_);
  Eigen::Matrix3d squares;
  squares << p[0], p[3], p[4], p[3], p[1], p[5], p[4], p[5], p[2];
  constexpr double kOfACube = 1.0 / 12.0;
  return squares - mean * mean.transpose() + kOfACube * Eigen::Matrix3d::Identity();
}

VANTAGE_INLINE Ellipsoid CellMoments::ellipsoid(const VoxelFrame& frame) const {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance_cells());
  Ellipsoid result;
  result.centre_m = frame.centre_of(origin_) + frame.size_m * mean_from_origin();
  result.axes = solver.eigenvectors().rowwise().reverse();
  result.semi_axes_m = frame.size_m * (5.0 * solver.eigenvalues().reverse()).cwiseSqrt();
  return result;
}

}  // namespace vantage
