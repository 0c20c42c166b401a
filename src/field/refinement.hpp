// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vantage/field/laplace_domain.hpp>
#include <vector>

#include "field/fine_kernels.hpp"

namespace vantage::detail {

/// Where a cell is stored.
struct CellPlace {
  std::size_t brick;  ///< number in the fine level
  std::size_t colour;
  std::size_t offset;  ///< among the cells of its colour in the brick

  /// `cell` must lie in a brick of the domain.
  [[nodiscard]] static CellPlace of(const LaplaceDomain& domain, const VoxelIndex& cell);
};

/// A solution, not yet divided by its value at the source.
struct CellValues {
  std::array<HalfField<double>, 2> u;  ///< by colour
  double at_source = 1.0;              ///< value at the source

  /// Value of a cell, 1 at the source; 0 where there is no unknown.
  [[nodiscard]] double at(const CellPlace& place) const {
    return u[place.colour][place.brick * kHalfBrick + place.offset] / at_source;
  }
  [[nodiscard]] std::size_t memory_bytes() const { return bytes_of(u[0]) + bytes_of(u[1]); }
};

/// How many unknowns have no strictly lower neighbour once all values are divided by that of the source.
[[nodiscard]] std::size_t count_stuck(const FineLevel& fine, const CellValues& values);

/// How far a solution is from solving its equations.
struct Defect {
  double norm = 0.0;      ///< Euclidean
  double largest = 0.0;   ///< of the cells where the solution is too low
  bool checked = true;    ///< whether these were looked for:
  std::size_t stuck = 0;  ///< cells without a strictly lower neighbour
};

/// The solution in double, and its residual: the outer loop of mixed precision refinement.
class Refinement {
 public:
  /// A unit source in the cell `source`, `uniform` in every cell.
  Refinement(const FineLevel& fine, const CellPlace& source, double uniform);

  /// What is to be added to the black cells, in units of `unit`.
  struct Step {
    const HalfField<float>& correction;
    double unit;
  };
  /// Where the residual of the black cells goes, in units of `unit`: about what it is expected to be.
  struct Remainder {
    HalfField<float>& residual;
    double unit;
  };
  /// Takes the step, solves for the red cells and takes the residual; if it is to `check`, looks for cells without a
  /// lower neighbour among the values divided by that of the source.
  Defect update(const FineLevel& fine, const Step& step, const Remainder& remainder, bool check);

  /// The solution, which is no longer here after it.
  [[nodiscard]] CellValues take() { return std::move(values_); }
  [[nodiscard]] std::size_t memory_bytes() const { return values_.memory_bytes() + bytes_of(partial_); }

 private:
  struct Partial {
    double square;
    double largest;
    double stuck;
  };
  template <bool checked>
  void pass(const FineLevel& fine, const Step& step, const Remainder& remainder);
  [[nodiscard]] double source_value(const FineLevel& fine, const Step& step) const;

  CellValues values_;
  CellPlace source_;
  double uniform_;
  std::vector<Partial> partial_;  // per brick
};

}  // namespace vantage::detail
