// SPDX-License-Identifier: MIT
// Beams group the rays of a view: they must contain their rays, and floods must reach all cells that the rays hit.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <set>
#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/map/impl/slice_beam.hpp>
#include <vantage/raytrace/impl/slice_flood.hpp>
#include <vantage/raytrace/view_rays.hpp>
#include <vector>

namespace vantage {
namespace {

using detail::instruction_sets;
using detail::InstructionSet;
using detail::LateralCells;
using detail::SliceAxes;
using detail::SliceBeam;
using detail::SliceFlood;
using detail::SliceWindows;
using detail::WindowCells;

// Images of panoramic sensors and pinholes, some with unrelated neighbours.
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

// A beam, windows of random cells along it with gaps between them, and the result of a flood.
struct FloodCase {
  struct Passage {
    SliceWindows windows;
    std::array<WindowCells, 3> met{};  // by instruction set
  };
  static constexpr std::int64_t kLast = 40;

  explicit FloodCase(std::mt19937& engine) : beam(frame, origin_in(engine), static_cast<std::int32_t>(engine() % 6)) {
    std::uniform_real_distribution<double> slope(-0.99, 0.99);
    std::uniform_real_distribution<double> width(0.0, 0.15);
    for (std::size_t i = 0; i < 2; ++i) {
      const double middle = engine() % 4 == 0 ? 0.0 : slope(engine);
      beam.least[i] = std::max(middle - width(engine), -0.99);
      beam.most[i] = std::min(middle + width(engine), 0.99);
    }
    const unsigned density = 2 + engine() % 8;
    std::uniform_int_distribution<std::int64_t> gap(0, 2);
    for (std::int64_t slice = 4 * gap(engine); slice < kLast; slice += gap(engine)) {
      Passage& passage = passages.emplace_back();
      passage.windows.first = slice;
      passage.windows.count = 1 + engine() % SliceWindows::kMost;
      slice += static_cast<std::int64_t>(passage.windows.count);
      const LateralCells cells = beam.cells_in(passage.windows.first, slice - 1);
      passage.windows.place = {beam.axes, beam.along(passage.windows.first), cells.lo[0] & ~3, cells.lo[1] & ~3};
      fits = fits && cells.hi[0] - passage.windows.place.first_u < SliceWindows::kWidth &&
             cells.hi[1] - passage.windows.place.first_v < SliceWindows::kHeight;
      for (std::size_t k = 0; k < passage.windows.count; ++k) {
        for (std::uint32_t& row : passage.windows.rows[k]) {
          for (unsigned column = 0; column < 32; ++column) {
            row |= std::uint32_t{engine() % density == 0} << column;
          }
        }
      }
    }
  }
  static Eigen::Vector3d origin_in(std::mt19937& engine) {
    std::uniform_real_distribution<double> metre(-3.0, 3.0);
    return {metre(engine), metre(engine), metre(engine)};
  }
  [[nodiscard]] Eigen::Vector3d origin() const {
    const VoxelIndex cell = beam.axes.at(beam.first_along, beam.first[0], beam.first[1]);
    Eigen::Vector3d place(cell.x, cell.y, cell.z);
    place[static_cast<Eigen::Index>(beam.axes.major)] += beam.within_major();
    place[static_cast<Eigen::Index>(beam.axes.u)] += beam.within[0];
    place[static_cast<Eigen::Index>(beam.axes.v)] += beam.within[1];
    return frame.size_m * place;
  }
  // Number of passages that the flood reaches before it is empty.
  std::size_t flood(const VoxelBox& box, InstructionSet set) {
    SliceFlood flood(box, set);
    EXPECT_TRUE(flood.begin(beam));
    std::size_t reached = 0;
    bool any_left = true;
    for (; any_left && reached < passages.size(); ++reached) {
      Passage& passage = passages[reached];
      any_left = flood.pass(passage.windows, passage.met[static_cast<std::size_t>(set)]);
    }
    return reached;
  }

  VoxelFrame frame{0.1};
  SliceBeam beam;
  std::vector<Passage> passages;
  bool fits = true;
};

// Where a ray of these slopes is blocked: passage, slice, row and column.
struct FloodStop {
  std::size_t passage;
  std::size_t slice;
  std::size_t row;
  std::int32_t column;
  VoxelIndex cell;
};
std::optional<FloodStop> first_stop(const FloodCase& of, const std::array<double, 2>& slopes) {
  const auto axis = [](const VoxelIndex& cell, std::size_t i) { return i == 0 ? cell.x : i == 1 ? cell.y : cell.z; };
  const SliceAxes& axes = of.beam.axes;
  Eigen::Vector3d along;
  along[static_cast<Eigen::Index>(axes.major)] = axes.up ? 1.0 : -1.0;
  along[static_cast<Eigen::Index>(axes.u)] = slopes[0];
  along[static_cast<Eigen::Index>(axes.v)] = slopes[1];
  const Eigen::Vector3d from = of.origin();
  constexpr double kFar = FloodCase::kLast + 8.0;
  for (const VoxelIndex& cell : VoxelRay(of.frame, from, from + kFar * of.frame.size_m * along)) {
    const std::int64_t slice = std::abs(axis(cell, axes.major) - of.beam.first_along);
    for (std::size_t i = 0; i < of.passages.size(); ++i) {
      const FloodCase::Passage& passage = of.passages[i];
      if (slice < passage.windows.first ||
          slice >= passage.windows.first + static_cast<std::int64_t>(passage.windows.count)) {
        continue;
      }
      const auto number = static_cast<std::size_t>(slice - passage.windows.first);
      const auto row = static_cast<std::size_t>(axis(cell, axes.v) - passage.windows.place.first_v);
      const std::int32_t column = axis(cell, axes.u) - passage.windows.place.first_u;
      if ((passage.windows.rows[number].at(row) >> column & 1U) != 0) {
        return FloodStop{i, number, row, column, cell};
      }
    }
  }
  return std::nullopt;
}

TEST(ViewBeams, FloodsReachWhatRaysMeet) {
  std::mt19937 engine(39);
  std::size_t stopped = 0;
  std::size_t said = 0;
  std::size_t blocking = 0;
  std::size_t dry = 0;
  std::size_t cases = 0;
  while (cases < 2'000) {
    FloodCase of(engine);
    if (!of.fits) {
      continue;
    }
    ++cases;
    constexpr std::int32_t kFar = 1'000;
    VoxelBox box{{-kFar, -kFar, -kFar}, {kFar, kFar, kFar}};
    if (cases % 4 == 0) {  // only a part of the beam
      const VoxelIndex at = of.beam.axes.at(of.beam.along(20), of.beam.first[0], of.beam.first[1]);
      box = {at - VoxelIndex{6, 7, 9}, at + VoxelIndex{8, 5, 4}};
    }
    const std::size_t reached = of.flood(box, InstructionSet::Baseline);
    dry += reached < of.passages.size() ? 1U : 0U;
    for (const InstructionSet set : instruction_sets()) {
      ASSERT_EQ(of.flood(box, set), reached);
      for (const FloodCase::Passage& passage : of.passages) {
        ASSERT_EQ(passage.met[static_cast<std::size_t>(set)], passage.met[0]);
      }
    }
    for (const FloodCase::Passage& passage : of.passages) {
      for (std::size_t k = 0; k < passage.windows.count; ++k) {
        const std::int64_t slice = passage.windows.first + static_cast<std::int64_t>(k);
        const LateralCells cells = of.beam.cells_in(slice, slice);
        for (std::int32_t v = cells.lo[1]; v <= cells.hi[1]; ++v) {
          const auto row = static_cast<std::size_t>(v - passage.windows.place.first_v);
          for (std::int32_t u = cells.lo[0]; u <= cells.hi[0]; ++u) {
            const std::int32_t column = u - passage.windows.place.first_u;
            blocking += passage.windows.rows[k][row] >> column & 1U;
            said += passage.met[0][k][row] >> column & 1U;
          }
        }
      }
    }
    std::set<std::tuple<std::size_t, std::size_t, std::size_t, std::int32_t>> met;
    for (int ray = 0; ray < 200; ++ray) {
      std::array<double, 2> slopes{};
      for (std::size_t i = 0; i < 2; ++i) {
        slopes[i] = std::uniform_real_distribution<double>(of.beam.least[i], of.beam.most[i])(engine);
      }
      const std::optional<FloodStop> stop = first_stop(of, slopes);
      ASSERT_TRUE(stop || reached == of.passages.size());
      if (stop && box.contains(stop->cell)) {
        ASSERT_LT(stop->passage, reached);
        const std::uint32_t row = of.passages[stop->passage].met[0][stop->slice][stop->row];
        ASSERT_NE(row >> stop->column & 1U, 0U);
        met.insert({stop->passage, stop->slice, stop->row, stop->column});
      }
    }
    stopped += met.size();
  }
  EXPECT_GT(dry, cases / 4);
  EXPECT_GT(stopped, 5 * cases);
  EXPECT_LT(3 * said, blocking);  // occluded cells are not reported as met
}

}  // namespace
}  // namespace vantage
