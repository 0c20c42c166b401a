// SPDX-License-Identifier: MIT
#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vantage/report/report_html.hpp>
#include <vantage/report/report_json.hpp>
#include <vector>

#include <vantage/map/impl/whole_file.hpp>
#include "report/page_files.hpp"
#include "report/replay.hpp"
#include "report/replay_json.hpp"

namespace vantage {
namespace {

using nlohmann::json;

// JSON as a script of the page reads it. It must hold no "<", which could end that script.
std::string script_of(const char* kind, const json& data) {
  const std::string text = data.dump(-1, ' ', false, json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) {
    if (c == '<') {
      safe += "\\u003c";
    } else {
      safe += c;
    }
  }
  return "<script type=\"application/json\" class=\"" + std::string(kind) + "\">" + safe + "</script>\n";
}

json parsed_report(const std::string& text) {
  json report = json::parse(text, nullptr, false);
  if (!report.is_object() || !report.contains("cycles") || !report.at("cycles").is_array() ||
      !report.contains("time_ms") || !report.contains("planner")) {
    throw std::invalid_argument("write_report_html: what is given is no report of a run");
  }
  return report;
}

json run_json(json report, const detail::Replay* replay) {
  json run = {{"report", std::move(report)}};
  // A record of another run, or of one that was still going on, does not fit the report.
  if (replay != nullptr && !replay->cycles.empty() && replay->cycles.size() == run["report"]["cycles"].size()) {
    run["replay"] = detail::replay_json(*replay);
  }
  return run;
}

// Writes a page: every {{name}} is replaced by the file of that name, but the one named `slot` by `scripts`.
void write_page(const char* file, std::string_view slot, const std::string& scripts,
                const std::filesystem::path& html) {
  std::string out;
  const std::string whole = detail::page_file(file);
  std::string_view page = whole;
  for (std::size_t open = page.find("{{"); open != std::string_view::npos; open = page.find("{{")) {
    const std::size_t close = page.find("}}", open);
    const std::string_view name = page.substr(open + 2, close - open - 2);
    out += page.substr(0, open);
    out += name == slot ? scripts : detail::page_file(name);
    page.remove_prefix(close + 2);
  }
  out += page;
  detail::write_whole_file(html, out);
}

}  // namespace

void write_report_html(std::span<const ReportedRun> runs, const std::filesystem::path& html) {
  if (runs.empty()) {
    throw std::invalid_argument("write_report_html: there is no run to show");
  }
  std::string scripts;
  for (const ReportedRun& run : runs) {
    json report = parsed_report(run.report);
    if (run.record.empty()) {
      scripts += script_of("run", run_json(std::move(report), nullptr));
    } else {
      const detail::Replay replay = detail::replay_of(run.record);
      scripts += script_of("run", run_json(std::move(report), &replay));
    }
  }
  write_page("page.html", "runs", scripts, html);
}

void write_report_html(const std::filesystem::path& record, const std::filesystem::path& html) {
  const detail::Replay replay = detail::replay_of(record);
  write_page("page.html", "runs", script_of("run", run_json(json::parse(report_json(replay.run)), &replay)), html);
}

void write_evaluation_html(const std::string& results, const std::filesystem::path& html) {
  const json data = json::parse(results, nullptr, false);
  const auto has = [&](const char* key) { return data.contains(key) && data.at(key).is_array(); };
  if (!data.is_object() || !has("classes") || !has("columns") || !has("rows") || !has("runs")) {
    throw std::invalid_argument("write_evaluation_html: what is given is no result of an evaluation");
  }
  write_page("evaluation.html", "results", script_of("results", data), html);
}

}  // namespace vantage
