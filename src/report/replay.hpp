// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/report/recorded_cycle.hpp>
#include <vantage/report/run_record.hpp>
#include <vector>

#include "report/timed_quads.hpp"

namespace vantage::detail {

/// A record made ready to be looked at: everything knows from which view on and until which it is to be seen.
struct Replay {
  RunRecord run;
  RangeSensor sensor;
  VoxelBox bounds;                                 ///< of every cell below
  std::array<std::vector<TimedQuad>, 6> surfaces;  ///< of occupied cells towards free ones, by direction
  std::array<std::vector<TimedQuad>, 6> voids;     ///< of void cells towards free ones, where a planner counts voids
  std::vector<TimedCell> frontiers;                ///< frontier cells
  std::vector<std::size_t> known_cells;            ///< free or occupied, after each view
  std::vector<RecordedCycle> cycles;               ///< without their changes, one per view
};

/// Reads all of a record; errors as RunRecordReader. Views after the first 65534 are left out.
[[nodiscard]] Replay replay_of(const std::filesystem::path& record);

}  // namespace vantage::detail
