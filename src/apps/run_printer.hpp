// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <vantage/report/run_record.hpp>

namespace vantage::apps {

/// Prints a run as it goes: a line per view, with a bar of the coverage where a person watches a terminal.
class RunPrinter {
 public:
  RunPrinter(std::ostream& out, bool terminal) : out_(out), terminal_(terminal) {}

  void head(const std::string& planner, const std::string& world, const std::string& sensor, double resolution_m,
            std::uint64_t seed);
  void view(const ViewRecord& view);
  void summary(const RunRecord& record);

 private:
  std::ostream& out_;
  bool terminal_;
};

}  // namespace vantage::apps
