// SPDX-License-Identifier: MIT
#include "apps/run_recording.hpp"

#include <chrono>
#include <iomanip>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vantage/planner/harmonic_planner.hpp>

namespace vantage::apps {
namespace {

const HarmonicField* field_of(const ExplorationPlanner& planner) {
  const auto* harmonic = dynamic_cast<const HarmonicPlanner*>(&planner);
  return harmonic == nullptr || !harmonic->field() ? nullptr : &*harmonic->field();
}

}  // namespace

RunRecording::RunRecording(ExplorationPlanner& planner, std::filesystem::path folder, RunRecorderSetup setup)
    : planner_(planner), folder_(std::move(folder)), setup_(std::move(setup)) {}

Plan RunRecording::plan(const OccupancyMap& map, const Pose& current) {
  Plan plan = planner_.plan(map, current);
  if (!folder_.empty()) {
    plan_ = plan;
  }
  return plan;
}

void RunRecording::look(const ViewRecord& view, const OccupancyMap& map) {
  if (folder_.empty() || !writable_) {
    return;
  }
  if (!recorder_) {
    make_run_folder(folder_);
  }
  const auto start = std::chrono::steady_clock::now();
  writable_ = errors_.attempt([&] {
    if (!recorder_) {
      recorder_.emplace(folder_ / "run.record", setup_);
    }
    recorder_->record(map, view, plan_ ? &*plan_ : nullptr, plan_ ? field_of(planner_) : nullptr);
  });
  plan_.reset();
  milliseconds_ += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void RunRecording::finish(const RunRecord& run) {
  if (recorder_ && writable_) {
    errors_.attempt([&] { recorder_->finish(run); });
  }
}

std::string RunRecording::cost(const RunRecord& run) const {
  double cycles_ms = 0.0;
  for (const ViewRecord& view : run.views) {
    cycles_ms += view.insert_ms + view.plan_ms;
  }
  if (!recorder_ || !(cycles_ms > 0.0)) {
    return "";
  }
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << "  recording    "
       << milliseconds_ / static_cast<double>(run.views.size()) << " ms a view, " << 100.0 * milliseconds_ / cycles_ms
       << " % of inserting and planning\n";
  return text.str();
}

std::optional<std::filesystem::path> RunRecording::file() const {
  return recorder_ ? std::optional(folder_ / "run.record") : std::nullopt;
}

}  // namespace vantage::apps
