// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "support/read_all.hpp"

namespace {

namespace fs = std::filesystem;

// The command names listed in the help.
std::vector<std::string> commands_of(const std::string& help) {
  std::vector<std::string> names;
  std::istringstream lines(help.substr(help.find("Commands")));
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line) && line.rfind("  ", 0) == 0) {
    names.push_back(line.substr(2, line.find(' ', 2) - 2));
  }
  return names;
}

// The option names in the help of a command, in order.
std::vector<std::string> options_of(const std::string& help) {
  std::vector<std::string> names;
  std::istringstream lines(help);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("  -", 0) == 0) {
      std::istringstream words(line.substr(2, line.find(' ', 2) - 2));
      for (std::string name; std::getline(words, name, ',');) {
        names.push_back(name);
      }
    }
  }
  return names;
}

struct Ran {
  int code = -1;
  std::string out;
  std::string err;
};

/// Runs the real program in a temporary folder.
class Program : public testing::Test {
 protected:
  Program()
      : folder_(fs::temp_directory_path() / ("vantage_program_" + std::to_string(::getpid()) + "_" +
                                             testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::create_directories(folder_);
  }
  ~Program() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string file(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return (folder_ / name).string();
  }
  [[nodiscard]] std::string out() const { return (folder_ / "out").string(); }
  [[nodiscard]] Ran run(const std::string& arguments) const {
    const fs::path out = folder_ / "stdout.txt";
    const fs::path err = folder_ / "stderr.txt";
    const std::string command =
        "'" VANTAGE_PROGRAM "' " + arguments + " >'" + out.string() + "' 2>'" + err.string() + "'";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, vantage::test::read_all(out), vantage::test::read_all(err)};
  }
  /// Expects exit code 2, one line `vantage: ...` on stderr that contains `names`, and no output file.
  void expect_refused(const std::string& arguments, const std::string& names,
                      const std::string& command = "explore ") {
    const std::string json = (folder_ / "report.json").string();
    const Ran ran = run(command + arguments + " --out '" + out() + "' --json '" + json + "'");
    EXPECT_EQ(ran.code, 2) << arguments << '\n' << ran.err;
    EXPECT_EQ(ran.err.rfind("vantage: ", 0), 0U) << arguments << '\n' << ran.err;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << arguments << '\n' << ran.err;
    EXPECT_NE(ran.err.find(names), std::string::npos) << arguments << '\n' << ran.err;
    EXPECT_EQ(ran.out, "") << arguments;
    EXPECT_FALSE(fs::exists(out())) << arguments;
    EXPECT_FALSE(fs::exists(json)) << arguments;
    ++refused_;
  }

  fs::path folder_;
  int refused_ = 0;
};

constexpr const char* kTable = "--world table --sensor kinect --resolution 0.2 --planner nearest-frontier ";

std::string ply(const std::string& vertices, std::size_t vertex_count, const std::string& faces,
                std::size_t face_count) {
  return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(vertex_count) +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(face_count) +
         "\nproperty list uchar int vertex_indices\nend_header\n" + vertices + faces;
}

TEST_F(Program, RefusesNumbersOutOfRange) {
  const std::string table(kTable);
  expect_refused("--world table --resolution 0", "--resolution is 0");
  expect_refused("--world table --resolution -0.1", "--resolution");
  expect_refused("--world table --resolution nan", "--resolution is nan");
  expect_refused("--world table --resolution 1e-7", "--resolution");
  expect_refused("--world table --resolution two", "--resolution: 'two' is not a number");
  expect_refused(table + "--size 8,8", "WorldOptions::length_m is 8, must be 0: table has a size of its own");
  expect_refused(table + "--band 0.2,1.4,2.5", "--band '0.2,1.4,2.5' must hold LOW <= SENSOR <= HIGH");
  expect_refused(table + "--band 900,901", "--band '900,901': HeightBandOptions::min_height_m is 900, must be below");
  expect_refused(table + "--set patience=3 --set patience=4", "--set 'patience=4': that setting is given twice");
  expect_refused(table + "--out ''", "--out: is empty");
  expect_refused(table + "--json ''", "--json: is empty");
  expect_refused(table + "--robot-radius -1", "--robot-radius");
  expect_refused(table + "--max-views 0", "--max-views");
  expect_refused(table + "--max-views -3", "--max-views: '-3' is not a whole number");
  expect_refused(table + "--memory-limit -1", "--memory-limit is -1, must be 0 or in [0.01, 1e9] MB");
  expect_refused(table + "--memory-limit nan", "--memory-limit");
  expect_refused(table + "--threads 99999999999", "--threads: '99999999999' is not a whole number from 0 to 1024");
  expect_refused(table + "--threads 0", "--threads");
  expect_refused(table + "--seed x", "--seed");
  expect_refused(table + "--seed -1", "--seed");
  expect_refused(table + "--scan-spacing -1", "--scan-spacing");
  expect_refused(table + "--noise -1", "--noise");
  expect_refused(table + "--pose-noise 0.01", "--pose-noise '0.01' must be two numbers");
  expect_refused(table + "--pose-noise 0.01,-1", "--pose-noise");
  expect_refused(table + "--up x", "--up");
  expect_refused(table + "--scale 0", "--scale");
  expect_refused(table + "--seed 1 --seed 2", "--seed is given twice, must be given once");
  expect_refused(table + "--seed 1 --seed 2 --seed 3", "--seed is given 3 times");
  EXPECT_EQ(refused_, 28);
}

TEST_F(Program, RefusesNamesThatDoNotExist) {
  expect_refused("--world room", "room");
  expect_refused("--world rooms --planner harmonious", "harmonious");
  expect_refused("--world rooms --planner harmonious", "tour, distance-advantage");  // planners, then peers
  expect_refused("--world rooms --sensor kinekt", "kinekt");
  expect_refused("--world rooms --sensor /dev/zero", "/dev/zero: ");
  expect_refused(std::string(kTable) + "--set gain=3", "gain");
  expect_refused(std::string(kTable) + "--set =3", "=3");
  expect_refused("--world rooms --planner harmonic --set tolerance=small", "tolerance");
  expect_refused(std::string(kTable) + "--fast",
                 "explore has no option --fast; what it takes: vantage explore --help");
  expect_refused("--world rooms --planer tour", "explore has no option --planer");
  expect_refused("--world rooms tour", "explore takes no 'tour'");
  expect_refused("--planner harmonic", "--world");
  EXPECT_EQ(refused_, 12);
}

TEST_F(Program, RefusesRegionsAndStarts) {
  const std::string table(kTable);
  expect_refused(table + "--region 0,0,0,1,1", "--region");
  expect_refused(table + "--region 0,0,0,1,one,1", "'one'");
  expect_refused(table + "--region 1,0,0,0,1,1", "--region");
  expect_refused(table + "--region 0,0,0,inf,1,1", "'inf'");
  expect_refused(table + "--region 50,50,0,51,51,1", "--region 50,50,0,51,51,1 holds nothing of the world");
  expect_refused("--world table --resolution 30", "no cell of 30 m");
  expect_refused("--world table --resolution 0.0001", "at most 1e+09: take larger cells, or a smaller region\n");
  expect_refused(table + "--start 0,0", "--start");
  expect_refused(table + "--start 0,0,high", "'high'");
  expect_refused(table + "--start 50,0,1", "--start 50,0,1");
  expect_refused(table + "--start 1.79,0,1", "--start 1.79,0,1: the start (1.79, 0, 1) is in or too near a wall");
  expect_refused("--world rooms --yaw-only --start 2,2,1,0,45", "an orientation that the robot cannot take");
  expect_refused(table + "--region -1,-1,0,1,1,2 --start 1.5,0,1", "--start 1.5,0,1");
  expect_refused(table + "--robot-radius 9", "fits nowhere");
  expect_refused("--world rooms --sensor stereo --resolution 0.15 --band 0.2,1.4", "begin at 0.15 m, and the floor");
  expect_refused("--world rooms --sensor stereo --band 0.3,1.4 --robot-radius 9", "region; it is too large, or");
  expect_refused("--world rooms --sensor stereo --band 0.44,1.4", "the floor at the start is at 0.19 m");
  expect_refused("--world rooms --sensor stereo --band 0.44,1.4 --start 2,2,0.92",
                 "the floor at the start is at 0.19 m");
  EXPECT_EQ(refused_, 18);
}

TEST_F(Program, RefusesFilesThatAreMissingOrBroken) {
  const std::string tail = " --sensor kinect --planner nearest-frontier";
  expect_refused("--world /nowhere/house.ply" + tail, "/nowhere/house.ply");
  expect_refused("--world /nowhere/map.bt" + tail, "/nowhere/map.bt");
  const std::string points = file("points.ply", ply("0 0 0\n1 0 0\n0 1 0\n", 3, "", 0));
  expect_refused("--world " + points + tail, points);
  const std::string nan = file("nan.ply", ply("0 0 0\nnan 0 0\n0 1 0\n", 3, "3 0 1 2\n", 1));
  expect_refused("--world " + nan + tail, nan);
  const std::string line = file("line.ply", ply("0 0 0\n1 0 0\n2 0 0\n", 3, "3 0 1 2\n", 1));
  expect_refused("--world " + line + tail, line + ": holds no triangle with an area");
  const std::string faces = "3 0 1 2\n3 0 1 3\n3 0 2 3\n3 1 2 3\n";
  const std::string tiny = file("tiny.ply", ply("0 0 0\n1e-3 0 0\n0 1e-3 0\n0 0 1e-3\n", 4, faces, 4));
  expect_refused("--world " + tiny + tail + " --up z",
                 tiny +
                     ": the region of 0.001 x 0.001 x 0.001 m holds no cell of 0.2 m: take smaller cells, "
                     "--resolution; a mesh whose unit is not the metre needs --scale");
  const std::string text = file("text.ply", "this is no mesh\n");
  expect_refused("--world " + text + tail, text);
  const std::string empty = file("empty.bt", "");
  expect_refused("--world " + empty + tail, empty);
  const std::string cut = file("cut.bt", "# Octomap OcTree binary file\nid OcTree\nsize 1000\nres 0.1\ndata\nab");
  expect_refused("--world " + cut + tail, cut);
  const std::string json = file("sensor.json", "{\"width\": 64,\n \"height\": }");
  expect_refused("--world table --sensor " + json, json);
  const std::string range =
      file("range.json", R"({"width": 64, "height": 48, "fx": 60, "fy": 60, "max_range_m": -4})");
  expect_refused("--world table --sensor " + range, "max_range_m is -4");
  expect_refused("--world table --sensor /nowhere/sensor.json", "/nowhere/sensor.json");
  EXPECT_EQ(refused_, 12);
}

TEST_F(Program, TimesARun) {
  const std::string motion = "--max-speed 2 --max-acceleration 3 --max-yaw-rate 90 --scan-rate 10 ";
  const Ran ran =
      run("explore --world table --sensor panoramic --resolution 0.2 --planner nearest-frontier --json - " + motion);
  EXPECT_EQ(ran.code, 0) << ran.err;
  const nlohmann::json report = nlohmann::json::parse(ran.out);
  ASSERT_TRUE(report["duration_s"].is_number());
  EXPECT_LE(report["duration_s"], report["cycles"].back()["time_s"]);
  EXPECT_GT(report["turned_deg"], 0.0);
  EXPECT_NEAR(report["cycles"][3]["time_s"].get<double>(), 0.3, 1e-12);
  EXPECT_NE(ran.err.find("duration"), std::string::npos) << ran.err;
  const std::string table(kTable);
  expect_refused(table + "--max-speed 2", "--max-acceleration is missing");
  expect_refused(table + "--planning-latency 0.1", "--max-speed is missing");
  expect_refused(table + motion + "--max-yaw-acceleration 0", "--max-yaw-acceleration");
  expect_refused(table + motion + "--planning-latency -1", "--planning-latency");
  expect_refused(table + "--max-acceleration 3 --max-yaw-rate 90 --scan-rate 15 --max-speed 0", "--max-speed");
  EXPECT_EQ(refused_, 5);
}

TEST_F(Program, RefusesWhatItCannotDo) {
  for (const char* arguments : {"", "dance", "explore --world", "reconstruct", "list --all"}) {
    const Ran ran = run(arguments);
    EXPECT_EQ(ran.code, 2) << arguments;
    EXPECT_EQ(ran.err.rfind("vantage: ", 0), 0U) << ran.err;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
  }
  const std::string names = run("dance").err;
  EXPECT_NE(names.find("no command 'dance'; there are: explore, reconstruct, replay, "), std::string::npos) << names;
  EXPECT_NE(names.find("report, compare, evaluate, map, list"), std::string::npos) << names;
}

TEST_F(Program, HelpsAndLists) {
  EXPECT_EQ(run("--help").code, 0);
  const Ran help = run("explore --help");
  EXPECT_EQ(help.code, 0);
  for (const char* flag :
       {"--world", "--planner", "--sensor", "--resolution", "--region", "--start", "--robot-radius", "--max-views",
        "--seed", "--threads", "--out", "--json", "--set", "--up", "--scale", "--set", "[harmonic]"}) {
    EXPECT_NE(help.out.find(flag), std::string::npos) << flag;
  }
  for (const char* command :
       {"--help", "explore --help", "report --help", "compare --help", "map --help", "list --help", "list"}) {
    std::istringstream text(run(command).out);
    std::size_t lines = 0;
    for (std::string line; std::getline(text, line); ++lines) {
      EXPECT_LE(line.size(), 120U) << line;
    }
    EXPECT_GE(lines, 6U) << command;
  }
  const Ran list = run("list");
  EXPECT_EQ(list.code, 0);
  for (const char* name : {"rooms", "office", "maze", "two-storey", "table", "crates-open", "crates-closed",
                           "harmonic", "frontier-gain", "nearest-frontier", "tour", "kinect", "panoramic"}) {
    EXPECT_NE(list.out.find(name), std::string::npos) << name;
  }
}

TEST_F(Program, ExploresAndReports) {
  const Ran ran = run("explore --world table --planner harmonic --sensor panoramic --resolution 0.2 --out '" + out() +
                      "' --json -");
  EXPECT_EQ(ran.code, 0) << ran.err;
  const nlohmann::json report = nlohmann::json::parse(ran.out);  // stdout contains JSON only
  EXPECT_EQ(report["command"], "explore");
  EXPECT_EQ(report["world"], "table");
  EXPECT_EQ(report["planner"], "harmonic");
  EXPECT_EQ(report["outcome"], "explored");
  EXPECT_EQ(report["resolution_m"], 0.2);
  EXPECT_EQ(report["views"], report["cycles"].size());
  EXPECT_EQ(report["collisions"], 0);
  EXPECT_GE(report["coverage"].get<double>(), 0.95);
  EXPECT_EQ(report["cycles"][0]["pose"].size(), 7U);
  EXPECT_NE(ran.err.find("view    1"), std::string::npos) << ran.err;
  EXPECT_EQ(nlohmann::json::parse(vantage::test::read_all(fs::path(out()) / "report.json")), report);
  for (const char* name : {"report.json", "map.ot", "floor_plan.png"}) {
    EXPECT_TRUE(fs::exists(fs::path(out()) / name)) << name;
    EXPECT_NE(ran.err.find(name), std::string::npos) << "the program names what it wrote: " << name;
  }
}

// The floor lies inside of a cell, through the upper part of which rays pass that meet it further away.
TEST_F(Program, ARobotThatDrivesIsNotCutOffByItsOwnFloor) {
  const Ran ran =
      run("explore --world rooms --resolution 0.25 --band 0.3,1.4 --look-around --sensor lidar --robot-radius 0.2 "
          "--planner nearest-frontier --json -");
  EXPECT_EQ(ran.code, 0) << ran.err;
  const nlohmann::json report = nlohmann::json::parse(ran.out);
  EXPECT_EQ(report["outcome"], "explored");
  EXPECT_GE(report["coverage"].get<double>(), 0.99);
}

// Cells of twice the radius: a free cell may hold a part of a wall, which only the cells beside it show.
TEST_F(Program, ABodySmallerThanACellTouchesNoWall) {
  std::size_t views = 0;
  for (const char* seed : {"1", "3"}) {
    const Ran ran = run(std::string("explore --world maze --size 8,8 --sensor kinect --resolution 0.3 --yaw-only "
                                    "--max-views 300 --json - --seed ") +
                        seed);
    const nlohmann::json report = nlohmann::json::parse(ran.out);
    EXPECT_EQ(report["collisions"], 0) << seed;
    EXPECT_GE(report["coverage"].get<double>(), 0.99) << seed;
    views += report["views"].get<std::size_t>();
  }
  EXPECT_GE(views, 100U);
}

TEST_F(Program, TellsHowShortAWayCouldBe) {
  const std::string arguments =
      "explore --world table --planner harmonic --sensor panoramic --resolution 0.2 --json -";
  const Ran bounded = run(arguments + " --bound");
  EXPECT_EQ(bounded.code, 0) << bounded.err;
  const nlohmann::json report = nlohmann::json::parse(bounded.out);
  EXPECT_GT(report["path_bound"]["length_m"].get<double>(), 1.0);
  EXPECT_TRUE(report["path_bound"]["is_met"].is_boolean());
  EXPECT_NE(bounded.err.find("  bound        "), std::string::npos) << bounded.err;
  EXPECT_NE(bounded.err.find(" times as far to see "), std::string::npos) << bounded.err;

  const Ran plain = run(arguments);
  EXPECT_FALSE(nlohmann::json::parse(plain.out).contains("path_bound"));
  EXPECT_EQ(plain.err.find("  bound        "), std::string::npos) << plain.err;
}

TEST_F(Program, CompletesInBash) {
  const auto completed = [&](const std::string& words, int word) {
    const std::string script =
        "source '" VANTAGE_SOURCE_DIR "/src/apps/completion.bash'; COMP_WORDS=('" VANTAGE_PROGRAM "' " + words +
        "); COMP_CWORD=" + std::to_string(word) + "; _vantage; printf '%s ' \"${COMPREPLY[@]}\"";
    const std::string command =
        "bash -c \"$(cat '" + file("script.sh", script) + "')\" >'" + (folder_ / "words.txt").string() + "'";
    EXPECT_EQ(std::system(command.c_str()), 0) << script;
    return vantage::test::read_all(folder_ / "words.txt");
  };
  EXPECT_EQ(completed("exp", 1), "explore ");
  EXPECT_EQ(completed("explore --reg", 2), "--region ");
  EXPECT_EQ(completed("explore --world two", 3), "two-storey ");
  EXPECT_EQ(completed("explore --planner near", 3), "nearest-frontier ");
  EXPECT_EQ(completed("reconstruct --sensor v", 3), "vpl ");
  EXPECT_EQ(completed("compare --o", 2), "--out ");
  EXPECT_EQ(completed("reconstruct --method h", 3), "hierarchical ");
  EXPECT_EQ(completed("replay --format ki", 3), "kitti-stereo ");
  EXPECT_EQ(completed("replay --planner harmonic,next", 3), "harmonic,next-best-view ");

  // All commands and options that the help describes at the start of a line, and no others.
  const std::vector<std::string> commands = commands_of(run("--help").out);
  EXPECT_GE(commands.size(), 7U);
  std::string all;
  for (const std::string& command : commands) {
    all += command + ' ';
    std::string options;
    for (const std::string& option : options_of(run(command + " --help").out)) {
      options += option + ' ';
    }
    EXPECT_EQ(completed(command + " -", 2), options) << command;
    EXPECT_NE(options.find("--help "), std::string::npos) << command;
  }
  EXPECT_EQ(completed("''", 1), all + "--help --version ");
}

TEST_F(Program, HelpsWithEveryCommandByExamplesThatItTakes) {
  std::size_t examples = 0;
  for (const std::string& command : commands_of(run("--help").out)) {
    const std::string help = run(command + " --help").out;
    const std::vector<std::string> known = options_of(help);
    std::istringstream lines(help.substr(help.find("Example")));
    for (std::string line; std::getline(lines, line);) {
      if (line.rfind("  vantage ", 0) != 0) {
        continue;
      }
      ++examples;
      EXPECT_EQ(line.rfind("  vantage " + command, 0), 0U) << line;
      std::istringstream words(line.substr(0, line.find(" | ")));
      for (std::string word; words >> word;) {
        EXPECT_TRUE(word.rfind("--", 0) != 0 || std::find(known.begin(), known.end(), word) != known.end())
            << command << " has no option " << word;
      }
    }
    EXPECT_NE(help.find("\n  vantage " + command), std::string::npos) << command << " has no example";
  }
  EXPECT_GE(examples, 12U);
}

// Uses the program `script` to simulate a terminal.
TEST_F(Program, DrawsOneBarOnATerminal) {
  if (std::system("command -v script >/dev/null") != 0) {
    GTEST_SKIP() << "there is no program `script` here to play a terminal";
  }
  const std::string typed = (folder_ / "typed.txt").string();
  const std::string command = "script -qec \"'" VANTAGE_PROGRAM "' explore " + std::string(kTable) +
                              "--max-views 4\" '" + typed + "' >/dev/null </dev/null";
  EXPECT_EQ(std::system(command.c_str()), 3 << 8);
  const std::string text = vantage::test::read_all(typed);
  EXPECT_EQ(text.find("view    1"), std::string::npos) << "no lines beside the bar\n" << text;
  std::size_t bars = 0;
  for (std::size_t at = text.find("\r["); at != std::string::npos; at = text.find("\r[", at + 1)) {
    ++bars;
    const std::string bar = text.substr(at + 1, text.find('\x1b', at) - at - 1);
    EXPECT_LE(bar.size(), 100U);
    EXPECT_NE(bar.find(" %  view " + std::to_string(bars) + "  "), std::string::npos) << bar;
    EXPECT_EQ(bar.find("views/s") != std::string::npos, bars > 1) << bar;
  }
  EXPECT_EQ(bars, 4U) << text;
}

TEST_F(Program, RecordsAndCompares) {
  const std::string first = (folder_ / "first").string();
  const std::string second = (folder_ / "second").string();
  for (const std::string& folder : {first, second}) {
    const Ran ran = run("explore " + std::string(kTable) + "--max-views 3 --quiet --seed " +
                        (folder == first ? "1" : "2") + " --out '" + folder + "'");
    EXPECT_EQ(ran.code, 3) << ran.err;
    EXPECT_EQ(ran.out + ran.err, "") << "it is quiet";
  }
  const Ran compared = run("compare '" + first + "/report.json' '" + second + "/report.json' --out '" + out() + "'");
  EXPECT_EQ(compared.code, 0) << compared.err;
  EXPECT_NE(compared.out.find("nearest-frontier in table, 0.2 m  2     3 (3-3)"), std::string::npos) << compared.out;
  EXPECT_GT(fs::file_size(fs::path(out()) / "report.html"), 500'000U);

  const Ran named =
      run("compare --by-folder '" + first + "/report.json' '" + second + "/report.json' --out '" + out() + "'");
  EXPECT_EQ(named.code, 0) << named.err;
  EXPECT_NE(named.out.find("\nfirst    1     3 "), std::string::npos) << named.out;
  EXPECT_NE(named.out.find("\nsecond   1     3 "), std::string::npos) << named.out;

  // Simulates a crash: the end of the file is missing.
  const fs::path record = fs::path(first) / "run.record";
  fs::resize_file(record, fs::file_size(record) - 20);
  const std::string morning = (folder_ / "morning").string();
  const Ran reported = run("report '" + record.string() + "' --ply --out '" + morning + "'");
  EXPECT_EQ(reported.code, 0) << reported.err;
  EXPECT_NE(reported.out.find("3 views, budget: the record ends before the run does"), std::string::npos);
  for (const char* name : {"report.html", "report.json", "map.ply", "points.ply"}) {
    EXPECT_TRUE(fs::exists(fs::path(morning) / name)) << name;
  }
  const nlohmann::json cut = nlohmann::json::parse(vantage::test::read_all(fs::path(morning) / "report.json"));
  EXPECT_GT(cut["coverage"], 0.0);
  EXPECT_TRUE(cut["observable_cells"].is_null()) << "only the end of a record tells it";
  const std::string nowhere = (folder_ / "nowhere").string();
  for (const char* arguments : {"report /nowhere/run.record", "compare /nowhere/report.json",
                                "report '" VANTAGE_PROGRAM "'", "compare '" VANTAGE_PROGRAM "'"}) {
    const Ran ran = run(std::string(arguments) + " --out '" + nowhere + "'");
    EXPECT_EQ(ran.code, 2) << arguments;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    EXPECT_FALSE(fs::exists(nowhere)) << arguments;
  }
}

TEST_F(Program, SaysThatABudgetEndedIt) {
  const Ran ran = run("explore " + std::string(kTable) + "--max-views 1 --json -");
  EXPECT_EQ(ran.code, 3) << ran.err;
  const nlohmann::json report = nlohmann::json::parse(ran.out);
  EXPECT_EQ(report["outcome"], "budget");
  EXPECT_EQ(report["views"], 1);
}

// Two rooms, and between them a gap that sight passes and the body does not.
TEST_F(Program, SaysThatSomethingIsLeft) {
  constexpr int kWidth = 60;
  constexpr int kHeight = 30;
  fs::create_directories(out());
  std::ofstream image(out() + "/rooms.pgm");
  image << "P2\n" << kWidth << ' ' << kHeight << "\n255\n";
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const bool border = x == 0 || x == kWidth - 1 || y == 0 || y == kHeight - 1;
      image << (border || (x == 25 && y != 14 && y != 15) ? 0 : 254) << '\n';
    }
  }
  image.close();
  std::ofstream(out() + "/rooms.yaml") << "image: rooms.pgm\nresolution: 0.1\norigin: [0.0, 0.0, 0.0]\n"
                                          "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
  const Ran ran = run("explore --world '" + out() + "/rooms.yaml' --start 1,1,0 --robot-radius 0.25 --json -");
  EXPECT_EQ(ran.code, 4) << ran.err;
  const nlohmann::json report = nlohmann::json::parse(ran.out);
  EXPECT_EQ(report["outcome"], "unreachable");
  EXPECT_NE(report["reason"].get<std::string>().find("free space that is cut off"), std::string::npos);
}

TEST_F(Program, SaysThatAFullMapEndedIt) {
  const Ran ran = run("explore " + std::string(kTable) + "--memory-limit 0.02 --json - --out '" + out() + "'");
  EXPECT_EQ(ran.code, 3) << ran.err;
  const nlohmann::json report = nlohmann::json::parse(ran.out);
  EXPECT_EQ(report["outcome"], "budget");
  const auto refused = report["cells_refused"].get<std::size_t>();
  EXPECT_GT(refused, 0U);
  EXPECT_NE(report["reason"].get<std::string>().find("; the map is full: it refused " + std::to_string(refused)),
            std::string::npos)
      << report["reason"];
  EXPECT_GT(report["coverage"], 0.01);
  EXPECT_LT(report["coverage"], 0.9);
  const std::string map = out() + "/map.ot";
  EXPECT_EQ(run("map '" + map + "' --memory-limit 0.02").code, 0);
  const Ran too_large = run("map '" + map + "' --memory-limit 0.01");
  EXPECT_EQ(too_large.code, 2);
  EXPECT_EQ(too_large.err, "vantage: " + map + ": its map needs more than the 10000 bytes of --memory-limit\n");
  EXPECT_EQ(too_large.out, "");
  const Ran whole = run("explore " + std::string(kTable) + "--memory-limit 100 --max-views 5 --json -");
  EXPECT_EQ(whole.code, 3) << whole.err;
  EXPECT_EQ(nlohmann::json::parse(whole.out)["cells_refused"], 0);
}

// A mesh: a block of 20 x 16 x 24 cm.
std::string block(double scale = 1.0) {
  std::ostringstream vertices;
  for (int corner = 0; corner < 8; ++corner) {
    vertices << (corner % 2 == 0 ? -0.1 : 0.1) * scale << ' ' << (corner / 2 % 2 == 0 ? -0.08 : 0.08) * scale << ' '
             << (corner / 4 == 0 ? 0.0 : 0.24) * scale << '\n';
  }
  const std::string faces = "4 0 1 3 2\n4 4 5 7 6\n4 0 1 5 4\n4 2 3 7 6\n4 0 2 6 4\n4 1 3 7 5\n";
  return ply(vertices.str(), 8, faces, 6);
}

TEST_F(Program, ReconstructsAnObjectOnTheTable) {
  const std::string object = "--object '" + file("block.ply", block()) + "' ";
  const Ran ran =
      run("reconstruct " + object + "--table --candidates 80 --resolution 0.04 --json - --out '" + out() + "'");
  ASSERT_EQ(ran.code, 0) << ran.err;
  const nlohmann::json report = nlohmann::json::parse(ran.out);
  EXPECT_EQ(report["command"], "reconstruct");
  EXPECT_EQ(report["planner"], "next-best-view");
  EXPECT_EQ(report["outcome"], "explored");
  EXPECT_GT(report["coverage"], 0.7);
  EXPECT_GT(report["observable_cells"], 50) << "of the box, seen from outside of it";
  EXPECT_GT(report["surface_coverage"], 0.7) << "all but what stands on the table";
  EXPECT_GT(report["seen_coverage"], 0.7) << "the same";
  EXPECT_GT(report["seen_observable"], 0.9);
  EXPECT_LE(report["seen_observable"], 1.0);
  EXPECT_NEAR(report["cycles"].back()["seen_observable"], report["seen_observable"], 1e-9);
  double seen = 0.0;
  for (const nlohmann::json& cycle : report["cycles"]) {
    EXPECT_GT(cycle["coverage"], 0.0);
    EXPECT_GE(cycle["seen_coverage"], seen);
    seen = cycle["seen_coverage"];
  }
  EXPECT_EQ(report["seen_coverage"], seen);
  EXPECT_GT(report["views"], 1);
  EXPECT_LT(report["views"], 15);
  EXPECT_EQ(report["collisions"], 0);
  EXPECT_TRUE(fs::exists(fs::path(out()) / "map.ot"));
  const Ran again = run("reconstruct " + object + "--table --candidates 80 --resolution 0.04 --json - --threads 2");
  const nlohmann::json same = nlohmann::json::parse(again.out);
  EXPECT_EQ(same["path_length_m"], report["path_length_m"]);
  EXPECT_EQ(same["surface_coverage"], report["surface_coverage"]);
  const Ran spent = run("reconstruct " + object + "--resolution 0.04 --max-views 1 --candidates 30");
  EXPECT_EQ(spent.code, 3) << spent.err;
  const Ran unmeasured =
      run("reconstruct " + object + "--table --resolution 0.04 --max-views 1 --no-coverage --json -");
  const nlohmann::json without = nlohmann::json::parse(unmeasured.out);
  EXPECT_TRUE(without["coverage"].is_null());
  EXPECT_TRUE(without["observable_cells"].is_null());
  EXPECT_GT(without["seen_observable"], 0.1) << "the object's surface is measured all the same";
  const double most_m = report["path_length_m"].get<double>() - 0.001;
  const Ran shorter = run("reconstruct " + object + "--table --candidates 80 --resolution 0.04 --json - --max-path " +
                          std::to_string(most_m));
  EXPECT_EQ(shorter.code, 3) << shorter.err;
  const nlohmann::json part = nlohmann::json::parse(shorter.out);
  EXPECT_EQ(part["outcome"], "budget");
  EXPECT_EQ(part["views"], report["views"].get<int>() - 1);
  EXPECT_LE(part["path_length_m"], most_m);
  const std::map<std::string, int> codes{
      {"evenly-spaced", 4}, {"random-views", 3}, {"furthest-view", 3}, {"oracle-greedy", 0}};
  for (const auto& [peer, code] : codes) {
    const Ran compared =
        run("reconstruct " + object + "--table --planner " + peer + " --resolution 0.04 --max-views 4 --json -");
    EXPECT_EQ(compared.code, code) << "only the oracle knows that nothing is left" << compared.err;
    const nlohmann::json other = nlohmann::json::parse(compared.out);
    EXPECT_EQ(other["planner"], peer);
    EXPECT_GT(other["seen_coverage"], 0.2) << peer;
  }
}

TEST_F(Program, WarnsOfAMeshInDoubtUnlessItIsQuiet) {
  const std::string mesh = "'" + file("tower.ply", block(30.0)) + "' ";
  const auto warns = [&](const std::string& arguments, const std::string& of) {
    const Ran told = run(arguments);
    EXPECT_NE(told.code, 2) << told.err;
    EXPECT_NE(told.err.find("tower.ply is " + of), std::string::npos) << told.err;
    const Ran quiet = run(arguments + " --quiet");
    EXPECT_EQ(quiet.code, told.code);
    EXPECT_EQ(quiet.out + quiet.err, "");
  };
  warns("explore --start 0,0,3 --resolution 0.4 --max-views 1 --world " + mesh, "higher than wide");
  warns("reconstruct --resolution 0.4 --max-views 1 --candidates 30 --object " + mesh, "7.2 m long");
}

TEST_F(Program, RefusesToReconstructWhatIsNone) {
  const std::string object = "--object '" + file("block.ply", block()) + "' ";
  const auto refused = [&](const std::string& arguments, const std::string& names) {
    expect_refused(arguments, names, "reconstruct ");
  };
  refused("--table", "--object");
  refused("--object /nowhere.ply", "/nowhere.ply");
  refused(object + "--place 1,2,3", "--place has 3 numbers");
  refused(object + "--place 0,0,0,0,0,0,0,1", "scale");
  refused(object + "--place 1,0,0,0,0,0,0,0", "quaternion");
  refused(object + "--object-box 0,0,0,1,-1,1", "--object-box");
  refused(object + "--object-box 90,90,90,91,91,91", "--object-box 90,90,90,91,91,91 holds nothing of the object");
  refused(object + "--planner oracle-greedy --set gain=3", "--set: --planner oracle-greedy has no settings");
  refused(object + "--planner harmonic", "no planner 'harmonic' looks at an object; there are: next-best-view, ");
  refused(object + "--table --place 1,99,0,0,0,0,0,1",
          "--place 1,99,0,0,0,0,0,1 puts the object outside of the room");
  refused(object + "--place 1,1e6,0,0,0,0,0,1 --resolution 1e-4 --robot-radius 0.001",
          ": the region begins at 999999,");
  refused(object + "--reference /nowhere.txt", "--reference /nowhere.txt: is no file that can be read");
  refused(object + "--method best", "'best', must be one of default, uniform, hierarchical");
  refused(object + "--candidates 0", "--candidates");
  refused(object + "--aimed 10001", "--aimed is 10001, must be at most 10000");
  refused(object + "--radius 0", "--radius");
  refused(object + "--robot-radius 3", "--robot-radius is 3, must be at most 100 cells of --resolution");
  refused(object + "--resolution 1e-6", "--resolution");
  refused(object + "--gap -1", "--gap");
  refused(object + "--max-path 0", "--max-path");
  refused(object + "--up x", "--up");
  refused(object + "--reference '" + file("points.txt", "1 2 three\n") + "'", "points.txt");
  refused(object + "--start 99,0,0", "start");
  refused(object + "--set gain=3", "gain");
  EXPECT_EQ(refused_, 24);
}

}  // namespace
