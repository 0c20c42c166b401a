// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/field/impl/refinement.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vantage::detail {

// The right hand side of one colour of a brick: uniform, plus 1 in the source cell if that belongs to it.
struct Load {
  double uniform;
  std::size_t source_row;  // kBrickRows if the source is not here
  std::size_t source_lane;

  Load(const CellPlace& source, std::size_t brick, std::size_t colour, double each)
      : uniform(each),
        source_row(source.brick == brick && source.colour == colour ? source.offset / 8 : kBrickRows),
        source_lane(source.offset % 8) {}
  [[nodiscard]] VANTAGE_ALWAYS_INLINE Lanes<double> at(std::size_t row) const {
    Lanes<double> lanes = all(uniform);
    if (row == source_row) {
      lanes[source_lane] += 1.0;
    }
    return lanes;
  }
};

// The value of the lowest neighbour of each cell. A neighbour value of 0 is ignored: it belongs to a closed face, or
// to a sink, which `faces` marks.
VANTAGE_ALWAYS_INLINE Lanes<double> lowest_of(const SixNeighbours<double>& neighbours, std::uint32_t faces) {
  const Lanes<double> none = all(std::numeric_limits<double>::max());
  Lanes<double> lowest = none;
  for (const Lanes<double>& neighbour : neighbours.at) {
    const Lanes<double> there = neighbour > 0.0 ? neighbour : none;
    lowest = there < lowest ? there : lowest;
  }
  return lowest * (1.0 - 0.125 * widen<double>(faces, kBesideSink));
}

// 1 for each cell without a strictly lower neighbour after all values are divided by `at_source`, otherwise 0.
VANTAGE_ALWAYS_INLINE Lanes<double> stuck_cells(const Lanes<double>& own, const SixNeighbours<double>& neighbours,
                                                std::uint32_t faces, double at_source) {
  const Lanes<double> lowest = lowest_of(neighbours, faces);
  const Lanes<double> stuck = lowest / at_source < own / at_source ? Lanes<double>{} : all(1.0);
  return widen<double>(faces, kDegree) > 0.0 ? stuck : Lanes<double>{};
}

// A fast version of the same test without divisions. It is conservative: cells nearly equal to their lowest neighbour
// are in doubt and must be tested exactly. A quotient has a relative rounding error below 2^-52. That does not hold
// below `least_`, so there every cell is in doubt.
class Doubt {
 public:
  explicit Doubt(double at_source)
      : least_(at_source > 0.0 ? 1e-290 * at_source : std::numeric_limits<double>::infinity()) {}
  // >= 0 for cells in doubt.
  [[nodiscard]] VANTAGE_ALWAYS_INLINE Lanes<double> about(const Lanes<double>& own, const Lanes<double>& degree,
                                                          const SixNeighbours<double>& neighbours,
                                                          std::uint32_t faces) const {
    const Lanes<double> lowest = lowest_of(neighbours, faces);
    const Lanes<double> bound = lowest > least_ ? lowest : all(least_);
    const Lanes<double> doubt = bound - own * (1.0 - 0x1p-50);
    return degree > 0.0 ? doubt : all(-1.0);
  }

 private:
  double least_;
};

// The larger of two values per lane; below, the largest of all lanes.
VANTAGE_ALWAYS_INLINE Lanes<double> larger(const Lanes<double>& a, const Lanes<double>& b) { return a > b ? a : b; }
VANTAGE_ALWAYS_INLINE double largest_of(const Lanes<double>& lanes) {
  double largest = lanes[0];
  for (std::size_t lane = 1; lane < kLanes; ++lane) {
    largest = lanes[lane] > largest ? lanes[lane] : largest;
  }
  return largest;
}

template <bool checked>
struct RedUpdate {
  const std::uint32_t* faces;
  Around<double> black;
  double* red;
  Load load_of;
  Doubt doubt;
  double* doubtful;

  VANTAGE_ALWAYS_INLINE void operator()() const {
    Lanes<double> most_doubt = all(-1.0);
    for (std::size_t row = 0; row < kBrickRows; ++row) {
      const Lanes<double> degree = widen<double>(faces[row], kDegree);
      const SixNeighbours<double> beside = neighbours<kRed>(black, row);
      const Lanes<double> solved = degree > 0.0 ? (beside.sum() + load_of.at(row)) / degree : Lanes<double>{};
      store<double>(red + row * 8, solved);
      if constexpr (checked) {
        most_doubt = larger(most_doubt, doubt.about(solved, degree, beside, faces[row]));
      }
    }
    *doubtful = largest_of(most_doubt);
  }
};

template <bool checked>
struct BlackDefect {
  const std::uint32_t* faces;
  const double* black;
  Around<double> red;
  Load load_of;
  Doubt doubt;
  double scale;
  float* out;  // the residual times `scale`
  double* square;
  double* largest;
  double* doubtful;

  VANTAGE_ALWAYS_INLINE void operator()() const {
    Lanes<double> sum{};
    Lanes<double> most{};
    Lanes<double> most_doubt = all(-1.0);
    for (std::size_t row = 0; row < kBrickRows; ++row) {
      const Lanes<double> degree = widen<double>(faces[row], kDegree);
      const Lanes<double> own = load(black + row * 8);
      const SixNeighbours<double> beside = neighbours<kBlack>(red, row);
      const Lanes<double> all_cells = load_of.at(row) - (degree * own - beside.sum());
      const Lanes<double> residual = degree > 0.0 ? all_cells : Lanes<double>{};
      store<float>(out + row * 8, __builtin_convertvector(scale * residual, Lanes<float>));
      sum += residual * residual;
      most = larger(most, residual);
      if constexpr (checked) {
        most_doubt = larger(most_doubt, doubt.about(own, degree, beside, faces[row]));
      }
    }
    *square = sum_of<double>(sum);
    *largest = largest_of(most);
    *doubtful = largest_of(most_doubt);
  }
};

struct Add {
  const float* correction;
  double scale;
  double* black;

  VANTAGE_ALWAYS_INLINE void operator()() const {
    for (std::size_t at = 0; at < kHalfBrick; at += kLanes) {
      const Lanes<double> step = __builtin_convertvector(load(correction + at), Lanes<double>);
      store<double>(black + at, load(black + at) + scale * step);
    }
  }
};

struct CountStuck {
  const std::uint32_t* faces;
  const double* own;
  double at_source;
  double* stuck;

  template <std::size_t colour>
  VANTAGE_ALWAYS_INLINE void over(const Around<double>& other) const {
    Lanes<double> count{};
    for (std::size_t row = 0; row < kBrickRows; ++row) {
      count += stuck_cells(load(own + row * 8), neighbours<colour>(other, row), faces[row], at_source);
    }
    *stuck = sum_of<double>(count);
  }
};

template <std::size_t colour>
struct CountStuckOf {
  CountStuck count;
  Around<double> other;

  VANTAGE_ALWAYS_INLINE void operator()() const { count.over<colour>(other); }
};

// The number of stuck cells of one colour in a brick.
template <std::size_t colour>
double stuck_in(const FineLevel& fine, const CellValues& values, std::size_t brick) {
  double stuck = 0.0;
  compiled_for(fine.set,
               CountStuckOf<colour>{{fine.faces[colour].data() + brick * kBrickRows,
                                     values.u[colour].data() + brick * kHalfBrick, values.at_source, &stuck},
                                    Around<double>(fine, values.u[1 - colour], brick)});
  return stuck;
}

VANTAGE_INLINE std::size_t count_stuck(const FineLevel& fine, const CellValues& values) {
  double stuck = 0.0;
  for (std::size_t b = 1; b < fine.brick_count; ++b) {
    stuck += stuck_in<kRed>(fine, values, b) + stuck_in<kBlack>(fine, values, b);
  }
  return static_cast<std::size_t>(stuck);
}

VANTAGE_INLINE Refinement::Refinement(const FineLevel& fine, const CellPlace& source, double uniform)
    : source_(source), uniform_(uniform), partial_(fine.brick_count, Partial{}) {
  make_room(fine, values_.u[kRed], kHalfBrick);
  clear(fine, values_.u[kBlack], kHalfBrick);
}

// Computes the value that the source cell will have after the step, on copies of its brick and the neighbours.
VANTAGE_INLINE double Refinement::source_value(const FineLevel& fine, const Step& step) const {
  const auto stepped = [&](std::size_t brick, std::size_t i) {
    return values_.u[kBlack][brick * kHalfBrick + i] +
           step.unit * static_cast<double>(step.correction[brick * kHalfBrick + i]);
  };
  if (source_.colour == kBlack) {
    return stepped(source_.brick, source_.offset);
  }
  HalfField<double> black(7 * kHalfBrick);
  Around<double> around{black.data(), {}};
  for (std::size_t n = 0; n < 7; ++n) {
    const std::size_t brick = n < 6 ? fine.links[source_.brick][n] : source_.brick;
    for (std::size_t i = 0; i < kHalfBrick; ++i) {
      black[n * kHalfBrick + i] = stepped(brick, i);
    }
    (n < 6 ? around.side[n] : around.own) = black.data() + n * kHalfBrick;
  }
  const Lanes<double> sum = neighbours<kRed>(around, source_.offset / 8).sum() +
                            Load(source_, source_.brick, kRed, uniform_).at(source_.offset / 8);
  return sum[source_.offset % 8] / fine.degree(kRed, source_.brick, source_.offset);
}

template <bool checked>
void Refinement::pass(const FineLevel& fine, const Step& step, const Remainder& remainder) {
  in_waves(
      fine,
      [&](std::size_t b) {
        compiled_for(fine.set, Add{step.correction.data() + b * kHalfBrick, step.unit,
                                   values_.u[kBlack].data() + b * kHalfBrick});
      },
      [&](std::size_t b) {
        double doubtful = -1.0;
        compiled_for(
            fine.set,
            RedUpdate<checked>{fine.faces[kRed].data() + b * kBrickRows, Around<double>(fine, values_.u[kBlack], b),
                               values_.u[kRed].data() + b * kHalfBrick, Load(source_, b, kRed, uniform_),
                               Doubt(values_.at_source), &doubtful});
        partial_[b].stuck = doubtful >= 0.0 ? stuck_in<kRed>(fine, values_, b) : 0.0;
      },
      [&](std::size_t b) {
        double doubtful = -1.0;
        compiled_for(fine.set, BlackDefect<checked>{fine.faces[kBlack].data() + b * kBrickRows,
                                                    values_.u[kBlack].data() + b * kHalfBrick,
                                                    Around<double>(fine, values_.u[kRed], b),
                                                    Load(source_, b, kBlack, uniform_), Doubt(values_.at_source),
                                                    1.0 / remainder.unit, remainder.residual.data() + b * kHalfBrick,
                                                    &partial_[b].square, &partial_[b].largest, &doubtful});
        partial_[b].stuck += doubtful >= 0.0 ? stuck_in<kBlack>(fine, values_, b) : 0.0;
      });
}

VANTAGE_INLINE Defect Refinement::update(const FineLevel& fine, const Step& step, const Remainder& remainder,
                                         bool check) {
  values_.at_source = source_value(fine, step);
  if (check) {
    pass<true>(fine, step, remainder);
  } else {
    pass<false>(fine, step, remainder);
  }
  Defect defect;
  for (const Partial& partial : partial_) {
    defect.norm += partial.square;
    defect.largest = std::max(defect.largest, partial.largest);
    defect.stuck += static_cast<std::size_t>(partial.stuck);
  }
  defect.norm = std::sqrt(defect.norm);
  defect.checked = check;
  if (check && !std::isfinite(defect.norm)) {
    defect.stuck = count_stuck(fine, values_);  // the doubt test does not catch NaN, so count exactly
  }
  return defect;
}

}  // namespace vantage::detail
