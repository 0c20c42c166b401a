// SPDX-License-Identifier: MIT
#pragma once

// The text form of TriedViews. One entry a line: a word and its numbers.
//
//     tried-views 1 <cells in metres> <plans>
//     cell x y z <known neighbours> <latest look>     evidence about a cell,
//     in-vain x y z                                   | followed by the places of its looks
//     clear x y z                                     |
//     missed x y z                                    |
//     hoped x y z                                     |
//     contested x y z                                 |
//     place x y z <nearest way> <plans no nearer> <failures> <rests until>
//     scan <rotation and translation, 3 rows of 4>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vantage/geometry/raster_order.hpp>
#include <vantage/view/tried_views.hpp>

namespace vantage {
namespace detail {

inline constexpr std::string_view kHead = "tried-views";
inline constexpr double kMostPlans = 1e15;  // every whole number up to here is a double

inline void append(std::string& text, std::string_view word, std::span<const double> numbers) {
  text += word;
  for (const double number : numbers) {
    std::array<char, 32> digits{};
    text.append(" ").append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr);
  }
  text += '\n';
}

inline void append(std::string& text, std::string_view word, const VoxelIndex& cell,
                   std::initializer_list<double> more = {}) {
  std::vector<double> numbers{static_cast<double>(cell.x), static_cast<double>(cell.y), static_cast<double>(cell.z)};
  numbers.insert(numbers.end(), more);
  append(text, word, numbers);
}

// One line of the text; what it holds is checked where it is asked for.
class TriedViewsLine {
 public:
  TriedViewsLine(std::string_view line, std::size_t number) : number_(number) {
    word_ = line.substr(0, line.find(' '));
    line.remove_prefix(word_.size());
    while (!line.empty()) {
      line.remove_prefix(1);
      const std::string_view digits = line.substr(0, line.find(' '));
      double value = 0.0;
      const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
      if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value)) {
        refuse("'" + std::string(digits.substr(0, 40)) + "' is not a finite number");
      }
      numbers_.push_back(value);
      line.remove_prefix(digits.size());
    }
  }

  [[nodiscard]] std::string_view word() const { return word_; }
  // All numbers, which are as many as this.
  [[nodiscard]] std::span<const double> numbers(std::size_t count) const {
    if (numbers_.size() != count) {
      refuse("'" + std::string(word_.substr(0, 40)) + "' takes " + std::to_string(count) + " numbers");
    }
    return numbers_;
  }
  // The cell at the start of `count` numbers.
  [[nodiscard]] VoxelIndex cell(std::size_t count) const {
    (void)numbers(count);
    const VoxelIndex cell{whole<std::int32_t>(0, kFurthestVoxel), whole<std::int32_t>(1, kFurthestVoxel),
                          whole<std::int32_t>(2, kFurthestVoxel)};
    if (!is_addressable(cell)) {
      refuse("a cell is not addressable");
    }
    return cell;
  }
  // The number at this position, a whole one of at most `most` either way.
  template <class Whole>
  [[nodiscard]] Whole whole(std::size_t position, double most) const {
    const double value = numbers_.at(position);
    if (value != std::floor(value) || std::abs(value) > most || (std::is_unsigned_v<Whole> && value < 0.0)) {
      refuse("a whole number was expected, and not above " + std::to_string(static_cast<std::int64_t>(most)));
    }
    return static_cast<Whole>(value);
  }
  [[noreturn]] void refuse(const std::string& why) const {
    throw std::runtime_error("line " + std::to_string(number_) + " of a memory of tried views: " + why);
  }

 private:
  std::size_t number_;
  std::string_view word_;
  std::vector<double> numbers_;
};

inline Pose pose_of(const TriedViewsLine& entry) {
  Pose pose = Pose::Identity();
  const std::span<const double> numbers = entry.numbers(12);
  for (int i = 0; i < 12; ++i) {
    pose.matrix()(i / 4, i % 4) = numbers[static_cast<std::size_t>(i)];
  }
  if (!is_rigid(pose)) {
    entry.refuse("the pose is not a rigid transform");
  }
  return pose;
}

}  // namespace detail

VANTAGE_INLINE std::string TriedViews::text() const {
  std::string text;
  detail::append(text, detail::kHead, std::array{1.0, cell_m_, static_cast<double>(plans_)});
  std::vector<VoxelIndex> cells;
  std::transform(looks_.begin(), looks_.end(), std::back_inserter(cells),
                 [](const auto& entry) { return entry.first; });
  std::sort(cells.begin(), cells.end(), RasterOrder{});
  for (const VoxelIndex& cell : cells) {
    const Looks& looks = looks_.at(cell);
    detail::append(text, "cell", cell,
                   {static_cast<double>(looks.known_neighbours), static_cast<double>(looks.latest)});
    for (const auto& [word, places] : kPlaceLists) {
      for (const VoxelIndex& place : looks.*places) {
        detail::append(text, word, place);
      }
    }
  }
  for (const Place& place : places_) {
    detail::append(text, "place", place.cell,
                   {place.nearest_way, static_cast<double>(place.no_nearer), static_cast<double>(place.failures),
                    static_cast<double>(place.rests_until)});
  }
  for (const Pose& pose : scanned_from_) {
    const Eigen::Matrix<double, 3, 4, Eigen::RowMajor> rows = pose.matrix().topRows<3>();
    detail::append(text, "scan", std::span(rows.data(), 12));
  }
  return text;
}

VANTAGE_INLINE void TriedViews::recall(const OccupancyMap& map, std::string_view text) {
  TriedViews read(sensor_, options_);
  Looks* looks = nullptr;
  std::size_t number = 0;
  for (; !text.empty(); text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1)) {
    const detail::TriedViewsLine entry(text.substr(0, text.find('\n')), ++number);
    if ((number == 1) != (entry.word() == detail::kHead)) {
      entry.refuse("the text starts with '" + std::string(detail::kHead) + "', once");
    }
    if (number == 1) {
      const std::span<const double> head = entry.numbers(3);
      if (head[0] != 1.0) {
        entry.refuse("the version is not 1");
      }
      if (head[1] != map.resolution_m()) {
        entry.refuse("cells of " + std::to_string(head[1]) + " m, the map has cells of " +
                     std::to_string(map.resolution_m()) + " m");
      }
      read.plans_ = entry.whole<std::uint64_t>(2, detail::kMostPlans);
    } else if (entry.word() == "cell") {
      const VoxelIndex cell = entry.cell(5);
      looks = &read.looks_[cell];
      read.may_hold_.insert(cell);
      looks->known_neighbours = entry.whole<int>(3, 6);
      looks->latest = entry.whole<std::uint64_t>(4, detail::kMostPlans);
    } else if (const auto* const list = std::find_if(kPlaceLists.begin(), kPlaceLists.end(),
                                                     [&](const auto& one) { return one.first == entry.word(); });
               list != kPlaceLists.end()) {
      if (looks == nullptr) {
        entry.refuse("a look without a cell");
      }
      (looks->*list->second).push_back(entry.cell(3));
    } else if (entry.word() == "place") {
      constexpr double kMost = 1e6;
      Place& place = read.place_of(entry.cell(7));
      place.revision = map.revision();
      place.nearest_way = entry.numbers(7)[3];
      place.no_nearer = entry.whole<int>(4, kMost);
      place.failures = entry.whole<int>(5, kMost);
      place.rests_until = entry.whole<std::uint64_t>(6, detail::kMostPlans);
    } else if (entry.word() == "scan") {
      read.remember_scan(detail::pose_of(entry));
    } else {
      entry.refuse("'" + std::string(entry.word().substr(0, 40)) + "' is not an entry");
    }
  }
  if (number == 0) {
    throw std::runtime_error("a memory of tried views is empty");
  }
  read.cell_m_ = map.resolution_m();
  read.map_ = KnownMap(map);
  read.reviewed_ = map.revision();
  read.rest_now();
  *this = std::move(read);
}

}  // namespace vantage
