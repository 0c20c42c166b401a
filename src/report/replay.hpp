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

/// A record prepared for display: every item has the view at which it appears and the view at which it disappears.
struct Replay {
  RunRecord run;
  RangeSensor sensor;
  VoxelBox bounds;                                 ///< box of all cells below
  std::array<std::vector<TimedQuad>, 6> surfaces;  ///< faces of occupied cells towards free ones, by direction
  std::array<std::vector<TimedQuad>, 6>
      voids;                             ///< faces of void cells towards free ones; only if the planner counts voids
  std::vector<TimedCell> frontiers;      ///< frontier cells
  std::vector<std::size_t> known_cells;  ///< free and occupied cells after each view
  std::vector<RecordedCycle> cycles;     ///< one per view, without `changes`
};

/// Reads a whole record. Views after the first 65534 are left out. Throws as RunRecordReader.
[[nodiscard]] Replay replay_of(const std::filesystem::path& record);

}  // namespace vantage::detail
