// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include <cstdio>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace {

// Prints, after the usual table, how many times as much processor time the peer took in the same run: for every benchmark with a part
// of ours in its name, each peer's that differs in that part alone.
class RatioReporter : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      if (run.run_type == Run::RT_Iteration && !run.error_occurred) {
        const std::string& arguments = run.run_name.args;
        times_.emplace_back(run.run_name.function_name + (arguments.empty() ? "" : "/" + arguments), run.GetAdjustedCPUTime() / benchmark::GetTimeUnitMultiplier(run.time_unit));
      }
    }
  }
  void Finalize() override {
    for (const auto& [ours, our_time] : times_) {
      for (const auto& [our_part, peers] : kPeers) {
        const std::size_t at = ours.find(our_part);
        for (const std::string_view peer : peers) {
          for (const auto& [theirs, their_time] : times_) {
            if (at != std::string::npos && theirs == std::string(ours).replace(at, our_part.size(), peer)) {
              std::printf("%-60s %8.1f x\n", (theirs + " : " + std::string(our_part.substr(1))).c_str(), their_time / our_time);
            }
          }
        }
      }
    }
  }

 private:
  struct Peers {
    std::string_view ours;
    std::vector<std::string_view> theirs;
  };
  static inline const std::vector<Peers> kPeers{
      {"/vantage", {"/octomap"}}, {"/multigrid", {"/gauss_seidel", "/eigen_iccg", "/hypre_boomeramg"}}};

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
