// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>
#include <vantage/compiler.hpp>

namespace VANTAGE_EXPORT vantage {

/// Tells a map from every other, wherever and whenever they are: each map has one of its own, a copy gets a new one,
/// and a map that is moved takes it along. Two addresses cannot say that, for another map may come to lie at one.
/// A map that has been moved from is the same as none.
class MapIdentity {
 public:
  /// A new one.
  MapIdentity() : token_(std::make_shared<const char>('\0')) {}
  ~MapIdentity() = default;
  /// A new one.
  MapIdentity(const MapIdentity& /*unused*/) : MapIdentity() {}
  /// A new one: what was written over is no longer what it was.
  MapIdentity& operator=(const MapIdentity& other) {
    if (this != &other) {
      *this = MapIdentity();
    }
    return *this;
  }
  /// Taken along.
  MapIdentity(MapIdentity&&) noexcept = default;
  /// Taken along.
  MapIdentity& operator=(MapIdentity&&) noexcept = default;

 private:
  friend class KnownMap;
  std::shared_ptr<const char> token_;
};

}  // namespace vantage
