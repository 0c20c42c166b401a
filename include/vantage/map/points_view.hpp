// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstring>
#include <span>
#include <vantage/compiler.hpp>

namespace VANTAGE_EXPORT vantage {

/// Points as they lie in the memory of a host: x, y and z are three floats in a row, in the byte order of this
/// machine, with one point every `stride_bytes`, at any alignment. Nothing is copied or owned; the memory must
/// outlive the view.
///
///     PointsView(points)                                                      // std::vector<Eigen::Vector3f>
///     PointsView(&cloud.data[x_offset], cloud.width * cloud.height, cloud.point_step)  // PointCloud2, rows unpadded
class PointsView {
 public:
  /// Bytes of one point.
  static constexpr std::size_t kBytes = 3 * sizeof(float);

  /// No points.
  PointsView() = default;
  /// All points of an array.
  explicit PointsView(std::span<const Eigen::Vector3f> points)
      : PointsView(points.data(), points.size(), sizeof(Eigen::Vector3f)) {}
  /// `count` points; `first` is the address of the x coordinate of the first one. Throws std::invalid_argument if
  /// `first` is null and `count` is not 0, or if `stride_bytes` is less than kBytes.
  PointsView(const void* first, std::size_t count, std::size_t stride_bytes);

  /// The number of points.
  [[nodiscard]] std::size_t size() const { return count_; }
  /// Address of the x coordinate of a point. `number` must be less than `size()`.
  [[nodiscard]] const std::byte* at(std::size_t number) const { return first_ + number * stride_bytes_; }
  /// A point. `number` must be less than `size()`.
  [[nodiscard]] Eigen::Vector3f operator[](std::size_t number) const {
    Eigen::Vector3f point;
    std::memcpy(point.data(), at(number), kBytes);
    return point;
  }
  /// Bytes from one point to the next.
  [[nodiscard]] std::size_t stride_bytes() const { return stride_bytes_; }

 private:
  const std::byte* first_ = nullptr;
  std::size_t count_ = 0;
  std::size_t stride_bytes_ = kBytes;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/map/impl/points_view.ipp>
#endif
