// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vantage/compiler.hpp>
#include <vantage/map/occupancy_map.hpp>

namespace VANTAGE_EXPORT vantage {

/// Remembers from which map something was computed. Objects that follow a map from call to call use it to detect that
/// they got another map. It does not keep the map alive.
class KnownMap {
 public:
  /// Refers to no map.
  KnownMap() = default;
  /// Refers to `map`.
  explicit KnownMap(const OccupancyMap& map)
      : address_(&map), token_(map.identity().token_), origin_(map.identity().origin_) {}

  /// Whether `map` is the remembered map. The map may have been moved to another address and its contents may have
  /// changed (see OccupancyMap::changed_since).
  [[nodiscard]] bool is(const OccupancyMap& map) const {
    const std::shared_ptr<const char> token = token_.lock();
    return token != nullptr && token == map.identity().token_;
  }
  /// Whether `map` is the remembered map, or both are copies (direct or indirect) of one map. A host may pass a new
  /// snapshot of its map to every plan.
  [[nodiscard]] bool is_copied_from(const OccupancyMap& map) const {
    const std::shared_ptr<const char> origin = origin_.lock();
    return origin != nullptr && origin == map.identity().origin_;
  }
  /// Whether `map` is the remembered map at its old address, so that pointers to it are still valid.
  [[nodiscard]] bool is_in_place(const OccupancyMap& map) const { return address_ == &map && is(map); }

 private:
  const OccupancyMap* address_ = nullptr;
  std::weak_ptr<const char> token_;  // a token is never reused while this weak reference exists
  std::weak_ptr<const char> origin_;
};

}  // namespace vantage
