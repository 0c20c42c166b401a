// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vantage/compiler.hpp>
#include <vantage/map/known_map.hpp>
#include <vantage/map/occupancy_map.hpp>

namespace VANTAGE_EXPORT vantage {

/// Something that is made from a map, `T(map)`, and brought up to date by `update()`, such as a FrontierTracker.
/// Made anew when it is asked to follow another map.
template <class T>
class Following {
 public:
  /// Brings the value up to date with `map`, which must outlive its next use. Returns whether it was made anew.
  /// Throws what T throws; the next call then makes it anew.
  bool follow(const OccupancyMap& map) {
    if (map_.is_in_place(map)) {
      value_->update();
      return false;
    }
    map_ = KnownMap();  // refers to no map if the next line throws
    value_.emplace(map);
    map_ = KnownMap(map);
    return true;
  }

  /// The value for the last followed map. Requires a call of `follow`.
  [[nodiscard]] const T& operator*() const { return *value_; }
  /// Members of the value for the last followed map. Requires a call of `follow`.
  [[nodiscard]] const T* operator->() const { return &*value_; }
  /// Members that change the value for the last followed map. Requires a call of `follow`.
  [[nodiscard]] T* operator->() { return &*value_; }

 private:
  KnownMap map_;
  std::optional<T> value_;
};

}  // namespace vantage
