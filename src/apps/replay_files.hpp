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

/// Writes report.json, map.ot, floor_plan.png, known.png (cells known over frames) and, of the record that the replay
/// left, report.html into a folder, which is made; returns the files in order, the record and the folder of the
/// frames' pictures among them. Throws std::runtime_error naming what cannot be written.
std::vector<std::filesystem::path> write_replay_files(const std::filesystem::path& folder, const ReplayRecord& record,
                                                      const std::string& json, const OccupancyMap& map,
                                                      const std::filesystem::path& run_record);

}  // namespace vantage::apps
