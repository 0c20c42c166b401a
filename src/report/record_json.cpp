// SPDX-License-Identifier: MIT
#include "report/record_json.hpp"

#include <nlohmann/json.hpp>
#include <stdexcept>

namespace vantage::detail {
namespace {

using nlohmann::json;

std::string dumped(const json& value) { return value.dump(-1, ' ', false, json::error_handler_t::replace); }

json parsed_chunk(const std::string& text) {
  try {
    return json::parse(text);
  } catch (const json::exception&) {
    throw std::runtime_error("a chunk of it is not JSON");
  }
}

template <class T>
void take(const json& object, const char* key, T& value) {
  const auto found = object.find(key);
  if (found != object.end() && !found->is_null()) {
    try {
      found->get_to(value);
    } catch (const json::exception&) {
      throw std::runtime_error("its field '" + std::string(key) + "' does not fit");
    }
  }
}

void take(const json& object, const char* key, std::optional<double>& value) {
  const auto found = object.find(key);
  if (found != object.end() && found->is_number()) {
    value = found->get<double>();
  }
}

json value_or_null(const std::optional<double>& value) { return value ? json(*value) : json(nullptr); }

json sensor_json(const RangeSensor& sensor) {
  return {{"projection", sensor.projection == RangeSensor::Projection::Pinhole ? "pinhole" : "spherical"},
          {"width", sensor.width},
          {"height", sensor.height},
          {"fx", sensor.fx},
          {"fy", sensor.fy},
          {"cx", sensor.cx},
          {"cy", sensor.cy},
          {"horizontal_fov_rad", sensor.horizontal_fov_rad},
          {"vertical_fov_rad", sensor.vertical_fov_rad},
          {"min_range_m", sensor.min_range_m},
          {"max_range_m", sensor.max_range_m},
          {"reports_no_return", sensor.reports_no_return}};
}

RangeSensor sensor_from(const json& object) {
  RangeSensor sensor;
  std::string projection = "pinhole";
  take(object, "projection", projection);
  sensor.projection =
      projection == "spherical" ? RangeSensor::Projection::Spherical : RangeSensor::Projection::Pinhole;
  take(object, "width", sensor.width);
  take(object, "height", sensor.height);
  take(object, "fx", sensor.fx);
  take(object, "fy", sensor.fy);
  take(object, "cx", sensor.cx);
  take(object, "cy", sensor.cy);
  take(object, "horizontal_fov_rad", sensor.horizontal_fov_rad);
  take(object, "vertical_fov_rad", sensor.vertical_fov_rad);
  take(object, "min_range_m", sensor.min_range_m);
  take(object, "max_range_m", sensor.max_range_m);
  take(object, "reports_no_return", sensor.reports_no_return);
  return sensor;
}

}  // namespace

std::string head_json(const RecordHead& head) {
  json object = {{"command", head.run.command},       {"world", head.run.world},
                 {"planner", head.run.planner},       {"seed", head.run.seed},
                 {"threads", head.run.threads},       {"resolution_m", head.run.resolution_m},
                 {"sensor", sensor_json(head.sensor)}};
  if (head.region) {
    const VoxelBox& r = *head.region;
    object["region"] = {r.lo.x, r.lo.y, r.lo.z, r.hi.x, r.hi.y, r.hi.z};
  }
  return dumped(object);
}

RecordHead head_of(const std::string& text) {
  const json object = parsed_chunk(text);
  RecordHead head;
  take(object, "command", head.run.command);
  take(object, "world", head.run.world);
  take(object, "planner", head.run.planner);
  take(object, "seed", head.run.seed);
  take(object, "threads", head.run.threads);
  take(object, "resolution_m", head.run.resolution_m);
  if (object.contains("sensor")) {
    head.sensor = sensor_from(object.at("sensor"));
  }
  std::vector<std::int32_t> region;
  take(object, "region", region);
  if (region.size() == 6) {
    head.region = VoxelBox{{region[0], region[1], region[2]}, {region[3], region[4], region[5]}};
  }
  return head;
}

std::string end_json(const RunRecord& run) {
  json object = {{"outcome", std::string(to_string(run.outcome))},
                 {"reason", run.reason},
                 {"coverage", value_or_null(run.coverage)},
                 {"observable_cells", run.observable_cells},
                 {"surface_coverage", value_or_null(run.surface_coverage)},
                 {"seen_observable", value_or_null(run.seen_observable)},
                 {"duration_s", value_or_null(run.duration_s)},
                 {"turned_deg", run.turned_deg},
                 {"collisions", run.collisions},
                 {"integration_operations", run.integration_operations},
                 {"planning_operations", run.planning_operations},
                 {"cells_refused", run.cells_refused},
                 {"peak_memory_mb", run.peak_memory_mb}};
  if (run.path_bound) {
    object["path_bound"] = {{"length_m", run.path_bound->length_m}, {"is_met", run.path_bound->is_met}};
  }
  if (run.audit) {
    object["audit"] = {{"cells_checked", run.audit->cells_checked},
                       {"looked_at_in_vain", run.audit->looked_at_in_vain},
                       {"observable_left", run.audit->observable_left}};
  }
  return dumped(object);
}

void read_end(const std::string& text, RunRecord& run) {
  const json object = parsed_chunk(text);
  std::string outcome;
  take(object, "outcome", outcome);
  for (const RunOutcome each : {RunOutcome::Explored, RunOutcome::Unreachable, RunOutcome::Blocked,
                                RunOutcome::Budget, RunOutcome::Interrupted}) {
    run.outcome = outcome == to_string(each) ? each : run.outcome;
  }
  take(object, "reason", run.reason);
  take(object, "coverage", run.coverage);
  take(object, "observable_cells", run.observable_cells);
  take(object, "surface_coverage", run.surface_coverage);
  take(object, "seen_observable", run.seen_observable);
  take(object, "duration_s", run.duration_s);
  take(object, "turned_deg", run.turned_deg);
  take(object, "collisions", run.collisions);
  take(object, "integration_operations", run.integration_operations);
  take(object, "planning_operations", run.planning_operations);
  take(object, "cells_refused", run.cells_refused);
  take(object, "peak_memory_mb", run.peak_memory_mb);
  if (const auto found = object.find("path_bound"); found != object.end()) {
    PathBound& bound = run.path_bound.emplace();
    take(*found, "length_m", bound.length_m);
    take(*found, "is_met", bound.is_met);
  }
  if (const auto found = object.find("audit"); found != object.end()) {
    AuditRecord& audit = run.audit.emplace();
    take(*found, "cells_checked", audit.cells_checked);
    take(*found, "looked_at_in_vain", audit.looked_at_in_vain);
    take(*found, "observable_left", audit.observable_left);
  }
}

}  // namespace vantage::detail
