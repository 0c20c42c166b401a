// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vantage/compiler.hpp>

namespace VANTAGE_EXPORT vantage {

/// One run of a page.
struct ReportedRun {
  std::string report;            ///< its report_json
  std::filesystem::path record;  ///< of a RunRecorder, for the replay; empty: curves and numbers only
};

/// One page that shows a run to people: a replay in three dimensions beside curves that follow it. It opens from disk
/// with any browser of today and needs nothing else, no network either. Several runs stand side by side, their curves
/// one upon the other, with medians and quartiles by planner. Throws std::invalid_argument if there is no run or a
/// report is not one, std::runtime_error naming a file that cannot be read or written.
void write_report_html(std::span<const ReportedRun> runs, const std::filesystem::path& html);

/// The page of one record, finished or not: what a robot's night left behind, in the morning.
void write_report_html(const std::filesystem::path& record, const std::filesystem::path& html);

}  // namespace vantage
