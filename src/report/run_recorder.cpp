// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vantage/geometry/raster_order.hpp>
#include <vantage/report/run_recorder.hpp>

#include "report/cycle_codec.hpp"
#include "report/record_chunk.hpp"
#include "report/record_json.hpp"

namespace vantage {
namespace detail {

// A file that only grows: an append writes everything or nothing.
class AppendFile {
 public:
  AppendFile(std::filesystem::path path, bool sync)
      : path_(std::move(path)),
        sync_(sync),
        file_(::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
    if (file_ < 0) {
      fail();
    }
  }
  AppendFile(const AppendFile&) = delete;
  AppendFile(AppendFile&&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;
  AppendFile& operator=(AppendFile&&) = delete;
  ~AppendFile() { ::close(file_); }

  void append(std::string_view bytes) {
    std::string_view left = bytes;
    while (!left.empty()) {
      const ssize_t written = ::write(file_, left.data(), left.size());
      if (written < 0 && errno == EINTR) {
        continue;
      }
      if (written < 0) {
        const int error = errno;
        if (::ftruncate(file_, static_cast<off_t>(size_)) == 0) {
          ::lseek(file_, static_cast<off_t>(size_), SEEK_SET);
        }
        errno = error;
        fail();
      }
      left.remove_prefix(static_cast<std::size_t>(written));
    }
    size_ += bytes.size();
    if (sync_ && ::fdatasync(file_) != 0) {
      fail();
    }
  }
  [[nodiscard]] std::uint64_t size() const { return size_; }

 private:
  [[noreturn]] void fail() const {
    throw std::runtime_error(path_.string() + ": cannot be written: " + std::generic_category().message(errno));
  }

  std::filesystem::path path_;
  bool sync_;
  std::uint64_t size_ = 0;
  int file_;
};

}  // namespace detail

namespace {

bool on_lattice(const VoxelIndex& cell, std::int32_t step) {
  return cell.x % step == 0 && cell.y % step == 0 && cell.z % step == 0;
}

// Descent of the potential per cell along each axis; a closed face contributes nothing.
Eigen::Vector3f fall_at(const Potential& potential, const VoxelIndex& cell, double own) {
  const auto at = [&](std::size_t face) { return potential.at(cell + kFaceNeighbours[face]).value_or(own); };
  const Eigen::Vector3d fall(at(0) - at(1), at(2) - at(3), at(4) - at(5));
  const double steepest = fall.cwiseAbs().maxCoeff();
  return steepest > 0.0 ? (fall / steepest).normalized().cast<float>() : Eigen::Vector3f(Eigen::Vector3f::Zero());
}

// Samples of a field on a lattice, with the least spacing that leaves at most `most` samples.
std::vector<FieldArrow> samples_of(const Potential& field, std::size_t most) {
  std::vector<FieldArrow> samples;
  if (most == 0) {
    return samples;
  }
  std::vector<VoxelIndex> cells;
  field.domain().for_each_cell([&](const VoxelIndex& cell) { cells.push_back(cell); });
  std::sort(cells.begin(), cells.end(), RasterOrder{});
  const double share = static_cast<double>(cells.size()) / static_cast<double>(most);
  auto step = static_cast<std::int32_t>(std::max(1.0, std::floor(std::cbrt(share))));
  const auto count = [&] {
    return static_cast<std::size_t>(
        std::count_if(cells.begin(), cells.end(), [&](const VoxelIndex& cell) { return on_lattice(cell, step); }));
  };
  while (count() > most) {
    ++step;
  }
  for (const VoxelIndex& cell : cells) {
    if (on_lattice(cell, step)) {
      const double phi = *field.at(cell);
      samples.push_back({cell, fall_at(field, cell, phi), static_cast<float>(phi)});
    }
  }
  return samples;
}

std::vector<BrickState> changes_since(const OccupancyMap& map, OccupancyMap::Revision revision) {
  std::vector<VoxelIndex> bricks = map.changed_since(revision);
  std::sort(bricks.begin(), bricks.end(), RasterOrder{});
  std::vector<BrickState> changes;
  changes.reserve(bricks.size());
  for (const VoxelIndex& address : bricks) {
    const Brick* brick = map.find_brick(address);
    changes.push_back({address, brick->known, brick->occupied});
  }
  return changes;
}

}  // namespace

class RunRecorder::State {
 public:
  State(const std::filesystem::path& path, RunRecorderSetup given) : setup(std::move(given)), file(path, setup.sync) {
    file.append(detail::kRecordMagic);
  }

  // The head is written with the first map, because it holds the resolution and the region.
  void begin(const OccupancyMap* map) {
    if (begun) {
      return;
    }
    detail::RecordHead head;
    head.run.command = setup.command;
    head.run.world = setup.world;
    head.run.planner = setup.planner;
    head.run.seed = setup.seed;
    head.run.threads = setup.threads;
    head.sensor = setup.sensor;
    if (map != nullptr) {
      head.run.resolution_m = map->resolution_m();
      head.region = map->region();
      resolution_m = map->resolution_m();
    }
    file.append(detail::packed(detail::ChunkKind::Head, detail::head_json(head)));
    begun = true;
  }

  RunRecorderSetup setup;
  detail::AppendFile file;
  bool begun = false;
  bool finished = false;
  double resolution_m = 0.0;
  OccupancyMap::Revision revision = 0;
  detail::BrickStates states;
  std::size_t views = 0;
  double path_length_m = 0.0;
  std::optional<Eigen::Vector3d> position;
};

RunRecorder::RunRecorder(const std::filesystem::path& file, const RunRecorderSetup& setup)
    : state_(std::make_unique<State>(file, setup)) {}
RunRecorder::RunRecorder(RunRecorder&&) noexcept = default;
RunRecorder& RunRecorder::operator=(RunRecorder&&) noexcept = default;
RunRecorder::~RunRecorder() = default;

void RunRecorder::record(const OccupancyMap& map, ViewRecord view, const Plan* plan, const HarmonicField* field) {
  State& state = *state_;
  if (state.finished) {
    throw std::logic_error("RunRecorder: the record has ended, nothing more can be recorded");
  }
  state.begin(&map);
  if (map.resolution_m() != state.resolution_m) {
    throw std::invalid_argument("RunRecorder: the map has other cells than the one recorded so far");
  }
  RecordedCycle cycle;
  if (plan != nullptr) {
    view.utility = plan->goal.utility;
    // If the planner counted none of a kind, the count of the host stays.
    view.frontier_cells = plan->statistics.frontier_cells > 0 ? plan->statistics.frontier_cells : view.frontier_cells;
    view.void_cells = plan->statistics.void_cells > 0 ? plan->statistics.void_cells : view.void_cells;
    view.outcome = plan->outcome;
    cycle.planned = true;
    cycle.reason = plan->reason;
    cycle.path = plan->path;
    cycle.candidates = plan->candidates;
    cycle.leftover = plan->leftover;
    cycle.survey_ms = plan->statistics.survey_ms;
    cycle.choose_ms = plan->statistics.evaluate_ms + plan->statistics.choose_ms;
    cycle.path_ms = plan->statistics.path_ms;
    if (field != nullptr) {
      cycle.field = samples_of(field->potential, state.setup.field_samples);
    }
  }
  cycle.view = std::move(view);
  cycle.changes = changes_since(map, state.revision);
  state.finished = true;  // also if this throws: later cycles would be encoded against one that is not in the file
  state.file.append(detail::packed(detail::ChunkKind::Cycle, detail::encode(cycle, state.states)));
  state.finished = false;
  state.revision = map.revision();
  state.views = cycle.view.view;
}

void RunRecorder::record(const OccupancyMap& map, const Pose& world_from_sensor, const Plan& plan, double insert_ms,
                         double plan_ms) {
  State& state = *state_;
  const Eigen::Vector3d position = world_from_sensor.translation();
  const double step_m = state.position ? (position - *state.position).norm() : 0.0;
  ViewRecord view;
  view.view = state.views + 1;
  view.pose = world_from_sensor;
  view.passed = {position};
  view.path_length_m = state.path_length_m + step_m;
  view.insert_ms = insert_ms;
  view.plan_ms = plan_ms;
  record(map, std::move(view), &plan);
  state.path_length_m += step_m;
  state.position = position;
}

void RunRecorder::finish(const RunRecord& run) {
  State& state = *state_;
  if (state.finished) {
    throw std::logic_error("RunRecorder: the run is finished already");
  }
  state.begin(nullptr);
  state.file.append(detail::packed(detail::ChunkKind::End, detail::end_json(run)));
  state.finished = true;
}

void RunRecorder::finish(RunOutcome outcome, const std::string& reason) {
  RunRecord run;
  run.outcome = outcome;
  run.reason = reason;
  finish(run);
}

std::uint64_t RunRecorder::bytes() const { return state_->file.size(); }

}  // namespace vantage
