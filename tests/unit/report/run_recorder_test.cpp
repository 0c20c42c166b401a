// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iterator>
#include <random>
#include <stdexcept>
#include <vantage/report/run_record_reader.hpp>
#include <vantage/report/run_recorder.hpp>

#include "support/random_maps.hpp"
#include "support/read_all.hpp"
#include "support/temporary_folder.hpp"

namespace vantage {
namespace {

void write_all(const std::filesystem::path& file, std::string_view bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

// The states of all cells in an order that does not depend on the history of the map.
std::vector<std::pair<VoxelIndex, Occupancy>> states_of(const OccupancyMap& map) {
  std::vector<std::pair<VoxelIndex, Occupancy>> states;
  map.for_each_known([&](const VoxelIndex& cell, Occupancy state) { states.emplace_back(cell, state); });
  std::sort(states.begin(), states.end());
  return states;
}

Plan some_plan(std::mt19937& engine) {
  std::uniform_real_distribution<double> metre(-3.0, 3.0);
  Plan plan;
  plan.outcome = Outcome::Move;
  plan.reason = "to see more";
  plan.goal = {pose_looking({metre(engine), metre(engine), 1.0}, metre(engine)), 17.5};
  plan.path = {pose_looking({0.0, 0.0, 1.0}, 0.0), plan.goal.pose};
  for (int i = 0; i < 3; ++i) {
    plan.candidates.push_back({pose_looking({metre(engine), metre(engine), 1.0}, metre(engine)), 1.0 + i});
  }
  plan.leftover = {1, 2, 3};
  plan.statistics.frontier_cells = 321;
  plan.statistics.void_cells = 12;
  plan.statistics.survey_ms = 1.5;
  plan.statistics.choose_ms = 2.5;
  plan.statistics.path_ms = 0.25;
  return plan;
}

// A run of scans in which a cell is sometimes forgotten. Stores the states after each cycle.
class Rehearsal {
 public:
  explicit Rehearsal(unsigned seed, std::size_t rays = 80) : engine_(seed), rays_(rays) {
    if (seed % 2 == 1) {
      map_ = OccupancyMap({.resolution_m = 0.25, .region = Box{{-2.5, -2.5, -2.5}, {2.5, 2.5, 2.5}}});
    }
  }

  void step() {
    const Scan scan = test::random_scan(engine_, rays_);
    map_.insert(scan);
    std::uniform_int_distribution<std::int32_t> coordinate(-9, 9);
    for (int i = 0; i < 20; ++i) {
      map_.set({coordinate(engine_), coordinate(engine_), coordinate(engine_)}, static_cast<Occupancy>(i % 3));
    }
    view_.view += 1;
    view_.passed = {view_.pose.translation(), scan.world_from_sensor.translation()};
    view_.path_length_m += (view_.passed[1] - view_.passed[0]).norm();
    view_.pose = scan.world_from_sensor;
    view_.coverage = 0.1 * static_cast<double>(view_.view);
    view_.time_s = view_.view > 1 ? std::optional(0.25 * static_cast<double>(view_.view)) : std::nullopt;
    if (view_.view % 2 == 1) {
      plan_ = some_plan(engine_);
    }
  }
  void record_into(RunRecorder& recorder) const {
    recorder.record(map_, view_, view_.view % 2 == 1 ? &plan_ : nullptr);
  }
  [[nodiscard]] const OccupancyMap& map() const { return map_; }
  [[nodiscard]] const ViewRecord& view() const { return view_; }
  [[nodiscard]] const Plan& plan() const { return plan_; }

 private:
  std::mt19937 engine_;
  std::size_t rays_;
  OccupancyMap map_ = OccupancyMap({.resolution_m = 0.25});
  ViewRecord view_;
  Plan plan_;
};

RunRecorderSetup setup() {
  return {
      .command = "host", .world = "lab", .planner = "harmonic", .seed = 7, .sensor = RangeSensor::preset("kinect")};
}

// Reads `file` and repeats the same run. Returns the number of equal cycles.
std::size_t cycles_that_agree(RunRecordReader& reader, unsigned seed) {
  Rehearsal rehearsal(seed);
  OccupancyMap map = reader.new_map();
  std::size_t cycles = 0;
  while (const std::optional<RecordedCycle> cycle = reader.next()) {
    rehearsal.step();
    apply_changes(*cycle, map);
    const bool planned = rehearsal.view().view % 2 == 1;
    const bool agrees = states_of(map) == states_of(rehearsal.map()) && cycle->view.view == rehearsal.view().view &&
                        cycle->view.pose.isApprox(rehearsal.view().pose, 1e-12) &&
                        cycle->view.path_length_m == rehearsal.view().path_length_m &&
                        cycle->view.coverage == rehearsal.view().coverage &&
                        cycle->view.time_s == rehearsal.view().time_s && cycle->view.passed.size() == 2 &&
                        cycle->planned == planned &&
                        (!planned || (cycle->reason == "to see more" && cycle->view.utility == 17.5 &&
                                      cycle->view.frontier_cells == 321 && cycle->candidates.size() == 3 &&
                                      cycle->path.size() == 2 && cycle->leftover == rehearsal.plan().leftover &&
                                      cycle->path[1].isApprox(rehearsal.plan().goal.pose, 1e-12) &&
                                      cycle->candidates[2].utility == 3.0 && cycle->survey_ms == 1.5));
    cycles += agrees ? 1U : 0U;
  }
  return cycles;
}

TEST(RunRecorder, WhatIsReadIsWhatWasRecorded) {
  const test::TemporaryFolder folder;
  std::size_t runs = 0;
  for (unsigned seed = 0; seed < 8; ++seed) {
    const std::filesystem::path file = folder / ("run" + std::to_string(seed));
    Rehearsal rehearsal(seed);
    RunRecorder recorder(file, setup());
    for (int i = 0; i < 7; ++i) {
      rehearsal.step();
      rehearsal.record_into(recorder);
    }
    RunRecord end;
    end.outcome = RunOutcome::Blocked;
    end.reason = "a door is shut";
    end.coverage = 0.75;
    end.observable_cells = 99;
    end.collisions = 2;
    end.path_bound = {.length_m = 12.5, .is_met = true};
    end.audit = {.cells_checked = 9, .looked_at_in_vain = 3, .observable_left = 1};
    recorder.finish(end);
    EXPECT_EQ(recorder.bytes(), std::filesystem::file_size(file));

    RunRecordReader reader(file);
    EXPECT_EQ(cycles_that_agree(reader, seed), 7U);
    EXPECT_TRUE(reader.finished());
    EXPECT_EQ(reader.tail(), "");
    EXPECT_EQ(reader.new_map().region(), rehearsal.map().region());
    EXPECT_EQ(reader.sensor().max_range_m, setup().sensor.max_range_m);
    const RunRecord& run = reader.run();
    EXPECT_EQ(run.world, "lab");
    EXPECT_EQ(run.seed, 7U);
    EXPECT_EQ(run.resolution_m, 0.25);
    EXPECT_EQ(run.outcome, RunOutcome::Blocked);
    EXPECT_EQ(run.reason, "a door is shut");
    EXPECT_EQ(run.coverage, 0.75);
    EXPECT_EQ(run.collisions, 2U);
    ASSERT_TRUE(run.path_bound && run.audit);
    EXPECT_EQ(run.path_bound->length_m, 12.5);
    EXPECT_TRUE(run.path_bound->is_met);
    EXPECT_EQ(run.audit->cells_checked, 9U);
    EXPECT_EQ(run.audit->looked_at_in_vain, 3U);
    EXPECT_EQ(run.audit->observable_left, 1U);
    EXPECT_EQ(run.views.size(), 7U);
    EXPECT_EQ(run.travelled.size(), 14U);
    runs += 1;
  }
  EXPECT_EQ(runs, 8U);
}

// A record of three cycles, truncated at every byte: an exception only if the head is incomplete; all complete cycles
// are read and no others.
TEST(RunRecorder, OpensHoweverItWasCut) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "run";
  std::vector<std::uint64_t> ends;
  {
    Rehearsal rehearsal(3, 6);
    RunRecorder recorder(file, setup());
    for (int i = 0; i < 3; ++i) {
      rehearsal.step();
      rehearsal.record_into(recorder);
      ends.push_back(recorder.bytes());
    }
    recorder.finish(RunOutcome::Explored, "done");
    ends.push_back(recorder.bytes());
  }
  const std::string whole = test::read_all(file);
  ASSERT_EQ(whole.size(), ends.back());
  std::size_t refused = 0;
  std::size_t opened = 0;
  std::size_t whole_chunks = 0;  // lengths at which no chunk is incomplete
  for (std::size_t length = whole.size(); length-- > 0;) {
    std::filesystem::resize_file(file, length);
    try {
      RunRecordReader reader(file);
      std::size_t cycles = 0;
      while (reader.next()) {
        ++cycles;
      }
      ++opened;
      const auto expected = static_cast<std::size_t>(
          std::count_if(ends.begin(), ends.end() - 1, [&](std::uint64_t end) { return end <= length; }));
      ASSERT_EQ(cycles, expected) << "cut after " << length;
      ASSERT_FALSE(reader.finished());
      whole_chunks += reader.tail().empty() ? 1U : 0U;
      ASSERT_TRUE(cycles == 0 || reader.tail().empty() == (std::find(ends.begin(), ends.end(), length) != ends.end()))
          << length << ' ' << reader.tail();
    } catch (const std::runtime_error& error) {
      ASSERT_NE(std::string(error.what()).find(file.string()), std::string::npos);
      ASSERT_LT(length, ends.front());
      ++refused;
    }
  }
  EXPECT_EQ(opened + refused, whole.size());
  EXPECT_EQ(whole_chunks, 4U) << "after the head and after each cycle";
  EXPECT_GT(opened, 1000U);
  EXPECT_GT(refused, 100U);
}

TEST(RunRecorder, NoticesDamage) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "run";
  std::uint64_t first_end = 0;
  {
    Rehearsal rehearsal(4);
    RunRecorder recorder(file, setup());
    rehearsal.step();
    rehearsal.record_into(recorder);
    first_end = recorder.bytes();
    rehearsal.step();
    rehearsal.record_into(recorder);
  }
  const std::string whole = test::read_all(file);
  std::mt19937 engine(1);
  std::uniform_int_distribution<std::size_t> place(first_end, whole.size() - 1);
  std::uniform_int_distribution<int> bit(0, 7);
  for (int i = 0; i < 300; ++i) {
    std::string damaged = whole;
    char& byte = damaged[place(engine)];
    byte = static_cast<char>(static_cast<unsigned char>(byte) ^ (1U << static_cast<unsigned>(bit(engine))));
    write_all(file, damaged);
    RunRecordReader reader(file);
    EXPECT_TRUE(reader.next());
    EXPECT_FALSE(reader.next());
    EXPECT_NE(reader.tail(), "");
  }
}

TEST(RunRecorder, SurvivesBeingKilled) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "run";
  int pipe_ends[2];
  ASSERT_EQ(::pipe(pipe_ends), 0);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    Rehearsal rehearsal(5);
    RunRecorder recorder(file, setup());
    for (char cycles = 1;; ++cycles) {
      rehearsal.step();
      rehearsal.record_into(recorder);
      if (::write(pipe_ends[1], &cycles, 1) != 1) {
        ::_exit(1);
      }
      if (cycles == 100) {
        ::_exit(0);  // ends by itself if it was not killed
      }
    }
  }
  char told = 0;
  while (told < 5 && ::read(pipe_ends[0], &told, 1) == 1) {
  }
  ASSERT_EQ(::kill(child, SIGKILL), 0);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFSIGNALED(status)) << "it was killed in the middle of its work";
  ::close(pipe_ends[1]);
  while (::read(pipe_ends[0], &told, 1) == 1) {  // cycles finished before the process ended
  }
  ::close(pipe_ends[0]);

  RunRecordReader reader(file);
  EXPECT_GE(cycles_that_agree(reader, 5), static_cast<std::size_t>(told));
  EXPECT_GE(reader.run().views.size(), 5U);
  EXPECT_FALSE(reader.finished());
  EXPECT_EQ(reader.run().outcome, RunOutcome::Budget);
  EXPECT_EQ(reader.run().leftover, (Leftover{1, 2, 3}));
}

TEST(RunRecorder, CountsForHostsThatDoNot) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "run";
  std::mt19937 engine(2);
  OccupancyMap map({.resolution_m = 0.25});
  {
    RunRecorder recorder(file, setup());
    for (int i = 0; i < 3; ++i) {
      map.insert(test::random_scan(engine, 40));
      recorder.record(map, pose_looking({2.0 * i, 0.0, 1.0}, 0.0), some_plan(engine), 1.0, 2.0);
    }
    recorder.finish(RunOutcome::Explored, "all seen");
    EXPECT_THROW(recorder.finish(RunOutcome::Explored, "again"), std::logic_error);
    EXPECT_THROW(recorder.record(map, Pose::Identity(), some_plan(engine)), std::logic_error);
  }
  RunRecordReader reader(file);
  while (reader.next()) {
  }
  EXPECT_EQ(reader.run().views.size(), 3U);
  EXPECT_EQ(reader.run().views.back().view, 3U);
  EXPECT_EQ(reader.run().path_length_m(), 4.0);
  EXPECT_EQ(reader.run().outcome, RunOutcome::Explored);
}

TEST(RunRecorder, NamesWhatIsWrong) {
  const test::TemporaryFolder folder;
  EXPECT_THROW(RunRecorder(folder / "no/such/folder", setup()), std::runtime_error);
  EXPECT_THROW(RunRecordReader(folder / "nothing"), std::runtime_error);
  write_all(folder / "text", "this is no record of anything at all");
  EXPECT_THROW(RunRecordReader(folder / "text"), std::runtime_error);
  RunRecorder recorder(folder / "run", setup());
  recorder.record(OccupancyMap({.resolution_m = 0.1}), ViewRecord{});
  EXPECT_THROW(recorder.record(OccupancyMap({.resolution_m = 0.2}), ViewRecord{}), std::invalid_argument);
}

}  // namespace
}  // namespace vantage
