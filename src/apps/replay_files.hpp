// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/vision/picture.hpp>
#include <vantage/vision/recording.hpp>
#include <vector>

#include "apps/replay_run.hpp"

namespace vantage::apps {

/// The last frame played: its colours, its depth, and for every planner the map about the sensor's height with the
/// view chosen next.
[[nodiscard]] Picture frame_sheet(const ReplayRecord& record, const Recording& recording,
                                  const RecordedReading& reading, const OccupancyMap& map);

/// Writes report.json, map.ot, floor_plan.png and known.png (cells known over frames) into a folder, which is made;
/// returns the files in order. Throws std::runtime_error naming what cannot be written.
std::vector<std::filesystem::path> write_replay_files(const std::filesystem::path& folder, const ReplayRecord& record,
                                                      const std::string& json, const OccupancyMap& map);

/// Writes a text. Throws std::runtime_error naming the file.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace vantage::apps
