// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <random>
#include <stdexcept>
#include <vantage/report/report_html.hpp>
#include <vantage/report/report_json.hpp>
#include <vantage/report/run_record_reader.hpp>
#include <vantage/report/run_recorder.hpp>

#include "support/random_maps.hpp"
#include "support/read_all.hpp"
#include "support/temporary_folder.hpp"

namespace vantage {
namespace {

// The runs, parsed as the page's script parses them.
std::vector<nlohmann::json> runs_in(const std::string& page) {
  const std::string open = "<script type=\"application/json\" class=\"run\">";
  std::vector<nlohmann::json> runs;
  for (std::size_t at = page.find(open); at != std::string::npos; at = page.find(open, at)) {
    at += open.size();
    runs.push_back(nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at)));
  }
  return runs;
}

void record_three_views(const std::filesystem::path& file) {
  std::mt19937 engine(1);
  OccupancyMap map({.resolution_m = 0.25});
  RunRecorder recorder(file, {.world = "</script><b>", .planner = "of my own"});
  for (int i = 0; i < 3; ++i) {
    map.insert(test::random_scan(engine, 60));
    Plan plan;
    plan.candidates = {{pose_looking({1.0, 2.0, 3.0}, 0.0), 4.0}};
    recorder.record(map, pose_looking({1.0 * i, 0.0, 1.0}, 0.0), plan, 1.0, 2.0);
  }
  recorder.finish(RunOutcome::Explored, "all is seen");
}

TEST(ReportHtml, HoldsTheReportAndTheReplay) {
  const test::TemporaryFolder folder;
  record_three_views(folder / "run");
  write_report_html(folder / "run", folder / "run.html");
  const std::string page = test::read_all(folder / "run.html");
  EXPECT_EQ(page.find("{{style.css}}"), std::string::npos) << "everything is filled in";
  EXPECT_NE(page.find("THREE"), std::string::npos);
  const std::vector<nlohmann::json> runs = runs_in(page);
  ASSERT_EQ(runs.size(), 1U);
  RunRecordReader reader(folder / "run");
  while (reader.next()) {
  }
  EXPECT_EQ(runs[0]["report"], nlohmann::json::parse(report_json(reader.run())));
  EXPECT_EQ(runs[0]["report"]["world"], "</script><b>");
  const nlohmann::json& replay = runs[0]["replay"];
  EXPECT_EQ(replay["cycles"].size(), 3U);
  EXPECT_EQ(replay["cycles"][2]["candidates"][0], (nlohmann::json{1.0, 2.0, 3.0, 1.0, 0.0, 0.0, 4.0}));
  EXPECT_EQ(replay["travelled"].size(), 3U);
  EXPECT_GT(replay["frontiers"]["count"], 10);
}

TEST(ReportHtml, DoesWithoutARecordAndWithOneOfAnotherRun) {
  const test::TemporaryFolder folder;
  record_three_views(folder / "run");
  RunRecord other;
  other.planner = "harmonic";
  other.views.resize(5);
  const std::vector<ReportedRun> runs{{report_json(other), {}}, {report_json(other), folder / "run"}};
  write_report_html(runs, folder / "two.html");
  const std::vector<nlohmann::json> shown = runs_in(test::read_all(folder / "two.html"));
  ASSERT_EQ(shown.size(), 2U);
  EXPECT_FALSE(shown[0].contains("replay"));
  EXPECT_FALSE(shown[1].contains("replay")) << "it has another number of views";
}

TEST(ReportHtml, SaysWhatIsWrong) {
  const test::TemporaryFolder folder;
  EXPECT_THROW(write_report_html(std::vector<ReportedRun>{}, folder / "none.html"), std::invalid_argument);
  EXPECT_THROW(write_report_html(std::vector<ReportedRun>{{"{}", {}}}, folder / "none.html"), std::invalid_argument);
  EXPECT_THROW(write_report_html(folder / "nothing", folder / "none.html"), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(folder / "none.html"));
  record_three_views(folder / "run");
  EXPECT_THROW(write_report_html(folder / "run", folder / "no/such/folder.html"), std::runtime_error);
}

}  // namespace
}  // namespace vantage
