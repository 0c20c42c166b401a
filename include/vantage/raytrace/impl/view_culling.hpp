// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/impl/instruction_set.hpp>
#include <vantage/map/impl/lane_queries.hpp>
#include <vantage/raytrace/impl/blocking_grid.hpp>
#include <vantage/raytrace/view_rays.hpp>

namespace vantage::detail {

/// How many rays of a set may meet a box. Some is also the answer if the test cannot tell.
enum class Meeting : std::uint8_t { None, Some, All };

/// Culling: finds the rays of a view that can meet a box at all.
class BoxCulling {
 public:
  BoxCulling(const Pose& world_from_sensor, const Box& box, InstructionSet set);

  /// Tests all rays in a cone.
  [[nodiscard]] Meeting meeting(const RayCone& cone) const;
  /// Bit mask of the rays of a tile that may meet the box.
  [[nodiscard]] std::uint64_t meeting(const RayTile& tile) const;
  /// Upper bound on the distance from the sensor to a point of the box, metres.
  [[nodiscard]] double furthest_m() const { return furthest_m_; }

 private:
  void find_outline(const Eigen::Matrix3d& world_from_sensor);

  InstructionSet set_;
  Eigen::Vector3d origin_;
  Box box_;
  double furthest_m_ = 0.0;
  bool inside_sphere_ = false;
  std::size_t edges_ = 0;  // number of edges of the outline
  // outward normals of the planes through the origin and an edge, in the sensor frame
  std::array<Eigen::Vector3d, 6> outwards_;
  Eigen::Vector3d axis_ = Eigen::Vector3d::UnitZ();  // from the sensor to the centre of the box, in the sensor frame
  double cos_ = -1.0;                                // half angle of the cone around the bounding sphere of the box
  double sin_ = 0.0;
};

/// Finds how far cones of rays from the sensor reach before a cell may stop one of the rays.
class FreeCone {
 public:
  /// The grid must outlive the object.
  FreeCone(const BlockingGrid& grid, const VoxelFrame& frame, const Pose& world_from_sensor);

  /// A distance, metres, up to which no cell stops a ray of the cone. The search ends soon after `enough_m`.
  [[nodiscard]] double free_m(const RayCone& cone, double enough_m);

 private:
  BlockingGrid::Reader reader_;
  double size_m_;
  Eigen::Vector3d origin_;  // in cells
  Eigen::Matrix3d world_from_sensor_;
};

inline BoxCulling::BoxCulling(const Pose& world_from_sensor, const Box& box, InstructionSet set)
    : set_(set), origin_(world_from_sensor.translation()), box_(box) {
  // Much larger than the rounding error of a ray, much smaller than a cell.
  const double margin =
      1e-9 * (1.0 + origin_.cwiseAbs().maxCoeff() + box.min.cwiseAbs().maxCoeff() + box.max.cwiseAbs().maxCoeff());
  box_.min.array() -= margin;
  box_.max.array() += margin;
  constexpr double kLooseness = 1e-5;  // tolerance for rotations that are not exactly orthonormal
  furthest_m_ = (1.0 + kLooseness) * (box_.max - origin_).cwiseAbs().cwiseMax((box_.min - origin_).cwiseAbs()).norm();
  const Eigen::Vector3d to_centre = box_.centre() - origin_;
  const double distance = to_centre.norm();
  const double radius = 0.5 * box_.extent().norm();
  inside_sphere_ = distance <= radius;
  if (!inside_sphere_) {
    axis_ = world_from_sensor.linear().transpose() * to_centre / distance;
    sin_ = radius / distance;
    cos_ = std::sqrt(1.0 - sin_ * sin_);
    find_outline(world_from_sensor.linear());
  }
}

// Two tests show that a cone misses the box: it does not meet the cone around the box's bounding sphere, or it lies
// completely on the outer side of a plane through the origin and an edge of the box's outline. The cone is completely
// inside if it lies on the inner side of all these planes.
inline Meeting BoxCulling::meeting(const RayCone& cone) const {
  if (inside_sphere_ || cone.cos_half_angle <= 0.0) {
    return Meeting::Some;
  }
  const double sin_of_sum = cone.sin_half_angle * cos_ + cone.cos_half_angle * sin_;
  const double cos_of_sum = cone.cos_half_angle * cos_ - cone.sin_half_angle * sin_;
  if (sin_of_sum > 0.0 && cone.axis.dot(axis_) < cos_of_sum) {
    return Meeting::None;
  }
  Meeting meeting = Meeting::All;
  for (std::size_t i = 0; i < edges_; ++i) {
    constexpr double kFlat = 1e-9;
    const double outwards = cone.axis.dot(outwards_[i]);
    if (outwards > cone.sin_half_angle + kFlat) {
      return Meeting::None;
    }
    if (outwards > -cone.sin_half_angle) {
      meeting = Meeting::Some;
    }
  }
  return meeting;
}

// A ray meets the box if it lies on the inner side of all planes through the origin and an edge of the outline.
inline std::uint64_t BoxCulling::meeting(const RayTile& tile) const {
  std::uint64_t meeting = tile.rays;
  RayBlock::PerRay<std::int32_t> flags;
  const float* const x = tile.directions[0].data();
  const float* const y = tile.directions[1].data();
  const float* const z = tile.directions[2].data();
  for (std::size_t edge = 0; edge < edges_; ++edge) {
    compiled_for(set_, [=, &flags, outwards = Eigen::Vector3f(outwards_[edge].cast<float>())] {
      constexpr float kFlat = 1e-6F;  // larger than the rounding error of single precision
      std::int32_t* const inside = flags.data();
      VANTAGE_INDEPENDENT
      for (std::size_t i = 0; i < RayBlock::kRays; ++i) {
        const float out = outwards.x() * x[i] + (outwards.y() * y[i] + outwards.z() * z[i]);
        const float slack = kFlat * (std::abs(x[i]) + (std::abs(y[i]) + std::abs(z[i])));
        inside[i] = out <= slack ? 1 : 0;
      }
    });
    meeting &= equal_to(flags, 1, set_);
  }
  return meeting;
}

// The outline: the edges between a face of the box that is visible from the origin and a face that is not.
inline void BoxCulling::find_outline(const Eigen::Matrix3d& world_from_sensor) {
  const auto side = [&](Eigen::Index axis, bool upper) {
    return (upper ? box_.max : box_.min)[axis] - origin_[axis];
  };
  // Whether the origin is on the outer side of a face, so that the face is visible.
  const auto looks = [&](Eigen::Index axis, bool upper) { return side(axis, upper) * (upper ? 1.0 : -1.0) < 0.0; };
  const Eigen::Vector3d to_centre = box_.centre() - origin_;
  for (Eigen::Index along = 0; along < 3; ++along) {
    const Eigen::Index a = (along + 1) % 3;
    const Eigen::Index b = (along + 2) % 3;
    for (unsigned edge = 0; edge < 4; ++edge) {
      const bool upper_a = (edge & 1U) != 0;
      const bool upper_b = (edge & 2U) != 0;
      if (looks(a, upper_a) != looks(b, upper_b)) {
        Eigen::Vector3d normal = Eigen::Vector3d::Zero();
        normal[a] = side(b, upper_b);
        normal[b] = -side(a, upper_a);
        // away from the box
        normal *= (normal.dot(to_centre) > 0.0 ? -1.0 : 1.0) / normal.norm();
        outwards_[edges_++] = world_from_sensor.transpose() * normal;
      }
    }
  }
}

inline FreeCone::FreeCone(const BlockingGrid& grid, const VoxelFrame& frame, const Pose& world_from_sensor)
    : reader_(grid),
      size_m_(frame.size_m),
      origin_(world_from_sensor.translation() / frame.size_m),
      world_from_sensor_(world_from_sensor.linear()) {}

// Steps along the axis from one cube of free words to the next. A ray of the cone at distance d from the sensor is at
// most d times the chord of the half angle away from the axis.
inline double FreeCone::free_m(const RayCone& cone, double enough_m) {
  constexpr double kLooseness = 1e-5;  // tolerance for rotations and rounding, per cell of distance
  constexpr double kLeastStep = 2.0;   // cells; a shorter step costs more than it saves
  constexpr double kSlack = 1e-3;      // tolerance for rounding, cells
  const double chord = std::sqrt(2.0 * (1.0 - cone.cos_half_angle)) + kLooseness;
  const Eigen::Vector3d axis = world_from_sensor_ * cone.axis;
  // Inverse of the largest speed at which the cone approaches the upper and the lower faces of a cube around it.
  std::array<double, 3> per_upper{};
  std::array<double, 3> per_lower{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double along = axis[static_cast<Eigen::Index>(i)];
    constexpr double kSlowest = 1e-9;
    per_upper[i] = 1.0 / std::max(chord + along, kSlowest);
    per_lower[i] = 1.0 / std::max(chord - along, kSlowest);
  }
  const double enough = enough_m / size_m_;
  double reached = 0.0;
  while (reached < enough) {
    const Eigen::Vector3d at = origin_ + reached * axis;
    const std::array<double, 3> place{at.x(), at.y(), at.z()};
    const auto cell = [&](std::size_t i) { return static_cast<std::int32_t>(std::floor(place[i])); };
    const VoxelIndex word = CellSet::word_of({cell(0), cell(1), cell(2)});
    const std::int32_t free = 4 * (reader_.distance(word) - 1);
    if (free < 0) {
      break;
    }
    const std::array<std::int32_t, 3> first{word.x * 4, word.y * 4, word.z * 4};
    // The cube of free words reaches `free` cells beyond this word. Step until the cone, which widens, may touch a
    // face.
    const double around = reached * chord + kSlack;
    double step = enough;
    for (std::size_t i = 0; i < 3; ++i) {
      const double upper = first[i] + 4 + free - place[i] - around;
      const double lower = place[i] - (first[i] - free) - around;
      step = std::min({step, upper * per_upper[i], lower * per_lower[i]});
    }
    if (step < kLeastStep) {
      break;
    }
    reached += step;
  }
  return reached * size_m_;
}

}  // namespace vantage::detail
