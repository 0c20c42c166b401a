// SPDX-License-Identifier: MIT
#include "arm/rrt_connect.hpp"

#include <ompl/base/MotionValidator.h>
#include <ompl/base/PlannerTerminationCondition.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/datastructures/NearestNeighborsLinear.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>

#include <memory>

#include "arm/ompl_quiet.hpp"

namespace vantage {
namespace {

using RealVectorState = ompl::base::RealVectorStateSpace::StateType;

Joints joints_of(const ompl::base::State* state, std::size_t count) {
  const double* values = state->as<RealVectorState>()->values;
  return {values, values + count};
}

class JointMotions final : public ompl::base::MotionValidator {
 public:
  JointMotions(ompl::base::SpaceInformation* information, const JointSpace& space)
      : MotionValidator(information), space_(space) {}

  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to) const override {
    return space_.admits_motion(joints_of(from, space_.ranges.size()), joints_of(to, space_.ranges.size()));
  }
  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to,
                   std::pair<ompl::base::State*, double>& last_valid) const override {
    last_valid.second = 0.0;
    return checkMotion(from, to);
  }

 private:
  const JointSpace& space_;
};

ompl::base::SpaceInformationPtr information_of(const JointSpace& space, std::uint64_t seed) {
  const auto count = static_cast<unsigned>(space.ranges.size());
  const auto states = std::make_shared<ompl::base::RealVectorStateSpace>(count);
  ompl::base::RealVectorBounds bounds(count);
  for (unsigned i = 0; i < count; ++i) {
    bounds.setLow(i, space.ranges[i].min);
    bounds.setHigh(i, space.ranges[i].max);
  }
  states->setBounds(bounds);
  states->setStateSamplerAllocator(
      [seed](const ompl::base::StateSpace* of) { return std::make_shared<SeededSampler>(of, seed); });
  auto information = std::make_shared<ompl::base::SpaceInformation>(states);
  information->setStateValidityChecker(
      [&space, count](const ompl::base::State* state) { return space.admits(joints_of(state, count)); });
  information->setMotionValidator(std::make_shared<JointMotions>(information.get(), space));
  information->setup();
  return information;
}

}  // namespace

std::optional<std::vector<Joints>> rrt_connect(const JointSpace& space, const Joints& from, const Joints& to,
                                               std::size_t iterations, std::uint64_t seed) {
  const OmplQuiet quiet;
  const ompl::base::SpaceInformationPtr information = information_of(space, seed);
  const auto problem = std::make_shared<ompl::base::ProblemDefinition>(information);
  ompl::base::ScopedState<ompl::base::RealVectorStateSpace> start(information);
  ompl::base::ScopedState<ompl::base::RealVectorStateSpace> goal(information);
  for (unsigned i = 0; i < from.size(); ++i) {
    start[i] = from[i];
    goal[i] = to[i];
  }
  problem->setStartAndGoalStates(start, goal);
  ompl::geometric::RRTConnect planner(information);
  planner.setProblemDefinition(problem);
  constexpr double kStepRad = 0.5;
  planner.setRange(kStepRad);
  // The trees are small, and OMPL's default structure uses an unseeded random generator.
  planner.setNearestNeighbors<ompl::NearestNeighborsLinear>();
  std::size_t asked = 0;
  const ompl::base::PlannerTerminationCondition spent([&asked, iterations] { return asked++ >= iterations; });
  if (planner.solve(spent) != ompl::base::PlannerStatus::EXACT_SOLUTION) {
    return std::nullopt;
  }
  std::vector<Joints> way;
  for (const ompl::base::State* state :
       problem->getSolutionPath()->as<ompl::geometric::PathGeometric>()->getStates()) {
    way.push_back(joints_of(state, from.size()));
  }
  return way;
}

}  // namespace vantage
