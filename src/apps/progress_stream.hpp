// SPDX-License-Identifier: MIT
#pragma once

#include <ostream>

#include "apps/explore_request.hpp"

namespace vantage::apps {

/// Where a run tells how it goes: stdout; stderr, if the report takes stdout (--json -); nowhere, if --quiet.
class ProgressStream {
 public:
  explicit ProgressStream(const ExploreRequest& request);

  [[nodiscard]] std::ostream& stream() { return stream_; }
  /// Whether a person may be looking on: a line can be written over.
  [[nodiscard]] bool is_terminal() const { return is_terminal_; }

 private:
  std::ostream silence_{nullptr};
  std::ostream& stream_;
  bool is_terminal_;
};

}  // namespace vantage::apps
