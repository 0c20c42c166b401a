// SPDX-License-Identifier: MIT
//
// Dornhege & Kleiner 2011, "A Frontier-Void-Based Approach for Autonomous Exploration in 3D", section IV-B.
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vantage/frontier/void_clusters.hpp>
#include <vantage/geometry/cell_moments.hpp>

#include "geometry/box_around.hpp"
#include "geometry/dice.hpp"
#include "map/option_rule.hpp"

namespace vantage {
namespace {

constexpr std::uint32_t kNoVoid = VoidClusters::kNone;
constexpr std::uint32_t kUnassigned = VoidClusters::kNone - 1;

// The variance of a solid ellipsoid along an axis of half length a is a^2 / this.
constexpr double kVarianceShare = 5.0;

// Grows clusters, one after the other, in a grid of the cells that still have none.
class Growth {
 public:
  Growth(VoxelGrid<std::uint32_t>& numbers, const VoxelFrame& frame, const VoidClusterOptions& options)
      : numbers_(numbers), frame_(frame), options_(options) {}

  VoidCluster grow(const VoxelIndex& start, std::uint32_t number) {
    number_ = number;
    members_.clear();
    moments_ = CellMoments(start);
    take(start);
    double score = score_now();
    for (std::size_t latest = 0;;) {
      const std::size_t before = members_.size();
      add_layer(latest);
      if (members_.size() == before) {
        break;
      }
      const double grown = score_now();
      if (grown < options_.min_score) {
        give_back(before);
        break;
      }
      score = grown;
      latest = before;
    }
    return {start, members_.size(), moments_.ellipsoid(frame_), score};
  }

 private:
  void take(const VoxelIndex& cell) {
    numbers_[cell] = number_;
    members_.push_back(cell);
    moments_.add(cell);
  }

  // One cell further on every side: along x, from there along y, from there along z. Members before `latest` have
  // found all their neighbours already.
  void add_layer(std::size_t latest) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t end = members_.size();
      for (std::size_t i = latest; i < end; ++i) {
        for (const VoxelIndex& step : {kFaceNeighbours[2 * axis], kFaceNeighbours[2 * axis + 1]}) {
          const VoxelIndex cell = members_[i] + step;
          if (numbers_.value_or(cell, kNoVoid) == kUnassigned) {
            take(cell);
          }
        }
      }
    }
  }

  void give_back(std::size_t first) {
    for (std::size_t i = first; i < members_.size(); ++i) {
      numbers_[members_[i]] = kUnassigned;
      moments_.remove(members_[i]);
    }
    members_.resize(first);
  }

  // Equation (2) for the members as they are.
  [[nodiscard]] double score_now() const {
    const Eigen::Matrix3d covariance = moments_.covariance_cells();
    const Eigen::Matrix3d inverse = covariance.inverse();
    const Eigen::Vector3d mean = moments_.mean_cells();
    std::size_t inside = 0;
    for (const VoxelIndex& cell : members_) {
      const Eigen::Vector3d off(cell.x - mean.x(), cell.y - mean.y(), cell.z - mean.z());
      inside += off.dot(inverse * off) <= kVarianceShare ? 1U : 0U;
    }
    const double variances = covariance.determinant();  // the product of the eigenvalues
    const double product = options_.score == FitScore::VolumeRatio
                               ? std::sqrt(std::pow(kVarianceShare, 3) * variances)
                               : variances * std::pow(frame_.size_m, 3);
    return static_cast<double>(inside) / (4.0 / 3.0 * std::numbers::pi * product);
  }

  VoxelGrid<std::uint32_t>& numbers_;
  const VoxelFrame frame_;
  const VoidClusterOptions options_;
  std::uint32_t number_ = 0;
  std::vector<VoxelIndex> members_;
  CellMoments moments_;
};

}  // namespace

VoidClusters cluster_void_cells(std::span<const VoxelIndex> cells, const VoxelFrame& frame,
                                const VoidClusterOptions& options) {
  detail::require_option(options.min_score > 0.0, "VoidClusterOptions::min_score", options.min_score, "> 0");
  VoxelGrid<std::uint32_t> numbers(detail::box_around(cells), kNoVoid);
  for (const VoxelIndex& cell : cells) {
    numbers[cell] = kUnassigned;
  }
  // In raster order, whatever the order in which they came.
  std::vector<std::size_t> left;
  left.reserve(cells.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers.values()[i] == kUnassigned) {
      left.push_back(i);
    }
  }
  std::vector<VoidCluster> clusters;
  Growth growth(numbers, frame, options);
  Dice dice(options.seed);
  while (!left.empty()) {
    std::size_t& drawn = left[dice.below(left.size())];
    const std::size_t start = drawn;
    drawn = left.back();
    left.pop_back();
    if (numbers.values()[start] == kUnassigned) {
      clusters.push_back(growth.grow(numbers.cell_at(start), static_cast<std::uint32_t>(clusters.size())));
    }
  }
  return {std::move(clusters), std::move(numbers)};
}

}  // namespace vantage
