// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <vantage/field/impl/cell_values.hpp>
#include <vantage/field/impl/fine_kernels.hpp>

namespace vantage::detail {

/// The number of unknowns without a strictly lower neighbour, after all values are divided by that of the source.
[[nodiscard]] std::size_t count_stuck(const FineLevel& fine, const CellValues& values);

/// The error of a solution in its equations.
struct Defect {
  double norm = 0.0;      ///< Euclidean norm of the residual
  double largest = 0.0;   ///< largest residual of a cell where the solution is too low
  bool checked = true;    ///< whether stuck cells were counted
  std::size_t stuck = 0;  ///< cells without a strictly lower neighbour
};

/// The solution in double precision and its residual: the outer loop of mixed precision refinement.
class Refinement {
 public:
  /// The right hand side is 1 in the cell `source`, plus `uniform` in every cell.
  Refinement(const FineLevel& fine, const CellPlace& source, double uniform);

  /// The correction of the black cells, in units of `unit`.
  struct Step {
    const HalfField<float>& correction;
    double unit;
  };
  /// Receives the residual of the black cells, divided by `unit`, which should be close to its expected norm.
  struct Remainder {
    HalfField<float>& residual;
    double unit;
  };
  /// Adds the step, solves for the red cells and computes the residual. If `check` is true, also counts the cells
  /// without a strictly lower neighbour after division by the value at the source.
  Defect update(const FineLevel& fine, const Step& step, const Remainder& remainder, bool check);

  /// Moves the solution out.
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

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/field/impl/refinement.ipp>
#endif
