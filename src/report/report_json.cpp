// SPDX-License-Identifier: MIT
#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <vantage/report/report_json.hpp>
#include <vantage/version.hpp>
#include <vector>

#include <vantage/map/impl/whole_file.hpp>

namespace vantage {
namespace {

using nlohmann::ordered_json;

template <class T>
ordered_json or_null(const std::optional<T>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json pose_json(const Pose& pose) {
  Eigen::Quaterniond q(pose.linear());
  if (q.w() < 0.0) {
    q.coeffs() = -q.coeffs();  // the same rotation; qw >= 0 makes it unique
  }
  const Eigen::Vector3d t = pose.translation();
  return ordered_json::array({t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()});
}

ordered_json median_and_max(std::vector<double> values) {
  if (values.empty()) {
    return {{"median", nullptr}, {"max", nullptr}};
  }
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  const double median = values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
  return {{"median", median}, {"max", values.back()}};
}

ordered_json times_json(const RunRecord& record) {
  std::vector<double> insert_ms;
  std::vector<double> plan_ms;
  for (const ViewRecord& view : record.views) {
    insert_ms.push_back(view.insert_ms);
    if (view.plan_ms > 0.0) {  // 0: the previous plan was still followed
      plan_ms.push_back(view.plan_ms);
    }
  }
  return {{"insert", median_and_max(std::move(insert_ms))}, {"plan", median_and_max(std::move(plan_ms))}};
}

// After this view, of the points that any admitted pose could see.
std::optional<double> seen_observable(const ViewRecord& view, const RunRecord& record) {
  if (!view.seen_coverage || !record.seen_coverage || !record.seen_observable) {
    return std::nullopt;
  }
  return *record.seen_coverage > 0.0 ? *view.seen_coverage * *record.seen_observable / *record.seen_coverage : 0.0;
}

ordered_json cycle_json(const ViewRecord& view, const RunRecord& record) {
  return {{"view", view.view},
          {"pose", pose_json(view.pose)},
          {"coverage", or_null(view.coverage)},
          {"seen_coverage", or_null(view.seen_coverage)},
          {"seen_observable", or_null(seen_observable(view, record))},
          {"time_s", or_null(view.time_s)},
          {"path_length_m", view.path_length_m},
          {"insert_ms", view.insert_ms},
          {"plan_ms", view.plan_ms},
          {"utility", view.utility},
          {"frontier_cells", view.frontier_cells},
          {"void_cells", view.void_cells},
          {"outcome", to_string(view.outcome)}};
}

ordered_json summary_json(const RunRecord& record) {
  ordered_json summary = {
      {"vantage", VANTAGE_VERSION_STRING},
      {"command", record.command},
      {"world", record.world},
      {"planner", record.planner},
      {"seed", record.seed},
      {"threads", record.threads},
      {"resolution_m", record.resolution_m},
      {"outcome", to_string(record.outcome)},
      {"reason", record.reason},
      {"views", record.views.size()},
      {"path_length_m", record.path_length_m()},
      {"duration_s", or_null(record.duration_s)},
      {"turned_deg", record.turned_deg},
      {"seen_coverage", or_null(record.seen_coverage)},
      {"seen_observable", or_null(record.seen_observable)},
      {"coverage", or_null(record.coverage)},
      {"observable_cells", record.coverage && record.observable_cells > 0 ? ordered_json(record.observable_cells)
                                                                          : ordered_json(nullptr)},
      {"surface_coverage", or_null(record.surface_coverage)},
      {"leftover",
       {{"unreachable", record.leftover.unreachable},
        {"unobservable", record.leftover.unobservable},
        {"in_vain", record.leftover.in_vain},
        {"too_small", 0}}},
      {"collisions", record.collisions},
      {"ray_operations", {{"integration", record.integration_operations}, {"planning", record.planning_operations}}},
      {"cells_refused", record.cells_refused},
      {"time_ms", times_json(record)},
      {"peak_memory_mb", record.peak_memory_mb}};
  if (record.path_bound) {
    summary["path_bound"] = {{"length_m", record.path_bound->length_m}, {"is_met", record.path_bound->is_met}};
  }
  if (record.audit) {
    summary["audit"] = {{"observable_left", record.audit->observable_left},
                        {"looked_at_in_vain", record.audit->looked_at_in_vain},
                        {"cells_checked", record.audit->cells_checked}};
  }
  return summary;
}

// A file name may hold any bytes. What is not UTF-8 is replaced, so that nothing throws at the end of a long run.
std::string dump(const ordered_json& value, int indent = -1) {
  return value.dump(indent, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace

std::string report_json(const RunRecord& record) {
  std::string text = dump(summary_json(record), 2);
  text.erase(text.size() - 2);  // "\n}": the cycles follow, one per line
  text += ",\n  \"cycles\": [";
  for (std::size_t i = 0; i < record.views.size(); ++i) {
    text += (i == 0 ? "\n    " : ",\n    ") + dump(cycle_json(record.views[i], record));
  }
  text += record.views.empty() ? "]\n}\n" : "\n  ]\n}\n";
  return text;
}

void write_report_json(const RunRecord& record, const std::filesystem::path& file) {
  detail::write_whole_file(file, report_json(record));
}

}  // namespace vantage
