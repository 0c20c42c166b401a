// SPDX-License-Identifier: MIT
// A sensor from a file, and the record of a run as JSON.
#include <fstream>
#include <iostream>
#include <string>
#include <vantage/report/report_json.hpp>
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
  const auto says = [&json](const std::string& text) { return json.find(text) != std::string::npos; };
  return sensor.width == 64 && says("\"vantage\": \"" VANTAGE_VERSION_STRING "\"") &&
                 says("\"planner\": \"of my own\"") && says("\"outcome\": \"explored\"")
             ? 0
             : 1;
}
