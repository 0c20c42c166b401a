// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vantage/compiler.hpp>
#include <vantage/map/known_map.hpp>
#include <vantage/map/occupancy_map.hpp>

namespace VANTAGE_EXPORT vantage {

/// Holds an object that is constructed from a map, `T(map)`, and updated by `T::update()`, such as a
/// FrontierTracker. Constructs a new one for another map, or if the map was moved to another address.
template <class T>
class Following {
 public:
  /// Updates the object to the state of `map`, which must outlive the object's next use. Returns whether a new
  /// object was constructed. Throws what T throws; the next call then constructs a new object.
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

  /// The object for the last followed map. Requires a call of `follow`.
  [[nodiscard]] const T& operator*() const { return *value_; }
  /// Members of the object for the last followed map. Requires a call of `follow`.
  [[nodiscard]] const T* operator->() const { return &*value_; }
  /// Members that change the object for the last followed map. Requires a call of `follow`.
  [[nodiscard]] T* operator->() { return &*value_; }

 private:
  KnownMap map_;
  std::optional<T> value_;
};

}  // namespace vantage
