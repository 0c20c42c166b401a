// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <vector>

namespace vantage::detail {

/// Threads that stay for the many short passes of a solver; whoever calls is one of them.
class ThreadTeam {
 public:
  /// So many threads (> 0), the caller's included. Throws std::system_error if there cannot be as many.
  explicit ThreadTeam(std::size_t threads);
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;
  ThreadTeam(ThreadTeam&&) = delete;
  ThreadTeam& operator=(ThreadTeam&&) = delete;
  ~ThreadTeam() { dismiss(); }

  [[nodiscard]] std::size_t size() const { return others_.size() + 1; }

  /// Calls `work(i)` for each i < size(), every one on its own thread, and returns when all are done. `work` must not
  /// throw.
  template <class Work>
  void run(const Work& work) {
    if (others_.empty()) {
      work(std::size_t{0});
      return;
    }
    start([](const void* what, std::size_t i) { (*static_cast<const Work*>(what))(i); }, &work);
  }
  /// Calls `work(begin, end)` on parts of [0, count) that together are all of it; on one thread if the parts would
  /// have less than `grain`.
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

  Call call_ = nullptr;  // none: the end
  const void* work_ = nullptr;
  std::atomic<std::uint32_t> round_{0};
  std::atomic<std::uint32_t> at_work_{0};
  std::vector<std::thread> others_;
};

}  // namespace vantage::detail
