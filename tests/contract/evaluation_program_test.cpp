// SPDX-License-Identifier: MIT
// `vantage evaluate exploration`: its files, and how it goes on where it was interrupted.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "support/read_all.hpp"
#include "support/temporary_folder.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTiny = "vantage evaluate exploration --worlds small-maze --quick --starts 1 ";

class Evaluation : public testing::Test {
 protected:
  // Runs a shell command in which "vantage" is the program and $OUT the folder of the results.
  int shell(const std::string& command) {
    std::ofstream(folder_ / "script.sh")
        << "vantage() { '" VANTAGE_PROGRAM "' \"$@\"; }\nOUT='" << out().string() << "'\n"
        << command << '\n';
    const int status =
        std::system(("bash '" + (folder_ / "script.sh").string() + "' >'" + (folder_ / "stdout.txt").string() +
                     "' 2>'" + (folder_ / "stderr.txt").string() + "'")
                        .c_str());
    out_ = test::read_all(folder_ / "stdout.txt");
    err_ = test::read_all(folder_ / "stderr.txt");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  [[nodiscard]] fs::path out() const { return folder_ / "out"; }
  [[nodiscard]] fs::path run_file(const std::string& planner) const {
    return out() / "runs" / "small-maze" / (planner + "-1.json");
  }
  [[nodiscard]] nlohmann::json run(const std::string& planner) const {
    return nlohmann::json::parse(test::read_all(run_file(planner)));
  }
  [[nodiscard]] std::size_t runs_told() const {
    std::size_t count = 0;
    for (std::size_t at = err_.find(", start "); at != std::string::npos; at = err_.find(", start ", at + 1)) {
      ++count;
    }
    return count;
  }

  test::TemporaryFolder folder_;
  std::string out_;
  std::string err_;
};

TEST_F(Evaluation, MakesATableAndGoesOn) {
  const std::string command = std::string(kTiny) + "--planners next-best-view,frontier-gain,hypotheses=30 --out $OUT";
  ASSERT_EQ(shell(command), 0) << err_;
  EXPECT_EQ(runs_told(), 2U) << err_;
  for (const char* file : {"table.md", "results.json", "index.html", "sensors/aerial.json"}) {
    EXPECT_TRUE(fs::exists(out() / file)) << file;
  }
  EXPECT_EQ(out_, test::read_all(out() / "table.md"));
  EXPECT_NE(out_.find("\n| small-maze | next-best-view | 1 explored | "), std::string::npos) << out_;
  EXPECT_NE(out_.find("\n| small-maze | frontier-gain,hypotheses=30 | 1 explored | "), std::string::npos) << out_;
  EXPECT_NE(out_.find("    vantage evaluate exploration --out DIR --worlds small-maze --planners "
                      "next-best-view,frontier-gain,hypotheses=30 --starts 1 --quick\n"),
            std::string::npos)
      << out_;
  EXPECT_EQ(nlohmann::json::parse(test::read_all(out() / "results.json"))["rows"].size(), 2U);

  // The same start for both, and what a run was made with repeats it.
  const nlohmann::json first = run("next-best-view");
  EXPECT_EQ(first["cycles"][0]["pose"], run("frontier-gain,hypotheses=30")["cycles"][0]["pose"]);
  ASSERT_EQ(shell("cd $OUT && vantage explore " + first["options"].get<std::string>() + " --quiet --json -"), 0)
      << err_;
  nlohmann::json again = nlohmann::json::parse(out_);
  EXPECT_EQ(again["views"], first["views"]);
  EXPECT_EQ(again["duration_s"], first["duration_s"]);
  EXPECT_EQ(again["turned_deg"], first["turned_deg"]);
  EXPECT_EQ(again["coverage"], first["coverage"]);
  EXPECT_EQ(again["cycles"].back()["pose"], first["cycles"].back()["pose"]);

  // Nothing is made twice; what is missing, broken or of other options is.
  const std::string table = test::read_all(out() / "table.md");
  ASSERT_EQ(shell(command), 0) << err_;
  EXPECT_EQ(runs_told(), 0U) << err_;
  EXPECT_EQ(out_, table);
  const std::string whole = test::read_all(run_file("next-best-view"));
  std::ofstream(run_file("next-best-view")) << whole.substr(0, whole.size() / 2);
  ASSERT_EQ(shell(command), 0) << err_;
  EXPECT_EQ(runs_told(), 1U) << err_;
  EXPECT_EQ(run("next-best-view")["views"], first["views"]);
  std::string other = whole;
  other.replace(other.find("--seed 1"), 8, "--seed 2");
  std::ofstream(run_file("next-best-view")) << other;
  ASSERT_EQ(shell(command), 0) << err_;
  EXPECT_EQ(runs_told(), 1U) << err_;
  EXPECT_EQ(run("next-best-view")["options"], first["options"]);
}

TEST_F(Evaluation, RefusesBeforeTheFirstRun) {
  std::ofstream(folder_ / "file") << "not a folder";
  const std::string file = (folder_ / "file").string();
  std::size_t refused = 0;
  const auto expect_refused = [&](const std::string& options, const std::string& what) {
    const std::string with_out = options.find("--out") == std::string::npos ? " --out $OUT" : "";
    EXPECT_EQ(shell("unset VANTAGE_DATA; vantage evaluate exploration " + options + with_out), 2) << options;
    EXPECT_EQ(err_.rfind("vantage: ", 0), 0U) << err_;
    EXPECT_EQ(std::count(err_.begin(), err_.end(), '\n'), 1) << err_;
    EXPECT_NE(err_.find(what), std::string::npos) << err_;
    EXPECT_FALSE(fs::exists(out())) << options;
    ++refused;
  };
  expect_refused("--worlds room", "--worlds: there is no 'room'; there are the classes and worlds generated, ");
  expect_refused("--worlds complex-office", "--worlds complex-office: VANTAGE_DATA must name the folder");
  expect_refused("--worlds rooms --planners harmonious", "harmonious");
  expect_refused("--worlds rooms --planners harmonic,mode=best", "mode");
  expect_refused("--worlds rooms --planners harmonic,gain=3", "gain");
  expect_refused("--worlds rooms --starts 0", "--starts");
  expect_refused("--worlds rooms --jobs 0", "--jobs");
  expect_refused("--worlds rooms --out " + file, "--out");
  expect_refused("--worlds rooms --out " + file + "/within", "--out");
  EXPECT_EQ(refused, 9U);
}

TEST_F(Evaluation, ObjectsNeedAFileOfResultsThatCanBeWritten) {
  EXPECT_EQ(shell("vantage evaluate objects --results $OUT/runs"), 2);
  EXPECT_EQ(err_, "vantage: " + (out() / "runs").string() + ": cannot be written: No such file or directory\n");
  EXPECT_EQ(shell("vantage evaluate objects --objects mug --planners evenly-spaced --quick --max-views 1 --results "
                  "/dev/full"),
            2);
  EXPECT_NE(err_.find("vantage: /dev/full: cannot be written: No space left on device\n"), std::string::npos) << err_;
}

TEST_F(Evaluation, LeavesOutWorldsWhoseDataIsNotThere) {
  EXPECT_EQ(shell("unset VANTAGE_DATA; " + std::string(kTiny) +
                  "--worlds timed --planners next-best-view --jobs 2 --out $OUT"),
            0)
      << err_;
  EXPECT_EQ(err_.rfind("VANTAGE_DATA is not set: complex-office, maze1, maze4 are left out\n", 0), 0U) << err_;
  EXPECT_EQ(runs_told(), 1U) << err_;
}

TEST_F(Evaluation, EndsCleanlyWhenInterrupted) {
  const std::string arguments =
      "evaluate exploration --worlds small-maze,driven --planners next-best-view "
      "--starts 1 --out " +
      out().string();
  const pid_t child = ::fork();
  if (child == 0) {
    const int file = ::open((folder_ / "stderr.txt").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    ::dup2(file, STDERR_FILENO);
    ::dup2(file, STDOUT_FILENO);
    ::execl("/bin/sh", "sh", "-c", ("exec '" VANTAGE_PROGRAM "' " + arguments).c_str(), nullptr);
    ::_exit(127);
  }
  for (int i = 0; i < 12000 && !fs::exists(run_file("next-best-view")); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ASSERT_TRUE(fs::exists(run_file("next-best-view")));
  ::kill(child, SIGINT);
  int status = 0;
  ::waitpid(child, &status, 0);
  err_ = test::read_all(folder_ / "stderr.txt");
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130) << err_;
  EXPECT_NE(err_.find("interrupted: 1 of 2 runs are there; the same command goes on"), std::string::npos) << err_;
  EXPECT_FALSE(fs::exists(out() / "runs" / "driven-office" / "next-best-view-1.json"));
  EXPECT_TRUE(fs::exists(out() / "index.html"));
}

}  // namespace
}  // namespace vantage
