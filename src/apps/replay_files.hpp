// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/picture/picture.hpp>
#include <vantage/vision/recording.hpp>

#include "apps/replay_run.hpp"
#include "apps/run_recording.hpp"

namespace vantage::apps {

/// Picture of the last frame played: its colours, its depth, and for every planner the map around the height of
/// the sensor with the view chosen next.
[[nodiscard]] Picture frame_sheet(const ReplayRecord& record, const Recording& recording,
                                  const RecordedReading& reading, const OccupancyMap& map);

/// Writes report.json, map.ot, floor_plan.png and report.html (from the record) into `folder`, and lists them with
/// the record and the folder of the frame pictures.
void write_replay_files(const std::filesystem::path& folder, const ReplayRecord& record, const std::string& json,
                        const OccupancyMap& map, const RunRecording& recording, OutputFiles& files);

}  // namespace vantage::apps
