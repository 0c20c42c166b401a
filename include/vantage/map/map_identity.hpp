// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>
#include <vantage/compiler.hpp>

namespace VANTAGE_EXPORT vantage {

/// Tells a map from every other, wherever and whenever they are: each map has one of its own, a copy gets a new one,
/// and a map that is moved takes it along. Two addresses cannot say that, for another map may come to lie at one.
/// A map that has been moved from is the same as none. Copies of a map, and of copies, have an origin in common.
class MapIdentity {
 public:
  /// A new one.
  MapIdentity() : token_(std::make_shared<const char>('\0')), origin_(token_) {}
  ~MapIdentity() = default;
  /// A new one, of the same origin.
  MapIdentity(const MapIdentity& other) : MapIdentity() { origin_ = other.origin_; }
  /// A new one, of the origin of the other: what was written over is not what it was.
  MapIdentity& operator=(const MapIdentity& other) {
    if (this != &other) {
      *this = MapIdentity(other);
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
  std::shared_ptr<const char> origin_;  // what copies have in common
};

}  // namespace vantage
