// SPDX-License-Identifier: MIT
// Shade & Newman 2011, "Choosing Where To Go: Complete 3D Exploration With Stereo", section II.
#include <algorithm>
#include <string>
#include <utility>
#include <vantage/field/laplace_guess.hpp>
#include <vantage/field/laplace_multigrid.hpp>
#include <vantage/field/streamline.hpp>
#include <vantage/geometry/raster_order.hpp>
#include <vantage/planner/harmonic_planner.hpp>
#include <vantage/planner/target_view.hpp>
#include <vantage/robot/grid_path.hpp>

#include "planner/frontier_cycle.hpp"

namespace vantage {
namespace {

using Position = LaplaceProblem::Position;

RelaxationOptions relaxation_options(const HarmonicOptions& options) {
  RelaxationOptions relaxation;
  relaxation.neumann = options.neumann;
  relaxation.order = options.solver == FieldSolver::GaussSeidel ? SweepOrder::Lexicographic : SweepOrder::RedBlack;
  relaxation.tolerance = options.tolerance;
  relaxation.max_sweeps = options.max_sweeps;
  relaxation.over_relaxation = options.over_relaxation;
  relaxation.uniform_source = options.uniform_source;
  return relaxation;
}

MultigridOptions multigrid_options(const HarmonicOptions& options) {
  MultigridOptions multigrid;
  multigrid.neumann = options.neumann;
  multigrid.uniform_source = options.uniform_source;
  return multigrid;
}

// Cells from which some frontier is seen, each once.
std::vector<VoxelIndex> viewpoints(const FrontierSurvey& survey) {
  std::vector<VoxelIndex> cells;
  cells.reserve(survey.targets.size());
  for (const FrontierTarget& target : survey.targets) {
    cells.push_back(target.viewpoint);
  }
  std::sort(cells.begin(), cells.end(), RasterOrder{});
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

const FrontierTarget* target_seen_from(const FrontierSurvey& survey, const VoxelIndex& cell) {
  const auto found = std::find_if(survey.targets.begin(), survey.targets.end(),
                                  [&](const FrontierTarget& target) { return target.viewpoint == cell; });
  return found == survey.targets.end() ? nullptr : &*found;
}

// The streamline as poses that look along the flow, one per cell or so, if every motion between them is admitted.
std::optional<std::vector<Pose>> poses_of_curve(const OccupancyMap& map, const Platform& platform,
                                                const Pose& current, const std::vector<Eigen::Vector3d>& curve,
                                                const Pose& goal) {
  std::vector<Pose> poses{current};
  for (std::size_t i = 2; i < curve.size(); i += 2) {
    poses.push_back(platform.facing(curve[i], curve[i] - curve[i - 2]));
  }
  poses.push_back(goal);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    if (!platform.admits_motion(map, poses[i - 1], poses[i]) || !platform.admits(map, poses[i])) {
      return std::nullopt;
    }
  }
  return poses;
}

}  // namespace

HarmonicPlanner::HarmonicPlanner(const PlannerSetup& setup, const HarmonicOptions& options)
    : setup_(setup), options_(options) {
  detail::validate(setup);
  detail::validate(options.survey);
  relaxation_options(options).validate();
  failed_ = FailedViews(options.survey.patience);
}

Plan HarmonicPlanner::plan(const OccupancyMap& map, const Pose& current) {
  field_.reset();
  detail::FrontierCycle cycle(map, current, setup_, options_.survey, failed_);
  if (cycle.over()) {
    return cycle.plan();
  }
  const FrontierSurvey& survey = cycle.survey();
  PlanStatistics& statistics = cycle.plan().statistics;
  detail::Stopwatch watch;
  std::vector<VoxelIndex> way{*survey.reachable.start()};
  if (target_seen_from(survey, way.back()) == nullptr) {  // else look from where the sensor is
    solve(survey, statistics);
    way = way_down(map, current, survey);
  }
  const TargetView chosen = view_of_target(map, *setup_.platform, setup_.sensor, survey,
                                           *target_seen_from(survey, way.back()), statistics.ray_operations);
  const double choose_ms = watch.lap_ms();
  std::optional<std::vector<Pose>> path;
  if (field_ && field_->followed) {
    path = poses_of_curve(map, *setup_.platform, current, field_->streamline, chosen.view.pose);
  }
  Plan plan = path ? cycle.go(chosen, std::move(*path)) : cycle.go(chosen, way);
  plan.statistics.choose_ms = choose_ms;
  plan.statistics.path_ms = watch.lap_ms();
  return plan;
}

void HarmonicPlanner::solve(const FrontierSurvey& survey, PlanStatistics& statistics) {
  field_.emplace(HarmonicField{
      LaplaceProblem(survey.reachable.cells(), viewpoints(survey), *survey.reachable.start()), {}, {}, {}, 0, true});
  if (options_.solver == FieldSolver::Multigrid) {
    solve_by_multigrid();
  } else {
    relax();
  }
  statistics.solver_sweeps = field_->report.sweeps;
  statistics.ray_operations += field_->report.cell_updates;
}

// Only a certified field is followed: then the way down from any cell ends at a sink.
void HarmonicPlanner::solve_by_multigrid() {
  const LaplaceMultigrid multigrid(field_->problem, multigrid_options(options_));
  const MultigridReport& report = multigrid.report();
  field_->phi = multigrid.values(field_->problem);
  field_->stuck_cells = report.stuck_cells;
  field_->followed = report.certified;
  field_->report.stop = report.stop == MultigridStop::Converged ? LaplaceStop::Converged : LaplaceStop::SweepLimit;
  field_->report.sweeps = report.iterations;
  field_->report.cell_updates = report.iterations * report.unknowns;
  field_->report.seconds = report.setup_seconds + report.solve_seconds;
}

void HarmonicPlanner::relax() {
  LaplaceRelaxation relaxation(field_->problem, relaxation_options(options_));
  if (options_.solver == FieldSolver::CoarseToFine) {
    relaxation.start_from(coarse_to_fine_guess(field_->problem, options_.uniform_source));
    relaxation.run(std::min(options_.smoothing_sweeps, options_.max_sweeps));
  } else {
    relaxation.run();
  }
  // The stop rule does not promise a way down: go on until there is one, or enough is enough.
  const auto arrives = [&] {
    return descend(field_->problem, relaxation.phi(), field_->problem.source()).reaches_sink;
  };
  while (!(field_->followed = arrives()) && relaxation.report().sweeps < options_.max_sweeps) {
    const std::size_t left = options_.max_sweeps - relaxation.report().sweeps;
    relaxation.run(std::min(left, std::max<std::size_t>(relaxation.report().sweeps, 10)));
  }
  field_->phi.assign(relaxation.phi().begin(), relaxation.phi().end());
  field_->report = relaxation.report();
  field_->stuck_cells = count_stuck_cells(field_->problem, field_->phi);
}

// The cells from the start to the sink that the field leads to; the shortest way where it leads nowhere.
std::vector<VoxelIndex> HarmonicPlanner::way_down(const OccupancyMap& map, const Pose& current,
                                                  const FrontierSurvey& survey) {
  const LaplaceProblem& problem = field_->problem;
  const VoxelFrame& frame = map.frame();
  if (!field_->followed) {
    return GridPaths(survey.reachable).to_nearest(viewpoints(survey));
  }
  const VoxelIndex start = problem.cell(problem.source());
  const bool inside = frame.cell_of(current.translation()) == start;
  const Eigen::Vector3d from_m = inside ? Eigen::Vector3d(current.translation()) : frame.centre_of(start);
  if (auto curve = streamline(problem, field_->phi, frame, from_m)) {
    std::vector<VoxelIndex> cells;
    for (const Eigen::Vector3d& point : *curve) {
      if (const VoxelIndex cell = frame.cell_of(point); cells.empty() || cells.back() != cell) {
        cells.push_back(cell);
      }
    }
    field_->streamline = std::move(*curve);
    field_->streamline.push_back(frame.centre_of(cells.back()));
    return GridPaths(survey.reachable).to(cells.back());
  }
  std::vector<VoxelIndex> cells;
  for (const Position position : descend(problem, field_->phi, problem.source()).cells) {
    cells.push_back(problem.cell(position));
    field_->streamline.push_back(frame.centre_of(cells.back()));
  }
  return cells;
}

}  // namespace vantage
