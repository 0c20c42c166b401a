// SPDX-License-Identifier: MIT
#pragma once

// Shade & Newman 2011, section IV-D.
#include <cmath>
#include <limits>
#include <vantage/field/streamline.hpp>

namespace vantage {
namespace detail {

using Position = LaplaceProblem::Position;

inline double value_at(std::span<const double> phi, Position position) {
  return phi[static_cast<std::size_t>(position)];
}

// Central differences per cell. The value behind a closed face is the cell's own value, so there is no flow through
// it.
inline Eigen::Vector3d gradient_at(const LaplaceProblem& problem, std::span<const double> phi, Position position) {
  const double own = value_at(phi, position);
  const auto& n = problem.neighbours(position);
  const auto beyond = [&](std::size_t face) {
    return n[face] == LaplaceProblem::kClosed ? own : value_at(phi, n[face]);
  };
  return 0.5 * Eigen::Vector3d(beyond(1) - beyond(0), beyond(3) - beyond(2), beyond(5) - beyond(4));
}

class Flow {
 public:
  Flow(const LaplaceProblem& problem, std::span<const double> phi, const VoxelFrame& frame)
      : problem_(problem), phi_(phi), frame_(frame) {}

  // Unit direction of steepest descent; nullopt where the field is constant or there is no cell.
  [[nodiscard]] std::optional<Eigen::Vector3d> direction(const Eigen::Vector3d& at_m) const {
    const Eigen::Vector3d centred = at_m / frame_.size_m - Eigen::Vector3d::Constant(0.5);
    const Eigen::Vector3d base = centred.array().floor();
    const Eigen::Vector3d share = centred - base;
    const VoxelIndex corner{static_cast<std::int32_t>(base.x()), static_cast<std::int32_t>(base.y()),
                            static_cast<std::int32_t>(base.z())};
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::int32_t i = 0; i < 8; ++i) {
      const VoxelIndex step{i & 1, i >> 1 & 1, i >> 2 & 1};
      const double weight = (step.x == 1 ? share.x() : 1.0 - share.x()) *
                            (step.y == 1 ? share.y() : 1.0 - share.y()) * (step.z == 1 ? share.z() : 1.0 - share.z());
      if (const auto position = problem_.position_of(corner + step); position && weight > 0.0) {
        sum -= weight * gradient_at(problem_, phi_, *position);
      }
    }
    const double length = sum.norm();
    if (!(length > 0.0)) {
      return std::nullopt;
    }
    return Eigen::Vector3d(sum / length);
  }

 private:
  const LaplaceProblem& problem_;
  std::span<const double> phi_;
  const VoxelFrame& frame_;
};

}  // namespace detail

VANTAGE_INLINE std::optional<detail::Position> steepest_neighbour(const LaplaceProblem& problem,
                                                                  std::span<const double> phi,
                                                                  detail::Position from) {
  detail::Position lowest = from;
  for (const detail::Position neighbour : problem.neighbours(from)) {
    if (neighbour != LaplaceProblem::kClosed && detail::value_at(phi, neighbour) < detail::value_at(phi, lowest)) {
      lowest = neighbour;
    }
  }
  return lowest == from ? std::nullopt : std::optional<detail::Position>(lowest);
}

VANTAGE_INLINE std::size_t count_stuck_cells(const LaplaceProblem& problem, std::span<const double> phi) {
  std::size_t stuck = 0;
  for (detail::Position position = 0; position < static_cast<detail::Position>(problem.size()); ++position) {
    if (problem.kind(position) != LaplaceCell::Sink && !steepest_neighbour(problem, phi, position)) {
      ++stuck;
    }
  }
  return stuck;
}

VANTAGE_INLINE Descent descend(const LaplaceProblem& problem, std::span<const double> phi, detail::Position from) {
  Descent descent;
  std::optional<detail::Position> at = from;
  while (at) {
    descent.cells.push_back(*at);
    if (problem.kind(*at) == LaplaceCell::Sink) {
      descent.reaches_sink = true;
      break;
    }
    at = steepest_neighbour(problem, phi, *at);
  }
  return descent;
}

VANTAGE_INLINE std::optional<std::vector<Eigen::Vector3d>> streamline(const LaplaceProblem& problem,
                                                                      std::span<const double> phi,
                                                                      const VoxelFrame& frame,
                                                                      const Eigen::Vector3d& from_m) {
  const detail::Flow flow(problem, phi, frame);
  const double step_m = 0.5 * frame.size_m;
  // Limit on the number of points. A curve that is longer circles in a hollow between cell centres, which
  // interpolation can create even if no cell is a minimum.
  const std::size_t longest = 6 * problem.size();
  // Number of steps without a new lowest cell that are tolerated: phi need not decrease at every half step.
  constexpr std::size_t kWindow = 16;
  std::vector<Eigen::Vector3d> points{from_m};
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t since_lowest = 0; points.size() < longest && since_lowest < kWindow; ++since_lowest) {
    const std::optional<detail::Position> here = problem.position_of(frame.cell_of(points.back()));
    if (!here) {
      return std::nullopt;
    }
    if (problem.kind(*here) == LaplaceCell::Sink) {
      return points;
    }
    if (detail::value_at(phi, *here) < lowest) {
      lowest = detail::value_at(phi, *here);
      since_lowest = 0;
    }
    // The midpoint rule; at the border of the domain the Euler step.
    const auto at_start = flow.direction(points.back());
    if (!at_start) {
      return std::nullopt;
    }
    const auto at_middle = flow.direction(points.back() + 0.5 * step_m * *at_start);
    points.push_back(points.back() + step_m * at_middle.value_or(*at_start));
  }
  return std::nullopt;
}

}  // namespace vantage
