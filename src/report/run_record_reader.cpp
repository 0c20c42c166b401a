// SPDX-License-Identifier: MIT
#include <fstream>
#include <stdexcept>
#include <utility>
#include <vantage/report/run_record_reader.hpp>

#include "report/cycle_codec.hpp"
#include "report/record_chunk.hpp"
#include "report/record_json.hpp"

namespace vantage {

class RunRecordReader::State {
 public:
  explicit State(const std::filesystem::path& path) : in(path, std::ios::binary) {
    const auto refuse = [&](const std::string& what) { throw std::runtime_error(path.string() + ": " + what); };
    if (!in || std::filesystem::is_directory(path)) {
      refuse("cannot be read");
    }
    std::string magic(detail::kRecordMagic.size(), '\0');
    in.read(magic.data(), static_cast<std::streamsize>(magic.size()));
    if (magic != detail::kRecordMagic) {
      refuse("is no record of a run");
    }
    const std::optional<detail::Chunk> chunk = detail::read_chunk(in, tail);
    if (!chunk || chunk->kind != detail::ChunkKind::Head) {
      refuse("ends before the first cycle" + (tail.empty() ? "" : ": " + tail));
    }
    try {
      head = detail::head_of(chunk->payload);
      head.sensor.validate();
      (void)OccupancyMap(map_options());
    } catch (const std::exception& error) {
      refuse(error.what());
    }
    run = head.run;
    run.outcome = RunOutcome::Budget;
    run.reason = "the record ends before the run does";
  }

  [[nodiscard]] OccupancyMapOptions map_options() const {
    OccupancyMapOptions options;
    if (head.run.resolution_m > 0.0) {
      options.resolution_m = head.run.resolution_m;
    }
    if (head.region) {
      options.region = VoxelFrame{options.resolution_m}.box_of(*head.region);
    }
    return options;
  }

  [[nodiscard]] std::optional<RecordedCycle> next() {
    if (over) {
      return std::nullopt;
    }
    over = true;  // unless everything below succeeds
    const std::optional<detail::Chunk> chunk = detail::read_chunk(in, tail);
    if (!chunk) {
      return std::nullopt;
    }
    try {
      if (chunk->kind == detail::ChunkKind::Cycle) {
        RecordedCycle cycle = detail::decode(chunk->payload, states);
        add(cycle);
        over = false;
        return cycle;
      }
      if (chunk->kind != detail::ChunkKind::End) {
        throw std::runtime_error("it is of no known kind");
      }
      detail::read_end(chunk->payload, run);
      finished = true;
      if (in.peek() != std::ifstream::traits_type::eof()) {
        tail = "something follows the end of the run";
      }
    } catch (const std::exception& error) {
      tail = std::string("a chunk cannot be read: ") + error.what();
    }
    return std::nullopt;
  }

  void add(const RecordedCycle& cycle) {
    const ViewRecord& view = cycle.view;
    run.views.push_back(view);
    run.travelled.insert(run.travelled.end(), view.passed.begin(), view.passed.end());
    run.coverage = view.coverage;
    run.surface_coverage = view.surface_coverage;
    run.seen_coverage = view.seen_coverage;
    if (cycle.planned) {
      run.leftover = cycle.leftover;
    }
  }

  std::ifstream in;
  std::string tail;
  detail::RecordHead head;
  detail::BrickStates states;
  RunRecord run;
  bool over = false;
  bool finished = false;
};

RunRecordReader::RunRecordReader(const std::filesystem::path& file) : state_(std::make_unique<State>(file)) {}
RunRecordReader::RunRecordReader(RunRecordReader&&) noexcept = default;
RunRecordReader& RunRecordReader::operator=(RunRecordReader&&) noexcept = default;
RunRecordReader::~RunRecordReader() = default;

const RangeSensor& RunRecordReader::sensor() const { return state_->head.sensor; }

OccupancyMap RunRecordReader::new_map() const { return OccupancyMap(state_->map_options()); }

std::optional<RecordedCycle> RunRecordReader::next() { return state_->next(); }
const RunRecord& RunRecordReader::run() const { return state_->run; }
bool RunRecordReader::finished() const { return state_->finished; }
const std::string& RunRecordReader::tail() const { return state_->tail; }

}  // namespace vantage
