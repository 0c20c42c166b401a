// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/planner/impl/tour_views.hpp>

#include <algorithm>
#include <array>
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
  const double range_m = std::min(kFurthestRangeM, counted_range_m(situation.map(), situation.sensor()));
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

// An unknown cell in sight of a place.
struct NumberedLine {
  std::uint32_t number;
  Eigen::Vector3d line;  // from the place, metres, world
};

VANTAGE_INLINE TourViews::TourViews(const Situation& situation, const std::vector<FrontierSite>& sites,
                                    std::uint64_t& operations) {
  const VoxelFrame& frame = situation.map().frame();
  const double range_m = counted_range_m(situation.map(), situation.sensor());
  std::vector<Eigen::Vector3d> middles;
  std::size_t targets = 0;
  for (const FrontierSite& site : sites) {
    middles.push_back(middle_of_unknown(site, frame));
    targets += site.targets.size();
  }
  const std::size_t stride = targets / kMostLookedFor + 1;
  for (const FrontierSite& site : sites) {
    for (std::size_t i = 0; i < site.targets.size(); i += stride) {
      unknown.push_back(site.targets[i].unknown);
    }
  }
  sort_unique(unknown);
  std::vector<Eigen::Vector3d> centres;
  centres.reserve(unknown.size());
  for (const VoxelIndex& cell : unknown) {
    centres.push_back(frame.centre_of(cell));
  }
  for (const VoxelIndex& place : places_of(situation, sites, middles)) {
    const Eigen::Vector3d position = situation.reachable().position_in(place);
    std::vector<NumberedLine> lines;
    for (std::uint32_t number = 0; number < unknown.size(); ++number) {
      const Eigen::Vector3d line = centres[number] - position;
      const double length_m = line.norm();
      if (length_m >= situation.sensor().min_range_m && length_m <= range_m &&
          !situation.tried().tried_from(unknown[number], place) &&
          in_plain_sight(situation.map(), position, unknown[number], operations)) {
        lines.push_back({number, line});
      }
    }
    const auto first = static_cast<std::ptrdiff_t>(views.size());
    for (std::size_t i = 0; i < middles.size() && !lines.empty(); ++i) {
      const Eigen::Vector3d line = middles[i] - position;
      if (line.norm() < 1e-3 || line.norm() > 1.5 * range_m) {
        continue;
      }
      const Pose pose = situation.platform().facing(position, line);
      const Eigen::Matrix3d sensor_from_world = pose.linear().transpose();
      std::vector<std::uint32_t> sees;
      for (const NumberedLine& cell : lines) {
        if (situation.sensor().in_view(sensor_from_world * cell.line)) {
          sees.push_back(cell.number);
        }
      }
      const bool is_new =
          std::none_of(views.begin() + first, views.end(), [&](const TourView& other) { return other.sees == sees; });
      if (!sees.empty() && is_new) {
        views.push_back({place, pose, std::move(sees)});
      }
    }
  }
}

}  // namespace vantage::detail
