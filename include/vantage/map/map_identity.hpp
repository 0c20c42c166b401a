// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>
#include <vantage/compiler.hpp>

namespace VANTAGE_EXPORT vantage {

/// A unique identity of a map. Every new map and every copy gets a new identity; a move transfers it. An address is
/// not enough, because a new map may be created at the address of a destroyed one. A map that was moved from has no
/// identity. A map and its copies share an origin.
class MapIdentity {
 public:
  /// Creates a new identity with a new origin.
  MapIdentity() : token_(std::make_shared<const char>('\0')), origin_(token_) {}
  ~MapIdentity() = default;
  /// Creates a new identity with the origin of `other`.
  MapIdentity(const MapIdentity& other) : MapIdentity() { origin_ = other.origin_; }
  /// Replaces this identity by a new one with the origin of `other`: the contents are no longer those of the old map.
  MapIdentity& operator=(const MapIdentity& other) {
    if (this != &other) {
      *this = MapIdentity(other);
    }
    return *this;
  }
  /// Takes over the identity of the other map.
  MapIdentity(MapIdentity&&) noexcept = default;
  /// Takes over the identity of the other map.
  MapIdentity& operator=(MapIdentity&&) noexcept = default;

 private:
  friend class KnownMap;
  std::shared_ptr<const char> token_;
  std::shared_ptr<const char> origin_;  // shared by a map and its copies
};

}  // namespace vantage
