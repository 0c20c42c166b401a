// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/planner/impl/tour_views.hpp>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>
#include <vantage/geometry/raster_order.hpp>

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
  const double range_m = std::min(kFurthestRangeM, counted_range_m(situation.map(), situation.sensor()));
  std::vector<VoxelIndex> places{*reachable.start()};
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const FrontierTarget& middle = sites[i].middle;
    places.push_back(middle.viewpoint);
    places.push_back(middle.frontier);
    const double height_m = reachable.position_in(middle.viewpoint).z();
    for (const double share : kRings) {
      for (const auto& [x, y] : kRing) {
        const double radius_m = share * range_m;
        places.push_back(situation.map().frame().cell_of(
            {middles[i].x() + radius_m * x, middles[i].y() + radius_m * y, height_m}));
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

// What is in sight, by number in `unknown`, each cell once.
inline std::vector<NumberedLine> numbered(const std::vector<TargetsInSight::Sighting>& sightings,
                                          const std::vector<VoxelIndex>& unknown) {
  std::vector<NumberedLine> lines;
  lines.reserve(sightings.size());
  for (const TargetsInSight::Sighting& sighting : sightings) {
    const auto at = std::lower_bound(unknown.begin(), unknown.end(), sighting.unknown, RasterOrder{});
    lines.push_back({static_cast<std::uint32_t>(at - unknown.begin()), sighting.line});
  }
  const auto before = [](const NumberedLine& a, const NumberedLine& b) { return a.number < b.number; };
  std::sort(lines.begin(), lines.end(), before);
  const auto same = [](const NumberedLine& a, const NumberedLine& b) { return a.number == b.number; };
  lines.erase(std::unique(lines.begin(), lines.end(), same), lines.end());
  return lines;
}

VANTAGE_INLINE TourViews::TourViews(const Situation& situation, const std::vector<FrontierSite>& sites,
                                    std::uint64_t& operations) {
  const double range_m = counted_range_m(situation.map(), situation.sensor());
  std::vector<Eigen::Vector3d> middles;
  for (const FrontierSite& site : sites) {
    middles.push_back(middle_of_unknown(site, situation.map().frame()));
    for (const FrontierTarget& target : site.targets) {
      unknown.push_back(target.unknown);
    }
  }
  sort_unique(unknown);
  std::vector<FrontierTarget> wanted;
  std::copy_if(situation.survey().targets.begin(), situation.survey().targets.end(), std::back_inserter(wanted),
               [&](const FrontierTarget& target) {
                 return std::binary_search(unknown.begin(), unknown.end(), target.unknown, RasterOrder{});
               });
  for (const VoxelIndex& place : places_of(situation, sites, middles)) {
    const Eigen::Vector3d position = situation.reachable().position_in(place);
    TargetsInSight in_sight(situation.surveyed(), wanted, position, range_m, operations);
    in_sight.leave_out_tried();
    const std::vector<NumberedLine> lines = numbered(in_sight.all(), unknown);
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
