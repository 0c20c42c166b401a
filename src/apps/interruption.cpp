// SPDX-License-Identifier: MIT
#include "apps/interruption.hpp"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <string_view>

namespace vantage::apps {
namespace {

constexpr int kInterruptedBySignal = 128;

// Lock-free atomics that a signal handler may touch.
std::atomic<bool> signals_held{false};
std::atomic<int> signal_seen{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

void say(std::string_view text) {
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text.data(), text.size());
}

extern "C" void on_signal(int signal) {
  int none = 0;
  if (signals_held.load() && signal_seen.compare_exchange_strong(none, signal)) {
    return;
  }
  say(signals_held.load() ? "vantage: interrupted twice: files may be missing\n"
                          : "vantage: interrupted before the first view: nothing was written\n");
  ::_exit(kInterruptedBySignal + signal);
}

void handle_signals(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace

Interruption::Interruption() {
  signals_held = false;
  signal_seen = 0;
  handle_signals(on_signal);
}

Interruption::~Interruption() { handle_signals(SIG_DFL); }

void Interruption::hold() { signals_held = true; }
bool Interruption::asked() const { return signal_seen.load() != 0; }
int Interruption::exit_code() const { return asked() ? kInterruptedBySignal + signal_seen.load() : 0; }

}  // namespace vantage::apps
