// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace {

// Prints, after the usual table, how many times as much processor time the peer took in the same run: for every benchmark with a part
// `vantage` in its name, each other that differs in that part alone.
class RatioReporter : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      if (run.run_type == Run::RT_Iteration && !run.error_occurred) {
        times_.emplace_back(run.run_name.str(), run.GetAdjustedCPUTime() / benchmark::GetTimeUnitMultiplier(run.time_unit));
      }
    }
  }
  void Finalize() override {
    for (const auto& [ours, our_time] : times_) {
      const std::size_t at = ours.find("/vantage");
      for (const char* peer : {"/octomap"}) {
        for (const auto& [theirs, their_time] : times_) {
          if (at != std::string::npos && theirs == std::string(ours).replace(at, 8, peer)) {
            std::printf("%-60s %8.1f x\n", (theirs + " : vantage").c_str(), their_time / our_time);
          }
        }
      }
    }
  }

 private:
  std::vector<std::pair<std::string, double>> times_;
};

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
    return 2;
  }
  RatioReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  benchmark::Shutdown();
  return 0;
}
