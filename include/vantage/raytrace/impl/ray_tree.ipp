// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <vantage/raytrace/ray_tree.hpp>

#include <vantage/settings/impl/option_rule.hpp>

namespace vantage {
namespace detail {

// The angles of eq. 6.
struct Angles {
  Angles(const RangeSensor& sensor, double cell_m)
      : half_across(0.5 * sensor.horizontal_angle_rad()),
        half_down(0.5 * sensor.vertical_angle_rad()),
        step(std::asin(cell_m / sensor.max_range_m)) {
    width = static_cast<std::size_t>(std::ceil(2.0 * half_across / step));
    height = static_cast<std::size_t>(std::ceil(2.0 * half_down / step));
  }

  [[nodiscard]] double across(std::size_t column) const { return -half_across + static_cast<double>(column) * step; }
  [[nodiscard]] double down(std::size_t row) const { return -half_down + static_cast<double>(row) * step; }
  [[nodiscard]] Eigen::Vector3d direction(std::size_t column, std::size_t row) const {
    const double alpha = across(column);
    const double beta = down(row);
    return {std::cos(beta) * std::sin(alpha), std::sin(beta), std::cos(beta) * std::cos(alpha)};
  }

  // Radians. Rays that are `step` apart are about a cell apart at the maximum range.
  double half_across;
  double half_down;
  double step;
  std::size_t width;
  std::size_t height;
};

inline std::size_t nearest_index(double place, std::size_t count) {
  return static_cast<std::size_t>(std::clamp(std::round(place), 0.0, static_cast<double>(count - 1)));
}

// The ray of `coarse` with the smallest angle to a ray of `fine`. If several are equal, the row nearest to that of
// the fine ray wins. In each row, the candidates are the ray with the nearest horizontal angle and the two ends of
// the row (for the seam behind the sensor). The search over rows stops when the angle to the row itself exceeds the
// best angle.
inline std::uint32_t nearest_ray(const Angles& coarse, const Angles& fine, std::size_t column, std::size_t row) {
  const Eigen::Vector3d ray = fine.direction(column, row);
  const double alpha = fine.across(column);
  const double beta = fine.down(row);
  const auto home = static_cast<std::int64_t>(nearest_index((beta + coarse.half_down) / coarse.step, coarse.height));
  double most = -2.0;
  std::uint32_t best = 0;
  const auto look_at = [&](std::int64_t candidate_row) {
    const auto r = static_cast<std::size_t>(candidate_row);
    const std::size_t middle = nearest_index((alpha + coarse.half_across) / coarse.step, coarse.width);
    for (const std::size_t c : {middle, std::size_t{0}, coarse.width - 1}) {
      const double cosine = ray.dot(coarse.direction(c, r));
      if (cosine > most) {
        most = cosine;
        best = static_cast<std::uint32_t>(r * coarse.width + c);
      }
    }
  };
  look_at(home);
  const auto rows = static_cast<std::int64_t>(coarse.height);
  const auto may_be_nearer = [&](std::int64_t r) {
    return r >= 0 && r < rows && std::cos(beta - coarse.down(static_cast<std::size_t>(r))) > most;
  };
  for (std::int64_t r = home - 1; may_be_nearer(r); --r) {
    look_at(r);
  }
  for (std::int64_t r = home + 1; may_be_nearer(r); ++r) {
    look_at(r);
  }
  return best;
}

inline RayImage image_of(const Angles& angles) {
  RayImage image{angles.width, angles.height, {}};
  image.directions.reserve(angles.width * angles.height);
  for (std::size_t row = 0; row < angles.height; ++row) {
    for (std::size_t column = 0; column < angles.width; ++column) {
      image.directions.push_back(angles.direction(column, row).cast<float>());
    }
  }
  return image;
}

inline void require_cell(const RangeSensor& sensor, double cell_m, const char* option) {
  detail::require_option(cell_m > 0.0 && cell_m < sensor.max_range_m, option, cell_m,
                         "> 0 and below the sensor's maximum range");
}

}  // namespace detail

VANTAGE_INLINE RayImage equal_angle_rays(const RangeSensor& sensor, double cell_m) {
  sensor.validate();
  detail::require_cell(sensor, cell_m, "equal_angle_rays: cell_m");
  return detail::image_of(detail::Angles(sensor, cell_m));
}

VANTAGE_INLINE RayTree::RayTree(const RangeSensor& sensor, double finest_cell_m, int levels) {
  sensor.validate();
  detail::require_option(levels >= 1 && levels <= 16, "RayTree: levels", levels, "in [1, 16]");
  detail::require_cell(sensor, finest_cell_m, "RayTree: finest_cell_m");
  detail::require_cell(sensor, finest_cell_m * (1 << (levels - 1)), "RayTree: the coarsest cell_m");
  for (int level = 0; level < levels; ++level) {
    const double cell_m = finest_cell_m * (1 << (levels - 1 - level));
    const detail::Angles angles(sensor, cell_m);
    Level& made = levels_.emplace_back();
    made.image = detail::image_of(angles);
    const std::size_t count = angles.width * angles.height;
    made.parents.assign(count, 0);
    made.first_child.assign(count + 1, 0);
    made.leaves.assign(count, level + 1 == levels ? 1 : 0);
    if (level == 0) {
      continue;
    }
    Level& above = levels_[static_cast<std::size_t>(level) - 1];
    const detail::Angles coarse(sensor, 2.0 * cell_m);
    for (std::size_t i = 0; i < count; ++i) {
      made.parents[i] = detail::nearest_ray(coarse, angles, i % angles.width, i / angles.width);
      ++above.first_child[made.parents[i] + 1];
    }
    // Counting sort: the children of a ray lie side by side, in the order of their numbers.
    for (std::size_t i = 1; i < above.first_child.size(); ++i) {
      above.first_child[i] += above.first_child[i - 1];
    }
    above.children.resize(count);
    std::vector<std::uint32_t> place = above.first_child;
    for (std::size_t i = 0; i < count; ++i) {
      above.children[place[made.parents[i]]++] = static_cast<std::uint32_t>(i);
    }
  }
  // From the finest level up: a ray has the leaves of its children.
  for (std::size_t level = levels_.size() - 1; level > 0; --level) {
    for (std::size_t i = 0; i < levels_[level].leaves.size(); ++i) {
      levels_[level - 1].leaves[levels_[level].parents[i]] += levels_[level].leaves[i];
    }
  }
}

}  // namespace vantage
