// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vantage/compiler.hpp>

namespace VANTAGE_EXPORT vantage {

/// An option that can be given as text, as `vantage list --settings PLANNER` prints it.
struct Setting {
  std::string name;           ///< key in Settings
  std::string default_value;  ///< as text; empty if there is none
  std::string unit;           ///< empty if there is none
  std::string meaning;        ///< description in one line
};

/// Values by name of the setting, as `--set key=value` gives them.
using Settings = std::map<std::string, std::string, std::less<>>;

}  // namespace vantage
