// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <vantage/field/potential.hpp>

#include <vantage/field/impl/cell_values.hpp>

namespace vantage {

VANTAGE_INLINE Potential::Potential(LaplaceDomain domain, const VoxelIndex& source, detail::CellValues&& values)
    : domain_(std::move(domain)), source_(source), values_(std::make_shared<detail::CellValues>(std::move(values))) {}

VANTAGE_INLINE Potential::Potential(const LaplaceProblem& problem, std::span<const double> phi)
    : domain_(problem), source_(problem.cell(problem.source())) {
  if (phi.size() != problem.size()) {
    throw std::invalid_argument("Potential: " + std::to_string(phi.size()) + " values for " +
                                std::to_string(problem.size()) + " cells");
  }
  detail::CellValues values;
  for (detail::HalfField<double>& half : values.u) {
    half.resize((domain_.bricks().size() + 1) * detail::kHalfBrick);
  }
  for (std::size_t i = 0; i < phi.size(); ++i) {
    const detail::CellPlace place(domain_, problem.cells()[i]);
    values.u[place.colour][place.brick * detail::kHalfBrick + place.offset] = phi[i];
  }
  values_ = std::make_shared<detail::CellValues>(std::move(values));
}

VANTAGE_INLINE std::optional<double> Potential::at(const VoxelIndex& cell) const {
  const std::uint32_t position = domain_.position_of_brick(cell);
  const std::size_t row = LaplaceDomain::row_of(cell);
  if (position == LaplaceDomain::kNone ||
      (domain_.bricks()[position].cells[row] & LaplaceDomain::bit_of(cell)) == 0) {
    return std::nullopt;
  }
  return values_ ? values_->at({position, row, static_cast<std::size_t>(cell.x & 15)}) : 1.0;
}

}  // namespace vantage
