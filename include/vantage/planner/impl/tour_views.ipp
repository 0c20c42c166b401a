// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/planner/impl/tour_views.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>
#include <vantage/geometry/raster_order.hpp>
#include <vantage/view/frontier_survey.hpp>

#include <vantage/view/impl/targets_in_sight.hpp>

namespace vantage::detail {

// Places around a part: in eight directions, at these shares of the range within which a view counts.
inline constexpr std::array<double, 2> kRings{0.2, 0.4};
inline constexpr double kDiagonal = 0.70710678118654752;
inline constexpr std::array<std::array<double, 2>, 8> kRing{{{1.0, 0.0},
                                                             {kDiagonal, kDiagonal},
                                                             {0.0, 1.0},
                                                             {-kDiagonal, kDiagonal},
                                                             {-1.0, 0.0},
                                                             {-kDiagonal, -kDiagonal},
                                                             {0.0, -1.0},
                                                             {kDiagonal, -kDiagonal}}};
// Further away a place no longer belongs to a part.
inline constexpr double kFurthestRangeM = 10.0;
// Places around parts stand on a lattice, so that parts beside each other share them.
inline constexpr double kLatticeM = 0.4;
// The tour is planned again long before the parts behind the first few are looked at.
inline constexpr std::size_t kPartsWithPlaces = 8;
// About so many cells stand for all of the parts.
inline constexpr std::size_t kMostLookedFor = 500;

// The coordinate of the lattice below or at `at`.
inline std::int32_t lattice_at(std::int32_t at, std::int32_t step) { return at - (at % step + step) % step; }

// Places around a part are at shares of this distance from it.
inline double furthest_range_m(const Situation& situation) {
  return std::min(kFurthestRangeM, counted_range_m(situation.map(), situation.sensor()));
}

VANTAGE_INLINE std::vector<FrontierSite> frontier_parts(const Situation& situation, double most_m) {
  const VoxelFrame& frame = situation.map().frame();
  const double range_m = counted_range_m(situation.map(), situation.sensor());
  const double beside_m = kRings.back() * furthest_range_m(situation);
  const double above_m = std::min(beside_m * std::tan(0.5 * situation.sensor().vertical_angle_rad()),
                                  std::sqrt(range_m * range_m - beside_m * beside_m));
  const std::int32_t side = std::max(1, frame.cells_up_to(most_m));
  return frontier_sites(situation.survey().targets, {side, side, std::max(side, frame.cells_up_to(2.0 * above_m))});
}

inline Eigen::Vector3d middle_of_unknown(const FrontierSite& site, const VoxelFrame& frame) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const FrontierTarget& target : site.targets) {
    sum += frame.centre_of(target.unknown);
  }
  return sum / static_cast<double>(site.targets.size());
}

inline std::vector<VoxelIndex> places_of(const Situation& situation, const std::vector<FrontierSite>& sites,
                                         const std::vector<Eigen::Vector3d>& middles) {
  const ReachableSpace& reachable = situation.reachable();
  const VoxelFrame& frame = situation.map().frame();
  const std::int32_t step = std::max(1, frame.cells_up_to(kLatticeM));
  const double range_m = furthest_range_m(situation);
  std::vector<VoxelIndex> places{*reachable.start()};
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const FrontierTarget& middle = sites[i].middle;
    places.push_back(middle.viewpoint);
    places.push_back(middle.frontier);
    const double height_m = reachable.position_in(middle.viewpoint).z();
    for (const double share : kRings) {
      const double radius_m = share * range_m;
      for (std::size_t way = 0; way < (i < kPartsWithPlaces ? kRing.size() : 0); ++way) {
        const auto& [x, y] = kRing[way];
        const VoxelIndex cell =
            frame.cell_of({middles[i].x() + radius_m * x, middles[i].y() + radius_m * y, height_m});
        places.push_back({lattice_at(cell.x, step), lattice_at(cell.y, step), cell.z});
      }
    }
  }
  sort_unique(places);
  std::erase_if(
      places, [&](const VoxelIndex& place) { return !reachable.contains(place) || situation.tried().rests(place); });
  return places;
}

VANTAGE_INLINE TourViews::TourViews(const Situation& situation, const std::vector<FrontierSite>& sites,
                                    std::uint64_t& operations) {
  const VoxelFrame& frame = situation.map().frame();
  std::size_t targets = 0;
  for (const FrontierSite& site : sites) {
    middles_.push_back(middle_of_unknown(site, frame));
    targets += site.targets.size();
  }
  const std::size_t stride = targets / kMostLookedFor + 1;
  std::vector<std::vector<VoxelIndex>> parts;
  for (const FrontierSite& site : sites) {
    std::vector<VoxelIndex>& part = parts.emplace_back();
    for (std::size_t i = 0; i < site.targets.size(); i += stride) {
      part.push_back(site.targets[i].unknown);
    }
    sort_unique(part);
    unknown.insert(unknown.end(), part.begin(), part.end());
  }
  sort_unique(unknown);
  shares.resize(unknown.size());
  for (const std::vector<VoxelIndex>& part : parts) {
    for (const VoxelIndex& cell : part) {
      const auto at = std::lower_bound(unknown.begin(), unknown.end(), cell, RasterOrder{}) - unknown.begin();
      double& share = shares[static_cast<std::size_t>(at)];
      share = std::max(share, 1.0 / static_cast<double>(part.size()));
    }
  }
  for (const VoxelIndex& place : places_of(situation, sites, middles_)) {
    std::vector<TourView> more = views_from(place, situation.reachable().position_in(place), situation, operations);
    std::move(more.begin(), more.end(), std::back_inserter(views));
  }
}

VANTAGE_INLINE std::vector<TourView> TourViews::views_from(const VoxelIndex& place, const Eigen::Vector3d& position_m,
                                                           const Situation& situation,
                                                           std::uint64_t& operations) const {
  const VoxelFrame& frame = situation.map().frame();
  const double range_m = counted_range_m(situation.map(), situation.sensor());
  std::vector<std::pair<std::uint32_t, Eigen::Vector3d>> lines;  // to the unknown cells in sight, by number
  for (std::uint32_t number = 0; number < unknown.size(); ++number) {
    const Eigen::Vector3d line = frame.centre_of(unknown[number]) - position_m;
    const double length_m = line.norm();
    if (length_m >= situation.sensor().min_range_m && length_m <= range_m &&
        !situation.tried().tried_from(unknown[number], place) &&
        in_plain_sight(situation.map(), position_m, unknown[number], operations)) {
      lines.emplace_back(number, line);
    }
  }
  std::vector<TourView> from_here;
  for (std::size_t i = 0; i < middles_.size() && !lines.empty(); ++i) {
    const Eigen::Vector3d line = middles_[i] - position_m;
    if (line.norm() < 1e-3 || line.norm() > 1.5 * range_m) {
      continue;
    }
    const Pose pose = situation.platform().facing(position_m, line);
    const Eigen::Matrix3d sensor_from_world = pose.linear().transpose();
    std::vector<std::uint32_t> sees;
    for (const auto& [number, line_to] : lines) {
      if (situation.sensor().in_view(sensor_from_world * line_to)) {
        sees.push_back(number);
      }
    }
    const bool is_new =
        std::none_of(from_here.begin(), from_here.end(), [&](const TourView& other) { return other.sees == sees; });
    if (!sees.empty() && is_new) {
      from_here.push_back({place, pose, std::move(sees)});
    }
  }
  return from_here;
}

}  // namespace vantage::detail
