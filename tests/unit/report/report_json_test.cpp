// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vantage/report/report_json.hpp>
#include <vantage/version.hpp>

namespace vantage {
namespace {

using nlohmann::ordered_json;

std::vector<std::string> keys_of(const ordered_json& object) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) {
    keys.push_back(key);
  }
  return keys;
}

RunRecord three_views() {
  RunRecord record;
  record.command = "explore";
  record.world = "rooms";
  record.planner = "harmonic";
  record.seed = 18446744073709551615ULL;
  record.resolution_m = 0.2;
  record.outcome = RunOutcome::Explored;
  record.reason = "nothing \"observable\" is left";
  record.coverage = 0.998;
  record.observable_cells = 123456;
  record.leftover = {1, 2, 3};
  for (std::size_t i = 1; i <= 3; ++i) {
    ViewRecord view;
    view.view = i;
    view.pose.translation() = Eigen::Vector3d(1.0, 2.0, 3.0);
    view.coverage = 0.25 * static_cast<double>(i);
    view.path_length_m = 2.0 * static_cast<double>(i);
    view.insert_ms = static_cast<double>(i * i);
    view.plan_ms = i == 2 ? 0.0 : 10.0 * static_cast<double>(i);
    record.views.push_back(view);
  }
  record.views.back().outcome = Outcome::Explored;
  return record;
}

TEST(ReportJson, HoldsExactlyTheKeysOfTheContractInOrder) {
  const ordered_json report = ordered_json::parse(report_json(three_views()));
  EXPECT_EQ(keys_of(report), (std::vector<std::string>{"vantage",
                                                       "command",
                                                       "world",
                                                       "planner",
                                                       "seed",
                                                       "threads",
                                                       "resolution_m",
                                                       "outcome",
                                                       "reason",
                                                       "views",
                                                       "path_length_m",
                                                       "duration_s",
                                                       "turned_deg",
                                                       "seen_coverage",
                                                       "seen_observable",
                                                       "coverage",
                                                       "observable_cells",
                                                       "surface_coverage",
                                                       "leftover",
                                                       "collisions",
                                                       "ray_operations",
                                                       "cells_refused",
                                                       "time_ms",
                                                       "peak_memory_mb",
                                                       "cycles"}));
  EXPECT_EQ(keys_of(report["leftover"]),
            (std::vector<std::string>{"unreachable", "unobservable", "in_vain", "too_small"}));
  EXPECT_EQ(keys_of(report["ray_operations"]), (std::vector<std::string>{"integration", "planning"}));
  EXPECT_EQ(keys_of(report["time_ms"]), (std::vector<std::string>{"insert", "plan"}));
  EXPECT_EQ(keys_of(report["time_ms"]["plan"]), (std::vector<std::string>{"median", "max"}));
  ASSERT_EQ(report["cycles"].size(), 3U);
  EXPECT_EQ(keys_of(report["cycles"][0]),
            (std::vector<std::string>{"view", "pose", "coverage", "seen_coverage", "seen_observable", "time_s",
                                      "path_length_m", "insert_ms", "plan_ms", "utility", "frontier_cells",
                                      "void_cells", "outcome"}));
}

TEST(ReportJson, SaysWhatTheRecordSays) {
  const ordered_json report = ordered_json::parse(report_json(three_views()));
  EXPECT_EQ(report["vantage"], VANTAGE_VERSION_STRING);
  EXPECT_EQ(report["seed"], 18446744073709551615ULL);
  EXPECT_EQ(report["outcome"], "explored");
  EXPECT_EQ(report["reason"], "nothing \"observable\" is left");
  EXPECT_EQ(report["views"], 3);
  EXPECT_EQ(report["path_length_m"], 6.0);
  EXPECT_EQ(report["coverage"], 0.998);
  EXPECT_EQ(report["observable_cells"], 123456);
  EXPECT_TRUE(report["surface_coverage"].is_null());
  EXPECT_TRUE(report["seen_coverage"].is_null());
  EXPECT_TRUE(report["cycles"][0]["seen_coverage"].is_null());
  EXPECT_EQ(report["leftover"]["in_vain"], 3);
  EXPECT_EQ(report["leftover"]["too_small"], 0) << "no count of cells makes a frontier too small";
  EXPECT_EQ(report["time_ms"]["insert"]["median"], 4.0);
  EXPECT_EQ(report["time_ms"]["insert"]["max"], 9.0);
  EXPECT_EQ(report["time_ms"]["plan"]["median"], 20.0) << "the view without a plan has no say";
  EXPECT_EQ(report["cycles"][0]["outcome"], "move");
  EXPECT_EQ(report["cycles"][2]["outcome"], "explored");
}

TEST(ReportJson, WritesARotationOneWayOnly) {
  RunRecord record = three_views();
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(3.5, Eigen::Vector3d(1.0, 2.0, -0.5).normalized()));
  record.views[0].pose.linear() = turn.toRotationMatrix();
  const ordered_json pose = ordered_json::parse(report_json(record))["cycles"][0]["pose"];
  ASSERT_EQ(pose.size(), 7U);
  EXPECT_EQ(pose[0], 1.0);
  EXPECT_GE(pose[6].get<double>(), 0.0);
  const Eigen::Quaterniond back(pose[6].get<double>(), pose[3].get<double>(), pose[4].get<double>(),
                                pose[5].get<double>());
  EXPECT_LT(back.angularDistance(turn), 1e-7);
}

TEST(ReportJson, LeavesUnknownNullAndSurvivesAnEmptyRun) {
  const ordered_json report = ordered_json::parse(report_json(RunRecord{}));
  EXPECT_TRUE(report["coverage"].is_null());
  EXPECT_TRUE(report["observable_cells"].is_null());
  EXPECT_TRUE(report["duration_s"].is_null());
  EXPECT_EQ(report["turned_deg"], 0.0);
  EXPECT_TRUE(report["time_ms"]["plan"]["median"].is_null());
  EXPECT_EQ(report["views"], 0);
  EXPECT_TRUE(report["cycles"].empty());
}

TEST(ReportJson, TellsTheTimeOfATimedRun) {
  RunRecord record = three_views();
  record.duration_s = 1.5;
  record.turned_deg = 90.0;
  record.views[1].time_s = 0.25;
  const ordered_json report = ordered_json::parse(report_json(record));
  EXPECT_EQ(report["duration_s"], 1.5);
  EXPECT_EQ(report["turned_deg"], 90.0);
  EXPECT_TRUE(report["cycles"][0]["time_s"].is_null());
  EXPECT_EQ(report["cycles"][1]["time_s"], 0.25);
}

TEST(ReportJson, NeverThrowsForTheBytesOfAFileName) {
  RunRecord record = three_views();
  record.world = "a\xff\xfe\nb";
  EXPECT_TRUE(ordered_json::accept(report_json(record)));
}

TEST(ReportJson, NamesTheFileThatCannotBeWritten) {
  try {
    write_report_json(three_views(), "/nowhere/at/all/report.json");
    FAIL() << "written";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/at/all/report.json"), std::string::npos);
  }
}

}  // namespace
}  // namespace vantage
