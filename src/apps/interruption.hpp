// SPDX-License-Identifier: MIT
#pragma once

namespace vantage::apps {

/// SIGINT and SIGTERM while a run goes on, of which there is one at a time. Before there is anything to lose, one
/// ends the process at once; after `hold` the first is kept for the run to see and the second ends the process. The
/// exit code is 128 and the signal's number in either case.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption(Interruption&&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  Interruption& operator=(Interruption&&) = delete;

  /// From the first view on.
  void hold();
  /// Whether a signal came since.
  [[nodiscard]] bool asked() const;
  /// Of the process that a signal ended; 0 where none came.
  [[nodiscard]] int exit_code() const;
};

}  // namespace vantage::apps
