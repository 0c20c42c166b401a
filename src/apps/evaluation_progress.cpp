// SPDX-License-Identifier: MIT
#include "apps/evaluation_progress.hpp"

#include <unistd.h>

#include <cstdio>
#include <iostream>
#include <numeric>

#include "apps/run_printer.hpp"

namespace vantage::apps {
namespace {

std::string name_of(const EvaluationStart& at, const PlannerText& planner) {
  return std::string(at.world->name) + ", " + planner + ", start " + std::to_string(at.start);
}

std::string brief(std::size_t views, double path_m, const std::optional<double>& covered) {
  char text[96];
  std::snprintf(text, sizeof text, "%zu views, %.1f m", views, path_m);
  std::string all = text;
  if (covered) {
    std::snprintf(text, sizeof text, ", %.1f %% known", 100.0 * *covered);
    all += text;
  }
  return all;
}

}  // namespace

double seconds_left(const std::map<std::string_view, RunsOfWorld>& worlds) {
  const auto sum_of = [](const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
  };
  double all_s = 0.0;
  std::size_t all = 0;
  for (const auto& [name, runs] : worlds) {
    all_s += sum_of(runs.wall_s);
    all += runs.wall_s.size();
  }
  const double mean_s = all == 0 ? 0.0 : all_s / static_cast<double>(all);
  double left_s = 0.0;
  for (const auto& [name, runs] : worlds) {
    const double own_s = runs.wall_s.empty() ? mean_s : sum_of(runs.wall_s) / static_cast<double>(runs.wall_s.size());
    left_s += static_cast<double>(runs.left) * own_s;
  }
  return left_s;
}

EvaluationProgress::EvaluationProgress(std::size_t jobs) : terminal_(isatty(STDERR_FILENO) != 0), jobs_(jobs) {}

void EvaluationProgress::found(const EvaluationStart& at, const StoredRun& run) {
  worlds_[at.world->name].wall_s.push_back(run.wall_s);
}

// "12 of 300, about 2 h left"
std::string EvaluationProgress::so_far() const {
  std::size_t made = 0;
  std::size_t left = 0;
  for (const auto& [name, runs] : worlds_) {
    made += runs.wall_s.size();
    left += runs.left;
  }
  const std::string count = std::to_string(made) + " of " + std::to_string(made + left);
  const double left_s = seconds_left(worlds_) / static_cast<double>(jobs_);
  return (terminal_
              ? drawn_bar(static_cast<double>(made) / static_cast<double>(std::max<std::size_t>(made + left, 1)))
              : "") +
         count + (left_s > 0.0 ? ", about " + rounded_time(left_s) + " left" : "");
}

void EvaluationProgress::move(const std::string& text) {
  constexpr auto kEvery = std::chrono::milliseconds(200);
  const auto now = std::chrono::steady_clock::now();
  if (terminal_ && now - moved_ > kEvery) {
    moved_ = now;
    std::cerr << '\r' << so_far() << "  " << text << "\x1b[K" << std::flush;
  }
}

void EvaluationProgress::say(const std::string& text) {
  std::cerr << (terminal_ ? "\r\x1b[K" : "") << text << '\n' << std::flush;
}

void EvaluationProgress::view(const EvaluationStart& at, const PlannerText& planner, const ViewRecord& view) {
  const std::scoped_lock lock(mutex_);
  move(name_of(at, planner) + ": " + brief(view.view, view.path_length_m, view.coverage));
}

void EvaluationProgress::work(const EvaluationStart& at, const std::string& doing) {
  const std::scoped_lock lock(mutex_);
  move(std::string(at.world->name) + ", start " + std::to_string(at.start) + ": looking for " + doing);
}

void EvaluationProgress::made(const EvaluationStart& at, const PlannerText& planner, const StoredRun& run) {
  const std::scoped_lock lock(mutex_);
  RunsOfWorld& world = worlds_[at.world->name];
  --world.left;
  world.wall_s.push_back(run.wall_s);
  const RunFigures& figures = run.figures;
  say((terminal_ ? "" : so_far() + "  ") + name_of(at, planner) + ": " +
      (figures.outcome == "budget" ? "the budget ended it" : figures.outcome) + ", " +
      brief(figures.views, figures.path_m, figures.covered) + ", in " + rounded_time(run.wall_s));
}

void EvaluationProgress::failed(const EvaluationStart& at, const PlannerText& planner, const std::string& message) {
  const std::scoped_lock lock(mutex_);
  --worlds_[at.world->name].left;
  say(name_of(at, planner) + ": failed: " + message);
}

void EvaluationProgress::finish() {
  if (terminal_) {
    std::cerr << "\r\x1b[K" << std::flush;
  }
}

}  // namespace vantage::apps
