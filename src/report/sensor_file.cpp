// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vantage/report/sensor_file.hpp>

#include <vantage/map/impl/file_bytes.hpp>

namespace vantage {
namespace {

using nlohmann::json;

constexpr std::array<std::string_view, 14> kFields{"projection",
                                                   "width",
                                                   "height",
                                                   "fx",
                                                   "fy",
                                                   "cx",
                                                   "cy",
                                                   "horizontal_fov_rad",
                                                   "horizontal_fov_deg",
                                                   "vertical_fov_rad",
                                                   "vertical_fov_deg",
                                                   "min_range_m",
                                                   "max_range_m",
                                                   "reports_no_return"};

/// Reads the fields of one JSON object. Every error names the field.
class Fields {
 public:
  explicit Fields(const json& object) : object_(object) {
    if (!object.is_object()) {
      throw std::runtime_error("must hold one JSON object, holds " + std::string(object.type_name()));
    }
    for (const auto& [key, value] : object.items()) {
      if (std::find(kFields.begin(), kFields.end(), key) == kFields.end()) {
        throw std::runtime_error("unknown field '" + key + "'");
      }
    }
  }

  [[nodiscard]] bool has(const char* key) const { return object_.contains(key); }

  [[nodiscard]] std::optional<double> number(const char* key) const {
    if (!has(key)) {
      return std::nullopt;
    }
    if (!object_.at(key).is_number()) {
      refuse(key, "a number");
    }
    return object_.at(key).get<double>();
  }
  [[nodiscard]] double required(const char* key) const {
    const std::optional<double> value = number(key);
    if (!value) {
      throw std::runtime_error("field '" + std::string(key) + "' is missing");
    }
    return *value;
  }
  [[nodiscard]] std::size_t count(const char* key) const {
    const double value = required(key);
    if (!(value >= 1.0 && value <= 100000.0) || value != std::floor(value)) {
      refuse(key, "a whole number from 1 to 100000");
    }
    return static_cast<std::size_t>(value);
  }
  [[nodiscard]] bool flag(const char* key) const {
    if (has(key) && !object_.at(key).is_boolean()) {
      refuse(key, "true or false");
    }
    return has(key) && object_.at(key).get<bool>();
  }
  [[nodiscard]] std::string text(const char* key, const char* otherwise) const {
    if (has(key) && !object_.at(key).is_string()) {
      refuse(key, "a string");
    }
    return has(key) ? object_.at(key).get<std::string>() : otherwise;
  }
  /// Reads `<name>_rad` or `<name>_deg`; radians.
  [[nodiscard]] std::optional<double> angle(const std::string& name) const {
    const std::optional<double> radians = number((name + "_rad").c_str());
    const std::optional<double> degrees = number((name + "_deg").c_str());
    if (radians && degrees) {
      throw std::runtime_error("both '" + name + "_rad' and '" + name + "_deg' are given");
    }
    return degrees ? std::optional(*degrees * std::numbers::pi / 180.0) : radians;
  }

 private:
  [[noreturn]] void refuse(const char* key, const char* rule) const {
    throw std::runtime_error("field '" + std::string(key) + "' is " + object_.at(key).dump() + ", must be " + rule);
  }

  const json& object_;
};

RangeSensor pinhole(const Fields& fields) {
  const std::optional<double> horizontal_rad = fields.angle("horizontal_fov");
  const std::optional<double> vertical_rad = fields.angle("vertical_fov");
  const bool by_angles = horizontal_rad || vertical_rad;
  if (by_angles && (fields.has("fx") || fields.has("fy") || fields.has("cx") || fields.has("cy"))) {
    throw std::runtime_error("give a pinhole's angles of view or its fx, fy, cx and cy, not both");
  }
  if (by_angles && !(horizontal_rad && vertical_rad)) {
    throw std::runtime_error("both angles of view must be given");
  }
  if (!by_angles && !fields.has("fx") && !fields.has("fy")) {
    throw std::runtime_error("a pinhole needs 'horizontal_fov_deg' and 'vertical_fov_deg', or 'fx' and 'fy'");
  }
  const double min_range_m = fields.number("min_range_m").value_or(0.0);
  const double max_range_m = fields.required("max_range_m");
  if (by_angles) {
    return RangeSensor::pinhole(fields.count("width"), fields.count("height"), *horizontal_rad, *vertical_rad,
                                min_range_m, max_range_m);
  }
  RangeSensor sensor;
  sensor.width = fields.count("width");
  sensor.height = fields.count("height");
  sensor.fx = fields.required("fx");
  sensor.fy = fields.required("fy");
  sensor.cx = fields.number("cx").value_or(0.5 * (static_cast<double>(sensor.width) - 1.0));
  sensor.cy = fields.number("cy").value_or(0.5 * (static_cast<double>(sensor.height) - 1.0));
  sensor.min_range_m = min_range_m;
  sensor.max_range_m = max_range_m;
  return sensor;
}

RangeSensor spherical(const Fields& fields) {
  for (const char* key : {"fx", "fy", "cx", "cy"}) {
    if (fields.has(key)) {
      throw std::runtime_error("field '" + std::string(key) + "' belongs to a pinhole, not to a spherical sensor");
    }
  }
  const std::optional<double> horizontal_rad = fields.angle("horizontal_fov");
  const std::optional<double> vertical_rad = fields.angle("vertical_fov");
  if (!horizontal_rad || !vertical_rad) {
    throw std::runtime_error("a spherical sensor needs 'horizontal_fov_deg' and 'vertical_fov_deg'");
  }
  return RangeSensor::spherical(fields.count("width"), fields.count("height"), *horizontal_rad, *vertical_rad,
                                fields.number("min_range_m").value_or(0.0), fields.required("max_range_m"));
}

RangeSensor sensor_of(const json& object) {
  const Fields fields(object);
  const std::string projection = fields.text("projection", "pinhole");
  if (projection != "pinhole" && projection != "spherical") {
    throw std::runtime_error("field 'projection' is \"" + projection + "\", must be \"pinhole\" or \"spherical\"");
  }
  RangeSensor sensor = projection == "pinhole" ? pinhole(fields) : spherical(fields);
  sensor.reports_no_return = fields.flag("reports_no_return");
  sensor.validate();
  return sensor;
}

// Messages of the JSON library begin with a tag in brackets. This keeps the line and the cause.
std::string without_tag(const std::string& message) {
  const std::size_t end = message.find("] ");
  return message.rfind('[', 0) == 0 && end != std::string::npos ? message.substr(end + 2) : message;
}

}  // namespace

RangeSensor load_sensor(const std::filesystem::path& file) {
  constexpr std::size_t kMostBytes = std::size_t{1} << 20U;
  const std::string text = detail::file_bytes(file, kMostBytes);
  try {
    return sensor_of(json::parse(text));
  } catch (const json::exception& error) {
    throw std::runtime_error(file.string() + ": not JSON: " + without_tag(error.what()));
  } catch (const std::exception& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

}  // namespace vantage
