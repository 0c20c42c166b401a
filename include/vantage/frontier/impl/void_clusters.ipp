// SPDX-License-Identifier: MIT
#pragma once

//
// Dornhege & Kleiner 2011, "A Frontier-Void-Based Approach for Autonomous Exploration in 3D", section IV-B.
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>
#include <vantage/frontier/void_clusters.hpp>
#include <vantage/geometry/cell_moments.hpp>
#include <vantage/geometry/raster_order.hpp>
#include <vantage/geometry/voxel_grid.hpp>

#include <vantage/geometry/impl/box_around.hpp>
#include <vantage/geometry/impl/dice.hpp>
#include <vantage/geometry/impl/prefetch.hpp>
#include <vantage/map/impl/instruction_set.hpp>
#include <vantage/settings/impl/option_rule.hpp>

namespace vantage {
namespace detail {

inline constexpr std::uint32_t kNoVoid = VoidClusters::kNone;
inline constexpr std::uint32_t kUnassigned = VoidClusters::kNone - 1;

// A solid ellipsoid has the variance a^2 / 5 along a half axis of length a.
inline constexpr double kVarianceShare = 5.0;

// Scales of the half axes at which the members inside are counted.
inline constexpr std::array<double, 5> kShares{1.0, 0.95, 0.9, 0.86, 0.82};

// Cluster numbers of all cells of a box. Used if the void cells fill the box densely.
class DenseNumbers {
 public:
  /// Marks `cells`, all inside `box`, as unassigned.
  DenseNumbers(std::span<const VoxelIndex> cells, const VoxelBox& box)
      : grid_(box, kNoVoid), strides_{1, box.extent().x, std::ptrdiff_t{box.extent().x} * box.extent().y} {
    lowest_ = {box.lo.x, box.lo.y, box.lo.z};
    highest_ = {box.hi.x - 1, box.hi.y - 1, box.hi.z - 1};
    for (const VoxelIndex& cell : cells) {
      grid_[cell] = kUnassigned;
    }
  }
  /// The positions of the unassigned cells, in raster order.
  [[nodiscard]] std::vector<std::size_t> positions() const {
    std::vector<std::size_t> positions;
    for (std::size_t i = 0; i < grid_.size(); ++i) {
      if (grid_.values()[i] == kUnassigned) {
        positions.push_back(i);
      }
    }
    return positions;
  }
  [[nodiscard]] std::uint32_t& operator[](std::size_t position) { return grid_.values()[position]; }
  [[nodiscard]] VoxelIndex cell_at(std::size_t position) const { return grid_.cell_at(position); }
  /// Calls `visit(position)` for the neighbour of a cell along `axis`, if it lies inside the box. `at` is the
  /// coordinate of the cell along `axis`.
  template <class Visit>
  void with_neighbour(std::size_t position, std::size_t axis, std::int32_t at, std::int32_t step,
                      const Visit& visit) const {
    if (step > 0 ? at < highest_[axis] : at > lowest_[axis]) {
      visit(position + static_cast<std::size_t>(step * strides_[axis]));
    }
  }

 private:
  VoxelGrid<std::uint32_t> grid_;
  std::array<std::ptrdiff_t, 3> strides_{};
  std::array<std::int32_t, 3> lowest_{};
  std::array<std::int32_t, 3> highest_{};
};

// The interface of DenseNumbers, for scattered cells: stores one number per void cell. A position is an index in
// raster order.
class SparseNumbers {
 public:
  explicit SparseNumbers(std::span<const VoxelIndex> cells) : cells_(cells.begin(), cells.end()) {
    sort_unique(cells_);
    numbers_.assign(cells_.size(), kUnassigned);
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      positions_[cells_[i]] = static_cast<std::uint32_t>(i);
    }
  }
  [[nodiscard]] std::vector<std::size_t> positions() const {
    std::vector<std::size_t> positions(cells_.size());
    std::iota(positions.begin(), positions.end(), std::size_t{0});
    return positions;
  }
  [[nodiscard]] std::uint32_t& operator[](std::size_t position) { return numbers_[position]; }
  [[nodiscard]] VoxelIndex cell_at(std::size_t position) const { return cells_[position]; }
  template <class Visit>
  void with_neighbour(std::size_t position, std::size_t axis, std::int32_t /*at*/, std::int32_t step,
                      const Visit& visit) const {
    const VoxelIndex neighbour =
        cells_[position] + VoxelIndex{axis == 0 ? step : 0, axis == 1 ? step : 0, axis == 2 ? step : 0};
    if (const std::uint32_t other = positions_[neighbour]; other != kNoVoid) {
      visit(other);
    }
  }

 private:
  std::vector<VoxelIndex> cells_;
  std::vector<std::uint32_t> numbers_;
  BrickGrid<std::uint32_t> positions_{kNoVoid};
};

// Draws the start cells of clusters at random. They lie anywhere in memory, so a batch is drawn and prefetched.
template <class Numbers>
class Starts {
 public:
  /// Takes the positions of all cells of `numbers`, which are all unassigned now.
  Starts(Numbers& numbers, std::uint64_t seed) : numbers_(numbers), dice_(seed), left_(numbers.positions()) {}

  // The next start cell that is still unassigned; nullopt if there is none.
  std::optional<std::size_t> next() {
    for (;;) {
      if (next_ == drawn_.size()) {
        draw();
      }
      if (drawn_.empty()) {
        return std::nullopt;
      }
      if (const std::size_t start = drawn_[next_++]; numbers_[start] == kUnassigned) {
        return start;
      }
    }
  }

 private:
  void draw() {
    constexpr std::size_t kAhead = 64;
    next_ = 0;
    drawn_.clear();
    for (std::size_t left = left_.size(); left > 0 && drawn_.size() < kAhead; --left) {
      drawn_.push_back(dice_.below(left));
      detail::prefetch_to_write(&left_[drawn_.back()]);
    }
    for (std::size_t& drawn : drawn_) {
      drawn = std::exchange(left_[drawn], left_.back());
      left_.pop_back();
      detail::prefetch(&numbers_[drawn]);
    }
  }

  Numbers& numbers_;
  Dice dice_;
  std::vector<std::size_t> left_;   // not drawn yet; initially in raster order
  std::vector<std::size_t> drawn_;  // the current batch; those before `next_` were returned
  std::size_t next_ = 0;
};

// Grows clusters, one after the other, over the unassigned cells.
template <class Numbers>
class Growth {
 public:
  Growth(Numbers& numbers, const VoxelFrame& frame, const VoidClusterOptions& options)
      : numbers_(numbers), frame_(frame), options_(options) {}

  VoidCluster grow(std::size_t start_offset, std::uint32_t number) {
    const VoxelIndex start = numbers_.cell_at(start_offset);
    number_ = number;
    moments_ = CellMoments(start);
    offsets_.clear();
    for (auto& coordinates : members_) {
      coordinates.clear();
    }
    take(start_offset, {start.x, start.y, start.z});
    counted_.members = 0;
    for (std::size_t latest = 0;;) {
      const std::size_t before = offsets_.size();
      add_layer(latest);
      if (offsets_.size() == before) {
        break;
      }
      if (!fits()) {
        give_back(before);
        break;
      }
      latest = before;
    }
    return {start, offsets_.size(), moments_.ellipsoid(frame_), score_now()};
  }

 private:
  using Cell = std::array<std::int32_t, 3>;

  void take(std::size_t offset, const Cell& cell) {
    numbers_[offset] = number_;
    offsets_.push_back(offset);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      members_[axis].push_back(cell[axis]);
    }
    moments_.add({cell[0], cell[1], cell[2]});
  }

  // Adds one layer: the neighbours along x, then the neighbours of all of these along y, then along z. Members before
  // `latest` already have all their neighbours.
  void add_layer(std::size_t latest) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t end = offsets_.size();
      for (std::size_t i = latest; i < end; ++i) {
        take_neighbour(i, axis, 1);
        take_neighbour(i, axis, -1);
      }
    }
  }

  void take_neighbour(std::size_t i, std::size_t axis, std::int32_t step) {
    numbers_.with_neighbour(offsets_[i], axis, members_[axis][i], step, [&](std::size_t offset) {
      if (numbers_[offset] == kUnassigned) {
        Cell cell{members_[0][i], members_[1][i], members_[2][i]};
        cell[axis] += step;
        take(offset, cell);
      }
    });
  }

  void give_back(std::size_t first) {
    for (std::size_t i = first; i < offsets_.size(); ++i) {
      numbers_[offsets_[i]] = kUnassigned;
      moments_.remove({members_[0][i], members_[1][i], members_[2][i]});
    }
    offsets_.resize(first);
    for (auto& coordinates : members_) {
      coordinates.resize(first);
    }
  }

  // The number of members inside the ellipsoid of all members at the time of counting, and inside the smaller
  // ellipsoids scaled by kShares.
  struct Counted {
    std::size_t members = 0;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    std::array<std::int32_t, kShares.size()> inside{};
  };

  void count() {
    counted_.members = offsets_.size();
    counted_.mean = moments_.mean_cells();
    counted_.covariance = moments_.covariance_cells();
    const Eigen::Matrix3d inverse = counted_.covariance.inverse();
    const std::array<double, 3> m{counted_.mean.x(), counted_.mean.y(), counted_.mean.z()};
    const std::array<double, 3> of_squares{inverse(0, 0), inverse(1, 1), inverse(2, 2)};
    const std::array<double, 3> of_products{2.0 * inverse(0, 1), 2.0 * inverse(0, 2), 2.0 * inverse(1, 2)};
    const std::int32_t* const xs = members_[0].data();
    const std::int32_t* const ys = members_[1].data();
    const std::int32_t* const zs = members_[2].data();
    auto& inside = counted_.inside;
    compiled_for(instructions_, [=, &inside, count = offsets_.size()] {
      std::array<std::int32_t, kShares.size()> within{};
      for (std::size_t i = 0; i < count; ++i) {
        const double x = xs[i] - m[0];
        const double y = ys[i] - m[1];
        const double z = zs[i] - m[2];
        const double square = x * (of_squares[0] * x + of_products[0] * y + of_products[1] * z) +
                              y * (of_squares[1] * y + of_products[2] * z) + of_squares[2] * z * z;
        for (std::size_t share = 0; share < within.size(); ++share) {
          within[share] += square <= kVarianceShare * kShares[share] * kShares[share] ? 1 : 0;
        }
      }
      inside = within;
    });
  }

  // A lower bound on the number of members inside the ellipsoid with these moments. It is the count of the largest
  // old, scaled ellipsoid that lies completely inside the new one. In units where the new ellipsoid is the unit ball
  // at 0, an old ellipsoid with scale s reaches at most `longest` * s from its own centre, which is at distance
  // `shift`.
  [[nodiscard]] std::int32_t inside_at_least(const Eigen::Vector3d& mean, const Eigen::Matrix3d& covariance) const {
    constexpr std::size_t kFew = 64;  // below this, counting all members is just as fast
    constexpr double kRounding = 1e-6;
    if (counted_.members < kFew) {
      return 0;
    }
    const Eigen::LLT<Eigen::Matrix3d> root(covariance);
    const Eigen::Matrix3d half = root.matrixL().solve(counted_.covariance);
    const Eigen::Matrix3d shape = root.matrixL().solve(half.transpose());
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(shape, Eigen::EigenvaluesOnly);
    const double longest = std::sqrt(solver.eigenvalues()[2]);
    const double shift = root.matrixL().solve(counted_.mean - mean).norm() / std::sqrt(kVarianceShare);
    for (std::size_t i = 0; i < kShares.size(); ++i) {
      if (shift + longest * kShares[i] <= 1.0 - kRounding) {
        return counted_.inside[i];
      }
    }
    return 0;
  }

  // Equation (2) for this number of members inside the ellipsoid.
  [[nodiscard]] double score(std::int32_t inside, const Eigen::Matrix3d& covariance) const {
    const double variances = covariance.determinant();  // equals the product of the eigenvalues
    const double product = options_.score == FitScore::VolumeRatio
                               ? std::sqrt(std::pow(kVarianceShare, 3) * variances)
                               : variances * std::pow(frame_.size_m, 3);
    return inside / (4.0 / 3.0 * std::numbers::pi * product);
  }

  // The exact score of the current members.
  [[nodiscard]] double score_now() {
    if (counted_.members != offsets_.size()) {
      count();
    }
    return score(counted_.inside[0], counted_.covariance);
  }

  // Whether the score is high enough. The lower bound is tried first, because counting all members after every layer
  // would dominate the run time.
  [[nodiscard]] bool fits() {
    const Eigen::Matrix3d covariance = moments_.covariance_cells();
    return score(inside_at_least(moments_.mean_cells(), covariance), covariance) >= options_.min_score ||
           score_now() >= options_.min_score;
  }

  Numbers& numbers_;
  const VoxelFrame frame_;
  const VoidClusterOptions options_;
  const InstructionSet instructions_ = best_instruction_set();
  std::uint32_t number_ = 0;
  std::vector<std::size_t> offsets_;                  // positions of the members
  std::array<std::vector<std::int32_t>, 3> members_;  // x, y and z of the members
  CellMoments moments_;
  Counted counted_;
};

template <class Numbers>
VoidClusters clusters_of(Numbers numbers, const VoxelFrame& frame, const VoidClusterOptions& options) {
  std::vector<VoidCluster> clusters;
  Growth<Numbers> growth(numbers, frame, options);
  Starts<Numbers> starts(numbers, options.seed);
  const std::vector<std::size_t> positions = numbers.positions();
  while (const auto start = starts.next()) {
    clusters.push_back(growth.grow(*start, static_cast<std::uint32_t>(clusters.size())));
  }
  BrickGrid<std::uint32_t> of_cells(kNoVoid);
  BrickGrid<std::uint32_t>::Writer write(of_cells);
  for (const std::size_t position : positions) {
    write(numbers.cell_at(position)) = numbers[position];
  }
  return {std::move(clusters), std::move(of_cells)};
}

}  // namespace detail

VANTAGE_INLINE VoidClusters::VoidClusters(std::span<const Tile> tiles) {
  for (const auto& [address, clusters] : tiles) {
    at_.place(address) = joined_.size();
    joined_.push_back({clusters, static_cast<std::uint32_t>(clusters_.size())});
    clusters_.insert(clusters_.end(), clusters->clusters_.begin(), clusters->clusters_.end());
  }
}

VANTAGE_INLINE VoidClusters cluster_void_cells(std::span<const VoxelIndex> cells, const VoxelFrame& frame,
                                               const VoidClusterOptions& options) {
  detail::require_option(options.min_score > 0.0, "VoidClusterOptions::min_score", options.min_score, "> 0");
  constexpr double kLoosest = 32.0;  // box cells per void cell, above which SparseNumbers is used
  const VoxelBox box = detail::box_around(cells);
  const VoxelIndex extent = box.extent();
  const bool tight = 1.0 * extent.x * extent.y * extent.z <= kLoosest * static_cast<double>(cells.size());
  return tight ? detail::clusters_of(detail::DenseNumbers(cells, box), frame, options)
               : detail::clusters_of(detail::SparseNumbers(cells), frame, options);
}

}  // namespace vantage
