// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <limits>
#include <random>
#include <vantage/map/occupancy_map.hpp>
#include <vector>

#include "support/equal_maps.hpp"
#include "support/random_maps.hpp"

namespace vantage {
namespace {

// The points as a driver leaves them: `stride` bytes apart, the first one at `offset`, other bytes are noise.
std::vector<std::byte> as_message(const std::vector<Eigen::Vector3f>& points, std::size_t stride, std::size_t offset,
                                  std::mt19937& engine) {
  std::vector<std::byte> bytes(offset + stride * points.size() + 1);
  for (std::byte& byte : bytes) {
    byte = static_cast<std::byte>(engine() & 0xFFU);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::memcpy(&bytes[offset + i * stride], points[i].data(), PointsView::kBytes);
  }
  return bytes;
}

Scan random_organised_scan(std::mt19937& engine) {
  Scan scan = test::random_scan(engine, 30);
  scan.points.clear();
  scan.width = 20 + engine() % 20;
  scan.height = 10 + engine() % 20;
  for (std::size_t i = 0; i < scan.width * scan.height; ++i) {
    const auto column = static_cast<float>(i % scan.width);
    const auto row = static_cast<float>(i / scan.width);
    scan.points.emplace_back(0.05F * column - 0.7F, 0.05F * row - 0.5F,
                             1.5F + 0.001F * static_cast<float>(engine() % 99));
  }
  return scan;
}

void expect_equal_reports(const ScanReport& a, const ScanReport& b) {
  static_assert(sizeof(ScanReport) == 10 * sizeof(std::size_t), "compares every counter");
  EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0);
}

TEST(ScanView, IsInsertedBitForBitAsItsCopy) {
  std::mt19937 engine(41);
  std::size_t compared = 0;
  std::size_t not_finite = 0;
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  for (int world = 0; world < 120; ++world) {
    OccupancyMap copied;
    OccupancyMap in_place;
    for (int step = 0; step < 4; ++step) {
      Scan scan = (world + step) % 2 == 0 ? test::random_scan(engine, 150) : random_organised_scan(engine);
      for (std::size_t i = engine() % 30; i < scan.points.size(); i += 37) {
        scan.points[i][static_cast<Eigen::Index>(engine() % 3)] = kNan;
      }
      const std::size_t stride = std::vector<std::size_t>{12, 16, 32, 13, 24}[engine() % 5];
      const std::size_t offset = engine() % 9;
      const std::vector<std::byte> message = as_message(scan.points, stride, offset, engine);
      const ScanView view{.world_from_sensor = scan.world_from_sensor,
                          .points = PointsView(&message[offset], scan.points.size(), stride),
                          .no_return = PointsView(scan.no_return),
                          .max_range_m = scan.max_range_m,
                          .width = scan.width,
                          .height = scan.height};
      ASSERT_EQ(view.organised(), scan.organised());
      const auto policy = static_cast<RayPolicy>(engine() % 2);
      const ScanReport report = copied.insert(scan, policy);
      expect_equal_reports(in_place.insert(view, policy), report);
      test::expect_equal_maps(in_place, copied);
      const Scan again = Scan::from_points(view.points, view.world_from_sensor);
      ASSERT_EQ(again.points.size(), scan.points.size());
      for (std::size_t i = 0; i < scan.points.size(); ++i) {
        ASSERT_EQ(std::memcmp(again.points[i].data(), scan.points[i].data(), PointsView::kBytes), 0);
      }
      not_finite += report.not_finite;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 480U);
  EXPECT_GT(not_finite, 2000U);
}

TEST(PointsView, RefusesWhatCannotBePoints) {
  const float xyz[3] = {1.0F, 2.0F, 3.0F};
  EXPECT_EQ(PointsView(xyz, 1, 12)[0], Eigen::Vector3f(1.0F, 2.0F, 3.0F));
  EXPECT_THROW(PointsView(xyz, 1, 11), std::invalid_argument);
  EXPECT_THROW(PointsView(nullptr, 1, 12), std::invalid_argument);
  EXPECT_EQ(PointsView(nullptr, 0, 12).size(), 0U);
  EXPECT_EQ(OccupancyMap().insert(ScanView{}).hits, 0U);
}

}  // namespace
}  // namespace vantage
