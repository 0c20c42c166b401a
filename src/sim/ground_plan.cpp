// SPDX-License-Identifier: MIT
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vantage/sim/ground_plan.hpp>

#include <vantage/settings/impl/option_rule.hpp>

namespace vantage {
namespace {

constexpr double kWallHeightM = 10.0;
constexpr double kInsetPixels = 0.01;

// Bounds of the corners of a box in another frame; x and y only.
Box turned_box(const Pose& to_from, const Box& box) {
  Box turned;
  for (const double x : {box.min.x(), box.max.x()}) {
    for (const double y : {box.min.y(), box.max.y()}) {
      turned.extend(to_from * Eigen::Vector3d(x, y, 0.0));
    }
  }
  return turned;
}

bool overlap_in_plane(const Box& a, const Box& b, double slack) {
  return a.min.x() + slack < b.max.x() && b.min.x() + slack < a.max.x() && a.min.y() + slack < b.max.y() &&
         b.min.y() + slack < a.max.y();
}

// Builds the walls along one axis of the pixels. A wall continues along pixels that are free on the same side. At
// its end it is shortened by the inset at a convex corner and extended by the inset at a concave one, so that the
// walls are closed.
class WallBuilder {
 public:
  WallBuilder(const GroundPlan& plan, TriangleMesh& mesh)
      : plan_(plan), extent_(plan.solid.box().extent()), mesh_(mesh) {}

  // `axis` is normal to the walls; `sign` is the side of the free pixels.
  void add_all(int axis, std::int32_t sign) {
    const std::int32_t lines = axis == 0 ? extent_.x : extent_.y;
    const std::int32_t length = axis == 0 ? extent_.y : extent_.x;
    for (std::int32_t line = -1; line <= lines; ++line) {
      const auto is_wall = [&](std::int32_t at) { return solid(axis, line, at) && !solid(axis, line + sign, at); };
      for (std::int32_t first = 0; first < length; ++first) {
        if (!is_wall(first)) {
          continue;
        }
        std::int32_t end = first + 1;
        while (end < length && is_wall(end)) {
          ++end;
        }
        const double across = line + (sign > 0 ? 1.0 - kInsetPixels : kInsetPixels);
        const double from = first - (solid(axis, line + sign, first - 1) ? kInsetPixels : -kInsetPixels);
        const double to = end + (solid(axis, line + sign, end) ? kInsetPixels : -kInsetPixels);
        add(axis, across, from, to);
        first = end;
      }
    }
  }

 private:
  bool solid(int axis, std::int32_t line, std::int32_t at) const {
    return plan_.solid.value_or(axis == 0 ? VoxelIndex{line, at, 0} : VoxelIndex{at, line, 0}, 1) != 0;
  }

  void add(int axis, double across, double from, double to) {
    const auto at = [&](double along, double z_m) {
      const Eigen::Vector2d pixels = axis == 0 ? Eigen::Vector2d(across, along) : Eigen::Vector2d(along, across);
      return Eigen::Vector3d(plan_.pixel_m * pixels.x(), plan_.pixel_m * pixels.y(), z_m);
    };
    mesh_.add_quad(at(from, -kWallHeightM), at(to, -kWallHeightM), at(to, kWallHeightM), at(from, kWallHeightM));
  }

  const GroundPlan& plan_;
  VoxelIndex extent_;
  TriangleMesh& mesh_;
};

}  // namespace

void GroundPlan::validate() const {
  detail::require_option(std::isfinite(pixel_m) && pixel_m > 0.0, "GroundPlan::pixel_m", pixel_m, "> 0");
  detail::require_option(std::isfinite(x_m), "GroundPlan::x_m", x_m, "finite");
  detail::require_option(std::isfinite(y_m), "GroundPlan::y_m", y_m, "finite");
  detail::require_option(std::isfinite(yaw_rad), "GroundPlan::yaw_rad", yaw_rad, "finite");
  if (solid.box().lo != VoxelIndex{} || solid.box().hi.z != 1) {
    throw std::invalid_argument("GroundPlan::solid must be one layer of pixels from (0, 0, 0) on");
  }
  if (std::none_of(solid.values().begin(), solid.values().end(), [](std::uint8_t pixel) { return pixel == 0; })) {
    throw std::invalid_argument("GroundPlan::solid has no free pixel");
  }
}

Pose GroundPlan::world_from_plan() const {
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  pose.translation() = Eigen::Vector3d(x_m, y_m, 0.0);
  return pose;
}

Box GroundPlan::bounds() const {
  Box bounds = turned_box(world_from_plan(), VoxelFrame{pixel_m}.box_of(solid.box()));
  bounds.max.z() = pixel_m;
  return bounds;
}

// Separating axes: two rectangles are disjoint exactly if an axis of one of them separates them.
bool GroundPlan::touches_solid(const Box& box) const {
  constexpr double kRoundingPixels = 1e-6;
  const double slack_m = kRoundingPixels * pixel_m;
  const Pose world_from_pixels = world_from_plan();
  const VoxelFrame frame{pixel_m};
  const Box among_pixels = turned_box(world_from_pixels.inverse(), box);
  const VoxelIndex last = frame.cell_of(among_pixels.max);
  VoxelIndex pixel = frame.cell_of(among_pixels.min);
  for (const std::int32_t first_x = pixel.x; pixel.y <= last.y; ++pixel.y) {
    for (pixel.x = first_x; pixel.x <= last.x; ++pixel.x) {
      if (solid.value_or(pixel, 1) != 0 && overlap_in_plane(frame.box_of(pixel), among_pixels, slack_m) &&
          overlap_in_plane(turned_box(world_from_pixels, frame.box_of(pixel)), box, slack_m)) {
        return true;
      }
    }
  }
  return false;
}

TriangleMesh GroundPlan::walls() const {
  TriangleMesh mesh;
  WallBuilder builder(*this, mesh);
  for (const int axis : {0, 1}) {
    builder.add_all(axis, -1);
    builder.add_all(axis, 1);
  }
  TriangleMesh placed;
  placed.append(mesh, world_from_plan());
  return placed;
}

RangeSensor in_plane(const RangeSensor& sensor) {
  RangeSensor row = sensor;
  row.height = 1;
  if (sensor.projection == RangeSensor::Projection::Pinhole) {
    row.fy = sensor.fx;
    row.cy = 0.0;
  } else {  // the same angle per ray vertically as horizontally
    row.vertical_fov_rad = std::min(sensor.horizontal_fov_rad / static_cast<double>(sensor.width), std::numbers::pi);
  }
  return row;
}

}  // namespace vantage
