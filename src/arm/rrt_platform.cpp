// SPDX-License-Identifier: MIT
#include <ompl/base/MotionValidator.h>
#include <ompl/base/PlannerTerminationCondition.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/datastructures/NearestNeighborsLinear.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/rrt/RRT.h>

#include <cmath>
#include <utility>
#include <vantage/arm/rrt_platform.hpp>
#include <vector>

#include <vantage/settings/impl/option_rule.hpp>
#include "arm/ompl_quiet.hpp"

namespace vantage {
namespace {

using PositionState = ompl::base::RealVectorStateSpace::StateType;

Eigen::Vector3d position_of(const ompl::base::State* state) {
  return Eigen::Vector3d(state->as<PositionState>()->values);
}

// OMPL's RRT with a fixed seed for the generator that decides when to sample the goal.
class SeededRrt final : public ompl::geometric::RRT {
 public:
  SeededRrt(const ompl::base::SpaceInformationPtr& information, std::uint64_t seed) : RRT(information) {
    rng_.setLocalSeed(static_cast<std::uint_fast32_t>((seed >> 32U ^ ~seed) & 0xFFFFFFFFU));
  }
};

// Collision tests of positions and straight motions of a platform. The orientation follows the motion.
class Positions final : public ompl::base::MotionValidator {
 public:
  Positions(ompl::base::SpaceInformation* information, const OccupancyMap& map, const Platform& platform)
      : MotionValidator(information), map_(map), platform_(platform) {}

  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to) const override {
    const Eigen::Vector3d a = position_of(from);
    const Eigen::Vector3d b = position_of(to);
    const Pose there = platform_.facing(b, b - a);
    return a == b ||
           (platform_.admits(map_, there) && platform_.admits_motion(map_, platform_.facing(a, b - a), there));
  }
  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to,
                   std::pair<ompl::base::State*, double>& last_valid) const override {
    last_valid.second = 0.0;
    return checkMotion(from, to);
  }

 private:
  const OccupancyMap& map_;
  const Platform& platform_;
};

ompl::base::SpaceInformationPtr positions_in(const OccupancyMap& map, const Platform& platform, std::uint64_t seed) {
  const auto states = std::make_shared<ompl::base::RealVectorStateSpace>(3);
  const Box space = map.frame().box_of(map.region() ? *map.region() : map.bounds());
  ompl::base::RealVectorBounds bounds(3);
  for (unsigned axis = 0; axis < 3; ++axis) {
    bounds.setLow(axis, space.min[axis]);
    bounds.setHigh(axis, space.max[axis]);
  }
  states->setBounds(bounds);
  states->setStateSamplerAllocator(
      [seed](const ompl::base::StateSpace* of) { return std::make_shared<SeededSampler>(of, seed); });
  auto information = std::make_shared<ompl::base::SpaceInformation>(states);
  // The motion test also checks the position where the motion ends.
  information->setStateValidityChecker([](const ompl::base::State* /*state*/) { return true; });
  information->setMotionValidator(std::make_shared<Positions>(information.get(), map, platform));
  information->setup();
  return information;
}

// The corners of a path between two positions, both included; empty if none is found.
std::vector<Eigen::Vector3d> corners_of_way(const OccupancyMap& map, const Platform& platform,
                                            const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                            const RrtOptions& options) {
  const OmplQuiet quiet;
  const ompl::base::SpaceInformationPtr information = positions_in(map, platform, options.seed);
  const auto problem = std::make_shared<ompl::base::ProblemDefinition>(information);
  ompl::base::ScopedState<ompl::base::RealVectorStateSpace> start(information);
  ompl::base::ScopedState<ompl::base::RealVectorStateSpace> goal(information);
  for (unsigned axis = 0; axis < 3; ++axis) {
    start[axis] = from[axis];
    goal[axis] = to[axis];
  }
  problem->setStartAndGoalStates(start, goal);
  SeededRrt planner(information, options.seed);
  planner.setProblemDefinition(problem);
  planner.setGoalBias(options.goal_bias);
  planner.setRange(options.step_m);
  // OMPL's default structure uses an unseeded random generator
  planner.setNearestNeighbors<ompl::NearestNeighborsLinear>();
  std::size_t asked = 0;
  const ompl::base::PlannerTerminationCondition spent([&] { return asked++ >= options.iterations; });
  std::vector<Eigen::Vector3d> corners;
  if (planner.solve(spent) == ompl::base::PlannerStatus::EXACT_SOLUTION) {
    for (const ompl::base::State* state :
         problem->getSolutionPath()->as<ompl::geometric::PathGeometric>()->getStates()) {
      corners.push_back(position_of(state));
    }
  }
  return corners;
}

}  // namespace

RrtPlatform::RrtPlatform(std::shared_ptr<const Platform> platform, const RrtOptions& options)
    : WrappedPlatform(std::move(platform)), options_(options) {
  detail::require_option(options.goal_bias >= 0.0 && options.goal_bias < 1.0, "RrtOptions::goal_bias",
                         options.goal_bias, "in [0, 1)");
  detail::require_option(std::isfinite(options.step_m) && options.step_m > 0.0, "RrtOptions::step_m", options.step_m,
                         "> 0");
  detail::require_option(options.iterations > 0, "RrtOptions::iterations", options.iterations, "> 0");
}

std::optional<std::vector<Pose>> RrtPlatform::path(const OccupancyMap& map, const Pose& from, const Pose& to) const {
  if (!wrapped().admits(map, to)) {
    return std::nullopt;
  }
  if (wrapped().admits_motion(map, from, to)) {
    return std::vector<Pose>{from, to};
  }
  const std::vector<Eigen::Vector3d> corners =
      corners_of_way(map, wrapped(), from.translation(), to.translation(), options_);
  if (corners.empty()) {
    return std::nullopt;
  }
  std::vector<Pose> poses{from};
  for (std::size_t at = 0; at + 1 < corners.size();) {
    const auto pose_at = [&](std::size_t i) {
      return i + 1 == corners.size() ? to : wrapped().facing(corners[i], corners[i] - corners[at]);
    };
    std::size_t next = corners.size() - 1;
    while (next > at + 1 &&
           !(wrapped().admits(map, pose_at(next)) && wrapped().admits_motion(map, poses.back(), pose_at(next)))) {
      --next;
    }
    if (!wrapped().admits_motion(map, poses.back(), pose_at(next))) {
      return std::nullopt;
    }
    poses.push_back(pose_at(next));
    at = next;
  }
  return poses;
}

}  // namespace vantage
