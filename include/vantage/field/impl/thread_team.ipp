// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/field/impl/thread_team.hpp>

namespace vantage::detail {

// Spins before it sleeps: the next pass mostly follows within microseconds, and waking up takes longer.
inline constexpr int kLooks = 10000;

// Returns when `value` is no longer `old`.
inline void wait_for_change(const std::atomic<std::uint32_t>& value, std::uint32_t old) {
  for (int look = 0; look < kLooks; ++look) {
    if (value.load(std::memory_order_acquire) != old) {
      return;
    }
  }
  value.wait(old, std::memory_order_acquire);
}

VANTAGE_INLINE ThreadTeam::ThreadTeam(std::size_t threads) {
  try {
    for (std::size_t i = 1; i < threads; ++i) {
      others_.emplace_back([this, i] { serve(i); });
    }
  } catch (...) {
    dismiss();
    throw;
  }
}

VANTAGE_INLINE void ThreadTeam::start(Call call, const void* work) {
  call_ = call;
  work_ = work;
  at_work_.store(static_cast<std::uint32_t>(others_.size()), std::memory_order_relaxed);
  round_.fetch_add(1, std::memory_order_release);
  round_.notify_all();
  call(work, 0);
  for (std::uint32_t left = at_work_.load(std::memory_order_acquire); left != 0;
       left = at_work_.load(std::memory_order_acquire)) {
    wait_for_change(at_work_, left);
  }
}

VANTAGE_INLINE void ThreadTeam::serve(std::size_t i) {
  for (std::uint32_t round = 0;; ++round) {
    wait_for_change(round_, round);
    if (call_ == nullptr) {
      return;
    }
    call_(work_, i);
    if (at_work_.fetch_sub(1, std::memory_order_acq_rel) == 1) {
      at_work_.notify_one();
    }
  }
}

VANTAGE_INLINE void ThreadTeam::dismiss() {
  call_ = nullptr;
  round_.fetch_add(1, std::memory_order_release);
  round_.notify_all();
  for (std::thread& other : others_) {
    other.join();
  }
}

}  // namespace vantage::detail
