// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/robot/platform.hpp>
#include <vantage/sim/triangle_mesh.hpp>
#include <vantage/sim/triangle_scene.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// A point of a surface and the side it belongs to.
struct SurfaceSample {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();    ///< world frame, metres
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit, away from what the surface bounds
};

/// Points drawn evenly from the surface of a mesh, by area; the same seed gives the same points. The side of a point
/// is that of the triangle's winding, counter-clockwise seen from outside; where nothing of the open can be seen from
/// that side, but from the other, it is the other. Throws std::invalid_argument if the mesh has no area.
[[nodiscard]] std::vector<SurfaceSample> sample_surface(const TriangleMesh& mesh, std::size_t count = 20'000,
                                                        std::uint64_t seed = 1);

/// What images have shown of a surface. A sample is seen from a pose when it lies in the image and within range, on
/// the side from which the sensor looks, at an incidence under 85 degrees, and no true surface hides it.
class SeenSurface {
 public:
  /// `scene` is all that may hide a sample. Throws std::invalid_argument as RangeSensor::validate.
  SeenSurface(const TriangleScene& scene, std::vector<SurfaceSample> samples, const RangeSensor& sensor);

  /// Counts what an image from this pose shows.
  void add(const Pose& world_from_sensor);
  /// The samples that an image from this pose shows, by number, ascending.
  [[nodiscard]] std::vector<std::uint32_t> visible_from(const Pose& world_from_sensor) const;
  /// Whether a sample was seen.
  [[nodiscard]] bool seen(std::uint32_t sample) const { return seen_[sample]; }
  /// How many samples were seen.
  [[nodiscard]] std::size_t seen_count() const { return seen_count_; }
  /// The samples.
  [[nodiscard]] const std::vector<SurfaceSample>& samples() const { return samples_; }
  /// Share of the samples seen so far; 1 if there are none.
  [[nodiscard]] double share() const;
  /// How many samples have been seen or can be from one of these places, turned there towards the sample as far as
  /// the platform allows.
  [[nodiscard]] std::size_t observable_count(const Platform& platform, std::span<const Eigen::Vector3d> places) const;

 private:
  [[nodiscard]] bool exposed(const SurfaceSample& sample, const Eigen::Vector3d& from) const;

  TriangleScene scene_;
  std::vector<SurfaceSample> samples_;
  RangeSensor sensor_;
  std::vector<bool> seen_;
  std::size_t seen_count_ = 0;
};

}  // namespace vantage
