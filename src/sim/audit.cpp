// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <unordered_set>
#include <vantage/geometry/raster_order.hpp>
#include <vantage/sim/audit.hpp>

#include <vantage/raytrace/impl/shared_work.hpp>
#include <vantage/settings/impl/option_rule.hpp>

namespace vantage {
namespace {

std::vector<VoxelIndex> unknown_beside_free(const OccupancyMap& map) {
  std::unordered_set<VoxelIndex> found;
  map.for_each_known([&](const VoxelIndex& cell, Occupancy occupancy) {
    if (occupancy != Occupancy::Free || !map.in_region(cell)) {
      return;
    }
    for (const VoxelIndex& step : kFaceNeighbours) {
      const VoxelIndex neighbour = cell + step;
      if (map.in_region(neighbour) && map.at(neighbour) == Occupancy::Unknown) {
        found.insert(neighbour);
      }
    }
  });
  std::vector<VoxelIndex> cells(found.begin(), found.end());
  std::sort(cells.begin(), cells.end(), RasterOrder{});
  return cells;
}

std::vector<VoxelIndex> places_within_reach(const OccupancyMap& map, const Platform& platform, const Pose& current) {
  constexpr std::int32_t kNear = 2;  // cells; how far a start is searched if the pose's own cell is too tight
  if (!map.frame().addressable(current.translation())) {
    return {};
  }
  std::unordered_set<VoxelIndex> seen;
  std::vector<VoxelIndex> places;
  const auto try_place = [&](const VoxelIndex& cell) {
    if (seen.insert(cell).second && platform.admits_cell(map, cell)) {
      places.push_back(cell);
    }
  };
  const VoxelIndex home = map.frame().cell_of(current.translation());
  for_each_cell(VoxelBox{home, home + VoxelIndex{1, 1, 1}}.grown(kNear), [&](const VoxelIndex& cell) {
    Pose there = current;
    there.translation() = map.frame().centre_of(cell);
    if (platform.admits_motion(map, current, there)) {
      try_place(cell);
    }
  });
  for (std::size_t next = 0; next < places.size(); ++next) {
    for (const VoxelIndex& step : kFaceNeighbours) {
      try_place(places[next] + step);
    }
  }
  return places;
}

// Whether two cells are one, or share a face, an edge or a corner.
bool touch(const VoxelIndex& a, const VoxelIndex& b) {
  const VoxelIndex d = a - b;
  return std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) <= 1;
}

// The cell faces that a segment crosses along one axis.
struct Faces {
  std::int32_t step = 0;                                   // +1 or -1, to the next cell
  std::int32_t left = 0;                                   // faces still to cross
  double next = std::numeric_limits<double>::infinity();   // position of the next face, as a share of the segment
  double delta = std::numeric_limits<double>::infinity();  // from one face to the next, likewise
};

std::array<Faces, 3> faces_between(const VoxelFrame& frame, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const VoxelIndex first = frame.cell_of(from);
  const VoxelIndex last = frame.cell_of(to);
  const std::array<std::int32_t, 3> begin{first.x, first.y, first.z};
  const std::array<std::int32_t, 3> end{last.x, last.y, last.z};
  std::array<Faces, 3> faces;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (begin[axis] == end[axis]) {
      continue;
    }
    const auto i = static_cast<Eigen::Index>(axis);
    const bool up = end[axis] > begin[axis];
    const double length_m = std::abs(to[i] - from[i]);
    const double face_m = (begin[axis] + (up ? 1 : 0)) * frame.size_m;
    faces[axis] = {.step = up ? 1 : -1,
                   .left = std::abs(end[axis] - begin[axis]),
                   .next = std::abs(face_m - from[i]) / length_m,
                   .delta = frame.size_m / length_m};
  }
  return faces;
}

// Whether all cells that the segment touches, except the one it starts in, are free. Where it crosses several
// faces at once (an edge or a corner), all cells around that point count.
bool is_free_line(const OccupancyMap& map, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  constexpr double kAtOnce = 1e-9;
  VoxelIndex cell = map.frame().cell_of(from);
  std::array<Faces, 3> faces = faces_between(map.frame(), from, to);
  while (faces[0].left + faces[1].left + faces[2].left > 0) {
    double time = std::numeric_limits<double>::infinity();
    for (const Faces& axis : faces) {
      time = axis.left > 0 ? std::min(time, axis.next) : time;
    }
    std::array<std::int32_t, 3> step{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (faces[axis].left > 0 && faces[axis].next <= time + kAtOnce) {
        step[axis] = faces[axis].step;
        faces[axis].next += faces[axis].delta;
        --faces[axis].left;
      }
    }
    for (unsigned int part = 1; part < 8; ++part) {  // every subset of the faces crossed at once
      const VoxelIndex touched = cell + VoxelIndex{(part & 1U) != 0U ? step[0] : 0, (part & 2U) != 0U ? step[1] : 0,
                                                   (part & 4U) != 0U ? step[2] : 0};
      if (touched != cell && map.at(touched) != Occupancy::Free) {
        return false;
      }
    }
    cell = cell + VoxelIndex{step[0], step[1], step[2]};
  }
  return true;
}

class Auditor {
 public:
  Auditor(const OccupancyMap& map, const Platform& platform, const RangeSensor& sensor)
      : map_(map), platform_(platform), sensor_(sensor) {}

  bool could_observe(const VoxelIndex& unknown, const VoxelIndex& place) const {
    const Eigen::Vector3d from = map_.frame().centre_of(place);
    const Eigen::Vector3d to = map_.frame().centre_of(unknown);
    if (!in_range((to - from).norm()) || !is_free_line(map_, to, from)) {
      return false;
    }
    const Pose pose = platform_.facing(from, to - from);
    return sensor_.in_view(pose.linear().transpose() * (to - from)) && platform_.admits(map_, pose);
  }

  bool had_in_view(const VoxelIndex& unknown, const Pose& pose) const {
    const Eigen::Vector3d to = map_.frame().centre_of(unknown);
    const Eigen::Vector3d line = to - pose.translation();
    return in_range(line.norm()) && sensor_.in_view(pose.linear().transpose() * line) &&
           is_free_line(map_, to, pose.translation());
  }

  // The cells of the poses that had `unknown` in view.
  std::set<VoxelIndex> looked_at_from(const VoxelIndex& unknown, std::span<const Pose> looked_from) const {
    std::set<VoxelIndex> from;
    for (const Pose& pose : looked_from) {
      if (map_.frame().addressable(pose.translation()) && had_in_view(unknown, pose)) {
        from.insert(map_.frame().cell_of(pose.translation()));
      }
    }
    return from;
  }

 private:
  bool in_range(double distance_m) const {
    return distance_m >= sensor_.min_range_m && distance_m <= sensor_.max_range_m;
  }

  const OccupancyMap& map_;
  const Platform& platform_;
  const RangeSensor& sensor_;
};

void check_audit(const RangeSensor& sensor, const Pose& current, std::span<const Pose> looked_from, int threads) {
  sensor.validate();
  detail::require_option(threads > 0, "audit: threads", threads, "> 0");
  if (!is_rigid(current)) {
    throw std::invalid_argument("audit: the pose is not a rigid transform");
  }
  for (const Pose& pose : looked_from) {
    if (!is_rigid(pose)) {
      throw std::invalid_argument("audit: a pose of the run is not a rigid transform");
    }
  }
}

}  // namespace

AuditResult audit(const OccupancyMap& map, const Platform& platform, const RangeSensor& sensor, const Pose& current,
                  std::span<const Pose> looked_from, int threads) {
  check_audit(sensor, current, looked_from, threads);
  const std::vector<VoxelIndex> unknown = unknown_beside_free(map);
  const std::vector<VoxelIndex> places = places_within_reach(map, platform, current);
  const Auditor auditor(map, platform, sensor);
  enum class Verdict : std::uint8_t { Hidden, InVain, Left };
  std::vector<Verdict> verdicts(unknown.size(), Verdict::Hidden);
  std::vector<VoxelIndex> seen_from(unknown.size());
  detail::share_work(unknown.size(), static_cast<std::size_t>(threads), [&](std::size_t i) {
    const auto sees = [&](const VoxelIndex& place) { return auditor.could_observe(unknown[i], place); };
    const auto first = std::find_if(places.begin(), places.end(), sees);
    if (first == places.end()) {
      return;
    }
    const std::set<VoxelIndex> from = auditor.looked_at_from(unknown[i], looked_from);
    const auto differs = [&](const VoxelIndex& place) {
      return std::none_of(from.begin(), from.end(), [&](const VoxelIndex& other) { return touch(place, other); });
    };
    const auto place =
        from.size() >= 2
            ? places.end()
            : std::find_if(first, places.end(), [&](const VoxelIndex& cell) { return differs(cell) && sees(cell); });
    verdicts[i] = place == places.end() ? Verdict::InVain : Verdict::Left;
    if (place != places.end()) {
      seen_from[i] = *place;
    }
  });
  AuditResult result;
  result.cells_checked = unknown.size();
  for (std::size_t i = 0; i < unknown.size(); ++i) {
    result.looked_at_in_vain += verdicts[i] == Verdict::InVain ? 1U : 0U;
    if (verdicts[i] == Verdict::Left) {
      result.left.push_back({unknown[i], seen_from[i]});
    }
  }
  result.observable_left = result.left.size();
  return result;
}

}  // namespace vantage
