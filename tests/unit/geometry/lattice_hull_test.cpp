// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <tuple>
#include <vantage/geometry/lattice_hull.hpp>

#include "support/qhull.hpp"

namespace vantage {
namespace {

// Clouds as they occur in maps: walls in one plane, edges of many cells, scattered cells and distant cells.
std::vector<VoxelIndex> cloud(int kind, std::mt19937& engine) {
  std::uniform_int_distribution<std::int32_t> near(-9, 9);
  std::uniform_int_distribution<std::int32_t> far(-4'000, 4'000);
  std::vector<VoxelIndex> cells;
  for (int i = 0; i < 60; ++i) {
    switch (kind % 4) {
      case 0:  // on the sides of a box
        cells.push_back({near(engine), near(engine), (i % 2) * 12});
        break;
      case 1:  // scattered
        cells.push_back({near(engine), near(engine), near(engine)});
        break;
      case 2:  // on a few parallel lines
        cells.push_back({near(engine), i % 3 * 5, i % 2 * 7});
        break;
      default:
        cells.push_back({far(engine), far(engine), far(engine)});
    }
  }
  return cells;
}

// Expects each plane of one hull to be a plane of the other.
void expect_same_planes(const LatticeHull& ours, const test::QhullHull& theirs) {
  for (const LatticeHull::Plane& exact : ours.planes()) {
    const HullPlane plane = exact.plane();
    EXPECT_TRUE(std::any_of(theirs.planes().begin(), theirs.planes().end(), [&](const HullPlane& other) {
      return (plane.normal - other.normal).norm() < 1e-9 && std::abs(plane.offset - other.offset) < 1e-6;
    }));
  }
  for (const HullPlane& plane : theirs.planes()) {
    const std::vector<LatticeHull::Plane> planes = ours.planes();
    EXPECT_TRUE(std::any_of(planes.begin(), planes.end(), [&](const LatticeHull::Plane& exact) {
      return (exact.plane().normal - plane.normal).norm() < 1e-9;
    }));
  }
}

// Compares planes and corners with Qhull.
TEST(LatticeHull, HasThePlanesThatQhullFinds) {
  std::mt19937 engine(5);
  std::size_t compared = 0;
  for (int world = 0; world < 200; ++world) {
    const std::vector<VoxelIndex> cells = cloud(world, engine);
    const LatticeHull hull(cells);
    const test::QhullHull qhull(cells);
    ASSERT_EQ(hull.empty(), qhull.empty()) << "world " << world;
    expect_same_planes(hull, qhull);
    for (const VoxelIndex& corner : hull.corners()) {
      EXPECT_TRUE(std::find(qhull.corners().begin(), qhull.corners().end(), corner) != qhull.corners().end());
    }
    ++compared;
  }
  EXPECT_EQ(compared, 200U);
}

// Six times the volume of the tetrahedron of four points, with sign.
std::int64_t volume(const VoxelIndex& a, const VoxelIndex& b, const VoxelIndex& c, const VoxelIndex& d) {
  const auto wide = [&](const VoxelIndex& p) { return std::array<std::int64_t, 3>{p.x - a.x, p.y - a.y, p.z - a.z}; };
  const auto [u, v, w] = std::tuple(wide(b), wide(c), wide(d));
  return u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
}

// Independent definition of a hull: it contains a point exactly if one of the tetrahedra of its points does
// (Caratheodory). A tetrahedron contains a point if no corner can be replaced by it with a change of orientation.
bool in_some_tetrahedron(const std::vector<VoxelIndex>& points, const VoxelIndex& p) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      for (std::size_t k = j + 1; k < points.size(); ++k) {
        for (std::size_t l = k + 1; l < points.size(); ++l) {
          const VoxelIndex &a = points[i], &b = points[j], &c = points[k], &d = points[l];
          const std::int64_t whole = volume(a, b, c, d);
          const std::int64_t sign = whole > 0 ? 1 : -1;
          if (whole != 0 && sign * volume(p, b, c, d) >= 0 && sign * volume(a, p, c, d) >= 0 &&
              sign * volume(a, b, p, d) >= 0 && sign * volume(a, b, c, p) >= 0) {
            return true;
          }
        }
      }
    }
  }
  return false;
}

TEST(LatticeHull, HoldsWhatSomeTetrahedronOfItsPointsHolds) {
  std::mt19937 engine(21);
  std::uniform_int_distribution<std::int32_t> coordinate(-6, 6);
  const auto draw = [&] { return VoxelIndex{coordinate(engine), coordinate(engine), coordinate(engine)}; };
  std::size_t compared = 0;
  std::size_t inside = 0;
  for (int world = 0; world < 120; ++world) {
    std::vector<VoxelIndex> points;
    for (int i = 0; i < 4 + world % 9; ++i) {
      points.push_back(draw());
    }
    const LatticeHull hull(points);
    for (int probe = 0; probe < 60; ++probe) {
      const VoxelIndex point = draw();
      const bool expected = in_some_tetrahedron(points, point);
      ASSERT_EQ(hull.contains(point), expected);
      inside += expected ? 1U : 0U;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 7200U);
  EXPECT_GT(inside, 600U);
}

// Growing in any order gives the hull of all points, and the hull of its corners is the same.
TEST(LatticeHull, GrowsToTheHullOfAll) {
  std::mt19937 engine(6);
  std::size_t compared = 0;
  for (int world = 0; world < 60; ++world) {
    LatticeHull grown;
    std::vector<VoxelIndex> all;
    for (int step = 0; step < 5; ++step) {
      const std::vector<VoxelIndex> cells = cloud(world + (step > 2 ? 1 : 0), engine);
      all.insert(all.end(), cells.begin(), cells.end());
      const bool was_empty = grown.empty();
      grown.insert(was_empty ? all : cells);
      std::shuffle(all.begin(), all.end(), engine);
      const LatticeHull anew(all);
      ASSERT_EQ(grown.planes(), anew.planes()) << "world " << world << ", step " << step;
      ASSERT_EQ(grown.corners(), anew.corners());
      ASSERT_EQ(LatticeHull(grown.corners()).planes(), grown.planes());
      for (const VoxelIndex& cell : all) {
        ASSERT_TRUE(grown.empty() || grown.contains(cell));
      }
      ++compared;
    }
  }
  EXPECT_EQ(compared, 300U);
}

TEST(LatticeHull, AWallOfCellsHasFourCorners) {
  std::vector<VoxelIndex> cells;
  for_each_cell({{0, 0, 0}, {9, 9, 1}}, [&](const VoxelIndex& cell) { cells.push_back(cell); });
  LatticeHull hull(cells);
  EXPECT_TRUE(hull.empty());
  EXPECT_FALSE(hull.contains({4, 4, 0}));
  cells.push_back({4, 4, 6});
  hull.insert(cells);
  EXPECT_EQ(hull.corners(), (std::vector<VoxelIndex>{{0, 0, 0}, {0, 8, 0}, {4, 4, 6}, {8, 0, 0}, {8, 8, 0}}));
  EXPECT_EQ(hull.planes().size(), 5U);
  EXPECT_TRUE(hull.contains({4, 4, 0}));
  EXPECT_FALSE(hull.contains({4, 4, -1}));
}

// Normals of this size do not fit 32 bits, distances do not fit 64.
TEST(LatticeHull, IsExactAtTheEndsOfTheMap) {
  constexpr std::int32_t kFar = kFurthestVoxel;
  const LatticeHull hull(std::vector<VoxelIndex>{
      {-kFar, -kFar, kFar}, {kFar, -kFar, -kFar}, {-kFar, kFar, -kFar}, {kFar, kFar, kFar}, {1, 2, 3}});
  EXPECT_EQ(hull.corners().size(), 4U);
  EXPECT_TRUE(hull.contains({0, 0, kFar}));  // on the edge between two corners
  EXPECT_FALSE(hull.contains({1, 0, kFar}));
  EXPECT_TRUE(hull.contains({0, 0, kFar - 1}));
}

}  // namespace
}  // namespace vantage
