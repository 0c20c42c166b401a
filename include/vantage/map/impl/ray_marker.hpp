// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <compare>
#include <optional>
#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/map/impl/ray_lanes.hpp>
#include <vantage/map/impl/scan_marks.hpp>

namespace vantage::detail {

/// A ray to draw, from the origin of its scan.
struct DrawnRay {
  Eigen::Vector3d end;
  VoxelIndex last;                ///< cell of the end
  std::size_t axis = 0;           ///< axis of `faces_before`
  std::int64_t faces_before = 0;  ///< the part to draw starts after this number of faces across `axis`
};

/// Marks the cells of rays from one origin, several rays in parallel.
class RayMarker {
 public:
  RayMarker(const VoxelFrame& frame, const Eigen::Vector3d& origin, ScanMarks& marks);

  /// Marks the cells passed by rays, without their end cells, as passed. `next(lane, ray)` stores the next ray of a
  /// lane in `ray`, or returns false if there is none. Successive rays of a lane may be neighbours. Rays of different
  /// lanes should be apart, because lanes that write the same word at the same time slow each other down.
  template <class Next>
  void mark(Next&& next) {
    DrawnRay ray;
    left_.fill(0);
    while (true) {
      std::int64_t steps = kNoRay;
      for (std::size_t lane = 0; lane < RayLanes::kLanes; ++lane) {
        while (left_[lane] == 0) {
          if (next(lane, ray)) {
            start(lane, ray);
          } else {
            park(lane);
          }
        }
        steps = left_[lane] < steps ? left_[lane] : steps;
      }
      if (steps == kNoRay) {
        return;
      }
      lanes_.walk(steps, marks_.passed());
      for (std::int64_t& left : left_) {
        left -= left == kNoRay ? 0 : steps;
      }
    }
  }

 private:
  static constexpr std::int64_t kNoRay = std::int64_t{1} << 62U;

  void park(std::size_t lane);
  void start(std::size_t lane, const DrawnRay& ray);
  void mark_far(const DrawnRay& ray);

  // The crossing of a face. Crossings at equal times are ordered by axis.
  struct Crossing {
    std::int64_t time = -1;
    std::size_t axis = 0;
    friend bool operator<(const Crossing& a, const Crossing& b) {
      return a.time != b.time ? a.time < b.time : a.axis < b.axis;
    }
    friend bool operator<=(const Crossing& a, const Crossing& b) { return !(b < a); }
  };
  // The part of a ray to draw: the cells after crossing `enters` and before crossing `leaves`.
  struct Part {
    Crossing enters;
    std::optional<Crossing> leaves;
  };
  using Crossings = std::array<FaceCrossings, 3>;
  [[nodiscard]] std::optional<Part> within_window(const DrawnRay& ray, const Crossings& faces, Part part) const;

  VoxelFrame frame_;
  Eigen::Vector3d origin_;
  VoxelIndex first_;
  bool starts_in_window_;
  ScanMarks& marks_;
  RayLanes lanes_;
  std::array<std::int64_t, RayLanes::kLanes> left_{};  // remaining steps of the ray in each lane
};

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/map/impl/ray_marker.ipp>
#endif
