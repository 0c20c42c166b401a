// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <sstream>
#include <stdexcept>
#include <vantage/robot/reachable_space.hpp>
#include <vantage/sim/truth.hpp>

#include <vantage/map/impl/brick_plane.hpp>
#include <vantage/settings/impl/option_rule.hpp>
#include "sim/rasterise.hpp"
#include "sim/sight.hpp"

namespace vantage {
namespace {

constexpr double kGrazedShare = 0.02;
constexpr double kLatticeM = 0.4;
constexpr double kMostCells = 4294967296.0;

OccupancyMapOptions map_options(double resolution_m, const Box& region) {
  detail::require_option(std::isfinite(resolution_m) && resolution_m > 0.0, "Truth: resolution_m", resolution_m,
                         "> 0");
  return {.resolution_m = resolution_m, .region = region};
}

// The region and the part of the mesh at most `around_m` from it.
VoxelBox covering(const VoxelFrame& frame, const Box& region, const Box& mesh, double around_m) {
  Box outer{region.min.cwiseMin(mesh.min), region.max.cwiseMax(mesh.max)};
  outer.min = outer.min.cwiseMax(region.min - Eigen::Vector3d::Constant(around_m));
  outer.max = outer.max.cwiseMin(region.max + Eigen::Vector3d::Constant(around_m));
  const double count = (outer.extent() / frame.size_m).array().ceil().prod();
  detail::require_option(count <= kMostCells, "Truth: count of cells", count,
                         "at most 4294967296; take a smaller region, larger cells or a shorter range");
  return {frame.cell_of(outer.min) - VoxelIndex{1, 1, 1}, frame.cell_of(outer.max) + VoxelIndex{2, 2, 2}};
}

// Whether surfaces of the mesh lie further than `around_m` from the region.
bool reaches_beyond(const Box& mesh, const Box& region, double around_m) {
  return (mesh.min.array() < region.min.array() - around_m).any() ||
         (mesh.max.array() > region.max.array() + around_m).any();
}

// Cells of a world that is a plane, in the layer of the region.
TrueCells cells_of_plan(const GroundPlan& plan, const VoxelFrame& frame, const VoxelBox& covered,
                        const VoxelBox& region) {
  TrueCells cells({{covered.lo.x, covered.lo.y, region.lo.z}, {covered.hi.x, covered.hi.y, region.hi.z}});
  const Eigen::Vector3d grazed = Eigen::Vector3d::Constant(kGrazedShare * frame.size_m);
  for_each_cell(cells.box(), [&](const VoxelIndex& cell) {
    const Box box = frame.box_of(cell);
    if (plan.touches_solid(box)) {
      const bool solid = plan.touches_solid({box.min + grazed, box.max - grazed});
      cells.set(cell, solid ? CellTruth::Occupied : CellTruth::Grazed);
    }
  });
  return cells;
}

// The largest set of nonzero cells joined face to face; of several, the first in raster order.
std::vector<VoxelIndex> largest_component(const VoxelGrid<std::uint8_t>& admitted) {
  VoxelGrid<std::uint8_t> seen(admitted.box(), 0);
  std::vector<VoxelIndex> largest;
  for_each_cell(admitted.box(), [&](const VoxelIndex& first) {
    if (admitted[first] == 0 || seen[first] != 0) {
      return;
    }
    std::vector<VoxelIndex> component{first};
    seen[first] = 1;
    for (std::size_t next = 0; next < component.size(); ++next) {
      for (const VoxelIndex& step : kFaceNeighbours) {
        const VoxelIndex neighbour = component[next] + step;
        if (admitted.value_or(neighbour, 0) != 0 && seen[neighbour] == 0) {
          seen[neighbour] = 1;
          component.push_back(neighbour);
        }
      }
    }
    if (component.size() > largest.size()) {
      largest = std::move(component);
    }
  });
  return largest;
}

}  // namespace

Truth::Truth(const World& world, double resolution_m, const Box& region, double around_m)
    : map_(map_options(resolution_m, region)) {
  detail::require_option(around_m >= 0.0 && around_m <= 1e4, "Truth: around_m", around_m, "in [0, 10000]");
  region_ = *map_.region();
  if (region_.empty()) {
    std::ostringstream message;
    message << "the region holds no cell of " << resolution_m << " m";
    throw std::invalid_argument(message.str());
  }
  if (world.plan && region_.extent().z != 1) {
    throw std::invalid_argument("Truth: the world is a plane, and the region not one layer of cells");
  }
  const VoxelFrame& frame = map_.frame();
  const Box inner = frame.box_of(region_);
  const VoxelBox covered = covering(frame, inner, world.mesh.bounds(), around_m);
  if (reaches_beyond(world.mesh.bounds(), inner, around_m)) {
    longest_range_m_ = around_m;
  }
  if (world.plan) {
    cells_ = cells_of_plan(*world.plan, frame, covered, region_);
  } else {
    cells_ = TrueCells(covered);
    rasterise(world.mesh, frame, kGrazedShare, cells_);
  }
  for_each_cell(Brick::over(region_), [&](const VoxelIndex& brick) {
    const BrickPlane known = detail::plane_of(brick, region_);
    BrickPlane occupied{};
    for (std::size_t word = 0; word < Brick::kWords && !cells_.is_free_brick(brick); ++word) {
      for_each_offset(known[word], word, [&](std::size_t offset) {
        const bool solid = at(Brick::cell_at(brick, offset)) != CellTruth::Free;
        occupied[word] |= std::uint64_t{solid} << (offset & 63U);
      });
    }
    map_.assign(brick, known, occupied);
  });
}

Truth Truth::in_band(const HeightBandOptions& options) const {
  HeightBand band(map_.options(), options);
  band.follow(map_);
  const std::int32_t lowest = band.layers().first;
  const std::int32_t above = band.layers().second;
  const std::int32_t layer = band.plane().region()->lo.z;
  const VoxelBox& box = cells_.box();
  TrueCells cells({{box.lo.x, box.lo.y, layer}, {box.hi.x, box.hi.y, layer + 1}});
  for_each_cell(cells.box(), [&](const VoxelIndex& column) {
    CellTruth state = CellTruth::Free;
    for (VoxelIndex cell{column.x, column.y, lowest}; cell.z < above; ++cell.z) {
      state = std::max(state, at(cell));  // Free < Grazed < Occupied
    }
    cells.set(column, state);
  });
  return {band.plane(), std::move(cells), longest_range_m_};
}

std::optional<Pose> Truth::draw_start(const Platform& platform, std::uint64_t seed) const {
  const std::vector<VoxelIndex> space = largest_component(platform.admitted_cells(map_, region_));
  if (space.empty()) {
    return std::nullopt;
  }
  std::mt19937_64 engine(seed);
  const auto draw = [&engine] { return static_cast<double>(engine() >> 11U) * 0x1p-53; };
  const auto at_random = static_cast<std::size_t>(draw() * static_cast<double>(space.size()));
  const double yaw_rad = 2.0 * std::numbers::pi * draw();
  return platform.facing(map_.frame().centre_of(space[at_random]), {std::cos(yaw_rad), std::sin(yaw_rad), 0.0});
}

std::vector<VoxelIndex> Truth::lattice(const Platform& platform, const Pose& start) const {
  const auto pitch =
      std::max<std::int32_t>(1, static_cast<std::int32_t>(std::lround(kLatticeM / map_.resolution_m())));
  const ReachableSpace space(map_, platform, start);
  const bool is_plane = region_.extent().z == 1;
  std::vector<VoxelIndex> lattice;
  space.for_each_brick([&](const VoxelIndex& brick, const BrickPlane& cells) {
    for_each_offset(cells, [&](std::size_t offset) {
      const VoxelIndex cell = Brick::cell_at(brick, offset);
      const bool on_lattice = cell.x % pitch == 0 && cell.y % pitch == 0 && (is_plane || cell.z % pitch == 0);
      if (cell == *space.start() || on_lattice) {
        lattice.push_back(cell);
      }
    });
  });
  return lattice;
}

std::vector<VoxelIndex> Truth::observable(const Platform& platform, const RangeSensor& sensor, const Pose& start,
                                          int threads, const std::function<void(double)>& on_share,
                                          const std::optional<Box>& within) const {
  sensor.validate();
  if (!sensor.reports_no_return) {
    detail::require_option(sensor.max_range_m <= longest_range_m_, "RangeSensor::max_range_m", sensor.max_range_m,
                           "at most Truth's around_m, because a ray may end on a surface further away");
  }
  const std::vector<VoxelIndex> poses = lattice(platform, start);
  const Sight sight(cells_, map_.frame(), sensor, platform.can_tilt());
  VoxelBox cells = region_;
  if (within) {
    const VoxelFrame& frame = map_.frame();
    const VoxelIndex lo = frame.cell_of(within->min);
    const VoxelIndex hi = frame.cell_of(within->max) + VoxelIndex{1, 1, 1};
    cells.lo = {std::max(cells.lo.x, lo.x), std::max(cells.lo.y, lo.y), std::max(cells.lo.z, lo.z)};
    cells.hi = {std::min(cells.hi.x, hi.x), std::min(cells.hi.y, hi.y), std::min(cells.hi.z, hi.z)};
  }
  return cells.empty() ? std::vector<VoxelIndex>() : seen_cells(sight, cells, poses, threads, on_share);
}

void Truth::tell_around(const Box& unknown, OccupancyMap& map) const {
  const auto is_apart = [&unknown](const Box& box) {
    return (box.max.array() <= unknown.min.array()).any() || (box.min.array() >= unknown.max.array()).any();
  };
  const VoxelFrame& frame = map_.frame();
  map_.for_each_brick([&](const VoxelIndex& address, const Brick& brick) {
    const bool all = is_apart(frame.box_of(Brick::cells_of(address)));
    BrickPlane known = brick.known;
    BrickPlane occupied = brick.occupied;
    for (std::size_t word = 0; word < Brick::kWords && !all; ++word) {
      for_each_offset(brick.known[word], word, [&](std::size_t offset) {
        if (!is_apart(frame.box_of(Brick::cell_at(address, offset)))) {
          known[word] &= ~(std::uint64_t{1} << (offset & 63U));
        }
      });
      occupied[word] &= known[word];
    }
    map.assign(address, known, occupied);
  });
}

double Truth::coverage(const OccupancyMap& map, const std::vector<VoxelIndex>& cells) const {
  if (cells.empty()) {
    return 1.0;
  }
  std::size_t right = 0;
  for (const VoxelIndex& cell : cells) {
    const Occupancy known = map.at(cell);
    const CellTruth truth = at(cell);
    const bool fits = truth == CellTruth::Grazed || (truth == CellTruth::Occupied) == (known == Occupancy::Occupied);
    right += known != Occupancy::Unknown && fits ? 1U : 0U;
  }
  return static_cast<double>(right) / static_cast<double>(cells.size());
}

}  // namespace vantage
