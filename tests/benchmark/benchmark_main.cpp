// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace {

// Prints the report in the requested format (--benchmark_format) and, at the end, to stderr how much more processor
// time each peer took in the same run. Peers of a benchmark are those whose names differ from it only in our part of
// the name. With repetitions, the least time counts on both sides, because disturbances only add time.
class RatioReporter : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& context) override { return format_->ReportContext(context); }
  void ReportRuns(const std::vector<Run>& runs) override {
    format_->ReportRuns(runs);
    for (const Run& run : runs) {
      failed_ = failed_ || run.error_occurred;
      if (run.run_type == Run::RT_Iteration && !run.error_occurred) {
        const std::string& arguments = run.run_name.args;
        add(run.run_name.function_name + (arguments.empty() ? "" : "/" + arguments),
            run.GetAdjustedCPUTime() / benchmark::GetTimeUnitMultiplier(run.time_unit));
      }
    }
  }
  void Finalize() override {
    format_->Finalize();
    for (const std::string& ours : names_) {
      for (const auto& [our_part, peers] : kPeers) {
        const std::size_t at = ours.find(our_part);
        for (const std::string_view peer : peers) {
          const auto theirs = least_times_.find(
              at == std::string::npos ? std::string() : std::string(ours).replace(at, our_part.size(), peer));
          if (theirs != least_times_.end()) {
            std::fprintf(stderr, "%-60s %8.1f x\n", (theirs->first + " : " + std::string(our_part.substr(1))).c_str(),
                         theirs->second / least_times_.at(ours));
          }
        }
      }
    }
  }

  // Whether a benchmark failed, which it does if a peer finds another result.
  [[nodiscard]] bool failed() const { return failed_; }

 private:
  struct Peers {
    std::string_view ours;
    std::vector<std::string_view> theirs;
  };
  static inline const std::vector<Peers> kPeers{
      {"/vantage", {"/octomap"}},
      {"/multigrid", {"/gauss_seidel", "/eigen_iccg", "/hypre_boomeramg"}},
      {"/incremental", {"/full", "/full_cells"}},
      {"/record", {"/cycle"}},
      {"/harmonic", {"/frontier-gain"}},
      {"/default/vantage",
       {"/uniform/octomap", "/culled/octomap", "/hierarchical_from_12/octomap", "/hierarchical_from_13/octomap",
        "/hierarchical_from_14/octomap", "/hierarchical_from_15/octomap", "/uniform/vantage",
        "/hierarchical_from_13/vantage"}}};

  void add(const std::string& name, double time) {
    const auto [entry, is_new] = least_times_.try_emplace(name, time);
    entry->second = std::min(entry->second, time);
    if (is_new) {
      names_.push_back(name);
    }
  }

  std::unique_ptr<benchmark::BenchmarkReporter> format_{benchmark::CreateDefaultDisplayReporter()};
  std::map<std::string, double> least_times_;
  std::vector<std::string> names_;  // in the order of the run
  bool failed_ = false;
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
  return reporter.failed() ? 1 : 0;
}
