// SPDX-License-Identifier: MIT
// The beams in which rays of a view go together: that they hold them.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <raytrace/slice_beam.hpp>
#include <tuple>
#include <vantage/raytrace/view_rays.hpp>
#include <vector>

namespace vantage {
namespace {

// Some look all around, and some have neighbours that are none.
ViewRays image_of_any_kind(std::mt19937& engine) {
  std::uniform_real_distribution<double> angle(0.05, 2.5);
  const std::size_t width = 1 + engine() % 60;
  const std::size_t height = 1 + engine() % 40;
  switch (engine() % 3) {
    case 0:
      return ViewRays(RangeSensor::spherical(width, height, 2.5 * angle(engine), angle(engine), 0.0, 5.0));
    case 1: {
      std::normal_distribution<float> normal;
      std::vector<Eigen::Vector3f> directions(width * height);
      for (Eigen::Vector3f& direction : directions) {
        direction = {normal(engine), normal(engine), normal(engine) + 0.001F};
      }
      return {directions, width, height, 5.0};
    }
    default:
      return ViewRays(RangeSensor::pinhole(width, height, angle(engine), angle(engine), 0.0, 5.0));
  }
}

// Every ray of a tile must lie on the inner side of the four planes through the origin and two corners of its hull.
TEST(ViewBeams, RaysOfATileLieBetweenItsCorners) {
  std::mt19937 engine(37);
  std::size_t within = 0;
  std::size_t without = 0;
  for (int image = 0; image < 100; ++image) {
    const ViewRays rays = image_of_any_kind(engine);
    for (std::size_t g = 0; g < rays.groups().size(); ++g) {
      const TileGroup& group = rays.groups()[g];
      for (std::size_t n = group.first; n < group.last; ++n) {
        std::array<Eigen::Vector3d, 4> around;
        for (std::size_t k = 0; k < 4; ++k) {
          for (std::size_t axis = 0; axis < 3; ++axis) {
            constexpr std::array<std::size_t, 4> kInTurn{0, 1, 3, 2};
            const std::size_t place = TileHulls::kTiles * kInTurn[k] + n - group.first;
            around[k][static_cast<Eigen::Index>(axis)] = rays.hulls()[g].corners[axis][place];
          }
        }
        if (around[0].isZero()) {
          ++without;
          continue;
        }
        for (std::size_t k = 0; k < 4; ++k) {
          const Eigen::Vector3d inwards = around[k].cross(around[(k + 1) % 4]);
          for (std::size_t i = 0; i < RayTile::kRays; ++i) {
            ASSERT_GE(inwards.dot(rays.tiles()[n].direction(i).cast<double>()), 0.0);
            ++within;
          }
        }
      }
    }
  }
  EXPECT_GT(within, 10'000U);
  EXPECT_GT(without, 100U);
}

TEST(ViewBeams, LayersOfABeamAreThoseOfItsSlices) {
  std::mt19937 engine(38);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 3'000; ++i) {
    const VoxelFrame frame{0.1};
    SliceBeam beam(frame, {20.0 * unit(engine), 20.0 * unit(engine), 20.0 * unit(engine)}, engine() % 3,
                   engine() % 2 == 0);
    for (std::size_t lateral = 0; lateral < 2; ++lateral) {
      std::tie(beam.least[lateral], beam.most[lateral]) = std::minmax({unit(engine), unit(engine)});
    }
    const auto from = static_cast<std::int64_t>(1 + engine() % 500);
    for (const InstructionSet set : instruction_sets()) {
      const LateralLayers layers = beam.layers_from(from, set);
      std::int64_t slice = from;
      for (std::size_t k = 0; k < LateralLayers::kLayers; ++k) {
        const std::int64_t next = slice + beam.left_in_layer(slice);
        const LateralCells expected = beam.cells_in(slice, next - 1);
        ASSERT_EQ(layers[k].lo, expected.lo);
        ASSERT_EQ(layers[k].hi, expected.hi);
        slice = next;
      }
    }
  }
}

}  // namespace
}  // namespace vantage
