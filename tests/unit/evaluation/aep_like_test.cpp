// SPDX-License-Identifier: MIT
#include "evaluation/aep_like.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace vantage {
namespace {

using detail::KeptColumns;
using detail::UnknownVolume;

RangeSensor short_sighted() { return RangeSensor::pinhole(40, 30, 1.6, 1.2, 0.0, 1.5); }

TEST(AepLike, GainsThatAreKeptAreThoseOfTheMapAsItIs) {
  std::mt19937 engine(1);
  OccupancyMap map({.resolution_m = 0.1, .region = Box{{0.0, 0.0, 0.0}, {8.0, 8.0, 2.0}}});
  KeptColumns kept;
  std::size_t computed = 0;
  std::size_t asked = 0;
  const auto draw = [&](std::int32_t below) {
    return static_cast<std::int32_t>(engine() % static_cast<unsigned>(below));
  };
  for (int round = 0; round < 60; ++round) {
    const VoxelIndex corner{draw(76), draw(76), draw(16)};
    for_each_cell(VoxelBox{corner, corner + VoxelIndex{4, 4, 4}}, [&](const VoxelIndex& cell) {
      map.set(cell, engine() % 8 == 0 ? Occupancy::Occupied : Occupancy::Free);
    });
    const UnknownVolume volume(map, short_sighted());
    kept.follow(map, volume.range_m());
    std::uint64_t operations = 0;
    for (int i = 0; i < 40; ++i, ++asked) {
      const VoxelIndex place{draw(8) * 10 + 5, draw(8) * 10 + 5, 10};
      const auto now = [&] { return volume.columns(map.frame().centre_of(place), operations); };
      const std::vector<double>& columns = kept.at(place, [&] {
        ++computed;
        return now();
      });
      EXPECT_EQ(columns, now());
    }
  }
  EXPECT_EQ(asked, 2400U);
  EXPECT_LT(computed, asked / 2);
}

TEST(AepLike, UnknownSpaceIsSeenUpToTheNextSurface) {
  OccupancyMap map({.resolution_m = 0.1, .region = Box{{-4.0, -4.0, -4.0}, {4.0, 4.0, 4.0}}});
  std::uint64_t operations = 0;
  const UnknownVolume volume(map, short_sighted());
  const Eigen::Vector3d here = Eigen::Vector3d::Zero();
  const std::vector<double> all = volume.columns(here, operations);
  for (std::size_t yaw = 0; yaw < UnknownVolume::kColumns; ++yaw) {
    EXPECT_NEAR(volume.in_view(all, yaw), volume.most(), 1e-9);
  }
  // The part of a ball of 1.5 m that is in view, by its angles.
  const double share = 1.6 * 2 * std::sin(0.6);
  EXPECT_NEAR(volume.most(), share * std::pow(1.5, 3) / 3.0, 0.05 * volume.most());
  for_each_cell(VoxelBox{{5, -40, -40}, {6, 40, 40}},
                [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Occupied); });
  const std::vector<double> walled = volume.columns(here, operations);
  // Its rays towards the wall are between 0.5 m and, aslant, 0.6 m long.
  EXPECT_GT(walled[0], all[0] * std::pow(0.5 / 1.5, 3));
  EXPECT_LT(walled[0], all[0] * std::pow(0.6 / 1.5, 3));
  EXPECT_EQ(walled[18], all[18]);  // away from it
}

}  // namespace
}  // namespace vantage
