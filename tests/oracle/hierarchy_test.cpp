// SPDX-License-Identifier: MIT
// The levels of the multigrid hierarchy against sums by definition, and the certification pass against one with
// divisions.
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <unordered_map>
#include <utility>

#include <vantage/field/impl/block_graph.hpp>
#include <vantage/field/impl/refinement.hpp>
#include "random_rooms.hpp"

namespace vantage {
namespace {

using detail::FineLevel;
using detail::GraphLevel;

LaplaceDomain domain_of(const RoomsOptions& options) {
  const RandomRooms rooms(options);
  LaplaceDomain domain = rooms.domain();
  domain.keep_component(rooms.source);
  return domain;
}

std::vector<RoomsOptions> worlds_of_levels() {
  return {{.extent = {70, 45, 37}, .seed = 31},
          {.extent = {90, 60, 41}, .room_cells = 7, .door_cells = 3, .seed = 32},
          {.extent = {70, 45, 37}, .room_cells = 13, .clutter = 0.02, .unexplored = 0.5, .seed = 33}};
}

// Calls visit(cell, brick, row, x) for each cell that is not a sink.
template <class Visit>
void for_each_unknown(const LaplaceDomain& domain, const Visit& visit) {
  for (std::size_t b = 0; b < domain.bricks().size(); ++b) {
    const VoxelIndex& address = domain.bricks()[b].address;
    for (std::int32_t i = 0; i < 1024; ++i) {
      const VoxelIndex cell{address.x * 16 + i % 16, address.y * 8 + i / 16 % 8, address.z * 8 + i / 128};
      if (domain.contains(cell) && !domain.is_sink(cell)) {
        visit(cell, b, static_cast<std::size_t>(i / 16), static_cast<std::size_t>(i % 16));
      }
    }
  }
}

TEST(HierarchyOracle, CellsAndBlocksKnowTheirFaces) {
  std::size_t cells = 0;
  for (const RoomsOptions& options : worlds_of_levels()) {
    const LaplaceDomain domain = domain_of(options);
    const FineLevel fine = detail::make_fine_level(domain);
    std::vector<std::array<std::uint32_t, 7>> faces(fine.blocks.size());  // to blocks at six sides, and to sinks
    for_each_unknown(domain, [&](const VoxelIndex& cell, std::size_t b, std::size_t row, std::size_t x) {
      const std::size_t block = (b + 1) * detail::kBrickBlocks + (row / 16 * 4 + row % 8 / 2) * 8 + x / 2;
      std::uint32_t open = 0;
      std::uint32_t beside_sink = 0;
      for (std::size_t side = 0; side < 6; ++side) {
        const VoxelIndex other = cell + kFaceNeighbours[side];
        const bool same = other.x >> 1 == cell.x >> 1 && other.y >> 1 == cell.y >> 1 && other.z >> 1 == cell.z >> 1;
        open += domain.contains(other) ? 1U : 0U;
        beside_sink |= domain.is_sink(other) ? detail::kBesideSink : 0U;
        if (domain.is_sink(other)) {
          ++faces[block][6];
        } else if (domain.contains(other) && !same) {
          ++faces[block][side];
        }
      }
      const std::uint32_t known = fine.faces[detail::colour_of(row, x)][(b + 1) * detail::kBrickRows + row] >>
                                  (4 * (detail::half_offset(row, x) % 8));
      ASSERT_EQ(known & 15U, open | beside_sink);
      ++cells;
    });
    for (std::size_t block = 0; block < faces.size(); ++block) {
      std::uint32_t packed = 0;
      std::uint32_t twice = 2 * faces[block][6];
      for (std::uint32_t side = 0; side < 6; ++side) {
        packed |= faces[block][side] << (3U * side);
        twice += faces[block][side];
      }
      ASSERT_EQ(fine.blocks[block], packed | twice << 18U) << block;
    }
  }
  EXPECT_GE(cells, 100000U);
}

// Conductance between pairs of nodes, each pair in both orders; that of a node with itself is its leak to the sinks.
using Joins = std::map<std::pair<std::uint32_t, std::uint32_t>, float>;

Joins joins_of(const GraphLevel& level) {
  Joins joins;
  for (std::uint32_t i = 0; i < level.size; ++i) {
    float sum = level.leak[i];
    joins[{i, i}] = level.leak[i];
    level.for_each_edge(i, [&](const GraphLevel::Edge& edge) {
      EXPECT_TRUE(joins.try_emplace({i, edge.to}, edge.conductance).second);  // no pair has two edges
      EXPECT_NE(i < level.even, edge.to < level.even);
      sum += edge.conductance;
    });
    EXPECT_EQ(level.diagonal[i], sum);
    EXPECT_EQ(detail::is_even(level.at[i]), i < level.even);
  }
  return joins;
}

// The conductances of the first graph, from the faces of the blocks.
Joins joins_between(const FineLevel& fine, const detail::BlockLevel& blocks) {
  std::unordered_map<VoxelIndex, std::size_t> places;
  const auto address = [&](std::size_t b, std::size_t i) {
    const VoxelIndex& brick = fine.address[b];
    const auto block = static_cast<std::int32_t>(i);
    return VoxelIndex{brick.x * 8 + block % 8, brick.y * 4 + block / 8 % 4, brick.z * 4 + block / 32};
  };
  const auto for_each_block = [&](const auto& visit) {
    for (std::size_t b = 1; b < fine.brick_count; ++b) {
      for (std::size_t i = 0; i < detail::kBrickBlocks; ++i) {
        if (fine.blocks[b * detail::kBrickBlocks + i] != 0) {
          visit(address(b, i), b * detail::kBrickBlocks + i);
        }
      }
    }
  };
  for_each_block([&](const VoxelIndex& at, std::size_t place) { places[at] = place; });
  Joins joins;
  for_each_block([&](const VoxelIndex& at, std::size_t place) {
    const std::uint32_t own = blocks.node[place];
    std::uint32_t twice = fine.blocks[place] >> 18U;
    for (std::uint32_t side = 0; side < 6; ++side) {
      const std::uint32_t faces = fine.blocks[place] >> (3U * side) & 7U;
      twice -= faces;
      if (faces != 0) {
        if (const std::uint32_t other = blocks.node[places.at(at + kFaceNeighbours[side])]; other != own) {
          joins[{own, other}] += detail::kOverCorrection * 0.5F * static_cast<float>(faces);
        }
      }
    }
    joins[{own, own}] += detail::kOverCorrection * 0.5F * static_cast<float>(twice);
  });
  return joins;
}

// The conductances of the level after `finer`, from those of `finer`.
Joins joins_after(const GraphLevel& finer, const Joins& joins) {
  Joins sums;
  for (const auto& [pair, conductance] : joins) {
    const std::pair<std::uint32_t, std::uint32_t> to{finer.node[pair.first], finer.node[pair.second]};
    if (pair.first == pair.second || to.first != to.second) {
      sums[to] += detail::kOverCorrection * conductance;
    }
  }
  return sums;
}

TEST(HierarchyOracle, GraphsAreTheSumsOfTheLevelsBefore) {
  std::size_t nodes = 0;
  std::size_t many_edges = 0;
  for (const RoomsOptions& options : worlds_of_levels()) {
    for (const std::size_t threads : {1U, 3U}) {
      const FineLevel fine = detail::make_fine_level(domain_of(options), threads);
      detail::BlockLevel blocks(fine);
      GraphLevel graph = detail::graph_of_blocks(fine, blocks);
      Joins joins = joins_of(graph);
      ASSERT_EQ(joins, joins_between(fine, blocks));
      while (graph.size > 30) {
        GraphLevel next = detail::coarsen(*fine.team, graph);
        ASSERT_LT(next.size, graph.size);
        for (std::uint32_t parent = 0; parent < next.size; ++parent) {
          for (std::uint32_t c = graph.first_child[parent]; c < graph.first_child[parent + 1]; ++c) {
            const VoxelIndex& at = graph.at[graph.children[c]];
            ASSERT_EQ(graph.node[graph.children[c]], parent);
            ASSERT_EQ(next.at[parent], VoxelIndex(at.x >> 1, at.y >> 1, at.z >> 1));
          }
        }
        ASSERT_EQ(graph.first_child.back(), graph.size);
        Joins after = joins_of(next);
        ASSERT_EQ(after, joins_after(graph, joins));
        many_edges += next.more.size();
        nodes += next.size;
        joins = std::move(after);
        graph = std::move(next);
      }
    }
  }
  EXPECT_GE(nodes, 3000U);
  EXPECT_GE(many_edges, 50U);
}

// The certification pass compares without divisions and divides only in doubtful cases. It must find as many stuck
// cells as a pass that always divides, for values that differ by a few units in the last place or by much.
TEST(HierarchyOracle, NoStuckCellIsWithoutADoubt) {
  std::mt19937 engine(34);
  std::uniform_int_distribution<int> few(-2, 2);
  std::size_t stuck = 0;
  std::size_t free = 0;
  for (const RoomsOptions& options : worlds_of_levels()) {
    const LaplaceDomain domain = domain_of(options);
    const FineLevel fine = detail::make_fine_level(domain);
    const detail::CellPlace source = detail::CellPlace(domain, RandomRooms(options).source);
    for (const double step : {0x1p-53, 0x1p-52, 0x1p-50, 0.01}) {
      detail::Refinement refinement(fine, source, 0.0);
      detail::HalfField<float> correction(fine.brick_count * detail::kHalfBrick, 0.0F);
      detail::HalfField<float> residual(correction.size(), 0.0F);
      const auto add = [&](double unit, const auto& value) {
        for (std::size_t i = detail::kHalfBrick; i < correction.size(); ++i) {
          const bool is_cell = fine.degree(detail::kBlack, i / detail::kHalfBrick, i % detail::kHalfBrick) > 0;
          correction[i] = is_cell ? value() : 0.0F;
        }
        return refinement.update(fine, {correction, unit}, {residual, 1.0}, true);
      };
      add(1.0, [] { return 1.3F; });
      const detail::Defect defect = add(step, [&] { return static_cast<float>(few(engine)); });
      ASSERT_EQ(defect.stuck, detail::count_stuck(fine, refinement.take())) << step;
      stuck += defect.stuck;
      free += domain.cell_count() - domain.sink_count() - defect.stuck;
    }
  }
  EXPECT_GE(stuck, 10000U);
  EXPECT_GE(free, 10000U);
}

}  // namespace
}  // namespace vantage
