// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vantage/vision/depth_camera.hpp>

#include <vantage/settings/impl/option_rule.hpp>

namespace vantage {
namespace {

using detail::require_option;

// Drops flying pixels between an edge and its background.
class EdgeFilter {
 public:
  EdgeFilter(const DepthImage& depth, const DepthCamera& camera) : depth_(depth), camera_(camera) {}

  [[nodiscard]] bool keeps(std::size_t column, std::size_t row) const {
    if (camera_.edge_share == 0.0) {
      return true;
    }
    const float z = depth_.at(column, row);
    const auto gap = static_cast<float>(camera_.edge_share) * z;
    constexpr std::array<std::pair<int, int>, 4> kAcross{{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};
    int support = 0;
    for (const auto& [dx, dy] : kAcross) {
      const float a = step_to(column, row, dx, dy) - z;  // NaN outside the image and where nothing was measured
      const float b = step_to(column, row, -dx, -dy) - z;
      support += (std::abs(a) <= gap ? 1 : 0) + (std::abs(b) <= gap ? 1 : 0);
      if ((a > gap && b < -gap) || (a < -gap && b > gap)) {
        return false;
      }
    }
    return support >= camera_.min_support;
  }

 private:
  [[nodiscard]] float step_to(std::size_t column, std::size_t row, int dx, int dy) const {
    const auto x = static_cast<std::ptrdiff_t>(column) + dx;
    const auto y = static_cast<std::ptrdiff_t>(row) + dy;
    const bool inside = x >= 0 && y >= 0 && x < static_cast<std::ptrdiff_t>(depth_.width) &&
                        y < static_cast<std::ptrdiff_t>(depth_.height);
    return inside ? depth_.at(static_cast<std::size_t>(x), static_cast<std::size_t>(y))
                  : std::numeric_limits<float>::quiet_NaN();
  }

  const DepthImage& depth_;
  const DepthCamera& camera_;
};

}  // namespace

double DepthNoise::sigma_m(double z_m) const { return constant_m + z_m * (linear + z_m * quadratic_per_m); }

double DepthNoise::range_for(double sigma_m) const {
  if (constant_m > sigma_m) {
    return 0.0;
  }
  const double left = sigma_m - constant_m;
  if (quadratic_per_m > 0.0) {  // the positive root, in a form without cancellation
    return 2.0 * left / (linear + std::sqrt(linear * linear + 4.0 * quadratic_per_m * left));
  }
  return linear > 0.0 ? left / linear : std::numeric_limits<double>::infinity();
}

void DepthCamera::validate() const {
  const auto is_focal_length = [](double f) { return std::isfinite(f) && f != 0.0; };
  require_option(width > 0, "DepthCamera::width", width, "> 0");
  require_option(height > 0, "DepthCamera::height", height, "> 0");
  require_option(is_focal_length(fx) && fx > 0.0, "DepthCamera::fx", fx, "> 0 and finite");
  require_option(is_focal_length(fy), "DepthCamera::fy", fy, "finite and not 0");
  require_option(std::isfinite(cx), "DepthCamera::cx", cx, "finite");
  require_option(std::isfinite(cy), "DepthCamera::cy", cy, "finite");
  require_option(std::isfinite(min_range_m) && min_range_m >= 0.0, "DepthCamera::min_range_m", min_range_m, ">= 0");
  require_option(std::isfinite(max_range_m) && max_range_m > min_range_m, "DepthCamera::max_range_m", max_range_m,
                 "finite and > DepthCamera::min_range_m");
  const auto at_least_0 = [](double value) { return std::isfinite(value) && value >= 0.0; };
  require_option(at_least_0(noise.constant_m), "DepthNoise::constant_m", noise.constant_m, ">= 0");
  require_option(at_least_0(noise.linear), "DepthNoise::linear", noise.linear, ">= 0");
  require_option(at_least_0(noise.quadratic_per_m), "DepthNoise::quadratic_per_m", noise.quadratic_per_m, ">= 0");
  require_option(max_sigma_m > 0.0, "DepthCamera::max_sigma_m", max_sigma_m, "> 0");
  require_option(edge_share >= 0.0 && edge_share < 1.0, "DepthCamera::edge_share", edge_share, "in [0, 1)");
  require_option(min_support >= 0 && min_support <= 8, "DepthCamera::min_support", min_support, "in [0, 8]");
  require_option(trusted_range_m() > min_range_m, "DepthCamera::max_sigma_m", max_sigma_m,
                 "enough for distances above DepthCamera::min_range_m");
  if (!is_rigid(posed_from_depth)) {
    throw std::invalid_argument("DepthCamera::posed_from_depth is not a rigid transform");
  }
}

double DepthCamera::trusted_range_m() const { return std::min(max_range_m, noise.range_for(max_sigma_m)); }

RangeSensor DepthCamera::range_sensor() const {
  validate();
  RangeSensor sensor;
  sensor.width = width;
  sensor.height = height;
  sensor.fx = fx;
  sensor.fy = std::abs(fy);
  sensor.cx = cx;
  sensor.cy = fy > 0.0 ? cy : static_cast<double>(height) - 1.0 - cy;
  sensor.min_range_m = min_range_m;
  sensor.max_range_m = trusted_range_m();
  return sensor;
}

DepthScan depth_scan(const DepthImage& depth, const DepthCamera& camera, const Pose& world_from_posed) {
  camera.validate();
  if (depth.width != camera.width || depth.height != camera.height ||
      depth.z_m.size() != depth.width * depth.height) {
    throw std::invalid_argument("the depth image is " + std::to_string(depth.width) + " x " +
                                std::to_string(depth.height) + " pixels, the camera's are " +
                                std::to_string(camera.width) + " x " + std::to_string(camera.height));
  }
  DepthScan result;
  Scan& scan = result.scan;
  scan.world_from_sensor = world_from_posed * camera.posed_from_depth;
  scan.max_range_m = camera.trusted_range_m();
  scan.width = depth.width;
  scan.height = depth.height;
  scan.points.assign(depth.z_m.size(), Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
  const EdgeFilter edges(depth, camera);
  for (std::size_t row = 0; row < depth.height; ++row) {
    const double y = (static_cast<double>(row) - camera.cy) / camera.fy;
    for (std::size_t column = 0; column < depth.width; ++column) {
      const double z = depth.at(column, row);
      if (!std::isfinite(z) || z <= 0.0) {
        ++result.report.not_measured;
      } else if (z < camera.min_range_m) {
        ++result.report.too_near;
      } else if (!edges.keeps(column, row)) {
        ++result.report.flying;
      } else {
        const double x = (static_cast<double>(column) - camera.cx) / camera.fx;
        scan.points[row * depth.width + column] = Eigen::Vector3d(x * z, y * z, z).cast<float>();
        ++result.report.used;
      }
    }
  }
  return result;
}

}  // namespace vantage
