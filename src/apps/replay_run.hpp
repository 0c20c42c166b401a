// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/report/run_record.hpp>
#include <vantage/robot/platform.hpp>
#include <vantage/vision/recording.hpp>
#include <vector>

namespace vantage::apps {

/// A plan and the time it took.
struct TimedPlan {
  std::string planner;
  Plan plan;
  double plan_ms = 0.0;
};

/// One frame that was played.
struct ReplayedFrame {
  std::size_t frame = 0;  // number in the recording
  ScanReport scan;
  DepthReport depth;
  std::size_t free_cells = 0;
  std::size_t occupied_cells = 0;
  std::size_t frontier_cells = 0;
  std::size_t void_cells = 0;
  std::vector<TimedPlan> plans;  // in the order of the planners
};

/// Result of `replay`.
struct ReplayRecord {
  RunRecord run;  // with the plans of the first planner
  std::vector<ReplayedFrame> frames;
  std::vector<SkippedFrame> skipped;  // frames that the recording left out or that could not be read
  bool to_the_end = true;             // false: max_views or `stop` ended it
};

/// Called for each frame once it is in the map.
using OnFrame = std::function<void(const ReplayRecord&, const RecordedReading&, const OccupancyMap&)>;

/// Which frames are played.
struct ReplaySpan {
  std::size_t every = 1;
  std::size_t max_views = 500;
  std::function<bool()> stop = {};  // asked after every frame; true ends the replay
};

/// Number of frames to be played, if all can be read.
[[nodiscard]] std::size_t frame_count(const Recording& recording, const ReplaySpan& span);

/// Integrates the frames of a recording in order and asks every planner for a plan after each. The space of the
/// body at each pose is declared free, because the sensor was there. Frames that cannot be read, or whose pose the
/// map cannot hold, are left out and listed. Throws std::runtime_error if that leaves no frame.
[[nodiscard]] ReplayRecord replay(const Recording& recording, const ReplaySpan& span, OccupancyMap& map,
                                  const Platform& platform,
                                  const std::vector<std::unique_ptr<ExplorationPlanner>>& planners,
                                  const OnFrame& on_frame);

/// The report of a run with one more key, `replay`: format, frames left out, and every planner's plan at every
/// frame.
[[nodiscard]] std::string replay_json(const ReplayRecord& record, const Recording& recording,
                                      const std::string& format);

}  // namespace vantage::apps
