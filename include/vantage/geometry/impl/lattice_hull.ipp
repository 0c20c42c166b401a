// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>
#include <vantage/geometry/lattice_hull.hpp>

#include <vantage/geometry/impl/box_around.hpp>

namespace vantage {
namespace detail {

using Integers = std::array<std::int64_t, 3>;
// Distances are products of three coordinate differences.
__extension__ typedef __int128 Wide;  // NOLINT(modernize-use-using): only a typedef takes __extension__

inline bool before(const VoxelIndex& a, const VoxelIndex& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

inline Integers difference(const VoxelIndex& a, const VoxelIndex& b) {
  return {std::int64_t{a.x} - b.x, std::int64_t{a.y} - b.y, std::int64_t{a.z} - b.z};
}

// The inputs are coordinate differences below 2^31, so no component reaches 2^63.
inline Integers cross(const Integers& a, const Integers& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline Wide dot(const Integers& a, const Integers& b) {
  return Wide{a[0]} * b[0] + Wide{a[1]} * b[1] + Wide{a[2]} * b[2];
}

inline double squared_length(const Integers& a) {
  return Eigen::Vector3d(static_cast<double>(a[0]), static_cast<double>(a[1]), static_cast<double>(a[2]))
      .squaredNorm();
}

// The first point with the largest `value`.
template <class Value>
VoxelIndex furthest(std::span<const VoxelIndex> points, const Value& value) {
  return *std::max_element(points.begin(), points.end(),
                           [&](const VoxelIndex& a, const VoxelIndex& b) { return value(a) < value(b); });
}

// Length of the first run of points in the same brick. They lie beyond nearly the same facets.
inline std::size_t run_length(std::span<const VoxelIndex> points) {
  const auto brick = [](const VoxelIndex& point) { return VoxelIndex{point.x >> 3, point.y >> 3, point.z >> 3}; };
  const auto end = std::find_if(points.begin(), points.end(),
                                [&](const VoxelIndex& point) { return brick(point) != brick(points.front()); });
  return static_cast<std::size_t>(end - points.begin());
}

}  // namespace detail

// The points outside the hull. Each is assigned to one facet that it lies beyond.
struct LatticeHull::Outside {
  static constexpr Number kNone = std::numeric_limits<Number>::max();
  std::span<const VoxelIndex> points;
  std::vector<Number> next;   // per point: next point of the same facet
  std::vector<Number> first;  // per facet: its first point
  std::vector<Number> seen;   // per facet: the last point for which it was visited
  std::vector<Number> open;   // facets that have points

  Outside(std::span<const VoxelIndex> all, std::size_t facets)
      : points(all), next(all.size(), kNone), first(facets, kNone), seen(facets, kNone) {}

  // Assigns a point to the first of `facets` that it lies beyond, or to none if it is inside.
  void assign(const LatticeHull& hull, Number point, std::span<const Number> facets) {
    for (const Number facet : facets) {
      if (hull.beyond(facet, points[point])) {
        if (first[facet] == kNone) {
          open.push_back(facet);
        }
        next[point] = std::exchange(first[facet], point);
        return;
      }
    }
  }
};

VANTAGE_INLINE HullPlane LatticeHull::Plane::plane() const {
  const Eigen::Vector3d outward(static_cast<double>(normal[0]), static_cast<double>(normal[1]),
                                static_cast<double>(normal[2]));
  const Eigen::Vector3d unit = outward.normalized();
  return {unit, -unit.dot(Eigen::Vector3d(point.x, point.y, point.z))};
}

VANTAGE_INLINE bool LatticeHull::Plane::operator==(const Plane& other) const {
  return normal == other.normal && detail::dot(normal, detail::difference(point, other.point)) == 0;
}

VANTAGE_INLINE LatticeHull::LatticeHull(std::span<const VoxelIndex> points) {
  if (start(points)) {
    insert(points);
  }
}

VANTAGE_INLINE void LatticeHull::insert(std::span<const VoxelIndex> points) {
  if (empty()) {
    *this = LatticeHull(points);
    return;
  }
  Outside outside(points, facets_.size());
  std::vector<Number> near;
  for (std::size_t begin = 0; begin < points.size();) {
    const std::span<const VoxelIndex> run = points.subspan(begin, detail::run_length(points.subspan(begin)));
    const VoxelBox box = detail::box_around(run);
    near.clear();
    for (Number facet = 0; facet < facets_.size(); ++facet) {
      const detail::Integers& normal = facets_[facet].normal;
      const VoxelIndex foremost{normal[0] > 0 ? box.hi.x - 1 : box.lo.x, normal[1] > 0 ? box.hi.y - 1 : box.lo.y,
                                normal[2] > 0 ? box.hi.z - 1 : box.lo.z};
      if (beyond(facet, foremost)) {
        near.push_back(facet);
      }
    }
    for (const std::size_t end = begin + run.size(); begin < end; ++begin) {
      outside.assign(*this, static_cast<Number>(begin), near);
    }
  }
  grow(outside);
}

VANTAGE_INLINE LatticeHull::Facet LatticeHull::facet(const VoxelIndex& a, const VoxelIndex& b, const VoxelIndex& c) {
  Facet facet{{a, b, c}, {}, detail::cross(detail::difference(b, a), detail::difference(c, a))};
  const std::int64_t divisor = std::gcd(std::gcd(facet.normal[0], facet.normal[1]), facet.normal[2]);
  for (std::int64_t& component : facet.normal) {
    component /= divisor == 0 ? 1 : divisor;
  }
  return facet;
}

VANTAGE_INLINE bool LatticeHull::beyond(Number facet, const VoxelIndex& point) const {
  return detail::dot(facets_[facet].normal, detail::difference(point, facets_[facet].corners[0])) > 0;
}

// Creates a tetrahedron of points far apart. Returns false if all points lie in one plane.
VANTAGE_INLINE bool LatticeHull::start(std::span<const VoxelIndex> points) {
  if (points.size() < 4) {
    return false;
  }
  const VoxelIndex a = points.front();
  VoxelIndex b =
      detail::furthest(points, [&](const VoxelIndex& p) { return detail::squared_length(detail::difference(p, a)); });
  const detail::Integers along = detail::difference(b, a);
  VoxelIndex c = detail::furthest(points, [&](const VoxelIndex& p) {
    return detail::squared_length(detail::cross(along, detail::difference(p, a)));
  });
  const detail::Integers across = facet(a, b, c).normal;
  const auto off_plane = [&](const VoxelIndex& p) { return detail::dot(across, detail::difference(p, a)); };
  const VoxelIndex d =
      detail::furthest(points, [&](const VoxelIndex& p) { return std::max(off_plane(p), -off_plane(p)); });
  if (off_plane(d) == 0) {
    return false;
  }
  if (off_plane(d) > 0) {
    std::swap(b, c);
  }
  facets_ = {facet(a, b, c), facet(b, a, d), facet(c, b, d), facet(a, c, d)};
  facets_[0].beside = {1, 2, 3};
  facets_[1].beside = {0, 3, 2};
  facets_[2].beside = {0, 1, 3};
  facets_[3].beside = {0, 2, 1};
  return true;
}

// Repeatedly extends the hull to the furthest point of a facet. A point beyond none of the new facets is inside.
VANTAGE_INLINE void LatticeHull::grow(Outside& outside) {
  while (!outside.open.empty()) {
    const Number start = outside.open.back();
    outside.open.pop_back();
    Number best = outside.first[start];
    if (best == Outside::kNone) {
      continue;
    }
    const Facet& facet = facets_[start];
    const auto distance = [&](Number point) {
      return detail::dot(facet.normal, detail::difference(outside.points[point], facet.corners[0]));
    };
    for (Number point = outside.next[best]; point != Outside::kNone; point = outside.next[point]) {
      best = distance(point) > distance(best) ? point : best;
    }
    replace(start, best, outside);
  }
}

// Replaces the facets visible from an outside point by a cone from their rim to the point.
VANTAGE_INLINE void LatticeHull::replace(Number first_visible, Number point, Outside& outside) {
  std::vector<Number> visible{first_visible};
  const std::vector<Edge> rim = horizon(visible, point, outside);
  std::vector<Number> loose;
  for (const Number facet : visible) {
    for (Number other = std::exchange(outside.first[facet], Outside::kNone); other != Outside::kNone;
         other = outside.next[other]) {
      loose.push_back(other);
    }
    facets_[facet].normal = {};
    unused_.push_back(facet);
  }
  const std::vector<Number> cone = add_cone(rim, outside.points[point]);
  outside.first.resize(facets_.size(), Outside::kNone);
  outside.seen.resize(facets_.size(), Outside::kNone);
  for (const Number other : loose) {
    if (other != point) {
      outside.assign(*this, other, cone);
    }
  }
}

// Appends all visible facets to the first one, and returns the edges around them.
VANTAGE_INLINE std::vector<LatticeHull::Edge> LatticeHull::horizon(std::vector<Number>& visible, Number point,
                                                                   Outside& outside) const {
  std::vector<Edge> rim;
  outside.seen[visible.front()] = point;
  for (std::size_t next = 0; next < visible.size(); ++next) {
    const Facet& facet = facets_[visible[next]];
    for (std::size_t i = 0; i < 3; ++i) {
      const Number other = facet.beside[i];
      if (outside.seen[other] == point) {
        continue;
      }
      if (beyond(other, outside.points[point])) {
        outside.seen[other] = point;
        visible.push_back(other);
      } else {
        rim.push_back({facet.corners[i], facet.corners[(i + 1) % 3], other});
      }
    }
  }
  return rim;
}

VANTAGE_INLINE std::vector<LatticeHull::Number> LatticeHull::add_cone(const std::vector<Edge>& rim,
                                                                      const VoxelIndex& apex) {
  std::vector<Number> cone;
  std::vector<std::pair<VoxelIndex, Number>> by_start;
  for (const Edge& edge : rim) {
    cone.push_back(add(facet(edge.from, edge.to, apex)));
    by_start.emplace_back(edge.from, cone.back());
    Facet& behind = facets_[edge.behind];
    const auto at = std::find(behind.corners.begin(), behind.corners.end(), edge.to) - behind.corners.begin();
    behind.beside[static_cast<std::size_t>(at)] = cone.back();
  }
  std::sort(by_start.begin(), by_start.end(),
            [](const auto& a, const auto& b) { return detail::before(a.first, b.first); });
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const Number after =
        std::lower_bound(by_start.begin(), by_start.end(), rim[i].to, [](const auto& a, const VoxelIndex& to) {
          return detail::before(a.first, to);
        })->second;
    facets_[cone[i]].beside[0] = rim[i].behind;
    facets_[cone[i]].beside[1] = after;
    facets_[after].beside[2] = cone[i];
  }
  return cone;
}

VANTAGE_INLINE LatticeHull::Number LatticeHull::add(const Facet& facet) {
  if (unused_.empty()) {
    facets_.push_back(facet);
    return static_cast<Number>(facets_.size() - 1);
  }
  const Number number = unused_.back();
  unused_.pop_back();
  facets_[number] = facet;
  return number;
}

VANTAGE_INLINE bool LatticeHull::contains(const VoxelIndex& point) const {
  for (Number facet = 0; facet < facets_.size(); ++facet) {
    if (beyond(facet, point)) {
      return false;
    }
  }
  return !empty();
}

VANTAGE_INLINE std::vector<LatticeHull::Plane> LatticeHull::planes() const {
  std::vector<Plane> planes;
  for (const Facet& facet : facets_) {
    if (facet.normal != detail::Integers{}) {
      planes.push_back({facet.normal, facet.corners[0]});
    }
  }
  std::sort(planes.begin(), planes.end(), [](const Plane& a, const Plane& b) { return a.normal < b.normal; });
  planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
  return planes;
}

// A vertex of triangles is a corner only if at least three planes meet there. Otherwise it lies inside a plane or an
// edge.
VANTAGE_INLINE std::vector<VoxelIndex> LatticeHull::corners() const {
  std::vector<std::pair<VoxelIndex, detail::Integers>> planes_at;
  for (const Facet& facet : facets_) {
    for (const VoxelIndex& corner : facet.corners) {
      if (facet.normal != detail::Integers{}) {
        planes_at.emplace_back(corner, facet.normal);
      }
    }
  }
  std::sort(planes_at.begin(), planes_at.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? detail::before(a.first, b.first) : a.second < b.second;
  });
  planes_at.erase(std::unique(planes_at.begin(), planes_at.end()), planes_at.end());
  std::vector<VoxelIndex> corners;
  for (auto at = planes_at.begin(); at != planes_at.end();) {
    const auto next = std::find_if(at, planes_at.end(), [&](const auto& other) { return other.first != at->first; });
    if (next - at >= 3) {
      corners.push_back(at->first);
    }
    at = next;
  }
  return corners;
}

}  // namespace vantage
