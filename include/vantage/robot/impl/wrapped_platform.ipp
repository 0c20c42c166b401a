// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <utility>
#include <vantage/robot/wrapped_platform.hpp>

namespace vantage {

VANTAGE_INLINE WrappedPlatform::WrappedPlatform(std::shared_ptr<const Platform> platform)
    : platform_(std::move(platform)) {
  if (platform_ == nullptr) {
    throw std::invalid_argument("WrappedPlatform: platform is null");
  }
}

}  // namespace vantage
