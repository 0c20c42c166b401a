// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vantage/compiler.hpp>

namespace VANTAGE_EXPORT vantage {

/// A run to show on a page.
struct ReportedRun {
  std::string report;            ///< the JSON text of report_json
  std::filesystem::path record;  ///< the record of a RunRecorder, for the replay; empty: only curves and figures
};

/// Writes one HTML page that shows runs: a 3D replay beside curves that follow it. The page opens from disk in any
/// current browser and needs no network. Several runs stand side by side with their curves in one plot and with
/// medians and quartiles by planner. Throws std::invalid_argument if there is no run or a report is not a
/// report_json, std::runtime_error with the path of a file that cannot be read or written.
void write_report_html(std::span<const ReportedRun> runs, const std::filesystem::path& html);

/// Writes the page of one record, finished or not. Throws as above.
void write_report_html(const std::filesystem::path& record, const std::filesystem::path& html);

/// Writes one HTML page of planners beside one another: tables and curves of the JSON text that exploration_json
/// (evaluation/exploration_table.hpp) gives. Throws std::invalid_argument if the text is not such JSON, and
/// std::runtime_error with the path if the page cannot be written.
void write_evaluation_html(const std::string& results, const std::filesystem::path& html);

}  // namespace vantage
