// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>

namespace vantage::apps {

/// Shows the progress of the search for observable cells, which precedes the first view: one line on stderr, if
/// that is a terminal, which is removed at the end.
class ObservableProgress {
 public:
  explicit ObservableProgress(bool quiet);

  /// Called as ExplorationRunOptions::on_observable_share.
  void tell(double share);
  /// Duration of the search, seconds.
  [[nodiscard]] double seconds() const { return seconds_; }

 private:
  bool terminal_;
  std::chrono::steady_clock::time_point start_;
  double seconds_ = 0.0;
  double told_s_ = 0.0;
};

}  // namespace vantage::apps
