// SPDX-License-Identifier: MIT
#pragma once

#include <ostream>

#include "apps/explore_request.hpp"

namespace vantage::apps {

/// Stream for the progress of a run: stdout; stderr if the report takes stdout (--json -); nowhere with --quiet.
class ProgressStream {
 public:
  explicit ProgressStream(const ExploreRequest& request);

  [[nodiscard]] std::ostream& stream() { return stream_; }
  /// Whether it is a terminal, so that a line can be overwritten.
  [[nodiscard]] bool is_terminal() const { return is_terminal_; }

 private:
  std::ostream silence_{nullptr};
  std::ostream& stream_;
  bool is_terminal_;
};

}  // namespace vantage::apps
