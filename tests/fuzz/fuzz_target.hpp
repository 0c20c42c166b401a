// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace vantage::fuzz {

/// Valid inputs of the linked target, from which mutations are made.
std::vector<std::string> seeds();

}  // namespace vantage::fuzz

/// Runs one input, with the interface of libFuzzer. Documented errors are caught; everything else is a finding.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
