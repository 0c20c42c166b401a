// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <vantage/report/run_record.hpp>

namespace vantage::apps {

/// How many views a run is going to have.
struct ExpectedViews {
  std::size_t count = 0;  // 0: nobody knows
  bool at_most = true;    // it may end before
};

/// Prints a run as it goes: one bar that moves where a person watches a terminal, else a line per view.
class RunPrinter {
 public:
  RunPrinter(std::ostream& out, bool terminal, ExpectedViews expected = {})
      : out_(out), terminal_(terminal), expected_(expected) {}

  void head(const std::string& planner, const std::string& world, const std::string& sensor, double resolution_m,
            std::uint64_t seed);
  void view(const ViewRecord& view);
  void summary(const RunRecord& record);
  // How long it took to find the observable cells.
  void observable(double seconds);
  // Says, on a terminal, what takes time; what comes of it takes the place of that.
  void working(const char* what, const char* doing);
  void audit(const RunRecord& record);
  void bound(const RunRecord& record);

 private:
  void line(const ViewRecord& view);
  void bar(const ViewRecord& view);

  std::ostream& out_;
  bool terminal_;
  ExpectedViews expected_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// What the bar says of a view, `seconds` after the start: share known, metres, views and their rate, and about how
/// much is left, by how fast the unknown share has shrunk so far. Where no truth is known to take a share of, by how
/// many views are expected.
[[nodiscard]] std::string bar_text(const ViewRecord& view, double seconds, const ExpectedViews& expected = {});
/// The drawn bar alone and the share in words.
[[nodiscard]] std::string drawn_bar(double share);
/// "3 min": nobody needs it more exactly.
[[nodiscard]] std::string rounded_time(double seconds);

}  // namespace vantage::apps
