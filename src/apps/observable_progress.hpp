// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>

namespace vantage::apps {

/// Tells how far the search for the observable cells of a world is, which goes before the first view: on stderr,
/// where that is a terminal, one line that is gone when it is done.
class ObservableProgress {
 public:
  explicit ObservableProgress(bool quiet);

  /// Called as ExplorationRunOptions::on_observable_share.
  void tell(double share);
  /// What it took.
  [[nodiscard]] double seconds() const { return seconds_; }

 private:
  bool terminal_;
  std::chrono::steady_clock::time_point start_;
  double seconds_ = 0.0;
  double told_s_ = 0.0;
};

}  // namespace vantage::apps
