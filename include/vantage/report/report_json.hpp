// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vantage/compiler.hpp>
#include <vantage/report/run_record.hpp>

namespace VANTAGE_EXPORT vantage {

/// The record of a run as one JSON object, indented, with a line per cycle. Its keys are a contract and never change
/// meaning; what is not known is null. Poses are [x, y, z, qx, qy, qz, qw], world_from_sensor, with qw >= 0. The
/// times of planning are over the views after which a plan was made.
[[nodiscard]] std::string report_json(const RunRecord& record);

/// Writes report_json to a file, replacing it. Throws std::runtime_error naming the file if it cannot be written.
void write_report_json(const RunRecord& record, const std::filesystem::path& file);

}  // namespace vantage
