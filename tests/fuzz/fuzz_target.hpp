// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace vantage::fuzz {

/// Whole inputs of the target that is linked, from which others are made.
std::vector<std::string> seeds();

}  // namespace vantage::fuzz

/// Takes one input, as libFuzzer calls it: errors that the reader documents are caught, all else is a finding.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
