// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vantage/field/laplace_domain.hpp>
#include <vector>

#include "field/fine_kernels.hpp"

namespace vantage::detail {

/// Where a cell is stored.
struct CellPlace {
  std::size_t brick;   ///< number in the fine level
  std::size_t colour;
  std::size_t offset;  ///< among the cells of its colour in the brick

  /// `cell` must lie in a brick of the domain.
  [[nodiscard]] static CellPlace of(const LaplaceDomain& domain, const VoxelIndex& cell);
};

/// How far a solution is from solving its equations.
struct Defect {
  double norm = 0.0;         ///< Euclidean
  double largest = 0.0;      ///< of the cells where the solution is too low
  std::size_t stuck = 0;     ///< cells without a strictly lower neighbour
};

/// The solution in double, and its residual: the outer loop of mixed precision refinement.
class Refinement {
 public:
  /// A unit source in the cell `source`, `uniform` in every cell.
  Refinement(const FineLevel& fine, const CellPlace& source, double uniform);

  /// Adds `scale * correction` to the black cells, solves for the red ones, and looks for cells without a lower
  /// neighbour among the values divided by that of the source.
  Defect update(const FineLevel& fine, const HalfField<float>& correction, double scale);
  /// Writes the residual of the black cells, times `scale`.
  void residual(const FineLevel& fine, double scale, HalfField<float>& out) const;

  /// Value of a cell, 1 at the source; 0 where there is no unknown.
  [[nodiscard]] double value(const CellPlace& place) const {
    return u_[place.colour][place.brick * kHalfBrick + place.offset] * per_source_;
  }
  [[nodiscard]] std::size_t memory_bytes() const { return bytes_of(u_[0]) + bytes_of(u_[1]) + bytes_of(partial_); }

 private:
  struct Partial {
    double square;
    double largest;
    std::int64_t stuck;
  };
  [[nodiscard]] double source_value(const FineLevel& fine) const;

  std::array<HalfField<double>, 2> u_;
  CellPlace source_;
  double uniform_;
  double per_source_ = 1.0;
  std::vector<Partial> partial_;  // per brick
};

}  // namespace vantage::detail
