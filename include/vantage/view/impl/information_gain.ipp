// SPDX-License-Identifier: MIT
#pragma once

//
// Delmerico, Isler, Sabzevari, Scaramuzza 2018, "A comparison of volumetric information gain metrics for active 3D
// object reconstruction", Autonomous Robots 42.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vantage/raytrace/impl/view_placer.hpp>
#include <vantage/view/information_gain.hpp>

#include <vantage/raytrace/impl/shared_work.hpp>
#include <vantage/settings/impl/option_rule.hpp>

namespace vantage {
namespace detail {

// In nats.
inline double entropy_of(double probability) {
  const double other = 1.0 - probability;
  return probability <= 0.0 || other <= 0.0 ? 0.0 : -probability * std::log(probability) - other * std::log(other);
}

// Calls `visit(cell, I_v of the cell)` along a ray.
template <class Visit>
void for_each_visible_entropy(std::span<const RayCell> ray, const Visit& visit) {
  double visible = 1.0;
  for (const RayCell& cell : ray) {
    visit(cell, visible * cell.entropy);
    visible *= 1.0 - cell.probability;
  }
}

inline bool meets_a_rear_side(std::span<const RayCell> ray) {
  return ray.size() >= 2 && ray.back().occupancy == Occupancy::Occupied &&
         ray[ray.size() - 2].occupancy == Occupancy::Unknown;
}

// One-dimensional squared distance transform along a line of cells, in units of cells: the lower envelope of
// parabolas (Felzenszwalb & Huttenlocher 2012).
class SquaredDistances {
 public:
  static constexpr double kNone = 1e20;

  explicit SquaredDistances(std::size_t most) : at_(most), vertex_(most), from_(most + 1) {}

  template <class Line>
  void along(std::size_t count, const Line& line) {
    std::size_t parabolas = 0;
    for (std::size_t i = 0; i < count; ++i) {
      at_[i] = line(i);
      if (at_[i] >= kNone) {
        continue;
      }
      double begins = -std::numeric_limits<double>::infinity();
      for (; parabolas > 0; --parabolas) {
        const auto [a, b] = std::pair{static_cast<double>(vertex_[parabolas - 1]), static_cast<double>(i)};
        begins = (at_[i] + b * b - at_[vertex_[parabolas - 1]] - a * a) / (2.0 * (b - a));
        if (begins > from_[parabolas - 1]) {
          break;
        }
      }
      vertex_[parabolas] = i;
      from_[parabolas] = parabolas == 0 ? -std::numeric_limits<double>::infinity() : begins;
      ++parabolas;
    }
    for (std::size_t i = 0, k = 0; parabolas > 0 && i < count; ++i) {
      while (k + 1 < parabolas && from_[k + 1] < static_cast<double>(i)) {
        ++k;
      }
      const double step = static_cast<double>(i) - static_cast<double>(vertex_[k]);
      line(i) = step * step + at_[vertex_[k]];
    }
  }

 private:
  std::vector<double> at_;
  std::vector<std::size_t> vertex_;
  std::vector<double> from_;
};

// Distance from every cell of the box to its nearest occupied cell, metres.
inline VoxelGrid<double> distances_to_surface(const OccupancyMap& map, const VoxelBox& box) {
  VoxelGrid<double> distances(box, SquaredDistances::kNone);
  for_each_cell(box, [&](const VoxelIndex& cell) {
    if (map.at(cell) == Occupancy::Occupied) {
      distances[cell] = 0.0;
    }
  });
  const VoxelIndex extent = box.extent();
  const std::array<std::size_t, 3> counts{static_cast<std::size_t>(extent.x), static_cast<std::size_t>(extent.y),
                                          static_cast<std::size_t>(extent.z)};
  const std::array<std::size_t, 3> strides{1, counts[0], counts[0] * counts[1]};
  SquaredDistances squared(*std::max_element(counts.begin(), counts.end()));
  for (std::size_t axis = 0; axis < 3 && distances.size() > 0; ++axis) {
    for (std::size_t start = 0; start < distances.size(); ++start) {
      if (start / strides[axis] % counts[axis] == 0) {
        squared.along(counts[axis],
                      [&](std::size_t i) -> double& { return distances.values()[start + i * strides[axis]]; });
      }
    }
  }
  for (double& distance : distances.values()) {
    distance = std::sqrt(distance) * map.resolution_m();
  }
  return distances;
}

// Conservative: may report a ray that only comes close to the box.
inline bool may_meet(const Box& box, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  double enters = 0.0;
  double leaves = 1.0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double extent = to[axis] - from[axis];
    if (extent == 0.0) {
      if (from[axis] < box.min[axis] || from[axis] > box.max[axis]) {
        return false;
      }
      continue;
    }
    const double a = (box.min[axis] - from[axis]) / extent;
    const double b = (box.max[axis] - from[axis]) / extent;
    enters = std::max(enters, std::min(a, b));
    leaves = std::min(leaves, std::max(a, b));
  }
  return enters <= leaves;
}

inline const std::vector<std::pair<std::string_view, RayGainMaker>>& gains() {
  static const std::vector<std::pair<std::string_view, RayGainMaker>> all{
      {"occlusion-aware", [](const OccupancyMap&, const VoxelBox&) { return occlusion_aware(); }},
      {"unobserved-voxel", [](const OccupancyMap&, const VoxelBox&) { return unobserved_voxel(); }},
      {"rear-side-voxel", [](const OccupancyMap&, const VoxelBox&) { return rear_side_voxel(); }},
      {"rear-side-entropy", [](const OccupancyMap&, const VoxelBox&) { return rear_side_entropy(); }},
      {"proximity-count",
       [](const OccupancyMap& map, const VoxelBox& object) { return proximity_count(map, object); }}};
  return all;
}

}  // namespace detail

VANTAGE_INLINE RayGain occlusion_aware() {
  return [](std::span<const RayCell> ray) {
    double sum = 0.0;
    detail::for_each_visible_entropy(ray, [&](const RayCell&, double visible_entropy) { sum += visible_entropy; });
    return sum;
  };
}

VANTAGE_INLINE RayGain unobserved_voxel() {
  return [](std::span<const RayCell> ray) {
    double sum = 0.0;
    detail::for_each_visible_entropy(ray, [&](const RayCell& cell, double visible_entropy) {
      sum += cell.occupancy == Occupancy::Unknown ? visible_entropy : 0.0;
    });
    return sum;
  };
}

VANTAGE_INLINE RayGain rear_side_voxel() {
  return [](std::span<const RayCell> ray) { return detail::meets_a_rear_side(ray) ? 1.0 : 0.0; };
}

VANTAGE_INLINE RayGain rear_side_entropy() {
  return [](std::span<const RayCell> ray) {
    double last = 0.0;
    if (detail::meets_a_rear_side(ray)) {
      detail::for_each_visible_entropy(ray.first(ray.size() - 1),
                                       [&](const RayCell&, double visible_entropy) { last = visible_entropy; });
    }
    return last;
  };
}

VANTAGE_INLINE RayGain proximity_count(const OccupancyMap& map, const VoxelBox& object, double d_max_m) {
  detail::require_option(std::isfinite(d_max_m) && d_max_m > 0.0, "proximity_count: d_max_m", d_max_m, "> 0");
  const auto distances = std::make_shared<const VoxelGrid<double>>(detail::distances_to_surface(map, object));
  return [distances, d_max_m](std::span<const RayCell> ray) {
    double sum = 0.0;
    for (const RayCell& cell : ray) {
      if (cell.occupancy == Occupancy::Unknown) {
        sum += std::max(d_max_m - (*distances)[cell.cell], 0.0);
      }
    }
    return sum;
  };
}

VANTAGE_INLINE RayGainMaker ray_gain_named(std::string_view name) {
  std::string list;
  for (const auto& [known, maker] : detail::gains()) {
    if (known == name) {
      return maker;
    }
    list += (list.empty() ? "" : ", ") + std::string(known);
  }
  throw std::invalid_argument("there is no gain '" + std::string(name) + "'; there are: " + list);
}

VANTAGE_INLINE const std::vector<std::string_view>& ray_gain_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const auto& [name, maker] : detail::gains()) {
      all.push_back(name);
    }
    return all;
  }();
  return names;
}

VANTAGE_INLINE ViewGain::ViewGain(const OccupancyMap& map, const RayCaster& caster, const ViewRays& rays,
                                  const VoxelBox& object, RayGain gain)
    : caster_(&caster), rays_(&rays), gain_(std::move(gain)), cells_(object) {
  if (!gain_) {
    throw std::invalid_argument("ViewGain: the gain cannot be called");
  }
  for_each_cell(object, [&](const VoxelIndex& cell) {
    const double probability = 1.0 / (1.0 + std::exp(-map.log_odds(cell).value_or(0.0)));
    cells_[cell] = {cell, map.at(cell), probability, detail::entropy_of(probability)};
  });
}

VANTAGE_INLINE double ViewGain::operator()(const Pose& world_from_sensor, std::size_t threads) const {
  detail::require_option(threads > 0, "ViewGain: threads", threads, "> 0");
  if (cells_.size() == 0) {
    return 0.0;
  }
  std::vector<RayEnd> ends(rays_->size());
  caster_->cast(world_from_sensor, *rays_, ends);
  std::vector<double> parts(rays_->tiles().size());
  detail::share_work(parts.size(), threads,
                     [&](std::size_t i) { parts[i] = of_tile(world_from_sensor, rays_->tiles()[i], ends); });
  double sum = 0.0;
  for (const double part : parts) {
    sum += part;
  }
  return sum;
}

VANTAGE_INLINE double ViewGain::of_tile(const Pose& world_from_sensor, const RayTile& tile,
                                        std::span<const RayEnd> ends) const {
  const VoxelFrame& frame = caster_->frame();
  const Eigen::Vector3d& origin = world_from_sensor.translation();
  Box box = frame.box_of(cells_.box());
  box.min.array() -= frame.size_m;
  box.max.array() += frame.size_m;
  const bool may_be_too_near = box.distance_to(origin) < rays_->min_range_m();
  const detail::RayPlacer placer = detail::view_placer(world_from_sensor, *rays_, frame);
  detail::RayBlock block;
  placer.place_ends(tile.directions, tile.stretch, block);
  std::vector<RayCell> passed;
  double sum = 0.0;
  for (std::uint64_t left = tile.rays; left != 0; left &= left - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(left));
    const Eigen::Vector3d to(block.end[0][i], block.end[1][i], block.end[2][i]);
    if (!detail::may_meet(box, origin, to)) {
      continue;
    }
    const RayEnd& stop = ends[tile.ray[i]];
    passed.clear();
    bool entered = false;
    for (const VoxelIndex& cell : VoxelRay(frame, origin, to)) {
      if (cells_.contains(cell)) {
        entered = true;
        const RayCell& here = cells_[cell];
        if (!may_be_too_near || (frame.centre_of(cell) - origin).norm() >= rays_->min_range_m()) {
          passed.push_back(here);
        }
        if (here.occupancy == Occupancy::Occupied) {
          break;
        }
      } else if (entered || (cell == stop.cell && stop.occupancy != Occupancy::Free)) {
        break;
      }
    }
    sum += passed.empty() ? 0.0 : gain_(passed);
  }
  return sum;
}

}  // namespace vantage
