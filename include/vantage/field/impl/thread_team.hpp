// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <vantage/compiler.hpp>
#include <vector>

namespace vantage::detail {

/// A pool of threads for the many short passes of a solver. The calling thread is one of them.
class ThreadTeam {
 public:
  /// Creates a team of `threads` threads (> 0), including the caller. Throws std::system_error if they cannot be
  /// created.
  explicit ThreadTeam(std::size_t threads);
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;
  ThreadTeam(ThreadTeam&&) = delete;
  ThreadTeam& operator=(ThreadTeam&&) = delete;
  ~ThreadTeam() { dismiss(); }

  [[nodiscard]] std::size_t size() const { return others_.size() + 1; }

  /// Calls `work(i)` for each i < size(), each on its own thread, and returns when all have finished. `work` must not
  /// throw.
  template <class Work>
  void run(const Work& work) {
    if (others_.empty()) {
      work(std::size_t{0});
      return;
    }
    start([](const void* what, std::size_t i) { (*static_cast<const Work*>(what))(i); }, &work);
  }
  /// Calls `work(begin, end)` on disjoint parts that cover [0, count). Uses a single thread if the parts would be
  /// smaller than `grain`.
  template <class Work>
  void split(std::size_t count, std::size_t grain, const Work& work) {
    if (count < grain * size()) {
      work(std::size_t{0}, count);
      return;
    }
    run([&](std::size_t i) { work(count * i / size(), count * (i + 1) / size()); });
  }

 private:
  using Call = void (*)(const void* work, std::size_t i);

  void start(Call call, const void* work);
  void serve(std::size_t i);
  void dismiss();

  Call call_ = nullptr;  // null: end of work
  const void* work_ = nullptr;
  std::atomic<std::uint32_t> round_{0};
  std::atomic<std::uint32_t> at_work_{0};
  std::vector<std::thread> others_;
};

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/field/impl/thread_team.ipp>
#endif
