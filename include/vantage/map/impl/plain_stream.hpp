// SPDX-License-Identifier: MIT
#pragma once

#include <locale>
#include <sstream>

namespace vantage::detail {

/// Text for files: numbers are written in the same way whatever locale the host has set.
class PlainStream : public std::ostringstream {
 public:
  PlainStream() { imbue(std::locale::classic()); }
};

}  // namespace vantage::detail
