// SPDX-License-Identifier: MIT
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <array>
#include <cstdint>
#include <vantage/field/laplace_guess.hpp>

namespace vantage {
namespace {

using Position = LaplaceProblem::Position;

constexpr Position kNone = -1;
constexpr std::size_t kSmallest = 400;  // unknowns that are solved outright
constexpr int kSweeps = 3;              // there and back, per level

// Laplace's equation over a graph of nodes: sum over edges of conductance * (phi - phi[to]) + leak * phi = load.
struct Level {
  struct Edge {
    Position to;
    std::uint32_t axis;
    double conductance;
  };
  std::vector<VoxelIndex> at;
  std::vector<std::size_t> first_edge{0};
  std::vector<Edge> edges;
  std::vector<double> leak;       // to sinks and source
  std::vector<double> load;       // from the source, and the uniform one
  std::vector<double> total;      // leak and all conductances
  std::vector<Position> coarser;  // the node of the next level

  [[nodiscard]] std::size_t size() const { return at.size(); }
  void close_node() {
    double sum = leak.back();
    for (std::size_t e = first_edge.back(); e < edges.size(); ++e) {
      sum += edges[e].conductance;
    }
    total.push_back(sum);
    first_edge.push_back(edges.size());
  }
};

std::int32_t along(const VoxelIndex& cell, std::uint32_t axis) {
  return axis == 0 ? cell.x : axis == 1 ? cell.y : cell.z;
}

Level finest_level(const LaplaceProblem& problem, double uniform_source, const std::vector<Position>& number) {
  Level level;
  const auto interior = static_cast<double>(problem.size() - problem.sink_count() - 1);
  for (Position position = 0; position < static_cast<Position>(problem.size()); ++position) {
    if (problem.kind(position) != LaplaceCell::Interior) {
      continue;
    }
    level.at.push_back(problem.cell(position));
    level.leak.push_back(0.0);
    level.load.push_back(uniform_source / interior);
    for (std::uint32_t face = 0; face < 6; ++face) {
      const Position neighbour = problem.neighbours(position)[face];
      if (neighbour == LaplaceProblem::kClosed) {
        continue;
      }
      if (problem.kind(neighbour) == LaplaceCell::Interior) {
        level.edges.push_back({number[static_cast<std::size_t>(neighbour)], face / 2, 1.0});
        continue;
      }
      level.leak.back() += 1.0;
      level.load.back() += problem.kind(neighbour) == LaplaceCell::Source ? 1.0 : 0.0;
    }
    level.close_node();
  }
  return level;
}

// Joins each node of even coordinate with the one after it along the axis, if a face between them is open.
std::size_t pair_nodes(Level& level, std::uint32_t axis) {
  level.coarser.assign(level.size(), kNone);
  Position count = 0;
  for (std::size_t i = 0; i < level.size(); ++i) {
    if (level.coarser[i] != kNone) {
      continue;
    }
    level.coarser[i] = count;
    const std::int32_t wanted = along(level.at[i], axis) ^ 1;
    const Level::Edge* strongest = nullptr;
    for (std::size_t e = level.first_edge[i]; e < level.first_edge[i + 1]; ++e) {
      const Level::Edge& edge = level.edges[e];
      const auto to = static_cast<std::size_t>(edge.to);
      if (edge.axis == axis && level.coarser[to] == kNone && along(level.at[to], axis) == wanted &&
          (strongest == nullptr || edge.conductance > strongest->conductance)) {
        strongest = &edge;
      }
    }
    if (strongest != nullptr) {
      level.coarser[static_cast<std::size_t>(strongest->to)] = count;
    }
    ++count;
  }
  return static_cast<std::size_t>(count);
}

VoxelIndex halved(VoxelIndex cell, std::uint32_t axis) {
  (axis == 0 ? cell.x : axis == 1 ? cell.y : cell.z) >>= 1;
  return cell;
}

Level coarser_level(const Level& fine, std::size_t count, std::uint32_t axis) {
  std::vector<std::array<Position, 2>> members(count, {kNone, kNone});
  for (std::size_t i = 0; i < fine.size(); ++i) {
    auto& pair = members[static_cast<std::size_t>(fine.coarser[i])];
    pair[pair[0] == kNone ? 0 : 1] = static_cast<Position>(i);
  }
  Level level;
  level.edges.reserve(fine.edges.size() / 2);
  // One past the edge of the node at work to a node along an axis, if that is not before its first. Edges along
  // different axes stay apart, for they are shortened at different levels and must remain symmetric.
  std::vector<std::array<std::size_t, 3>> edge_to(count, {0, 0, 0});
  for (std::size_t node = 0; node < count; ++node) {
    level.at.push_back(halved(fine.at[static_cast<std::size_t>(members[node][0])], axis));
    level.leak.push_back(0.0);
    level.load.push_back(0.0);
    for (const Position member : members[node]) {
      if (member == kNone) {
        continue;
      }
      const auto i = static_cast<std::size_t>(member);
      level.leak.back() += fine.leak[i];
      level.load.back() += fine.load[i];
      for (std::size_t e = fine.first_edge[i]; e < fine.first_edge[i + 1]; ++e) {
        const Level::Edge& edge = fine.edges[e];
        const auto to = static_cast<std::size_t>(fine.coarser[static_cast<std::size_t>(edge.to)]);
        if (to == node) {
          continue;
        }
        // Twice as far apart along the axis.
        const double conductance = edge.axis == axis ? 0.5 * edge.conductance : edge.conductance;
        std::size_t& known = edge_to[to][edge.axis];
        if (known > level.first_edge.back()) {
          level.edges[known - 1].conductance += conductance;
        } else {
          level.edges.push_back({static_cast<Position>(to), edge.axis, conductance});
          known = level.edges.size();
        }
      }
    }
    level.close_node();
  }
  return level;
}

std::vector<double> solve_outright(const Level& level) {
  using Sparse = Eigen::SparseMatrix<double>;
  const auto size = static_cast<Eigen::Index>(level.size());
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd load(size);
  for (std::size_t i = 0; i < level.size(); ++i) {
    const auto row = static_cast<int>(i);
    entries.emplace_back(row, row, level.total[i]);
    for (std::size_t e = level.first_edge[i]; e < level.first_edge[i + 1]; ++e) {
      entries.emplace_back(row, level.edges[e].to, -level.edges[e].conductance);
    }
    load[row] = level.load[i];
  }
  Sparse matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Sparse> solver(matrix);
  const Eigen::VectorXd phi = solver.solve(load);
  return {phi.begin(), phi.end()};
}

void smooth(const Level& level, std::vector<double>& phi) {
  const auto update = [&](std::size_t i) {
    double sum = level.load[i];
    for (std::size_t e = level.first_edge[i]; e < level.first_edge[i + 1]; ++e) {
      sum += level.edges[e].conductance * phi[static_cast<std::size_t>(level.edges[e].to)];
    }
    phi[i] = sum / level.total[i];
  };
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (std::size_t i = 0; i < level.size(); ++i) {
      update(i);
    }
    for (std::size_t i = level.size(); i-- > 0;) {
      update(i);
    }
  }
}

std::vector<double> solve_from_coarse(Level level) {
  std::vector<Level> levels;
  levels.push_back(std::move(level));
  std::uint32_t axis = 0;
  for (int idle = 0; levels.back().size() > kSmallest && idle < 3; axis = (axis + 1) % 3) {
    const std::size_t count = pair_nodes(levels.back(), axis);
    if (count == levels.back().size()) {
      ++idle;
      for (VoxelIndex& cell : levels.back().at) {
        cell = halved(cell, axis);
      }
      continue;
    }
    idle = 0;
    levels.push_back(coarser_level(levels.back(), count, axis));
  }
  std::vector<double> phi = solve_outright(levels.back());
  for (std::size_t fine = levels.size() - 1; fine-- > 0;) {
    std::vector<double> finer(levels[fine].size());
    for (std::size_t i = 0; i < finer.size(); ++i) {
      finer[i] = phi[static_cast<std::size_t>(levels[fine].coarser[i])];
    }
    phi = std::move(finer);
    smooth(levels[fine], phi);
  }
  return phi;
}

}  // namespace

std::vector<double> coarse_to_fine_guess(const LaplaceProblem& problem, double uniform_source) {
  std::vector<double> guess(problem.size(), 0.0);
  guess[static_cast<std::size_t>(problem.source())] = 1.0;
  std::vector<Position> number(problem.size(), kNone);
  std::vector<std::size_t> interior;
  for (std::size_t i = 0; i < problem.size(); ++i) {
    if (problem.kind(static_cast<Position>(i)) == LaplaceCell::Interior) {
      number[i] = static_cast<Position>(interior.size());
      interior.push_back(i);
    }
  }
  if (interior.empty()) {
    return guess;
  }
  const std::vector<double> phi = solve_from_coarse(finest_level(problem, uniform_source, number));
  for (std::size_t i = 0; i < interior.size(); ++i) {
    guess[interior[i]] = phi[i];
  }
  return guess;
}

}  // namespace vantage
