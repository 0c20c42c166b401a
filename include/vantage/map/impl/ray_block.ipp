// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>
#include <vantage/map/impl/ray_block.hpp>

namespace vantage::detail {

enum class Given : std::uint8_t { Returns, ReturnsOfAnyRange, Directions };

template <Given kGiven>
inline void ends(const RayPlacer& placer, const RayBlock::Points& point, RayBlock& block) {
  const SensorFrame sensor = placer.sensor;
  const double max_range_m = placer.max_range_m;
  const double furthest_m = placer.furthest_m;
  const float* const in = point.data();
  std::int64_t* const fates = block.fate.data();
  double* const x_end = block.end[0].data();
  double* const y_end = block.end[1].data();
  double* const z_end = block.end[2].data();
  VANTAGE_INDEPENDENT
  for (std::size_t i = 0; i < RayBlock::kRays; ++i) {
    double x = in[3 * i];
    double y = in[3 * i + 1];
    double z = in[3 * i + 2];
    const double squared = SensorFrame::squared(x, y, z);
    std::int64_t fate = 0;
    if constexpr (kGiven != Given::ReturnsOfAnyRange) {
      const double range_m = std::sqrt(squared);
      const double shorter = max_range_m / range_m;
      const bool ends_here = kGiven == Given::Returns && range_m <= max_range_m;
      const double scale = ends_here ? 1.0 : shorter;
      x *= scale;
      y *= scale;
      z *= scale;
      constexpr RayFate kBeyond = kGiven == Given::Returns ? RayFate::BeyondRange : RayFate::NoReturn;
      fate = ends_here ? 0 : static_cast<std::int64_t>(kBeyond);
    }
    const double end_x = sensor.world(0, x, y, z);
    const double end_y = sensor.world(1, x, y, z);
    const double end_z = sensor.world(2, x, y, z);
    for (const double end : {end_x, end_y, end_z}) {
      fate = std::abs(end) <= furthest_m ? fate : static_cast<std::int64_t>(RayFate::NotAddressable);
    }
    fate = squared == 0.0 ? static_cast<std::int64_t>(RayFate::ZeroLength) : fate;
    fate = squared <= std::numeric_limits<double>::max() ? fate : static_cast<std::int64_t>(RayFate::NotFinite);
    const bool usable = fate <= static_cast<std::int64_t>(RayFate::NoReturn);
    fates[i] = fate;
    x_end[i] = usable ? end_x : sensor.translation[0];
    y_end[i] = usable ? end_y : sensor.translation[1];
    z_end[i] = usable ? end_z : sensor.translation[2];
  }
}

VANTAGE_INLINE void RayPlacer::place_ends(bool are_returns, RayBlock& block, InstructionSet set) const {
  if (!are_returns) {
    place_ends(block.point, block, set);
  } else if (std::isinf(max_range_m)) {
    compiled_for(set, [&] { ends<Given::ReturnsOfAnyRange>(*this, block.point, block); });
  } else {
    compiled_for(set, [&] { ends<Given::Returns>(*this, block.point, block); });
  }
}

VANTAGE_INLINE void RayPlacer::place_ends(const RayBlock::Points& directions, RayBlock& block,
                                          InstructionSet set) const {
  compiled_for(set, [&] { ends<Given::Directions>(*this, directions, block); });
}

VANTAGE_INLINE void RayPlacer::place_ends(const std::array<RayBlock::PerRay<float>, 3>& directions,
                                          const RayBlock::PerRay<double>& stretch, RayBlock& block,
                                          InstructionSet set) const {
  compiled_for(set, [this, &block, in_x = directions[0].data(), in_y = directions[1].data(),
                     in_z = directions[2].data(), by = stretch.data()] {
    const SensorFrame frame = sensor;
    double* const x_end = block.end[0].data();
    double* const y_end = block.end[1].data();
    double* const z_end = block.end[2].data();
    VANTAGE_INDEPENDENT
    for (std::size_t i = 0; i < RayBlock::kRays; ++i) {
      const double x = in_x[i] * by[i];
      const double y = in_y[i] * by[i];
      const double z = in_z[i] * by[i];
      x_end[i] = frame.world(0, x, y, z);
      y_end[i] = frame.world(1, x, y, z);
      z_end[i] = frame.world(2, x, y, z);
    }
  });
}

// As VoxelFrame::cell_of, without branches and without the clamp, because all ends are addressable.
VANTAGE_INLINE void RayPlacer::place_cells(RayBlock& block, InstructionSet set) const {
  compiled_for(set, [&] {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t i = 0; i < RayBlock::kRays; ++i) {
        const double cell = block.end[axis][i] / size_m;
        const auto towards_zero = static_cast<std::int32_t>(cell);
        block.cell[axis][i] = towards_zero - (towards_zero > cell ? 1 : 0);
      }
    }
  });
}

}  // namespace vantage::detail
