// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <vantage/report/run_record.hpp>

namespace vantage::apps {

/// Number of views that a run is expected to have.
struct ExpectedViews {
  std::size_t count = 0;  // 0: unknown
  bool at_most = true;    // whether the run may end earlier
};

/// Prints the progress of a run: one moving bar on a terminal, otherwise a line per view.
class RunPrinter {
 public:
  RunPrinter(std::ostream& out, bool terminal, ExpectedViews expected = {})
      : out_(out), terminal_(terminal), expected_(expected) {}

  void head(const std::string& planner, const std::string& world, const std::string& sensor, double resolution_m,
            std::uint64_t seed);
  void view(const ViewRecord& view);
  void summary(const RunRecord& record);
  // Tells how long the search for observable cells took, seconds.
  void observable(double seconds);
  // Prints on a terminal what takes time; the next output replaces it.
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

/// Text of the bar for a view, `seconds` after the start: share known, metres, views and their rate, and the
/// estimated time left, from how fast the unknown share shrinks. Without ground truth the estimate uses the
/// expected number of views.
[[nodiscard]] std::string bar_text(const ViewRecord& view, double seconds, const ExpectedViews& expected = {});
/// The bar itself and the share in per cent.
[[nodiscard]] std::string drawn_bar(double share);
/// A rounded time such as "3 min".
[[nodiscard]] std::string rounded_time(double seconds);

}  // namespace vantage::apps
