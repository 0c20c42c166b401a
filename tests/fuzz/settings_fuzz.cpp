// SPDX-License-Identifier: MIT
// Settings of any planner: its name in the first line, key=value in each further one. What is refused must be named.
#include <cstdlib>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <vantage/planner/make_planner.hpp>
#include <vantage/robot/free_flyer.hpp>

#include "fuzz_target.hpp"

std::vector<std::string> vantage::fuzz::seeds() {
  std::vector<std::string> seeds;
  for (const std::string_view planner : vantage::planner_names()) {
    std::string seed(planner);
    for (const vantage::Setting& setting : vantage::planner_settings(planner)) {
      seed += "\n" + setting.name + "=" + setting.default_value;
      seeds.push_back(std::string(planner) + "\n" + setting.name + "=" + setting.default_value);
    }
    seeds.push_back(seed);
  }
  return seeds;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream lines(std::string(reinterpret_cast<const char*>(data), size));
  std::string planner;
  std::getline(lines, planner);
  vantage::Settings settings;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t sign = std::min(line.find('='), line.size());
    settings[line.substr(0, sign)] = line.substr(std::min(sign + 1, line.size()));
  }
  const vantage::PlannerSetup setup{
      .sensor = vantage::RangeSensor::pinhole(24, 18, 1.0, 0.8, 0.1, 3.0),
      .platform = std::make_shared<const vantage::FreeFlyer>(vantage::FreeFlyerOptions{.radius_m = 0.1})};
  try {
    (void)vantage::make_planner(planner, setup, settings);
  } catch (const std::invalid_argument& error) {
    const std::string message = error.what();  // ends at a NUL
    bool named = message.find(planner.c_str()) != std::string::npos;
    for (const auto& [key, value] : settings) {
      named = named || message.find(key.c_str()) != std::string::npos;
    }
    if (!named) {
      std::abort();
    }
  }
  return 0;
}
