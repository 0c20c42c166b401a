// SPDX-License-Identifier: MIT
#include "arm/xml_extent.hpp"

#include <algorithm>

namespace vantage::detail {
namespace {

// End of the tag that starts at `at`: the position of its '>' outside quotes, or the end of the text.
std::size_t end_of_tag(std::string_view text, std::size_t at) {
  char quote = 0;
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (quote != 0) {
      quote = c == quote ? '\0' : quote;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '>') {
      return at;
    }
  }
  return text.size();
}

bool starts(std::string_view text, std::size_t at, std::string_view with) {
  return text.substr(at, with.size()) == with;
}

// The position after a comment, CDATA section or declaration that starts at `at`; `at` itself if an element starts
// there.
std::size_t past_other(std::string_view text, std::size_t at) {
  const auto past = [&](std::string_view end) {
    const std::size_t found = text.find(end, at);
    return found == std::string_view::npos ? text.size() : found + end.size();
  };
  return starts(text, at, "<!--")        ? past("-->")
         : starts(text, at, "<![CDATA[") ? past("]]>")
         : starts(text, at, "<?")        ? past("?>")
         : starts(text, at, "<!")        ? past(">")
                                         : at;
}

}  // namespace

XmlExtent xml_extent(std::string_view text, std::string_view name) {
  XmlExtent extent;
  std::size_t depth = 0;
  for (std::size_t at = text.find('<'); at < text.size(); at = text.find('<', at)) {
    if (const std::size_t past = past_other(text, at); past != at) {
      at = past;
      continue;
    }
    const std::size_t end = end_of_tag(text, at);
    if (starts(text, at, "</")) {
      depth -= depth > 0 ? 1U : 0U;
    } else {
      const std::size_t named = text.find_first_of(" \t\r\n/>", at + 1);
      extent.named += text.substr(at + 1, std::min(named, text.size()) - at - 1) == name ? 1U : 0U;
      extent.depth = std::max(extent.depth, depth + 1);
      depth += text[end - 1] == '/' ? 0U : 1U;
    }
    at = end;
  }
  return extent;
}

}  // namespace vantage::detail
