// SPDX-License-Identifier: MIT
#include <cstdlib>
#include <stdexcept>
#include <vantage/report/sensor_file.hpp>

#include "fuzz_target.hpp"
#include "input_file.hpp"

std::vector<std::string> vantage::fuzz::seeds() {
  return {
      R"({"width": 64, "height": 48, "fx": 60.5, "fy": 60, "cx": 31, "min_range_m": 0.1, "max_range_m": 4})",
      R"({"projection": "spherical", "width": 36, "height": 18, "horizontal_fov_deg": 360, "vertical_fov_rad": 1.5,
 "max_range_m": 1e1, "reports_no_return": true})"};
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const vantage::fuzz::InputFile file(data, size, ".json");
  try {
    const vantage::RangeSensor sensor = vantage::load_sensor(file.path());
    if (sensor.width * sensor.height > vantage::RangeSensor::kMostRays || !sensor.direction(0, 0).allFinite() ||
        !sensor.direction(sensor.width - 1, sensor.height - 1).allFinite()) {
      std::abort();
    }
  } catch (const std::runtime_error&) {  // documented
  }
  return 0;
}
