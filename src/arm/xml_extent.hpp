// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string_view>

namespace vantage::detail {

/// Size measures of an XML text that limit the work of a parser.
struct XmlExtent {
  std::size_t depth = 0;  ///< largest nesting depth of elements
  std::size_t named = 0;  ///< number of elements with the given name
};

/// Counts tags without building a tree. Skips comments and quoted attributes. Malformed text is left to the parser.
[[nodiscard]] XmlExtent xml_extent(std::string_view text, std::string_view name);

}  // namespace vantage::detail
