// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/report/run_record.hpp>

// Header-only, because the components that make runs use it and the report exports no symbol for it.
namespace vantage::detail {

/// Says in the record of a run what its map refused (RunRecord::cells_refused).
inline void tell_refused(RunRecord& run, const OccupancyMap& map) {
  run.cells_refused = map.cells_refused();
  if (run.cells_refused == 0) {
    return;
  }
  if (run.outcome == RunOutcome::Explored) {
    run.outcome = RunOutcome::Budget;
  }
  run.reason += "; the map is full: it refused " + std::to_string(run.cells_refused) + " updates of cells";
}

}  // namespace vantage::detail
