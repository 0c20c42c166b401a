// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <stdexcept>
#include <string>
#include <vantage/evaluation/exploration_table.hpp>
#include <vantage/evaluation/spread.hpp>
#include <vantage/report/report_json.hpp>
#include <vector>

namespace vantage {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// By definition: at least a share of the values is not above it, with a line between neighbours.
double slow_quantile(const std::vector<double>& values, double share) {
  std::vector<double> left = values;
  const double place = share * static_cast<double>(values.size() - 1);
  double below = 0.0;
  for (double taken = 0.0; !left.empty(); taken += 1.0) {
    const auto least = std::min_element(left.begin(), left.end());
    if (taken >= place) {
      return taken == place ? *least : below + (place - (taken - 1.0)) * (*least - below);
    }
    below = *least;
    left.erase(least);
  }
  return below;
}

TEST(Quantile, AgreesWithItsDefinition) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> value(-5.0, 5.0);
  std::size_t checked = 0;
  for (std::size_t count = 1; count <= 20; ++count) {
    for (const double share : {0.0, 0.25, 0.3, 0.5, 0.75, 0.99, 1.0}) {
      std::vector<double> values(count);
      std::generate(values.begin(), values.end(), [&] { return value(engine); });
      EXPECT_NEAR(quantile(values, share), slow_quantile(values, share), 1e-12);
      ++checked;
    }
  }
  EXPECT_EQ(checked, 140U);
  EXPECT_EQ(quantile({1.0, kInfinity, kInfinity}, 0.5), kInfinity);
  EXPECT_EQ(quantile({kInfinity, 2.0, 1.0}, 0.5), 2.0);
  EXPECT_THROW((void)quantile({}, 0.5), std::invalid_argument);
  EXPECT_THROW((void)quantile({1.0}, 1.5), std::invalid_argument);
}

TEST(Spread, IsTheMedianWithQuartiles) {
  EXPECT_EQ(spread_text({}, 1), "-");
  EXPECT_EQ(spread_text({3.14159}, 2), "3.14");
  EXPECT_EQ(spread_text({5.0, 1.0, 2.0, 3.0, 4.0}, 0), "3 (2-4)");
  EXPECT_EQ(spread_text({1.0, 2.0, kInfinity, kInfinity, kInfinity}, 1), "never (2.0-never)");
}

// A run that knows ever more: after view i of n a share of i / n, at i metres and, if it is timed, 2 i seconds.
RunRecord run_of(std::size_t views, bool timed, RunOutcome outcome = RunOutcome::Explored) {
  RunRecord record;
  record.command = "explore";
  record.world = "rooms";
  record.planner = "harmonic";
  record.outcome = outcome;
  record.turned_deg = 90.0 * static_cast<double>(views);
  record.collisions = 1;
  for (std::size_t i = 1; i <= views; ++i) {
    ViewRecord view;
    const auto at = static_cast<double>(i);
    view.view = i;
    view.path_length_m = at;
    view.coverage = at / static_cast<double>(views);
    view.insert_ms = 500.0;
    view.plan_ms = i % 2 == 0 ? 100.0 * at : 0.0;
    if (timed) {
      view.time_s = 2.0 * at;
    }
    record.views.push_back(view);
  }
  record.coverage = record.views.back().coverage;
  if (timed) {
    record.duration_s = record.views.back().time_s;
  }
  return record;
}

EvaluatedRun evaluated(const std::string& world, const std::string& planner, std::uint64_t start,
                       const RunRecord& record) {
  return {.world = world, .planner = planner, .start = start, .figures = run_figures(report_json(record))};
}

TEST(RunFigures, AreThoseOfTheReport) {
  const RunRecord record = run_of(20, true);
  const RunFigures figures = run_figures(report_json(record));
  EXPECT_EQ(figures.planner, "harmonic");
  EXPECT_EQ(figures.outcome, "explored");
  EXPECT_EQ(figures.views, 20U);
  EXPECT_EQ(figures.path_m, 20.0);
  EXPECT_EQ(figures.turned_deg, 1800.0);
  EXPECT_EQ(figures.duration_s, 40.0);
  EXPECT_EQ(figures.collisions, 1U);
  EXPECT_EQ(figures.plan_ms.size(), 10U);
  EXPECT_NEAR(figures.computing_s, 10.0 + 11.0, 1e-9);
  ASSERT_EQ(figures.after_views.size(), 20U);
  ASSERT_TRUE(first_known(figures, 0.95));
  EXPECT_EQ(first_known(figures, 0.95)->view, 19U);
  EXPECT_EQ(first_known(figures, 0.951)->view, 20U);
  EXPECT_EQ(first_known(figures, 0.951)->time_s, 40.0);
  EXPECT_FALSE(first_known(figures, 1.01));
  RunRecord unmeasured = record;
  for (ViewRecord& view : unmeasured.views) {
    view.coverage.reset();
  }
  unmeasured.coverage.reset();
  EXPECT_FALSE(first_known(run_figures(report_json(unmeasured)), 0.1));
  EXPECT_THROW((void)run_figures("{}"), std::invalid_argument);
  EXPECT_THROW((void)run_figures("no report"), std::invalid_argument);
}

const std::vector<WorldClass> kClasses{
    {.name = "houses", .about = "About houses.", .command = "do houses", .worlds = {"big", "small"}},
    {.name = "fields", .about = "About fields.", .command = "do fields", .worlds = {"field"}},
    {.name = "empty", .about = "Nothing ran.", .command = "do nothing", .worlds = {"nowhere"}}};

std::vector<EvaluatedRun> seven_runs() {
  std::vector<EvaluatedRun> runs;
  for (const std::size_t views : {10U, 30U, 20U}) {
    runs.push_back(evaluated("small", "harmonic", runs.size() + 1, run_of(views, false)));
    runs.back().bound = PathBound{5.0, views != 10U};
  }
  runs.push_back(evaluated("big", "harmonic", 1, run_of(40, false, RunOutcome::Budget)));
  runs.push_back(evaluated("small", "tour,cost=path", 1, run_of(12, false)));
  runs.push_back(evaluated("field", "harmonic", 1, run_of(100, true)));
  runs.push_back(evaluated("field", "harmonic", 2, run_of(1000, true)));
  return runs;
}

TEST(ExplorationTable, ShowsMediansAndQuartilesByWorldAndPlanner) {
  const std::string tables = exploration_tables(kClasses, seven_runs());
  EXPECT_EQ(
      tables,
      "## houses\n\nAbout houses.\n\n    do houses\n\n"
      "| world | planner | ended | path, m | at 95 %, m | at 99 %, m | path to the bound | turned, deg | scans | "
      "coverage | collisions | plan, ms | plan 99th, ms |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n"
      "| big | harmonic | 1 budget | 40.0 | 38.0 | 40.0 | - | 3600 | 40 | 1.0000 | 1 | 2100.0 | 3962.0 |\n"
      "| small | harmonic | 3 explored | 20.0 (15.0-25.0) | 19.0 (14.5-24.0) | 20.0 (15.0-25.0) | <= 4.00 "
      "(3.00-5.00) | 1800 (1350-2250) | 20 (15-25) | 1.0000 (1.0000-1.0000) | 3 | 1100.0 | 2942.0 |\n"
      "| small | tour,cost=path | 1 explored | 12.0 | 12.0 | 12.0 | - | 1080 | 12 | 1.0000 | 1 | 700.0 | 1190.0 "
      "|\n"
      "\n## fields\n\nAbout fields.\n\n    do fields\n\n"
      "| world | planner | ended | time, s | at 95 %, s | at 99 %, s | path, m | at 95 %, m | at 99 %, m | turned, "
      "deg | scans | coverage | collisions | plan, ms | plan 99th, ms |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n"
      "| field | harmonic | 2 explored | 1100.0 (650.0-1550.0) | 1045.0 (617.5-1472.5) | 1089.0 (643.5-1534.5) | "
      "550.0 (325.0-775.0) | 522.5 (308.8-736.2) | 544.5 (321.8-767.2) | 49500 (29250-69750) | 550 (325-775) | "
      "1.0000 (1.0000-1.0000) | 2 | 45100.0 | 98902.0 |\n");
}

TEST(ExplorationTable, SaysWhatWasNeverReached) {
  RunRecord half = run_of(10, false, RunOutcome::Unreachable);
  half.views.resize(9);  // 0.9 of the world
  half.coverage = half.views.back().coverage;
  const std::vector<EvaluatedRun> runs{evaluated("field", "harmonic", 1, half)};
  const std::string tables = exploration_tables(kClasses, runs);
  EXPECT_NE(tables.find("| 1 unreachable | 9.0 | never | never |"), std::string::npos) << tables;
  const auto json = nlohmann::json::parse(exploration_json(kClasses, runs));
  EXPECT_TRUE(json["rows"][0]["path_95_m"]["median"].is_null());
  EXPECT_TRUE(json["rows"][0]["duration_s"].is_null());
}

TEST(ExplorationJson, HasTheFiguresOfTheTableAndCurves) {
  const auto json = nlohmann::json::parse(exploration_json(kClasses, seven_runs()));
  ASSERT_EQ(json["classes"].size(), 2U);
  ASSERT_EQ(json["rows"].size(), 4U);
  const auto& row = json["rows"][1];
  EXPECT_EQ(row["world"], "small");
  EXPECT_EQ(row["runs"], 3);
  EXPECT_EQ(row["outcomes"]["explored"], 3);
  EXPECT_EQ(row["collisions"], 3);
  EXPECT_EQ(row["bounds_met"], false);
  EXPECT_EQ(row["path_m"]["median"], 20.0);
  EXPECT_EQ(row["path_m"]["q1"], 15.0);
  EXPECT_EQ(row["path_m"]["q3"], 25.0);
  ASSERT_EQ(json["runs"].size(), 7U);
  EXPECT_EQ(json["runs"][0]["curve"].size(), 10U);
  const auto& thinned = json["runs"][6]["curve"];
  ASSERT_EQ(thinned.size(), 250U);
  EXPECT_EQ(thinned[0], nlohmann::json({1.0, 2.0, 0.001}));
  EXPECT_EQ(thinned[249], nlohmann::json({1000.0, 2000.0, 1.0}));
}

}  // namespace
}  // namespace vantage
