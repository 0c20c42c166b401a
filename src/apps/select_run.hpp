// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vantage/vision/recording.hpp>
#include <vector>

#include "apps/progress_stream.hpp"
#include "apps/replay_request.hpp"

namespace vantage::apps {

/// `vantage replay --select`: in which order would planners have taken the recorded views, and how soon would they
/// have known what there is to know? Compares them with the recorded order, views spread evenly, random orders and
/// the greedy order of one who has seen all; prints a table, and writes selection.json and selection.png where an
/// --out is given. Returns the exit code; throws std::runtime_error if no frame can be read.
[[nodiscard]] int select_views(const ReplayRequest& request, const Recording& recording, ProgressStream& told);

}  // namespace vantage::apps
