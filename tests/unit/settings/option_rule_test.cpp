// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

#include <vantage/settings/impl/option_rule.hpp>

namespace vantage::detail {
namespace {

template <class Number>
std::string refusal(Number value) {
  try {
    require_option(false, "HostOptions::reach_m", value, "> 0");
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "was not refused";
}

TEST(OptionRule, SaysWhichOptionItsValueAndItsRule) {
  EXPECT_EQ(refusal(-0.5), "HostOptions::reach_m is -0.5, must be > 0");
  EXPECT_EQ(refusal(0), "HostOptions::reach_m is 0, must be > 0");
  EXPECT_EQ(refusal(std::numeric_limits<std::uint64_t>::max()),
            "HostOptions::reach_m is 18446744073709551615, must be > 0");
  EXPECT_EQ(refusal(std::numeric_limits<double>::infinity()), "HostOptions::reach_m is inf, must be > 0");
  EXPECT_EQ(refusal(std::numeric_limits<double>::quiet_NaN()), "HostOptions::reach_m is nan, must be > 0");
}

// A value just beyond its limit must not print like the limit, nor a tiny value like zero.
TEST(OptionRule, PrintsEnoughDigitsToTellValuesApart) {
  EXPECT_EQ(refusal(1e-9), "HostOptions::reach_m is 1e-09, must be > 0");
  EXPECT_EQ(refusal(1.0000000000000002), "HostOptions::reach_m is 1.0000000000000002, must be > 0");
  EXPECT_EQ(refusal(0.1F), "HostOptions::reach_m is 0.1, must be > 0");
  EXPECT_EQ(refusal(std::numeric_limits<double>::denorm_min()), "HostOptions::reach_m is 5e-324, must be > 0");
}

TEST(OptionRule, LetsPassWhatHolds) { EXPECT_NO_THROW(require_option(true, "HostOptions::reach_m", -1.0, "> 0")); }

}  // namespace
}  // namespace vantage::detail
