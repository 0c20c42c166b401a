// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vantage/compiler.hpp>
#include <vantage/map/occupancy_map.hpp>

namespace VANTAGE_EXPORT vantage {

/// Which map something was made from: for whatever follows a map from call to call, and must not take another one for
/// it. Does not keep the map.
class KnownMap {
 public:
  /// No map.
  KnownMap() = default;
  /// This one.
  explicit KnownMap(const OccupancyMap& map)
      : address_(&map), token_(map.identity().token_), origin_(map.identity().origin_) {}

  /// Whether `map` is that map, perhaps moved elsewhere; by now it may have changed (OccupancyMap::changed_since).
  [[nodiscard]] bool is(const OccupancyMap& map) const {
    const std::shared_ptr<const char> token = token_.lock();
    return token != nullptr && token == map.identity().token_;
  }
  /// Whether `map` is that map or shares its origin: a copy of it, or one of which both are copies. A host may hand a
  /// new snapshot of its map to every plan.
  [[nodiscard]] bool is_copied_from(const OccupancyMap& map) const {
    const std::shared_ptr<const char> origin = origin_.lock();
    return origin != nullptr && origin == map.identity().origin_;
  }
  /// Whether it also lies where it lay, so that pointers to it still hold.
  [[nodiscard]] bool is_in_place(const OccupancyMap& map) const { return address_ == &map && is(map); }

 private:
  const OccupancyMap* address_ = nullptr;
  std::weak_ptr<const char> token_;  // a token that is still held belongs to that map alone
  std::weak_ptr<const char> origin_;
};

}  // namespace vantage
