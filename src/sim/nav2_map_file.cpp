// SPDX-License-Identifier: MIT
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vantage/sim/nav2_map_file.hpp>
#include <vector>

#include "sim/flat_yaml.hpp"
#include "sim/pgm_image.hpp"

namespace vantage {
namespace {

// The values of a map file by key. Every error names the file and the key.
class MapKeys {
 public:
  explicit MapKeys(const std::filesystem::path& path) : path_(path), values_(detail::read_flat_yaml(path)) {}

  [[noreturn]] void refuse(const std::string& what) const { throw std::runtime_error(path_.string() + ": " + what); }

  [[nodiscard]] bool has(const std::string& key) const { return values_.contains(key); }

  [[nodiscard]] std::string text(const std::string& key) const {
    const std::vector<std::string>& list = found(key);
    if (list.size() != 1 || list.front().empty()) {
      refuse("'" + key + "' must be one value");
    }
    return list.front();
  }

  [[nodiscard]] std::vector<double> numbers(const std::string& key, std::size_t count) const {
    std::vector<double> numbers;
    for (const std::string& word : found(key)) {
      double number = 0.0;
      const char* end = word.data() + word.size();
      const auto [stopped, error] = std::from_chars(word.data() + (word.starts_with('+') ? 1 : 0), end, number);
      if (error != std::errc{} || stopped != end || !std::isfinite(number)) {
        refuse(std::string("'").append(key).append("' holds '").append(word).append("', which is not a number"));
      }
      numbers.push_back(number);
    }
    if (numbers.size() != count) {
      refuse("'" + key + "' must be " + (count == 1 ? "one number" : std::to_string(count) + " numbers") + ", is " +
             std::to_string(numbers.size()));
    }
    return numbers;
  }

  [[nodiscard]] double number(const std::string& key, double lowest, double highest) const {
    const double number = numbers(key, 1).front();
    if (number < lowest || number > highest) {
      refuse("'" + key + "' is " + text(key) + ", must be in [" + short_text(lowest) + ", " + short_text(highest) +
             "]");
    }
    return number;
  }

  [[nodiscard]] bool flag(const std::string& key) const {
    const std::string word = text(key);
    for (const char* yes : {"1", "true", "True"}) {
      if (word == yes) {
        return true;
      }
    }
    for (const char* no : {"0", "false", "False"}) {
      if (word == no) {
        return false;
      }
    }
    refuse("'" + key + "' is '" + word + "', must be 0 or 1");
  }

 private:
  static std::string short_text(double number) {
    std::array<char, 32> digits{};
    return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr};
  }

  [[nodiscard]] const std::vector<std::string>& found(const std::string& key) const {
    const auto value = values_.find(key);
    if (value == values_.end()) {
      refuse("'" + key + "' is missing");
    }
    return value->second;
  }

  std::filesystem::path path_;
  detail::FlatYaml values_;
};

}  // namespace

GroundPlan read_nav2_map(const std::filesystem::path& path) {
  constexpr double kFurthestM = 1e7;
  const MapKeys keys(path);
  if (keys.has("mode") && keys.text("mode") != "trinary") {
    keys.refuse("'mode' is '" + keys.text("mode") + "', only trinary is read");
  }
  GroundPlan plan;
  plan.pixel_m = keys.number("resolution", 1e-4, 1e4);
  const std::vector<double> origin = keys.numbers("origin", 3);
  plan.x_m = origin[0];
  plan.y_m = origin[1];
  plan.yaw_rad = origin[2];
  if (std::abs(plan.x_m) > kFurthestM || std::abs(plan.y_m) > kFurthestM) {
    keys.refuse("'origin' is further than 10000 km away");
  }
  const bool negate = keys.flag("negate");
  const double free_below = keys.number("free_thresh", 0.0, 1.0);
  if (free_below > keys.number("occupied_thresh", 0.0, 1.0)) {
    keys.refuse("'free_thresh' is above 'occupied_thresh'");
  }
  const detail::PgmImage image = detail::read_pgm(path.parent_path() / keys.text("image"));
  plan.solid = VoxelGrid<std::uint8_t>({{0, 0, 0}, {image.width, image.height, 1}}, 1);
  bool any_free = false;
  for_each_cell(plan.solid.box(), [&](const VoxelIndex& pixel) {
    const double bright = image.bright(pixel.x, image.height - 1 - pixel.y);
    const bool is_free = (negate ? bright : 1.0 - bright) < free_below;
    plan.solid[pixel] = is_free ? 0 : 1;
    any_free = any_free || is_free;
  });
  if (!any_free) {
    keys.refuse("no pixel of '" + keys.text("image") + "' is free by its thresholds");
  }
  return plan;
}

}  // namespace vantage
