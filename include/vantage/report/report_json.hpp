// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vantage/compiler.hpp>
#include <vantage/report/run_record.hpp>

namespace VANTAGE_EXPORT vantage {

/// Returns the record of a run as one indented JSON object with one line per cycle. The keys are a contract and
/// never change their meaning; a value that is not known is null. Poses are [x, y, z, qx, qy, qz, qw],
/// world_from_sensor, metres, qw >= 0. The planning times cover the views after which a plan was made. `leftover`
/// has the counts of Leftover, and `too_small`: frontier cells given up because they are few together. It is always
/// 0, because no count of cells makes a frontier too small.
[[nodiscard]] std::string report_json(const RunRecord& record);

/// Writes report_json to a file and replaces what was there. Throws std::runtime_error with the path if it cannot
/// be written.
void write_report_json(const RunRecord& record, const std::filesystem::path& file);

}  // namespace vantage
