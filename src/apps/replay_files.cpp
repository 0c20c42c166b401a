// SPDX-License-Identifier: MIT
#include "apps/replay_files.hpp"

#include <sstream>
#include <stdexcept>
#include <vantage/map/octomap_bridge.hpp>
#include <vantage/picture/depth_picture.hpp>
#include <vantage/picture/floor_plan.hpp>
#include <vantage/vision/read_picture.hpp>

#include <vantage/map/impl/whole_file.hpp>

namespace vantage::apps {
namespace {

FloorPlanContent journey(const RunRecord& run) {
  FloorPlanContent content;
  content.travelled = run.travelled;
  for (const ViewRecord& view : run.views) {
    content.views.push_back(view.pose);
  }
  return content;
}

std::string words_of(const TimedPlan& timed, const Pose& pose) {
  std::ostringstream words;
  words << timed.planner << ": " << to_string(timed.plan.outcome);
  if (timed.plan.outcome == Outcome::Move) {
    words.precision(2);
    words << std::fixed << ", " << (timed.plan.goal.pose.translation() - pose.translation()).norm() << " m away";
  }
  return words.str();
}

}  // namespace

Picture frame_sheet(const ReplayRecord& record, const Recording& recording, const RecordedReading& reading,
                    const OccupancyMap& map) {
  const ReplayedFrame& frame = record.frames.back();
  const RecordedFrame& recorded = recording.frames()[frame.frame];
  std::vector<Picture> pictures;
  std::vector<Picture> plans;
  if (!recorded.colour.empty()) {
    try {
      pictures.push_back(read_picture(recorded.colour));
    } catch (const std::runtime_error&) {  // a sheet without colours is still useful
    }
  }
  pictures.push_back(draw_depth(reading.depth.z_m, reading.depth.width, recording.camera().min_range_m,
                                recording.camera().trusted_range_m()));
  const Pose& pose = record.run.views.back().pose;
  for (const TimedPlan& timed : frame.plans) {
    FloorPlanContent content = journey(record.run);
    content.title = words_of(timed, pose);
    content.slice_z_m = pose.translation().z();
    if (timed.plan.outcome == Outcome::Move) {
      content.next = timed.plan.goal.pose;
    }
    plans.push_back(draw_floor_plan(map, content));
  }
  constexpr std::size_t kHeight = 480;
  constexpr std::size_t kWidth = 1600;
  return below_each_other(std::vector<Picture>{side_by_side(pictures, kHeight), side_by_side(plans, kHeight)},
                          kWidth);
}

void write_replay_files(const std::filesystem::path& folder, const ReplayRecord& record, const std::string& json,
                        const OccupancyMap& map, const RunRecording& recording, OutputFiles& files) {
  using std::filesystem::path;
  files.write(folder / "report.json", [&](const path& file) { detail::write_whole_file(file, json); });
  files.write(folder / "map.ot", [&](const path& file) { save_octomap(map, file); });
  FloorPlanContent content = journey(record.run);
  content.title = path(record.run.world).filename().string() + ": map and frames";
  files.write(folder / "floor_plan.png", [&](const path& file) { write_png(draw_floor_plan(map, content), file); });
  write_page(recording, json, files);
  files.add(folder / "frames");
}

}  // namespace vantage::apps
