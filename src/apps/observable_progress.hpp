// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>

namespace vantage::apps {

/// Shows the progress of the search for observable cells, which precedes the first view, on stderr: on a terminal one
/// line, which is removed at the end; otherwise a line every ten seconds.
class ObservableProgress {
 public:
  explicit ObservableProgress(bool quiet);

  /// Called as ExplorationRunOptions::on_observable_share.
  void tell(double share);
  /// Duration of the search, seconds.
  [[nodiscard]] double seconds() const { return seconds_; }

 private:
  bool quiet_;
  bool terminal_;
  std::chrono::steady_clock::time_point start_;
  double seconds_ = 0.0;
  double told_s_ = 0.0;
};

}  // namespace vantage::apps
