// SPDX-License-Identifier: MIT
#include "apps/observable_progress.hpp"

#include <unistd.h>

#include <cstdio>
#include <iostream>

#include "apps/run_printer.hpp"

namespace vantage::apps {

ObservableProgress::ObservableProgress(bool quiet)
    : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0), start_(std::chrono::steady_clock::now()) {}

void ObservableProgress::tell(double share) {
  const double first_s = terminal_ ? 0.5 : 2.0;  // seconds; a shorter search gets no line
  const double every_s = terminal_ ? 0.2 : 10.0;
  seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const bool is_told = told_s_ > 0.0;
  if (quiet_ || (share < 1.0 && seconds_ < (is_told ? told_s_ + every_s : first_s))) {
    return;
  }
  if (share < 1.0) {
    std::cerr << (terminal_ ? "\r" + drawn_bar(share) : "") << "looking for what can be observed, about "
              << rounded_time(seconds_ * (1.0 - share) / share) << " left"
              << (terminal_ ? "\x1b[K" : "; --no-coverage skips this\n") << std::flush;
    told_s_ = seconds_;
  } else if (is_told && terminal_) {
    std::cerr << "\r\x1b[K" << std::flush;
  }
}

}  // namespace vantage::apps
