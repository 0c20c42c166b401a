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

/// A point of a surface and its outer side.
struct SurfaceSample {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();    ///< world frame, metres
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit normal, away from what the surface bounds
};

/// Draws points evenly by area from the surface of a mesh; the same seed gives the same points. The side of a
/// point follows the winding of its triangle, counter-clockwise seen from outside; if only the other side can be
/// seen from the open, it is the other side. Throws std::invalid_argument if the mesh has no area.
[[nodiscard]] std::vector<SurfaceSample> sample_surface(const TriangleMesh& mesh, std::size_t count = 20'000,
                                                        std::uint64_t seed = 1);

/// What images have shown of a surface. A pose sees a sample if it lies in the image and within range, on the side
/// of the sensor, at an incidence under 85 degrees, and no true surface occludes it.
class SeenSurface {
 public:
  /// `scene` is everything that may occlude a sample. Throws as RangeSensor::validate.
  SeenSurface(const TriangleScene& scene, std::vector<SurfaceSample> samples, const RangeSensor& sensor);

  /// Adds an image taken at this pose.
  void add(const Pose& world_from_sensor);
  /// Numbers of the samples that an image from this pose shows, ascending.
  [[nodiscard]] std::vector<std::uint32_t> visible_from(const Pose& world_from_sensor) const;
  /// Whether a sample was seen.
  [[nodiscard]] bool seen(std::uint32_t sample) const { return seen_[sample]; }
  /// How many samples were seen.
  [[nodiscard]] std::size_t seen_count() const { return seen_count_; }
  /// The samples that were passed to the constructor.
  [[nodiscard]] const std::vector<SurfaceSample>& samples() const { return samples_; }
  /// Share of the samples seen so far, in [0, 1]; 1 if there are none.
  [[nodiscard]] double share() const;
  /// How many samples have been seen or can be seen from one of these places (world frame, metres), with the
  /// sensor turned towards the sample as far as the platform can.
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
