// SPDX-License-Identifier: MIT
#include "apps/observable_progress.hpp"

#include <unistd.h>

#include <cstdio>
#include <iostream>

#include "apps/run_printer.hpp"

namespace vantage::apps {

ObservableProgress::ObservableProgress(bool quiet)
    : terminal_(!quiet && isatty(STDERR_FILENO) != 0), start_(std::chrono::steady_clock::now()) {}

void ObservableProgress::tell(double share) {
  constexpr double kFirstS = 0.5;  // seconds; a shorter search gets no line
  constexpr double kEveryS = 0.2;
  seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const bool is_told = told_s_ > 0.0;
  if (!terminal_ || (share < 1.0 && seconds_ < (is_told ? told_s_ + kEveryS : kFirstS))) {
    return;
  }
  if (share < 1.0) {
    std::cerr << '\r' << drawn_bar(share) << "looking for what can be observed, about "
              << rounded_time(seconds_ * (1.0 - share) / share) << " left\x1b[K" << std::flush;
    told_s_ = seconds_;
  } else if (is_told) {
    std::cerr << "\r\x1b[K" << std::flush;
  }
}

}  // namespace vantage::apps
