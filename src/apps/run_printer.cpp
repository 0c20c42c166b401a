// SPDX-License-Identifier: MIT
#include "apps/run_printer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace vantage::apps {
namespace {

std::string format(const char* pattern, ...) __attribute__((format(printf, 1, 2)));
std::string format(const char* pattern, ...) {
  char text[512];
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(text, sizeof text, pattern, arguments);
  va_end(arguments);
  return text;
}

double median(std::vector<double> values) {
  if (values.empty()) {
    return 0.0;
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::string times(const char* what, const std::vector<double>& ms) {
  return ms.empty() ? ""
                    : format("  %-12s median %.1f ms, longest %.1f ms\n", what, median(ms),
                             *std::max_element(ms.begin(), ms.end()));
}

}  // namespace

void RunPrinter::head(const std::string& planner, const std::string& world, const std::string& sensor,
                      double resolution_m, std::uint64_t seed) {
  start_ = std::chrono::steady_clock::now();
  out_ << planner << (planner == "next-best-view" ? " looks at " : " explores ") << world << " with " << sensor
       << format(", cells of %g m, seed %llu\n", resolution_m, static_cast<unsigned long long>(seed)) << std::flush;
}

std::string drawn_bar(double share) {
  constexpr int kWidth = 24;
  const int full = std::clamp(static_cast<int>(std::floor(share * kWidth + 1e-9)), 0, kWidth);
  return '[' + std::string(static_cast<std::size_t>(full), '#') +
         std::string(static_cast<std::size_t>(kWidth - full), '.') + format("] %5.1f %%  ", 100.0 * share);
}

std::string rounded_time(double seconds) {
  return seconds < 99.5    ? format("%.0f s", seconds)
         : seconds < 5940. ? format("%.0f min", seconds / 60.0)
                           : format("%.1f h", seconds / 3600.0);
}

std::string bar_text(const ViewRecord& view, double seconds, const ExpectedViews& expected) {
  const std::optional<double> known = view.seen_coverage ? view.seen_coverage
                                      : view.coverage    ? view.coverage
                                                         : view.surface_coverage;
  const bool counted = !known && expected.count > 0;
  const auto done = static_cast<double>(view.view);
  std::string text;
  if (known) {
    text += drawn_bar(*known);
  } else if (counted && !expected.at_most) {
    text += drawn_bar(done / static_cast<double>(expected.count));
  }
  text += format("view %zu", view.view);
  if (counted) {
    text += format(expected.at_most ? " of at most %zu" : " of %zu", expected.count);
  }
  text += format("  %.1f m", view.path_length_m);
  if (view.view == 1 || !(seconds > 0.0)) {  // the rate is counted from the first view
    return text;
  }
  text += format("  %.1f views/s", (done - 1.0) / seconds);
  if (known && *known > 0.0 && *known < 1.0) {
    text += "  about " + rounded_time(seconds * (1.0 - *known) / *known) + " left";
  } else if (counted && view.view < expected.count) {
    const double left_s = seconds * (static_cast<double>(expected.count) - done) / (done - 1.0);
    text += (expected.at_most ? "  at most " : "  about ") + rounded_time(left_s) + " left";
  }
  return text;
}

void RunPrinter::view(const ViewRecord& view) { terminal_ ? bar(view) : line(view); }

void RunPrinter::bar(const ViewRecord& view) {
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  out_ << "\r" << bar_text(view, seconds, expected_) << "\x1b[K" << std::flush;  // clears the rest of the line
}

void RunPrinter::line(const ViewRecord& view) {
  out_ << format("view %4zu  ", view.view);
  if (view.coverage) {
    out_ << format("%5.1f %% known  ", 100.0 * *view.coverage);
  }
  if (view.surface_coverage) {
    out_ << format("%5.1f %% of the surface  ", 100.0 * *view.surface_coverage);
  }
  if (view.seen_coverage) {
    out_ << format("%5.1f %% seen  ", 100.0 * *view.seen_coverage);
  }
  out_ << format("%7.1f m  ", view.path_length_m);
  if (!view.surface_coverage) {
    out_ << format("%7zu frontier cells  ", view.frontier_cells);
  }
  out_ << format("insert %6.1f ms  plan %8.1f ms\n", view.insert_ms, view.plan_ms) << std::flush;
}

void RunPrinter::summary(const RunRecord& record) {
  std::vector<double> insert_ms;
  std::vector<double> plan_ms;
  for (const ViewRecord& view : record.views) {
    insert_ms.push_back(view.insert_ms);
    if (view.plan_ms > 0.0) {
      plan_ms.push_back(view.plan_ms);
    }
  }
  out_ << (terminal_ && !record.views.empty() ? "\n\n  " : "\n  ") << format("%-12s ", "outcome")
       << to_string(record.outcome) << ": " << record.reason << '\n'
       << format("  %-12s %zu, over a path of %.1f m\n", "views", record.views.size(), record.path_length_m());
  if (record.duration_s) {
    out_ << format("  %-12s %.1f s, turned %.0f degrees\n", "duration", *record.duration_s, record.turned_deg);
  }
  if (record.coverage) {
    out_ << format("  %-12s %.2f %% of %zu observable cells\n", "coverage", 100.0 * *record.coverage,
                   record.observable_cells);
  }
  if (record.surface_coverage) {
    out_ << format("  %-12s %.2f %% of the object's points\n", "surface", 100.0 * *record.surface_coverage);
  }
  if (record.seen_coverage && record.seen_observable) {
    out_ << format("  %-12s %.2f %% of its surface, %.2f %% of what any admitted pose could see\n", "seen",
                   100.0 * *record.seen_coverage, 100.0 * *record.seen_observable);
  }
  out_ << format("  %-12s %zu unreachable, %zu unobservable, %zu looked at in vain\n", "left over",
                 record.leftover.unreachable, record.leftover.unobservable, record.leftover.in_vain)
       << format("  %-12s %zu\n", "collisions", record.collisions) << times("inserting", insert_ms)
       << times("planning", plan_ms) << format("  %-12s %.0f MB at most\n", "memory", record.peak_memory_mb)
       << std::flush;
}

void RunPrinter::observable(double seconds) {
  out_ << format("  %-12s found in %.1f s, before the first view\n", "observable", seconds) << std::flush;
}

void RunPrinter::working(const char* what, const char* doing) {
  if (terminal_) {
    out_ << format("  %-12s %s", what, doing) << std::flush;
  }
}

void RunPrinter::audit(const RunRecord& record) {
  if (record.audit) {
    out_ << (terminal_ ? "\r\033[K" : "")
         << format("  %-12s %zu of %zu unknown cells beside free space could still be observed", "audit",
                   record.audit->observable_left, record.audit->cells_checked)
         << format("; %zu more were looked at in vain\n", record.audit->looked_at_in_vain) << std::flush;
  }
}

void RunPrinter::bound(const RunRecord& record) {
  if (!record.path_bound) {
    return;
  }
  const auto [length_m, is_met] = *record.path_bound;
  out_ << (terminal_ ? "\r\033[K" : "")
       << format("  %-12s %s%.2f m for one who knows the world, to see all of it", "bound", is_met ? "" : "at least ",
                 length_m);
  if (length_m > 0.0 && record.coverage) {  // the coverage tells whether this run saw all of it, too
    out_ << format("; this run travelled %.2f times as far to see %.2f %%", record.path_length_m() / length_m,
                   100.0 * *record.coverage);
  }
  out_ << '\n' << std::flush;
}

}  // namespace vantage::apps
