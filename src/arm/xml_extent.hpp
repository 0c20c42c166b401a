// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string_view>

namespace vantage::detail {

/// How much a parser of an XML text has to take.
struct XmlExtent {
  std::size_t depth = 0;  ///< of the elements within one another
  std::size_t named = 0;  ///< elements of the name asked for
};

/// Counts tags without building anything. Comments and quoted attributes are passed over; what is not well-formed
/// is left to the parser.
[[nodiscard]] XmlExtent xml_extent(std::string_view text, std::string_view name);

}  // namespace vantage::detail
