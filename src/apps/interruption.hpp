// SPDX-License-Identifier: MIT
#pragma once

namespace vantage::apps {

/// SIGINT and SIGTERM during a run; there is one object at a time. Before `hold` a signal ends the process at
/// once. After it the first signal is kept for the run to see and the second one ends the process. The exit code
/// is 128 plus the number of the signal in both cases.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption(Interruption&&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  Interruption& operator=(Interruption&&) = delete;

  /// Called at the first view: from now on there is something to lose.
  void hold();
  /// Whether a signal came since `hold`.
  [[nodiscard]] bool asked() const;
  /// Exit code after a signal; 0 if none came.
  [[nodiscard]] int exit_code() const;
};

}  // namespace vantage::apps
