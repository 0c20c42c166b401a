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

/// What a planner would do next.
struct TimedPlan {
  std::string planner;
  Plan plan;
  double plan_ms = 0.0;
};

/// One frame as it was played.
struct ReplayedFrame {
  std::size_t frame = 0;  // in the recording
  ScanReport scan;
  DepthReport depth;
  std::size_t free_cells = 0;
  std::size_t occupied_cells = 0;
  std::size_t frontier_cells = 0;
  std::size_t void_cells = 0;
  std::vector<TimedPlan> plans;  // in the order of the planners
};

/// How a recording was played.
struct ReplayRecord {
  RunRecord run;  // by the first planner
  std::vector<ReplayedFrame> frames;
  std::vector<SkippedFrame> skipped;  // those the recording left out, and those that could not be read
  bool to_the_end = true;             // false: max_views came first, or somebody stopped it
};

/// What is told about a frame once it is in the map.
using OnFrame = std::function<void(const ReplayRecord&, const RecordedReading&, const OccupancyMap&)>;

/// Which frames are played.
struct ReplaySpan {
  std::size_t every = 1;
  std::size_t max_views = 500;
  std::function<bool()> stop = {};  // asked after every frame; true ends the replay there
};

/// How many frames are going to be played, if all can be read.
[[nodiscard]] std::size_t frame_count(const Recording& recording, const ReplaySpan& span);

/// Integrates the frames of a recording in their order and asks every planner after each what it would do next. The
/// space that the body takes is free: the sensor was there. Frames that cannot be read, or whose pose the map
/// cannot hold, are left out and told. Throws std::runtime_error if that are all.
[[nodiscard]] ReplayRecord replay(const Recording& recording, const ReplaySpan& span, OccupancyMap& map,
                                  const Platform& platform,
                                  const std::vector<std::unique_ptr<ExplorationPlanner>>& planners,
                                  const OnFrame& on_frame);

/// The report of a run with one more key, `replay`: the format, frames left out, and every planner's plan at every
/// frame.
[[nodiscard]] std::string replay_json(const ReplayRecord& record, const Recording& recording,
                                      const std::string& format);

}  // namespace vantage::apps
