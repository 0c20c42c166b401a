// SPDX-License-Identifier: MIT
// Insertion against its definition, cell by cell, where shortcuts could fail: dense depth images in which most rays
// add nothing, unorganised scans, and rays exactly through edges and corners of cells.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/compare_with_definition.hpp"

namespace vantage {
namespace {

double uniform(std::mt19937& engine, double lo, double hi) {
  return std::uniform_real_distribution<double>(lo, hi)(engine);
}

// The intersection of rays from `eye` with a closed room that contains a few boxes.
struct Room {
  explicit Room(std::mt19937& engine) {
    for (Box& box : boxes) {
      const Eigen::Vector3d lo(uniform(engine, -2, 1.5), uniform(engine, -2, 1.5), uniform(engine, 0, 1.5));
      box = {lo,
             lo + Eigen::Vector3d(uniform(engine, 0.1, 0.8), uniform(engine, 0.1, 0.8), uniform(engine, 0.1, 0.8))};
    }
  }
  [[nodiscard]] double distance(const Eigen::Vector3d& eye, const Eigen::Vector3d& direction) const {
    const auto slab = [&](const Box& box) {
      const Eigen::Array3d a = (box.min - eye).array() / direction.array();
      const Eigen::Array3d b = (box.max - eye).array() / direction.array();
      return std::pair(a.min(b).maxCoeff(), a.max(b).minCoeff());
    };
    double nearest = slab({{-2.5, -2.5, 0}, {2.5, 2.5, 2.4}}).second;
    for (const Box& box : boxes) {
      const auto [enter, leave] = slab(box);
      nearest = enter > 0.1 && enter <= leave ? std::min(nearest, enter) : nearest;
    }
    return nearest;
  }
  std::array<Box, 5> boxes;
};

enum class Kind { Pinhole, Spherical, Shuffled };

// An image of a random room with noise, holes and rays without return. In a shuffled one, neighbours are unrelated.
Scan random_image(std::mt19937& engine, Kind kind, std::size_t width, std::size_t height, const Room& room) {
  Scan scan;
  scan.width = width;
  scan.height = height;
  const Eigen::Vector3d eye(uniform(engine, -2, 2), uniform(engine, -2, 2), uniform(engine, 0.3, 2));
  scan.world_from_sensor = pose_looking(eye, uniform(engine, -3.1, 3.1), uniform(engine, -1, 1));
  const double noise_m = uniform(engine, 0, 1) < 0.5 ? 0.0 : 0.01;
  const double holes = uniform(engine, 0, 1) < 0.5 ? 0.0 : 0.1;
  for (std::size_t i = 0; i < width * height; ++i) {
    const double u = (static_cast<double>(i % width) + 0.5) / static_cast<double>(width) - 0.5;
    const double v = (static_cast<double>(i / width) + 0.5) / static_cast<double>(height) - 0.5;
    const Eigen::Vector3d direction = kind == Kind::Spherical
                                          ? Eigen::Vector3d(std::sin(6.28 * u) * std::cos(2 * v), std::sin(2 * v),
                                                            std::cos(6.28 * u) * std::cos(2 * v))
                                          : Eigen::Vector3d(1.2 * u, 0.9 * v, 1.0).normalized();
    const double range_m =
        room.distance(eye, scan.world_from_sensor.linear() * direction) + noise_m * uniform(engine, -1, 1);
    const bool is_hole = uniform(engine, 0, 1) < holes;
    scan.points.push_back(is_hole ? Eigen::Vector3f::Constant(NAN)
                                  : Eigen::Vector3f((direction * range_m).cast<float>()));
    if (is_hole && i % 2 == 0) {
      scan.no_return.push_back(direction.cast<float>());
    }
  }
  if (kind == Kind::Shuffled) {
    std::shuffle(scan.points.begin(), scan.points.end(), engine);
  }
  if (uniform(engine, 0, 1) < 0.5 || !scan.no_return.empty()) {
    scan.max_range_m = uniform(engine, 1.0, 4.0);
  }
  return scan;
}

std::size_t compare_images(Kind kind, std::uint32_t seed, int images) {
  std::mt19937 engine(seed);
  std::size_t cells = 0;
  for (int i = 0; i < images; ++i) {
    const auto width = static_cast<std::size_t>(uniform(engine, 5, 170));
    const auto height = static_cast<std::size_t>(uniform(engine, 5, 130));
    const Scan scan = random_image(engine, kind, width, height, Room(engine));
    EXPECT_TRUE(scan.organised());
    OccupancyMapOptions options{.resolution_m = std::exp(uniform(engine, std::log(0.02), std::log(0.5)))};
    cells += test::compare_with_definition(scan, options, RayPolicy::EveryReturn);
    cells += test::compare_with_definition(scan, options, RayPolicy::EachEndCell);
    options.region = Box{{-1.0, -2.0, 0.2}, {1.5, 0.7, 1.9}};
    cells += test::compare_with_definition(scan, options, RayPolicy::EveryReturn);
  }
  return cells;
}

TEST(ScanCells, OfDepthImages) { EXPECT_GT(compare_images(Kind::Pinhole, 11, 40), 500'000U); }

TEST(ScanCells, OfSphericalImages) { EXPECT_GT(compare_images(Kind::Spherical, 12, 12), 500'000U); }

TEST(ScanCells, OfImagesThatAreNone) { EXPECT_GT(compare_images(Kind::Shuffled, 13, 20), 500'000U); }

// Rays from corners or centres of cells to lattice points, so that ties decide everything. Either to random points,
// or to steps of walls that are dense enough for most rays to be inserted in part.
Scan lattice_scan(std::mt19937& engine, double resolution_m, double offset, bool anywhere) {
  std::uniform_int_distribution<int> coordinate(-25, 25);
  const auto lattice = [&](double x, double y, double z) {
    return Eigen::Vector3d(Eigen::Vector3d(x + offset, y + offset, z + offset) * resolution_m);
  };
  Scan scan;
  const Eigen::Vector3d eye = lattice(coordinate(engine), coordinate(engine), coordinate(engine));
  scan.world_from_sensor.translation() = eye;
  scan.width = 64;
  scan.height = 48;
  const int depth = coordinate(engine);
  const int step = coordinate(engine) / 8;
  for (int row = 0; row < 48; ++row) {
    for (int column = 0; column < 64; ++column) {
      const Eigen::Vector3d end =
          anywhere ? lattice(coordinate(engine), coordinate(engine), coordinate(engine))
                   : lattice(0.125 * column - 4.0, 0.125 * row - 3.0, depth + (column / 5 + row / 7) % 4 * step);
      scan.points.push_back((end - eye).cast<float>());
    }
  }
  return scan;
}

TEST(ScanCells, OfRaysThroughEdgesAndCorners) {
  std::mt19937 engine(14);
  std::size_t cells = 0;
  for (const double resolution_m : {0.05, 0.1, 0.25, 0.3}) {
    for (int world = 0; world < 60; ++world) {
      const Scan scan = lattice_scan(engine, resolution_m, world % 2 == 0 ? 0.5 : 0.0, world % 4 == 0);
      for (const RayPolicy policy : {RayPolicy::EveryReturn, RayPolicy::EachEndCell}) {
        cells += test::compare_with_definition(scan, {.resolution_m = resolution_m}, policy);
      }
    }
  }
  EXPECT_GT(cells, 500'000U);
}

// Inserts the scan and expects all log-odds to change as defined. Returns the number of cells kept by
// keep_grazed_cells.
std::size_t insert_beside_definition(const Scan& scan, RayPolicy policy, OccupancyMap& map) {
  OccupancyMapOptions of_octomap = map.options();
  of_octomap.keep_grazed_cells = false;
  const std::size_t would_clear = scan_cells(scan, OccupancyMap(of_octomap), policy).cleared.size();
  const ScanCells expected = scan_cells(scan, map, policy);
  const OccupancyMap before = map;
  EXPECT_EQ(map.insert(scan, policy).cells_cleared, expected.cleared.size());
  std::size_t wrong = 0;
  map.for_each_known([&](const VoxelIndex& cell, Occupancy) {
    const double moved = expected.hit.contains(cell) ? 0.85 : expected.cleared.contains(cell) ? -0.4 : 0.0;
    const double log_odds = std::clamp(before.log_odds(cell).value_or(0.0) + moved, -2.0, 3.5);
    wrong += std::abs(map.log_odds(cell).value() - log_odds) < 1e-9 ? 0U : 1U;
  });
  EXPECT_EQ(wrong, 0U);
  return would_clear - expected.cleared.size();
}

TEST(ScanCells, OfRaysThatGraze) {
  std::mt19937 engine(15);
  std::size_t spared = 0;
  for (int world = 0; world < 9; ++world) {
    const Room room(engine);
    const Kind kind = world % 3 == 0 ? Kind::Pinhole : world % 3 == 1 ? Kind::Spherical : Kind::Shuffled;
    const RayPolicy policy = world % 2 == 0 ? RayPolicy::EveryReturn : RayPolicy::EachEndCell;
    OccupancyMapOptions options{.resolution_m = uniform(engine, 0.05, 0.3), .keep_grazed_cells = true};
    options.erase_range_m = world % 2 == 0 ? uniform(engine, 0.3, 2.0) : options.erase_range_m;
    if (world % 4 == 3) {
      options.region = Box{{-1.0, -2.0, 0.2}, {1.5, 0.7, 1.9}};
    }
    OccupancyMap map(options);
    for (int scan = 0; scan < 12; ++scan) {
      spared += insert_beside_definition(random_image(engine, kind, 64, 48, room), policy, map);
    }
  }
  EXPECT_GT(spared, 1'000U);
}

// A sensor moves along a known wall. Returns the maximum number of wall cells that were free at once.
std::size_t worn_cells(bool keep_grazed_cells) {
  OccupancyMap map({.resolution_m = 0.1, .keep_grazed_cells = keep_grazed_cells});
  for (std::int32_t x = -5; x < 80; ++x) {
    map.set(VoxelIndex{x, 10, 0}, Occupancy::Occupied);
  }
  std::size_t worn = 0;
  constexpr double kWallM = 1.09;  // near the far side of its cells
  for (int step = 0; step < 400; ++step) {
    Scan scan;
    scan.world_from_sensor.translation() = Eigen::Vector3d(0.017 * step, 0.6, 0.05);
    for (double angle = 0.1; angle < 3.0; angle += 0.02) {
      const double range_m = (kWallM - 0.6) / std::sin(angle);
      const Eigen::Vector3d end =
          scan.world_from_sensor.translation() + range_m * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0);
      if (end.x() > -0.4 && end.x() < 7.9) {
        scan.points.emplace_back((scan.world_from_sensor.inverse() * end).cast<float>());
      }
    }
    map.insert(scan);
    for (std::int32_t x = -5, free = 0; x < 80; ++x) {
      free += map.at({x, 10, 0}) == Occupancy::Free ? 1 : 0;
      worn = std::max(worn, static_cast<std::size_t>(free));
    }
  }
  return worn;
}

TEST(ScanCells, GrazingRaysWearAWallAwayUnlessItsCellsAreKept) {
  EXPECT_GT(worn_cells(false), 5U);
  EXPECT_EQ(worn_cells(true), 0U);
}

TEST(ScanCells, AnImageWhoseSidesOverflowIsNone) {
  Scan scan;
  scan.points.assign(16, Eigen::Vector3f(0.0F, 0.0F, 1.0F));
  scan.width = std::size_t{1} << 62U;
  scan.height = 4;  // the product is 0 in 64 bits
  EXPECT_FALSE(scan.organised());
  scan.width = (std::size_t{1} << 63U) + 4;
  scan.height = 4;  // the product is 16 in 64 bits
  EXPECT_FALSE(scan.organised());
  EXPECT_GT(test::compare_with_definition(scan, {.resolution_m = 0.1}, RayPolicy::EveryReturn), 5U);
}

}  // namespace
}  // namespace vantage
