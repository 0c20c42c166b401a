// SPDX-License-Identifier: MIT
// Files and exit codes of the program, however it ends: a file is complete or does not exist.
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
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "support/read_all.hpp"
#include "support/temporary_folder.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

constexpr const char* kShortRun =
    "explore --world table --sensor kinect --resolution 0.2 --planner nearest-frontier --max-views 2 ";
constexpr const char* kLongRun =
    "explore --world office --size 30,30 --sensor kinect --planner nearest-frontier --resolution 0.2 --no-coverage "
    "--max-views 100000 ";

class ProgramOutput : public testing::Test {
 protected:
  [[nodiscard]] std::string out() const { return (folder_ / "out").string(); }
  // Runs a shell command in which "vantage" is the program. Returns the exit code and stores stderr in err_.
  [[nodiscard]] int shell(const std::string& command) {
    const fs::path script = folder_ / "script.sh";
    std::ofstream(script) << "vantage() { '" VANTAGE_PROGRAM "' \"$@\"; }\n" << command << '\n';
    const fs::path err = folder_ / "stderr.txt";
    const int status = std::system(("bash '" + script.string() + "' 2>'" + err.string() + "'").c_str());
    err_ = test::read_all(err);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  // Expects one line on stderr that contains `what`.
  void expect_said(const std::string& what) const {
    EXPECT_EQ(err_.rfind("vantage: ", 0), 0U) << err_;
    EXPECT_EQ(std::count(err_.begin(), err_.end(), '\n'), 1) << err_;
    EXPECT_NE(err_.find(what), std::string::npos) << err_;
  }
  [[nodiscard]] std::set<std::string> files_in(const fs::path& folder) const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) {
      names.insert(entry.path().filename().string());
    }
    return names;
  }
  // Starts the program in the background.
  [[nodiscard]] pid_t start(const std::string& arguments) const {
    std::vector<std::string> words{VANTAGE_PROGRAM};
    std::istringstream given(arguments);
    for (std::string word; given >> word;) {
      words.push_back(word);
    }
    words.insert(words.end(), {"--out", out()});
    std::vector<char*> pointers;
    for (std::string& word : words) {
      pointers.push_back(word.data());
    }
    pointers.push_back(nullptr);
    const std::string err = folder_ / "stderr.txt";
    const pid_t child = ::fork();
    if (child == 0) {
      const int null = ::open("/dev/null", O_WRONLY);
      const int file = ::open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
      ::dup2(null, STDOUT_FILENO);
      ::dup2(file, STDERR_FILENO);
      ::execv(pointers[0], pointers.data());
      ::_exit(127);
    }
    return child;
  }
  // Waits up to two minutes until the run has recorded a few views.
  [[nodiscard]] bool is_under_way(pid_t child) const {
    for (int i = 0; i < 12000; ++i) {
      std::error_code none;
      if (fs::file_size(fs::path(out()) / "run.record", none) > 20'000 && !none) {
        return true;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ::kill(child, SIGKILL);
    (void)code_of(child);
    return false;
  }
  [[nodiscard]] static int code_of(pid_t child) {
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

  test::TemporaryFolder folder_;
  std::string err_;
};

TEST_F(ProgramOutput, AFullOrClosedStdoutIsAnError) {
  EXPECT_EQ(shell(std::string("vantage ") + kShortRun + "--json - --quiet >/dev/full"), 2);
  expect_said("stdout: not all could be written");
  EXPECT_EQ(shell("vantage list >/dev/full"), 2);
  expect_said("stdout: not all could be written");
  EXPECT_EQ(shell("vantage --help >/dev/full"), 2);
  expect_said("stdout: not all could be written");
  EXPECT_EQ(shell(std::string("set -o pipefail; vantage ") + kShortRun + "--json - --quiet | true"), 2);
  expect_said("stdout: not all could be written");
}

TEST_F(ProgramOutput, TargetsAreTriedBeforeTheRun) {
  const std::string nowhere = (folder_ / "no/such/report.json").string();
  EXPECT_EQ(shell(std::string("vantage ") + kLongRun + "--json " + nowhere), 2);
  expect_said("--json " + nowhere + ": cannot be written: No such file or directory");
  EXPECT_EQ(shell(std::string("vantage ") + kLongRun + "--out /proc/run"), 2);
  expect_said("--out /proc/run: cannot be made");
  EXPECT_EQ(shell(std::string("vantage ") + kLongRun + "--out /dev/null"), 2);
  expect_said("--out /dev/null: is not a folder");
  EXPECT_EQ(shell(std::string("vantage ") + kShortRun + "--quiet --json /dev/full"), 2);
  expect_said("/dev/full: cannot be written: No space left on device");
  EXPECT_EQ(shell("vantage map '" VANTAGE_PROGRAM "' --out x"), 2);
  EXPECT_EQ(shell(std::string("vantage ") + kShortRun + "--world nowhere.ply --out '" + out() + "/deeper'"), 2);
  EXPECT_FALSE(fs::exists(out())) << "trying leaves nothing behind";
}

TEST_F(ProgramOutput, AFolderHoldsOneRun) {
  fs::create_directories(fs::path(out()) / "frames");
  for (const char* name : {"voids.png", "void_utility.png", "run.record", "report.html", "map.ot.part",
                           "selection.json", "notes.txt", "frames/1.png", "frames/notes.txt"}) {
    std::ofstream(fs::path(out()) / name) << "old";
  }
  EXPECT_EQ(shell(std::string("vantage ") + kShortRun + "--quiet --out '" + out() + "'"), 3) << err_;
  const std::set<std::string> expected{"report.json", "map.ot", "floor_plan.png", "run.record",
                                       "report.html", "frames", "notes.txt"};
  EXPECT_EQ(files_in(out()), expected);
  EXPECT_EQ(files_in(fs::path(out()) / "frames"), std::set<std::string>{"notes.txt"});
  EXPECT_EQ(nlohmann::json::parse(test::read_all(fs::path(out()) / "report.json")).at("views"), 2);
}

TEST_F(ProgramOutput, TheRecordGivesTheSameReportAgain) {
  EXPECT_EQ(shell(std::string("vantage ") + kShortRun + "--audit --bound --quiet --out '" + out() + "'"), 3) << err_;
  const std::string again = (folder_ / "again").string();
  EXPECT_EQ(shell("vantage report '" + out() + "/run.record' --out '" + again + "' >/dev/null"), 0) << err_;
  const auto report = nlohmann::json::parse(test::read_all(fs::path(out()) / "report.json"));
  const auto repeated = nlohmann::json::parse(test::read_all(fs::path(again) / "report.json"));
  EXPECT_TRUE(report.contains("audit") && report.contains("path_bound"));
  EXPECT_EQ(nlohmann::json::diff(report, repeated), nlohmann::json::array());
}

TEST_F(ProgramOutput, AFileThatCannotBeWrittenKeepsNoOtherFromBeingWritten) {
  const std::set<std::string> all{"report.json", "map.ot", "floor_plan.png", "run.record", "report.html"};
  const std::string json = (folder_ / "report.json").string();
  for (const std::string name : {"map.ot", "floor_plan.png", "report.html", "run.record"}) {
    fs::remove_all(out());
    fs::remove(json);
    fs::create_directories(fs::path(out()) / name / "kept");
    EXPECT_EQ(shell(std::string("vantage ") + kShortRun + "--quiet --out '" + out() + "' --json '" + json + "'"), 2);
    expect_said(out() + "/" + name + ": cannot be written: Is a directory");
    EXPECT_TRUE(fs::exists(json)) << name;
    for (const std::string& other : all) {
      EXPECT_EQ(fs::is_regular_file(fs::path(out()) / other),
                other != name && (other != "report.html" || name != "run.record"))
          << other << " without " << name;
    }
  }
}

TEST_F(ProgramOutput, AReportMadeAgainIsWrittenAsFarAsItCanBe) {
  EXPECT_EQ(shell(std::string("vantage ") + kShortRun + "--quiet --out '" + out() + "'"), 3) << err_;
  const fs::path again = folder_ / "again";
  fs::create_directories(again / "report.html");
  EXPECT_EQ(shell("vantage report '" + out() + "/run.record' --ply --out '" + again.string() + "' >/dev/null"), 2);
  expect_said("report.html: cannot be written: Is a directory");
  const std::set<std::string> expected{"report.json", "report.html", "map.ply", "points.ply"};
  EXPECT_EQ(files_in(again), expected);
}

// A file size limit simulates a full disk: whichever file hits the limit, all existing files are complete.
TEST_F(ProgramOutput, AFullDiskLeavesWholeFilesOnly) {
  std::size_t failed = 0;
  std::size_t ran = 0;
  for (int kilobytes = 1; kilobytes < 3000; kilobytes = kilobytes * 2 + 1, ++ran) {
    fs::remove_all(out());
    const int code = shell("trap '' XFSZ; ulimit -f " + std::to_string(kilobytes) + "; vantage " + kShortRun +
                           "--quiet --out '" + out() + "'");
    if (code == 3) {
      continue;
    }
    ++failed;
    EXPECT_EQ(code, 2) << kilobytes;
    expect_said(": cannot be written: File too large");
    for (const std::string& name : files_in(out())) {
      const std::string content = test::read_all(fs::path(out()) / name);
      EXPECT_EQ(name.find(".part"), std::string::npos) << kilobytes;
      EXPECT_FALSE(content.empty() && name != "run.record") << name << " at " << kilobytes;
      if (name == "report.json") {
        EXPECT_TRUE(nlohmann::json::accept(content)) << kilobytes;
      } else if (name == "report.html") {
        EXPECT_NE(content.find("</html>"), std::string::npos) << kilobytes;
      } else if (fs::path(name).extension() == ".png") {
        EXPECT_NE(content.find("IEND"), std::string::npos) << name << " at " << kilobytes;
      }
    }
  }
  EXPECT_GE(failed, 5U);
  EXPECT_GE(ran, 10U);
}

TEST_F(ProgramOutput, ASignalEndsARunAfterTheViewAtHand) {
  for (const auto& [signal, code] : {std::pair(SIGINT, 130), std::pair(SIGTERM, 143)}) {
    fs::remove_all(out());
    const pid_t child = start(kLongRun);
    ASSERT_TRUE(is_under_way(child));
    ::kill(child, signal);
    EXPECT_EQ(code_of(child), code);
    const nlohmann::json report = nlohmann::json::parse(test::read_all(fs::path(out()) / "report.json"));
    EXPECT_EQ(report.at("outcome"), "interrupted");
    EXPECT_EQ(report.at("reason"), "interrupted after view " + std::to_string(report.at("views").get<int>()));
    for (const char* name : {"map.ot", "floor_plan.png", "run.record", "report.html"}) {
      EXPECT_TRUE(fs::exists(fs::path(out()) / name)) << name;
    }
    EXPECT_EQ(shell("vantage report '" + out() + "/run.record' --out '" + (folder_ / "again").string() + "' | grep " +
                    "': interrupted after view'"),
              0);
  }
}

TEST_F(ProgramOutput, ASecondSignalEndsItAtOnce) {
  const pid_t child = start(kLongRun);
  ASSERT_TRUE(is_under_way(child));
  ::kill(child, SIGINT);
  ::kill(child, SIGTERM);
  const int code = code_of(child);
  EXPECT_TRUE(code == 143 || code == 130) << code << ": two that wait are taken in any order";
  EXPECT_EQ(
      shell("vantage report '" + out() + "/run.record' --out '" + (folder_ / "again").string() + "' >/dev/null"), 0)
      << "the record up to the last view opens";
}

TEST_F(ProgramOutput, ASignalBeforeTheFirstViewLeavesNothing) {
  const pid_t child = start("explore --world office --size 60,60 --resolution 0.1 --planner nearest-frontier");
  std::this_thread::sleep_for(std::chrono::milliseconds(300));  // the program still computes what is observable
  ::kill(child, SIGTERM);
  const int code = code_of(child);
  EXPECT_TRUE(code == 143 || code == -SIGTERM) << code << ": it may not have begun to listen";
  EXPECT_FALSE(fs::exists(out()));
}

TEST_F(ProgramOutput, ALongSearchBeforeTheFirstViewIsToldWithoutATerminal) {
  const std::string object = (folder_ / "corner.obj").string();
  std::ofstream(object) << "v 0 4 3\nv 0 0 3\nv 0 0 0\nf 1 2 3\n";
  for (const std::string& arguments :
       {std::string("explore --world office --size 60,60 --resolution 0.1 --planner nearest-frontier"),
        "reconstruct --object " + object}) {
    const pid_t child = start(arguments);
    std::string told;
    for (int i = 0; i < 6000 && told.find('\n') == std::string::npos; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      told = test::read_all(folder_ / "stderr.txt");
    }
    ::kill(child, SIGKILL);
    EXPECT_EQ(code_of(child), -SIGKILL);
    EXPECT_EQ(told.rfind("looking for what can be observed, about ", 0), 0U) << arguments << '\n' << told;
    EXPECT_NE(told.find(" left; --no-coverage skips this\n"), std::string::npos) << told;
  }
}

// SIGKILL at any moment leaves complete files and a readable record.
TEST_F(ProgramOutput, KilledItLeavesWholeFilesOnly) {
  std::size_t opened = 0;
  for (int moment = 0; moment < 3; ++moment) {
    fs::remove_all(out());
    const pid_t child = start(kLongRun);
    ASSERT_TRUE(is_under_way(child));
    std::this_thread::sleep_for(std::chrono::milliseconds(40 * moment));
    ::kill(child, SIGKILL);
    EXPECT_EQ(code_of(child), -SIGKILL);
    for (const std::string& name : files_in(out())) {
      EXPECT_TRUE(name == "run.record" || fs::path(name).extension() == ".part") << name;
    }
    opened += shell("vantage report '" + out() + "/run.record' --out '" + (folder_ / "again").string() +
                    "' >/dev/null") == 0
                  ? 1U
                  : 0U;
  }
  EXPECT_EQ(opened, 3U);
}

TEST_F(ProgramOutput, OptionsThatWouldDoNothingAreRefused) {
  const auto refused = [&](const std::string& arguments, const std::string& what) {
    EXPECT_EQ(shell("vantage explore " + arguments + " --json '" + (folder_ / "x.json").string() + "'"), 2)
        << arguments;
    expect_said(what);
    EXPECT_FALSE(fs::exists(folder_ / "x.json")) << arguments;
  };
  std::ofstream(folder_ / "map.ot") << "# Octomap OcTree file\n";
  const std::string map = (folder_ / "map.ot").string();
  refused("--world rooms --up y", "--up: rooms is no mesh file");
  refused("--world rooms --scale 2", "--scale: rooms is no mesh file");
  refused("--world " + map + " --up z", "--up: " + map + " is no mesh file");
  refused("--world " + map + " --scale 1", "--scale: " + map + " is no mesh file");
  refused("--world " + map + " --size 4,4", "--size");
  for (const char* world : {"rooms", "table", "two-storey", "crates-open", "crates-closed"}) {
    refused(std::string("--world ") + world + " --size 8,8", "--size '8,8': ");
  }
  refused("--world table list", "explore takes no 'list'; what it takes: vantage explore --help");
  refused("list --world table", "explore takes no 'list'");
  refused("--world office --size 0,0", "--size '0,0' must be two numbers > 0");
  refused("--world office --size 1e9,8", "--size: '1e9' in '1e9,8' must be within 1e6 either way");
  refused("--world office --band 0.2,1.4 --yaw-only", "--yaw-only does not go with --band");
  refused("--world office --band 0.2,1.4,5", "--band '0.2,1.4,5' must hold LOW <= SENSOR <= HIGH");
  refused("--world office --band 1.4,0.2", "--band '1.4,0.2' must hold LOW <= SENSOR <= HIGH");
  refused("--world table --pose-noise 1e20,0", "--pose-noise: '1e20'");
  refused("--world table --pose-noise 11,0", "--pose-noise '11,0' must be two numbers");
  refused("--world table --noise nan", "--noise is nan, must be in [0, 1000]");
  refused("--world table --noise 1e9", "--noise is 1e+09, must be in [0, 1000]");
  refused("--world table --scan-spacing inf", "--scan-spacing is inf, must be in [0, 1e6] metres");
  refused("--world table --start 1e7,0,0", "--start: '1e7'");
  refused("--world table --planner next-best-view --set radii_m=1", "has no setting 'radii_m'");
  refused("--world table --planner next-best-view --set object=0,0,0,1,1,1 --set radii_m=nan",
          "setting 'radii_m' is 'nan', must be numbers > 0, with commas between them");
  refused("--world table --planner harmonic --set tolerance=inf", "setting 'tolerance' is 'inf'");
}

}  // namespace
}  // namespace vantage
