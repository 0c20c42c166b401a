// SPDX-License-Identifier: MIT
#include "field/refinement.hpp"

#include <algorithm>
#include <cmath>

namespace vantage::detail {
namespace {

using Mask = Lanes<std::int64_t>;

// The right hand side: the same everywhere but in one cell, if that is in this half of a brick.
struct Load {
  double uniform;
  std::size_t source_row;   // none: past the last row
  std::size_t source_lane;

  Load(const CellPlace& source, std::size_t brick, std::size_t colour, double each)
      : uniform(each), source_row(source.brick == brick && source.colour == colour ? source.offset / 8 : kBrickRows),
        source_lane(source.offset % 8) {}
  [[nodiscard]] VANTAGE_INLINE Lanes<double> at(std::size_t row) const {
    Lanes<double> lanes = all(uniform);
    if (row == source_row) {
      lanes[source_lane] += 1.0;
    }
    return lanes;
  }
};

// One for each cell that has no strictly lower neighbour once all values are multiplied by `scale`. A value of 0 is that
// of a sink, a lower neighbour that `beside_sink` knows of, or stands behind a closed face.
VANTAGE_INLINE Mask stuck_cells(const Lanes<double>& own, const SixNeighbours<double>& neighbours, std::uint8_t beside_sink,
                                const Lanes<double>& degree, double scale) {
  const Mask lane_bit{1, 2, 4, 8, 16, 32, 64, 128};
  const Lanes<double> scaled = own * scale;
  Mask lower = ((all<std::int64_t>(beside_sink) & lane_bit) != 0) & (scaled > 0.0);
  for (const Lanes<double>& neighbour : neighbours.at) {
    lower |= (neighbour > 0.0) & (neighbour * scale < scaled);
  }
  return (degree > 0.0) & ~lower & 1;
}

struct RedUpdate {
  const std::uint8_t* degree;
  const std::uint8_t* beside_sink;
  Around<double> black;
  double* red;
  Load load_of;
  double scale;
  std::int64_t* stuck;

  VANTAGE_INLINE void operator()() const {
    Mask count{};
    for (std::size_t row = 0; row < kBrickRows; ++row) {
      const Lanes<double> faces = widen<double>(degree + row * 8);
      const SixNeighbours<double> beside = neighbours<kRed>(black, row);
      const Lanes<double> solved = faces > 0.0 ? (beside.sum() + load_of.at(row)) / faces : Lanes<double>{};
      store<double>(red + row * 8, solved);
      count += stuck_cells(solved, beside, beside_sink[row], faces, scale);
    }
    *stuck = sum_of<std::int64_t>(count);
  }
};

struct BlackDefect {
  const std::uint8_t* degree;
  const std::uint8_t* beside_sink;
  const double* black;
  Around<double> red;
  Load load_of;
  double scale;
  double* square;
  double* largest;
  std::int64_t* stuck;

  VANTAGE_INLINE void operator()() const {
    Lanes<double> sum{};
    Lanes<double> most{};
    Mask count{};
    for (std::size_t row = 0; row < kBrickRows; ++row) {
      const Lanes<double> faces = widen<double>(degree + row * 8);
      const Lanes<double> own = load(black + row * 8);
      const SixNeighbours<double> beside = neighbours<kBlack>(red, row);
      const Lanes<double> all_cells = load_of.at(row) - (faces * own - beside.sum());
      const Lanes<double> residual = faces > 0.0 ? all_cells : Lanes<double>{};
      sum += residual * residual;
      most = residual > most ? residual : most;
      count += stuck_cells(own, beside, beside_sink[row], faces, scale);
    }
    *square = sum_of<double>(sum);
    *largest = most[0];
    for (std::size_t lane = 1; lane < kLanes; ++lane) {
      *largest = most[lane] > *largest ? most[lane] : *largest;
    }
    *stuck += sum_of<std::int64_t>(count);
  }
};

struct BlackResidual {
  const std::uint8_t* degree;
  const double* black;
  Around<double> red;
  Load load_of;
  double scale;
  float* out;

  VANTAGE_INLINE void operator()() const {
    for (std::size_t row = 0; row < kBrickRows; ++row) {
      const Lanes<double> faces = widen<double>(degree + row * 8);
      const Lanes<double> residual =
          load_of.at(row) - (faces * load(black + row * 8) - neighbours<kBlack>(red, row).sum());
      const Lanes<double> kept = faces > 0.0 ? scale * residual : Lanes<double>{};
      store<float>(out + row * 8, __builtin_convertvector(kept, Lanes<float>));
    }
  }
};

struct Add {
  const float* correction;
  double scale;
  double* black;

  VANTAGE_INLINE void operator()() const {
    for (std::size_t at = 0; at < kHalfBrick; at += kLanes) {
      const Lanes<double> step = __builtin_convertvector(load(correction + at), Lanes<double>);
      store<double>(black + at, load(black + at) + scale * step);
    }
  }
};

}  // namespace

CellPlace CellPlace::of(const LaplaceDomain& domain, const VoxelIndex& cell) {
  const std::size_t row = LaplaceDomain::row_of(cell);
  const auto x = static_cast<std::size_t>(cell.x & 15);
  return {domain.position_of_brick(cell) + std::size_t{1}, colour_of(row, x), half_offset(row, x)};
}

Refinement::Refinement(const FineLevel& fine, const CellPlace& source, double uniform)
    : source_(source), uniform_(uniform), partial_(fine.brick_count, Partial{}) {
  u_[kRed].assign(fine.brick_count * kHalfBrick, 0.0);
  u_[kBlack].assign(fine.brick_count * kHalfBrick, 0.0);
}

// What the value at the source is as soon as the red cells are solved for.
double Refinement::source_value(const FineLevel& fine) const {
  if (source_.colour == kBlack) {
    return u_[kBlack][source_.brick * kHalfBrick + source_.offset];
  }
  const std::size_t row = source_.offset / 8;
  const Lanes<double> sum =
      neighbours<kRed>(Around<double>(fine, u_[kBlack], source_.brick), row).sum() +
      Load(source_, source_.brick, kRed, uniform_).at(row);
  return sum[source_.offset % 8] / static_cast<double>(fine.degree[kRed][source_.brick * kHalfBrick + source_.offset]);
}

Defect Refinement::update(const FineLevel& fine, const HalfField<float>& correction, double scale) {
  for (std::size_t b = 1; b < fine.brick_count; ++b) {
    run(Add{correction.data() + b * kHalfBrick, scale, u_[kBlack].data() + b * kHalfBrick});
  }
  per_source_ = 1.0 / source_value(fine);
  in_waves(
      fine, [](std::size_t) {},
      [&](std::size_t b) {
        run(RedUpdate{fine.degree[kRed].data() + b * kHalfBrick, fine.beside_sink[kRed].data() + b * kBrickRows,
                      Around<double>(fine, u_[kBlack], b), u_[kRed].data() + b * kHalfBrick,
                      Load(source_, b, kRed, uniform_), per_source_, &partial_[b].stuck});
      },
      [&](std::size_t b) {
        run(BlackDefect{fine.degree[kBlack].data() + b * kHalfBrick, fine.beside_sink[kBlack].data() + b * kBrickRows,
                        u_[kBlack].data() + b * kHalfBrick, Around<double>(fine, u_[kRed], b),
                        Load(source_, b, kBlack, uniform_), per_source_, &partial_[b].square, &partial_[b].largest,
                        &partial_[b].stuck});
      });
  Defect defect;
  for (const Partial& partial : partial_) {
    defect.norm += partial.square;
    defect.largest = std::max(defect.largest, partial.largest);
    defect.stuck += static_cast<std::size_t>(partial.stuck);
  }
  defect.norm = std::sqrt(defect.norm);
  return defect;
}

void Refinement::residual(const FineLevel& fine, double scale, HalfField<float>& out) const {
  for (std::size_t b = 1; b < fine.brick_count; ++b) {
    run(BlackResidual{fine.degree[kBlack].data() + b * kHalfBrick, u_[kBlack].data() + b * kHalfBrick,
                      Around<double>(fine, u_[kRed], b), Load(source_, b, kBlack, uniform_), scale,
                      out.data() + b * kHalfBrick});
  }
}

}  // namespace vantage::detail
