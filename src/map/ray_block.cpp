// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <map/ray_block.hpp>

namespace vantage {
namespace {

template <bool kLimited>
inline void ends(const RayPlacer& placer, RayFate beyond, RayBlock& block) {
  const SensorFrame sensor = placer.sensor;
  const double max_range_m = placer.max_range_m;
  const double furthest_m = placer.furthest_m;
  const double furthest_hit_m = beyond == RayFate::BeyondRange ? max_range_m : -1.0;
  for (std::size_t i = 0; i < RayBlock::kRays; ++i) {
    double x = block.point[3 * i];
    double y = block.point[3 * i + 1];
    double z = block.point[3 * i + 2];
    const double squared = SensorFrame::squared(x, y, z);
    std::int64_t fate = 0;
    if constexpr (kLimited) {
      const double range_m = std::sqrt(squared);
      const bool ends_here = range_m <= furthest_hit_m;
      const double shorter = max_range_m / range_m;
      const double scale = ends_here ? 1.0 : shorter;
      x *= scale;
      y *= scale;
      z *= scale;
      fate = ends_here ? 0 : static_cast<std::int64_t>(beyond);
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
    block.fate[i] = fate;
    block.end[0][i] = usable ? end_x : sensor.translation[0];
    block.end[1][i] = usable ? end_y : sensor.translation[1];
    block.end[2][i] = usable ? end_z : sensor.translation[2];
  }
}

}  // namespace

void RayPlacer::place_ends(bool are_returns, RayBlock& block, InstructionSet set) const {
  const RayFate beyond = are_returns ? RayFate::BeyondRange : RayFate::NoReturn;
  if (are_returns && std::isinf(max_range_m)) {
    compiled_for(set, [&] { ends<false>(*this, beyond, block); });
  } else {
    compiled_for(set, [&] { ends<true>(*this, beyond, block); });
  }
}

// VoxelFrame::cell_of, without a branch.
void RayPlacer::place_cells(RayBlock& block, InstructionSet set) const {
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

}  // namespace vantage
