// SPDX-License-Identifier: MIT
// Reads a sensor from a file and writes the record of a run as JSON.
#include <fstream>
#include <iostream>
#include <string>
#include <vantage/report/report_html.hpp>
#include <vantage/report/report_json.hpp>
#include <vantage/report/run_recorder.hpp>
#include <vantage/report/sensor_file.hpp>
#include <vantage/version.hpp>

int main() {
  std::ofstream("sensor.json") << R"({"width": 64, "height": 48, "fx": 60, "fy": 60, "max_range_m": 4})";
  const vantage::RangeSensor sensor = vantage::load_sensor("sensor.json");

  vantage::RunRecord record;
  record.command = "explore";
  record.planner = "of my own";
  record.outcome = vantage::RunOutcome::Explored;
  const std::string json = vantage::report_json(record);
  std::cout << json;
  vantage::OccupancyMap map({.resolution_m = 0.1});
  map.set({1, 2, 3}, vantage::Occupancy::Occupied);
  vantage::RunRecorder recorder("run.record", {.planner = record.planner, .sensor = sensor});
  recorder.record(map, vantage::Pose::Identity(), vantage::Plan{});
  recorder.finish(vantage::RunOutcome::Explored, "one cell is enough");
  vantage::write_report_html("run.record", "run.html");  // needs no file from the build tree

  const auto says = [&json](const std::string& text) { return json.find(text) != std::string::npos; };
  return sensor.width == 64 && says("\"vantage\": \"" VANTAGE_VERSION_STRING "\"") &&
                 says("\"planner\": \"of my own\"") && says("\"outcome\": \"explored\"")
             ? 0
             : 1;
}
