// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vantage/vision/recording.hpp>
#include <vector>

#include "apps/progress_stream.hpp"
#include "apps/replay_request.hpp"

namespace vantage::apps {

/// Runs `vantage replay --select`: how soon would everything have been known with the recorded views in another
/// order? Compares the order by expected cells with that by unknown cells, the recorded order, evenly spread views,
/// random orders and the greedy order with full knowledge. Prints a table; with --out it writes selection.json.
/// Returns the exit code. Throws std::runtime_error if no frame can be read.
[[nodiscard]] int select_views(const ReplayRequest& request, const Recording& recording, ProgressStream& told);

}  // namespace vantage::apps
