// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "support/temporary_folder.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

/// Runs the real program.
class SearchProgram : public testing::Test {
 protected:
  [[nodiscard]] static std::string text_in(const fs::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  [[nodiscard]] int run(const std::string& arguments) {
    const fs::path out = folder_ / "stdout.txt";
    const fs::path err = folder_ / "stderr.txt";
    const int status = std::system(
        ("'" VANTAGE_PROGRAM "' search " + arguments + " >'" + out.string() + "' 2>'" + err.string() + "'").c_str());
    out_ = text_in(out);
    err_ = text_in(err);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  void expect_refused(const std::string& arguments, const std::string& words) {
    EXPECT_EQ(run(arguments + " --json '" + (folder_ / "refused.json").string() + "'"), 2) << arguments;
    EXPECT_EQ(err_.rfind("vantage: ", 0), 0U) << err_;
    EXPECT_EQ(std::count(err_.begin(), err_.end(), '\n'), 1) << err_;
    EXPECT_NE(err_.find(words), std::string::npos) << err_;
    EXPECT_FALSE(fs::exists(folder_ / "refused.json")) << arguments;
  }

  test::TemporaryFolder folder_;
  std::string out_;
  std::string err_;
};

TEST_F(SearchProgram, MovesTheArmFromViewToViewTheSameEveryTime) {
  const std::string arguments = "--world crates-closed --resolution 0.05 --max-views 3 --json -";
  ASSERT_EQ(run(arguments), 3) << err_;
  const nlohmann::json report = nlohmann::json::parse(out_);
  EXPECT_EQ(report["command"], "search");
  EXPECT_EQ(report["planner"], "frontier-void");
  EXPECT_EQ(report["outcome"], "budget");
  EXPECT_EQ(report["views"], 3);
  EXPECT_EQ(report["collisions"], 0);
  ASSERT_EQ(report["cycles"].size(), 3U);
  EXPECT_GT(report["cycles"][0]["utility"].get<double>(), 10.0);
  EXPECT_GT(report["path_length_m"].get<double>(), 0.1);
  for (const nlohmann::json& cycle : report["cycles"]) {
    const double x = cycle["pose"][0];
    const double y = cycle["pose"][1];
    const double z = cycle["pose"][2];
    EXPECT_LT(x * x + y * y + (z - 0.4) * (z - 0.4), 1.01) << "the arm reaches 1 m from its shoulder";
  }
  EXPECT_NE(err_.find("dm^3"), std::string::npos) << "progress goes to stderr where the report goes to stdout";
  ASSERT_EQ(run(arguments), 3) << err_;
  const nlohmann::json again = nlohmann::json::parse(out_);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(report["cycles"][i]["pose"], again["cycles"][i]["pose"]);
    EXPECT_EQ(report["cycles"][i]["utility"], again["cycles"][i]["utility"]);
  }
}

// The exhaustive planner and the lower bound of views, with large cells to be fast.
TEST_F(SearchProgram, WeighsAllPosesAndTellsHowFewViewsCouldDo) {
  const std::string arguments =
      "--world crates-open --resolution 0.1 --planner exhaustive --max-views 3 --bound 60 --exhaustive --json -";
  ASSERT_NE(run(arguments), 2) << err_;
  const nlohmann::json report = nlohmann::json::parse(out_);
  EXPECT_EQ(report["planner"], "exhaustive");
  EXPECT_EQ(report["collisions"], 0);
  EXPECT_GT(report["cycles"][0]["utility"].get<double>(), 5.0);
  EXPECT_NE(err_.find("  exhaustive   of "), std::string::npos) << err_;
  EXPECT_NE(err_.find("  bound        after the first view "), std::string::npos) << err_;
  EXPECT_EQ(err_.find("fewer than -"), std::string::npos) << err_;
  EXPECT_NE(err_.find("  left         dm^3 after each view of the greedy choice: "), std::string::npos) << err_;
  const std::string told = err_.substr(err_.find("  exhaustive"));
  ASSERT_NE(run(arguments + " --threads 3"), 2) << err_;
  EXPECT_EQ(told, err_.substr(err_.find("  exhaustive"))) << "the same for any number of threads";
  EXPECT_EQ(run("--world crates-open --resolution 0.1 --planner exhaustive --json -"), 0) << err_;
  EXPECT_EQ(nlohmann::json::parse(out_).at("outcome"), "explored");
  expect_refused("--world crates-open --planner exhaustive --set views=3", "has one setting, least_view_m3");
  expect_refused("--world crates-open --planner exhaustive --set least_view_m3=-1", "must be one number >= 0");
}

TEST_F(SearchProgram, TakesTheUnitAndTheAxisOfAMesh) {
  const std::string mesh = (folder_ / "wall.obj").string();
  std::ofstream(mesh) << "v 300 -500 -100\nv 300 500 -100\nv 300 500 300\nv 0 -500 300\nv -500 500 -100\n"
                         "f 1 2 3\nf 1 3 4\nf 2 3 5\n";
  expect_refused("--world '" + mesh + "'", "; a mesh whose unit is not the metre needs --scale");
  EXPECT_NE(run("--world '" + mesh + "' --scale 0.01 --up z --max-views 1 --resolution 0.1"), 2) << err_;
}

TEST_F(SearchProgram, RefusesWhatMakesNoSenseInOneLine) {
  expect_refused("--world crates-open --arm /tmp", "/tmp: cannot be opened");
  expect_refused("--world crates-open --arm /dev/zero", "/dev/zero: holds more than");
  expect_refused("--world crates-open --arm /nowhere/arm.urdf", "/nowhere/arm.urdf: cannot be opened");
  expect_refused("--world crates-open --links base_link", "--links 'base_link' must be BASE,SENSOR");
  expect_refused("--world crates-open --links base_link,hand", "has no link 'hand'");
  expect_refused("--world crates-open --joints 0,0,0", "--joints must be 5 angles in degrees");
  expect_refused("--world crates-open --base 1,2", "--base has 2 numbers");
  expect_refused("--world table", "--base 0,0,0,0: the start (");
  expect_refused("--world table --joints 0,-0.7,1.5,0,0", "--base 0,0,0,0 and --joints 0,-0.7,1.5,0,0: the start (");
  expect_refused("--world crates-open --scale 2", "--scale: crates-open is no mesh file");
  expect_refused("--world crates-open --resolution 1e-4", "of the region, must be at most 1e+09: take larger cells");
  const std::string bare = (folder_ / "bare.urdf").string();
  std::ofstream(bare) << R"(<robot name="bare"><link name="base_link"/><link name="sensor"/>
    <joint name="j" type="continuous"><parent link="base_link"/><child link="sensor"/><axis xyz="0 0 1"/></joint></robot>)";
  expect_refused("--world crates-open --arm " + bare, "bare.urdf has no collision shapes");
  expect_refused("--world moon", "there is no world \"moon\"");
  EXPECT_EQ(run("--help"), 0);
  EXPECT_NE(out_.find("--exhaustive"), std::string::npos);
}

}  // namespace
}  // namespace vantage
