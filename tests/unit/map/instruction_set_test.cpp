// SPDX-License-Identifier: MIT
// Every instruction set of this processor gives the same bits as plain C++.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/map/impl/ray_block.hpp>
#include <vantage/map/impl/ray_lanes.hpp>
#include <vector>

namespace vantage {
namespace {

using detail::best_instruction_set;
using detail::best_instruction_set_within;
using detail::instruction_sets;
using detail::InstructionSet;
using detail::RayBlock;
using detail::RayLanes;
using detail::RayPlacer;
using detail::SensorFrame;

TEST(InstructionSet, PlainCodeComesFirst) {
  ASSERT_FALSE(instruction_sets().empty());
  EXPECT_EQ(instruction_sets().front(), InstructionSet::Baseline);
  EXPECT_EQ(instruction_sets().back(), best_instruction_set());
}

TEST(InstructionSet, MayBeLimitedToOneThatHasAName) {
  EXPECT_EQ(best_instruction_set_within(""), instruction_sets().back());
  EXPECT_EQ(best_instruction_set_within("avx512"), instruction_sets().back());
  EXPECT_EQ(best_instruction_set_within("avx2"), std::min(InstructionSet::Avx2, instruction_sets().back()));
  EXPECT_EQ(best_instruction_set_within("baseline"), InstructionSet::Baseline);
  for (const char* const name : {"sse", "AVX2", "avx", "avx512 "}) {
    try {
      (void)best_instruction_set_within(name);
      ADD_FAILURE() << name;
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(error.what(),
                "VANTAGE_INSTRUCTION_SET is " + std::string(name) + ", must be baseline, avx2 or avx512");
    }
  }
}

// Eight rays in a window of 512 cells per edge, with plain coordinates as positions.
RayLanes random_lanes(std::mt19937& engine) {
  RayLanes lanes;
  std::uniform_int_distribution<std::int64_t> time(0, FaceCrossings::kEnd);
  std::uniform_int_distribution<std::int32_t> coordinate(0, 511);
  lanes.mask = {0x1FF, 0x1FF << 9, 0x1FF << 18};
  for (std::size_t lane = 0; lane < RayLanes::kLanes; ++lane) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int64_t one = std::int64_t{1} << 9 * axis;
      const bool up = coordinate(engine) % 2 == 0;
      lanes.at[axis][lane] = coordinate(engine) * one;
      lanes.step[axis][lane] = up ? ~lanes.mask[axis] + one : -one;
      lanes.next[axis][lane] = time(engine) >> coordinate(engine) % 60;  // with ties
      lanes.delta[axis][lane] = time(engine) >> (coordinate(engine) % 50 + 10);
    }
  }
  return lanes;
}

TEST(InstructionSet, LanesWalkAlike) {
  std::mt19937 engine(21);
  const std::size_t words = (std::size_t{1} << 27U) / 64;
  std::size_t rays = 0;
  std::size_t marks = 0;
  for (const InstructionSet set : instruction_sets()) {
    std::vector<std::uint64_t> expected(words);
    std::vector<std::uint64_t> plane(words);
    for (int i = 0; i < 4000; ++i) {
      RayLanes plain = random_lanes(engine);
      RayLanes lanes = plain;
      const std::int64_t steps = i % 90;
      plain.walk(steps, expected.data(), InstructionSet::Baseline);
      lanes.walk(steps, plane.data(), set);
      EXPECT_EQ(lanes.next, plain.next);
      EXPECT_EQ(lanes.at, plain.at);
      rays += RayLanes::kLanes;
    }
    EXPECT_EQ(plane, expected);
    for (const std::uint64_t word : expected) {
      marks += static_cast<std::size_t>(std::popcount(word));
    }
  }
  EXPECT_EQ(rays, 32'000U * instruction_sets().size());
  EXPECT_GT(marks, 1'000'000U * instruction_sets().size());
}

// Coordinates of all magnitudes, on and off the lattice, including non-finite ones.
float random_coordinate(std::mt19937& engine) {
  std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
  constexpr float kInf = std::numeric_limits<float>::infinity();
  switch (engine() % 16) {
    case 0:
      return std::ldexp(unit(engine), static_cast<int>(engine() % 250) - 125);
    case 1:
      return 0.0F;
    case 2:
      return engine() % 8 == 0 ? kInf : std::round(20 * unit(engine)) * 0.25F;
    case 3:
      return engine() % 8 == 0 ? std::numeric_limits<float>::quiet_NaN() : 4 * unit(engine);
    default:
      return 8 * unit(engine);
  }
}

bool same_bits(const RayBlock& a, const RayBlock& b) {
  return std::memcmp(a.end.data(), b.end.data(), sizeof(a.end)) == 0 && a.fate == b.fate && a.cell == b.cell;
}

TEST(InstructionSet, PointsArePlacedAlike) {
  std::mt19937 engine(22);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::size_t blocks = 0;
  std::array<std::size_t, 6> fates{};
  for (const InstructionSet set : instruction_sets()) {
    for (int i = 0; i < 3000; ++i) {
      const Eigen::Quaterniond rotation(unit(engine), unit(engine), unit(engine), unit(engine));
      const Pose pose = Eigen::Translation3d(unit(engine), unit(engine), unit(engine)) *
                        (i % 10 == 0 ? Eigen::Quaterniond::Identity() : rotation.normalized());
      const double size_m = i % 3 == 0 ? 0.25 : 0.1 + 0.05 * unit(engine);
      const double range_m = i % 2 == 0 ? std::numeric_limits<double>::infinity() : 4.0 + unit(engine);
      const RayPlacer placer{SensorFrame(pose), range_m, size_m * kFurthestVoxel, size_m};
      RayBlock plain;
      for (float& coordinate : plain.point) {
        coordinate = random_coordinate(engine);
      }
      RayBlock block = plain;
      const bool are_returns = i % 5 != 0;
      placer.place_ends(are_returns, plain, InstructionSet::Baseline);
      placer.place_cells(plain, InstructionSet::Baseline);
      placer.place_ends(are_returns, block, set);
      placer.place_cells(block, set);
      EXPECT_TRUE(same_bits(block, plain)) << "block " << i;
      const VoxelFrame frame{size_m};
      for (std::size_t ray = 0; ray < RayBlock::kRays; ++ray) {
        ++fates[static_cast<std::size_t>(plain.fate[ray])];
        const VoxelIndex cell = frame.cell_of({plain.end[0][ray], plain.end[1][ray], plain.end[2][ray]});
        EXPECT_EQ(cell, (VoxelIndex{plain.cell[0][ray], plain.cell[1][ray], plain.cell[2][ray]}));
      }
      ++blocks;
    }
  }
  EXPECT_EQ(blocks, 3000U * instruction_sets().size());
  for (const std::size_t rays : fates) {
    EXPECT_GT(rays, 10U);
  }
}

}  // namespace
}  // namespace vantage
