// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>
#include <vantage/evaluation/exploration_table.hpp>
#include <vantage/evaluation/spread.hpp>

namespace vantage {
namespace {

using TableJson = nlohmann::ordered_json;

// A figure of each run, of which a row shows median and quartiles; none: it was not measured.
struct Column {
  std::string_view key;
  std::string_view title;
  int digits;
  std::optional<double> (*figure)(const EvaluatedRun& run);
};

constexpr double kNever = std::numeric_limits<double>::infinity();

std::optional<double> path_at(const EvaluatedRun& run, double share) {
  if (!run.figures.covered) {
    return std::nullopt;
  }
  const std::optional<KnownSoFar> known = first_known(run.figures, share);
  return known ? known->path_m : kNever;
}

std::optional<double> time_at(const EvaluatedRun& run, double share) {
  if (!run.figures.covered || !run.figures.duration_s) {
    return std::nullopt;
  }
  const std::optional<KnownSoFar> known = first_known(run.figures, share);
  return known ? known->time_s : kNever;
}

std::optional<double> to_bound(const EvaluatedRun& run) {
  return run.bound && run.bound->length_m > 0.0 ? std::optional(run.figures.path_m / run.bound->length_m)
                                                : std::nullopt;
}

using Run = EvaluatedRun;
constexpr std::array<Column, 10> kColumns{{
    {"duration_s", "time, s", 1, [](const Run& run) { return run.figures.duration_s; }},
    {"time_95_s", "at 95 %, s", 1, [](const Run& run) { return time_at(run, 0.95); }},
    {"time_99_s", "at 99 %, s", 1, [](const Run& run) { return time_at(run, 0.99); }},
    {"path_m", "path, m", 1, [](const Run& run) { return std::optional(run.figures.path_m); }},
    {"path_95_m", "at 95 %, m", 1, [](const Run& run) { return path_at(run, 0.95); }},
    {"path_99_m", "at 99 %, m", 1, [](const Run& run) { return path_at(run, 0.99); }},
    {"to_bound", "path to the bound", 2, to_bound},
    {"turned_deg", "turned, deg", 0, [](const Run& run) { return std::optional(run.figures.turned_deg); }},
    {"views", "scans", 0, [](const Run& run) { return std::optional(static_cast<double>(run.figures.views)); }},
    {"coverage", "coverage", 4, [](const Run& run) { return run.figures.covered; }},
}};

// The runs of a planner in a world.
struct Row {
  std::string world;
  std::string planner;
  std::vector<const Run*> runs = {};

  [[nodiscard]] std::vector<double> figures(const Column& column) const {
    std::vector<double> values;
    for (const Run* run : runs) {
      if (const std::optional<double> value = column.figure(*run)) {
        values.push_back(*value);
      }
    }
    return values;
  }
  [[nodiscard]] std::map<std::string, std::size_t> outcomes() const {
    std::map<std::string, std::size_t> counts;
    for (const Run* run : runs) {
      ++counts[run->figures.outcome];
    }
    return counts;
  }
  [[nodiscard]] std::size_t collisions() const {
    std::size_t sum = 0;
    for (const Run* run : runs) {
      sum += run->figures.collisions;
    }
    return sum;
  }
  [[nodiscard]] std::vector<double> plan_ms() const {
    std::vector<double> all;
    for (const Run* run : runs) {
      all.insert(all.end(), run->figures.plan_ms.begin(), run->figures.plan_ms.end());
    }
    return all;
  }
  // Whether every bound is the length of some path. If not, a ratio to it is at least the one to the optimum.
  [[nodiscard]] bool bounds_met() const {
    return std::all_of(runs.begin(), runs.end(), [](const Run* run) { return !run->bound || run->bound->is_met; });
  }
};

// In the order of the worlds, then in that of the runs.
std::vector<Row> rows_of(const std::vector<std::string>& worlds, std::span<const Run> runs) {
  std::vector<Row> rows;
  for (const std::string& world : worlds) {
    const std::size_t first = rows.size();
    for (const Run& run : runs) {
      if (run.world != world) {
        continue;
      }
      auto row = std::find_if(rows.begin() + static_cast<std::ptrdiff_t>(first), rows.end(),
                              [&](const Row& each) { return each.planner == run.planner; });
      if (row == rows.end()) {
        row = rows.insert(row, {.world = world, .planner = run.planner});
      }
      row->runs.push_back(&run);
    }
  }
  return rows;
}

std::string outcomes_text(const Row& row) {
  std::string text;
  for (const auto& [outcome, count] : row.outcomes()) {
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + outcome;
  }
  return text;
}

std::string quantile_text(const std::vector<double>& values, double share) {
  return values.empty() ? "-" : spread_text({quantile(values, share)}, 1);
}

std::string table_of(const std::vector<Row>& rows) {
  std::vector<std::vector<std::string>> columns;  // each with its title
  const auto add = [&](std::string_view title, const auto& text) {
    columns.push_back({std::string(title)});
    for (const Row& row : rows) {
      columns.back().push_back(text(row));
    }
  };
  add("world", [](const Row& row) { return row.world; });
  add("planner", [](const Row& row) { return row.planner; });
  add("ended", outcomes_text);
  for (const Column& column : kColumns) {
    if (std::any_of(rows.begin(), rows.end(), [&](const Row& row) { return !row.figures(column).empty(); })) {
      add(column.title, [&](const Row& row) {
        const std::string text = spread_text(row.figures(column), column.digits);
        return (column.key == "to_bound" && !row.bounds_met() ? "<= " : "") + text;
      });
    }
  }
  add("collisions", [](const Row& row) { return std::to_string(row.collisions()); });
  add("plan, ms", [](const Row& row) { return quantile_text(row.plan_ms(), 0.5); });
  add("plan 99th, ms", [](const Row& row) { return quantile_text(row.plan_ms(), 0.99); });

  std::string text;
  for (std::size_t line = 0; line <= rows.size(); ++line) {
    for (const auto& column : columns) {
      text += "| " + column[line] + " ";
    }
    text += "|\n";
    for (std::size_t i = 0; line == 0 && i < columns.size(); ++i) {
      text += "|---";
    }
    text += line == 0 ? "|\n" : "";
  }
  return text;
}

TableJson finite_or_null(double value) { return std::isfinite(value) ? TableJson(value) : TableJson(nullptr); }

TableJson quantile_json(const std::vector<double>& values, double share) {
  return values.empty() ? TableJson(nullptr) : finite_or_null(quantile(values, share));
}

TableJson row_json(const Row& row) {
  const std::vector<double> plan_ms = row.plan_ms();
  TableJson json{{"world", row.world},
                 {"planner", row.planner},
                 {"runs", row.runs.size()},
                 {"outcomes", row.outcomes()},
                 {"collisions", row.collisions()},
                 {"bounds_met", row.bounds_met()},
                 {"plan_p50_ms", quantile_json(plan_ms, 0.5)},
                 {"plan_p99_ms", quantile_json(plan_ms, 0.99)}};
  for (const Column& column : kColumns) {
    const std::vector<double> values = row.figures(column);
    json[std::string(column.key)] = values.empty() ? TableJson(nullptr)
                                                   : TableJson{{"median", quantile_json(values, 0.5)},
                                                               {"q1", quantile_json(values, 0.25)},
                                                               {"q3", quantile_json(values, 0.75)}};
  }
  return json;
}

double rounded(double value, double per_unit) { return std::round(value * per_unit) / per_unit; }

TableJson curve_json(const std::vector<KnownSoFar>& known) {
  constexpr std::size_t kMostPoints = 250;
  TableJson curve = TableJson::array();
  const std::size_t points = std::min(known.size(), kMostPoints);
  for (std::size_t i = 0; i < points; ++i) {
    const KnownSoFar& at = known[points < 2 ? 0 : i * (known.size() - 1) / (points - 1)];
    if (at.covered) {
      curve.push_back({rounded(at.path_m, 100.0),
                       at.time_s ? TableJson(rounded(*at.time_s, 100.0)) : TableJson(nullptr),
                       rounded(*at.covered, 1e5)});
    }
  }
  return curve;
}

}  // namespace

std::string exploration_tables(std::span<const WorldClass> classes, std::span<const EvaluatedRun> runs) {
  std::string text;
  for (const WorldClass& each : classes) {
    const std::vector<Row> rows = rows_of(each.worlds, runs);
    if (!rows.empty()) {
      text += (text.empty() ? "## " : "\n## ") + each.name + "\n\n" + each.about + "\n\n    " + each.command +
              "\n\n" + table_of(rows);
    }
  }
  return text;
}

std::string exploration_json(std::span<const WorldClass> classes, std::span<const EvaluatedRun> runs) {
  TableJson json{{"classes", TableJson::array()},
                 {"columns", TableJson::array()},
                 {"rows", TableJson::array()},
                 {"runs", TableJson::array()}};
  for (const WorldClass& each : classes) {
    const std::vector<Row> rows = rows_of(each.worlds, runs);
    if (rows.empty()) {
      continue;
    }
    json["classes"].push_back(
        {{"name", each.name}, {"about", each.about}, {"command", each.command}, {"worlds", each.worlds}});
    for (const Row& row : rows) {
      json["rows"].push_back(row_json(row));
    }
  }
  for (const Column& column : kColumns) {
    json["columns"].push_back({{"key", column.key}, {"title", column.title}, {"digits", column.digits}});
  }
  for (const EvaluatedRun& run : runs) {
    json["runs"].push_back({{"world", run.world},
                            {"planner", run.planner},
                            {"start", run.start},
                            {"outcome", run.figures.outcome},
                            {"curve", curve_json(run.figures.after_views)}});
  }
  return json.dump(1, ' ', false, TableJson::error_handler_t::replace) + "\n";
}

}  // namespace vantage
