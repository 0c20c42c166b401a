// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vantage/report/run_record_reader.hpp>
#include <vector>

#include "support/depth_files.hpp"
#include "support/real_data.hpp"
#include "support/temporary_folder.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

/// Runs the real program on generated recordings.
class ReplayProgram : public testing::Test {
 protected:
  // A camera that moves along a wall at a distance of 2 m and turns slightly.
  ReplayProgram() {
    fs::create_directories(data());
    for (int i = 0; i < 5; ++i) {
      const std::string name = data() / ("frame-00000" + std::to_string(i));
      test::write_depth(name + ".depth.png", 64, 48, std::vector<std::uint16_t>(64 * 48, 2000));
      cv::imwrite(name + ".color.png", cv::Mat(48, 64, CV_8UC3, cv::Scalar(40 * i, 90, 200)));
      test::write_text(name + ".pose.txt", "1 0 0 " + std::to_string(0.2 * i) + "\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
    }
    test::write_text(data() / "camera-intrinsics.txt", "55 0 32\n0 55 24\n0 0 1\n");
  }
  [[nodiscard]] fs::path data() const { return folder_ / "data"; }
  [[nodiscard]] int run(const std::string& arguments) {
    const fs::path out = folder_ / "stdout.txt";
    const fs::path err = folder_ / "stderr.txt";
    const int status = std::system(
        ("'" VANTAGE_PROGRAM "' replay " + arguments + " >'" + out.string() + "' 2>'" + err.string() + "'").c_str());
    out_ = test::bytes_in(out);
    err_ = test::bytes_in(err);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  [[nodiscard]] std::string on_data() const {
    return "--dataset '" + data().string() + "' --format 7scenes --resolution 0.1 ";
  }
  void expect_refused(const std::string& arguments, const std::string& words) {
    EXPECT_EQ(run(arguments + " --out '" + (folder_ / "out").string() + "'"), 2) << arguments;
    EXPECT_EQ(err_.rfind("vantage: ", 0), 0U) << err_;
    EXPECT_EQ(std::count(err_.begin(), err_.end(), '\n'), 1) << err_;
    EXPECT_NE(err_.find(words), std::string::npos) << err_;
    EXPECT_FALSE(fs::exists(folder_ / "out")) << arguments;
  }

  test::TemporaryFolder folder_;
  std::string out_;
  std::string err_;
};

TEST_F(ReplayProgram, PlaysARecordingAndTellsWhatEveryPlannerWouldDo) {
  fs::resize_file(data() / "frame-000002.depth.png", 60);
  const fs::path out = folder_ / "out";
  ASSERT_EQ(run(on_data() + "--planner nearest-frontier,harmonic --json - --out '" + out.string() + "'"), 0) << err_;
  const auto report = nlohmann::json::parse(out_);
  EXPECT_EQ(report.at("command"), "replay");
  EXPECT_EQ(report.at("planner"), "nearest-frontier");
  EXPECT_EQ(report.at("views"), 4);
  EXPECT_EQ(report.at("cycles").size(), 4U);
  EXPECT_NEAR(report.at("path_length_m").get<double>(), 0.8, 1e-9);
  const auto& replay = report.at("replay");
  EXPECT_EQ(replay.at("frames").size(), 4U);
  EXPECT_EQ(replay.at("frames")[1].at("plans").size(), 2U);
  EXPECT_EQ(replay.at("frames")[1].at("plans")[1].at("planner"), "harmonic");
  ASSERT_EQ(replay.at("skipped").size(), 1U);
  EXPECT_EQ(replay.at("skipped")[0].at("frame"), "frame-000002");
  EXPECT_NE(replay.at("skipped")[0].at("reason").get<std::string>().find("cut off"), std::string::npos);
  EXPECT_NE(err_.find("frame-000002: "), std::string::npos);
  for (const char* name :
       {"report.json", "map.ot", "floor_plan.png", "run.record", "report.html", "frames/frame-000004.png"}) {
    EXPECT_TRUE(fs::exists(out / name)) << name;
  }
  EXPECT_FALSE(fs::exists(out / "frames/frame-000002.png"));
  EXPECT_EQ(nlohmann::json::parse(test::bytes_in(out / "report.json")).at("replay").at("format"), "7scenes");
}

// An invalid frame is skipped; the others are used.
TEST_F(ReplayProgram, LeavesOutFramesWhosePoseCannotBe) {
  test::write_text(data() / "frame-000001.pose.txt", "1 0 0 nan\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  test::write_text(data() / "frame-000002.pose.txt", "1 0 0 1e300\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  test::write_text(data() / "frame-000003.pose.txt", "1 0 0 1e6\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  ASSERT_EQ(run(on_data() + "--planner nearest-frontier --json -"), 0) << err_;
  const auto report = nlohmann::json::parse(out_);
  EXPECT_EQ(report.at("views"), 2);
  ASSERT_EQ(report.at("replay").at("skipped").size(), 3U);
  for (const char* name : {"frame-000001: ", "frame-000002: its pose is at ", "frame-000003: its pose is at "}) {
    EXPECT_NE(err_.find(name), std::string::npos) << name << err_;
  }
}

TEST_F(ReplayProgram, NamesOfFramesMayBeAnyBytes) {
  fs::rename(data() / "frame-000001.pose.txt", data() / "frame-\xBB.pose.txt");
  EXPECT_EQ(run(on_data() + "--planner nearest-frontier --json -"), 0) << err_;
  EXPECT_EQ(run(on_data() + "--select --json -"), 0) << err_;
}

TEST_F(ReplayProgram, LeavesARecordThatTellsTheSame) {
  const fs::path out = folder_ / "out";
  ASSERT_EQ(
      run(on_data() + "--planner harmonic,nearest-frontier --robot-radius 0 --quiet --out '" + out.string() + "'"), 0)
      << err_;
  EXPECT_EQ(out_ + err_, "") << "it is quiet";
  const auto report = nlohmann::json::parse(test::bytes_in(out / "report.json"));
  RunRecordReader reader(out / "run.record");
  OccupancyMap map = reader.new_map();
  std::size_t views = 0;
  std::size_t plans_with_field = 0;
  while (const std::optional<RecordedCycle> cycle = reader.next()) {
    apply_changes(*cycle, map);
    const auto& told = report.at("replay").at("frames").at(views);
    const auto& plan = told.at("plans").at(0);
    const OccupancyMap::Counts counts = map.counts();
    EXPECT_EQ(counts.free, told.at("free_cells"));
    EXPECT_EQ(counts.occupied, told.at("occupied_cells"));
    EXPECT_EQ(cycle->view.void_cells, told.at("void_cells"));
    EXPECT_EQ(cycle->view.frontier_cells, told.at("frontier_cells"));
    EXPECT_EQ(cycle->reason, plan.at("reason"));
    EXPECT_EQ(to_string(cycle->view.outcome), plan.at("outcome").get<std::string>());
    ASSERT_EQ(cycle->view.passed.size(), 1U);
    EXPECT_LT((cycle->view.passed[0] - cycle->view.pose.translation()).norm(), 1e-5);
    plans_with_field += cycle->field.empty() ? 0U : 1U;
    ++views;
  }
  EXPECT_EQ(views, 5U);
  EXPECT_GT(plans_with_field, 0U) << "of the first planner, which is the harmonic one";
  EXPECT_EQ(reader.run().command, "replay");
  EXPECT_EQ(reader.run().planner, "harmonic");
  EXPECT_EQ(reader.run().reason, report.at("reason").get<std::string>());
}

// One progress bar over all frames. Uses the program `script` to simulate a terminal.
TEST_F(ReplayProgram, DrawsABarOnATerminal) {
  if (std::system("command -v script >/dev/null") != 0) {
    GTEST_SKIP() << "there is no program `script` here to play a terminal";
  }
  for (const std::string more : {"--planner nearest-frontier", "--select"}) {
    const fs::path typed = folder_ / "typed.txt";
    const std::string command = "script -qec \"'" VANTAGE_PROGRAM "' replay " + on_data() + more + "\" '" +
                                typed.string() + "' >/dev/null </dev/null";
    EXPECT_EQ(std::system(command.c_str()), 0) << more;
    const std::string text = test::bytes_in(typed);
    EXPECT_EQ(text.find("pixels"), std::string::npos) << "no lines beside the bar\n" << text;
    std::size_t bars = 0;
    for (std::size_t at = text.find("\r["); at != std::string::npos; at = text.find("\r[", at + 1)) {
      ++bars;
      const std::string bar = text.substr(at + 1, text.find('\x1b', at) - at - 1);
      EXPECT_LE(bar.size(), 100U);
      EXPECT_NE(bar.find("view "), std::string::npos) << bar;
      EXPECT_NE(bar.find(" of 5"), std::string::npos) << bar;
    }
    EXPECT_EQ(bars, more == "--select" ? 8U : 5U) << text;
  }
}

TEST_F(ReplayProgram, ABudgetEndsIt) {
  EXPECT_EQ(run(on_data() + "--max-views 2 --planner nearest-frontier --json -"), 3);
  EXPECT_EQ(nlohmann::json::parse(out_).at("views"), 2);
  EXPECT_EQ(run(on_data() + "--every 2 --planner nearest-frontier --json -"), 0);
  EXPECT_EQ(nlohmann::json::parse(out_).at("views"), 3);
}

TEST_F(ReplayProgram, ComparesOrdersOfViews) {
  const fs::path out = folder_ / "out";
  ASSERT_EQ(run(on_data() + "--select --json - --out '" + out.string() + "'"), 0) << err_;
  const auto report = nlohmann::json::parse(out_);
  EXPECT_EQ(report.at("command"), "replay");
  const auto& selection = report.at("selection");
  EXPECT_EQ(selection.at("frames").size(), 5U);
  EXPECT_EQ(selection.at("orders").size(), 5U);
  for (const auto& order : selection.at("orders")) {
    EXPECT_EQ(order.at("volume").size(), 5U) << order.at("name");
    EXPECT_NEAR(order.at("volume").back().get<double>(), 1.0, 1e-12) << "every order ends with all that is known";
    EXPECT_LE(order.at("volume_area").get<double>(),
              selection.at("greedy_volume").at("volume_area").get<double>() + 0.05);
    EXPECT_EQ(order.at("void_cells").size(), 5U) << order.at("name");
    EXPECT_LE(order.at("void_cells").back(), selection.at("void_cells")) << order.at("name");
  }
  EXPECT_NE(err_.find("expected cells"), std::string::npos);
}

TEST_F(ReplayProgram, SaysWhatItAssumedOfTheCamera) {
  EXPECT_EQ(run(on_data() + "--max-views 1 --planner harmonic"), 3) << err_;
  EXPECT_EQ(out_.find("camera-intrinsics.txt"), std::string::npos) << out_;
  fs::remove(data() / "camera-intrinsics.txt");
  EXPECT_EQ(run(on_data() + "--max-views 1 --planner harmonic"), 3) << err_;
  EXPECT_NE(out_.find("there is no camera-intrinsics.txt: "), std::string::npos) << out_;
  EXPECT_NE(out_.find("; if they are others, say so: --intrinsics\n"), std::string::npos) << out_;
}

TEST_F(ReplayProgram, SaysThatARegionHoldsNothing) {
  EXPECT_EQ(run(on_data() + "--planner harmonic --region 90,90,90,91,91,91 --json -"), 0) << err_;
  EXPECT_EQ(nlohmann::json::parse(out_).at("reason"), "--region 90,90,90,91,91,91 holds nothing that a frame shows");
}

TEST_F(ReplayProgram, RefusesBadInput) {
  expect_refused("--format tum", "--dataset");
  expect_refused("--dataset '" + (folder_ / "no").string() + "' --format tum", "no: is not a folder");
  expect_refused("--dataset '" + data().string() + "' --format tum", "groundtruth.txt: cannot be opened");
  expect_refused("--dataset '" + data().string() + "' --format bag", "there is no format 'bag'");
  expect_refused(on_data() + "--planner magic", "there is no planner 'magic'");
  expect_refused(on_data() + "--planner ,", "there is no planner ''");
  expect_refused(on_data() + "--intrinsics 1,2,3", "--intrinsics has 3 numbers");
  for (const char* format : {"apc", "kitti-stereo", "stanford"}) {
    expect_refused("--dataset '" + data().string() + "' --intrinsics 1,2,3,4 --format " + format,
                   "--intrinsics: the files");
  }
  expect_refused(on_data() + "--every 0", "--every is 0");
  expect_refused(on_data() + "--object-box 0,0,0,1,1,1", "--object-box says what counts for --select");
  expect_refused(on_data() + "--select --planner harmonic", "--planner excludes --select");
  expect_refused(on_data() + "--select --set a=1", "--set does not go with --select");
  expect_refused(on_data() + "--select --memory-limit 5", "--memory-limit does not go with --select");
  expect_refused(on_data() + "--select --object-box 0,0,0,1,1", "--object-box has 5 numbers");
  expect_refused(on_data() + "--select --object-box 90,90,90,91,91,91",
                 "--object-box 90,90,90,91,91,91 holds nothing that a frame shows");
  expect_refused(on_data() + "--select --object-box 0,0,0,900,900,900",
                 "--object-box 0,0,0,900,900,900: --resolution");
  expect_refused(on_data() + "--select --region 90,90,90,91,91,91", "--region 90,90,90,91,91,91 holds nothing");
  expect_refused(on_data() + "--max-range -1", "--max-range is -1");
  expect_refused(on_data() + "--up north", "--up is 'north'");
  expect_refused(on_data() + "--disparities 64",
                 "--disparities or --window: a recording '7scenes' has no pairs to match");
  expect_refused("--dataset '" + data().string() + "' --format 7scenes --resolution 0", "--resolution is 0");
  for (const auto& entry : fs::directory_iterator(data())) {
    if (entry.path().extension() == ".png") {
      test::write_text(entry.path(), "no image");
    }
  }
  expect_refused(on_data(), "none of its images can be read; the first: ");
}

}  // namespace
}  // namespace vantage
