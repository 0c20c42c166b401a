// SPDX-License-Identifier: MIT
// The survey against its definition: every line of sight is walked cell by cell in the map.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <stdexcept>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/view/frontier_survey.hpp>
#include <vantage/view/frontier_surveyor.hpp>

namespace vantage {
namespace {

constexpr std::int32_t kExtent = 11;
constexpr std::size_t kDirections = 48;

struct SurveyedWorld {
  OccupancyMap map;
  FreeFlyer flyer;
  RangeSensor sensor;
  Pose current;
  double furthest_m;  // length of the search rays, metres
  FrontierSurveyOptions options{.sight_directions = kDirections};
  TriedViews tried{sensor};
  bool is_level = false;  // the region is one layer of cells
};

// Random rooms with walls, worn walls and unknown holes.
OccupancyMap random_rooms(std::mt19937& engine, double resolution_m, bool is_level = false) {
  OccupancyMapOptions options{.resolution_m = resolution_m};
  const double edge_m = 0.9 * kExtent * resolution_m;
  if (engine() % 3 == 0) {
    options.region = Box{Eigen::Vector3d::Constant(-edge_m), Eigen::Vector3d::Constant(edge_m)};
  }
  if (is_level) {
    options.region = Box{Eigen::Vector3d(-edge_m, -edge_m, 0.0), Eigen::Vector3d(edge_m, edge_m, resolution_m)};
  }
  OccupancyMap map(options);
  std::uniform_int_distribution<std::int32_t> coordinate(-kExtent, kExtent);
  std::uniform_int_distribution<std::int32_t> edge(3, kExtent);
  const auto box = [&](std::int32_t thin) {
    const VoxelIndex lo{coordinate(engine), coordinate(engine), coordinate(engine)};
    VoxelIndex extent{edge(engine), edge(engine), edge(engine)};
    (thin == 0 ? extent.x : thin == 1 ? extent.y : thin == 2 ? extent.z : extent.x) = thin < 3 ? 1 : extent.x;
    return VoxelBox{lo, lo + extent};
  };
  map.set_log_odds(VoxelBox{{-4, -4, -4}, {5, 5, 5}}, -2.0);
  for (int i = 0; i < 14; ++i) {
    map.set_log_odds(box(3), -2.0);
  }
  for (int i = 0; i < 14; ++i) {
    map.set_log_odds(box(i % 3), i % 7 == 0 ? 0.85 - 3 * 0.4 : 3.0);
  }
  for (int i = 0; i < 6; ++i) {
    for_each_cell(box(i % 3), [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Unknown); });
  }
  map.set_log_odds(VoxelBox{{-2, -2, -2}, {3, 3, 3}}, -2.0);  // at the sensor
  return map;
}

SurveyedWorld random_world(std::mt19937& engine, bool is_level = false) {
  const double resolution_m = engine() % 2 == 0 ? 0.1 : 0.05;
  const double far_m = (engine() % 4 == 0 ? 1000.0 : static_cast<double>(5 + engine() % 30)) * resolution_m;
  const double min_m = 2.0 * resolution_m;
  RangeSensor sensor =
      engine() % 2 == 0
          ? RangeSensor::spherical(90, 60, 1.2, !is_level && engine() % 2 == 0 ? 0.3 : 1.0, min_m, far_m)
          : RangeSensor::spherical(36, 18, 2.0 * std::numbers::pi, std::numbers::pi, min_m, far_m);
  sensor.reports_no_return = true;
  const OccupancyMap map = random_rooms(engine, resolution_m, is_level);
  const double across_m = map.frame().box_of(map.bounds()).extent().norm() + resolution_m;
  const double radius_m = (engine() % 2 == 0 || is_level ? 0.4 : 1.6) * resolution_m;
  SurveyedWorld world{map, FreeFlyer({.radius_m = radius_m, .margin_m = 0.0, .yaw_only = engine() % 3 == 0}), sensor,
                      pose_looking(Eigen::Vector3d::Constant(0.5 * resolution_m), 0.0), std::min(far_m, across_m)};
  world.is_level = is_level;
  return world;
}

// All around, or level.
std::vector<Eigen::Vector3d> directions(std::size_t count, bool level) {
  std::vector<Eigen::Vector3d> all;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = level ? 0.0 : 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(count);
    const double angle = std::numbers::pi * (3.0 - std::sqrt(5.0)) * static_cast<double>(i);
    all.emplace_back(std::sqrt(1.0 - z * z) * std::cos(angle), std::sqrt(1.0 - z * z) * std::sin(angle), z);
  }
  return all;
}

bool serves(const SurveyedWorld& world, const VoxelIndex& viewpoint, const VoxelIndex& unknown) {
  const Eigen::Vector3d from = world.map.frame().centre_of(viewpoint);
  const Eigen::Vector3d line = world.map.frame().centre_of(unknown) - from;
  std::uint64_t operations = 0;
  return line.norm() >= world.sensor.min_range_m && line.norm() <= world.sensor.max_range_m &&
         in_plain_sight(world.map, from, unknown, operations) && !world.tried.tried_from(unknown, viewpoint) &&
         !world.tried.rests(viewpoint) &&
         (world.flyer.can_tilt() || world.sensor.in_view(world.flyer.facing(from, line).linear().transpose() * line));
}

std::optional<VoxelIndex> along(const SurveyedWorld& world, const ReachableSpace& reachable,
                                const VoxelIndex& unknown, const Eigen::Vector3d& direction) {
  const VoxelFrame& frame = world.map.frame();
  const Eigen::Vector3d centre = frame.centre_of(unknown);
  for (const VoxelIndex& cell : VoxelRay(frame, centre, centre + world.furthest_m * direction)) {
    if (cell != unknown && world.map.at(cell) != Occupancy::Free) {
      return std::nullopt;
    }
    if (cell != unknown && reachable.contains(cell) && serves(world, cell, unknown)) {
      return cell;
    }
  }
  return std::nullopt;
}

// The target of a frontier cell by definition: the first unknown neighbour that is seen along its first direction.
std::optional<FrontierTarget> target_of(const SurveyedWorld& world, const ReachableSpace& reachable,
                                        const VoxelIndex& frontier) {
  const std::vector<Eigen::Vector3d> all_around = directions(kDirections, world.is_level);
  for (const VoxelIndex& step : kFaceNeighbours) {
    const VoxelIndex unknown = frontier + step;
    if (!world.map.in_region(unknown) || world.map.at(unknown) != Occupancy::Unknown ||
        world.tried.gave_up(unknown)) {
      continue;
    }
    if (const auto straight = along(world, reachable, unknown, Eigen::Vector3d(-step.x, -step.y, -step.z))) {
      return FrontierTarget{frontier, unknown, *straight};
    }
    for (const Eigen::Vector3d& direction : all_around) {
      if (const auto viewpoint = along(world, reachable, unknown, direction)) {
        return FrontierTarget{frontier, unknown, *viewpoint};
      }
    }
  }
  return std::nullopt;
}

// Whether a line from `viewpoint` to the centre of a face of `unknown`, a hair inside, is clear.
bool sees_a_face(const SurveyedWorld& world, const VoxelIndex& viewpoint, const VoxelIndex& unknown) {
  const VoxelFrame& frame = world.map.frame();
  const Eigen::Vector3d from = frame.centre_of(viewpoint);
  const Eigen::Vector3d line = frame.centre_of(unknown) - from;
  const auto is_clear_to = [&](const VoxelIndex& step) {
    const Eigen::Vector3d out(step.x, step.y, step.z);
    if (out.dot(line) >= 0.0) {
      return false;  // the face looks away
    }
    for (const VoxelIndex& cell : VoxelRay(frame, from, frame.centre_of(unknown) + 0.49 * frame.size_m * out)) {
      if (cell != unknown && world.map.at(cell) != Occupancy::Free) {
        return false;
      }
    }
    return true;
  };
  return line.norm() >= world.sensor.min_range_m && line.norm() <= world.sensor.max_range_m &&
         !world.tried.tried_from(unknown, viewpoint) && !world.tried.rests(viewpoint) &&
         (world.flyer.can_tilt() ||
          world.sensor.in_view(world.flyer.facing(from, line).linear().transpose() * line)) &&
         std::any_of(kFaceNeighbours.begin(), kFaceNeighbours.end(), is_clear_to);
}

// The target of a frontier cell that has none by `target_of`: along the first direction from it, a place that sees an
// unknown neighbour, if only in part.
std::optional<FrontierTarget> part_target_of(const SurveyedWorld& world, const ReachableSpace& reachable,
                                             const VoxelIndex& frontier) {
  const VoxelFrame& frame = world.map.frame();
  const Eigen::Vector3d centre = frame.centre_of(frontier);
  for (const Eigen::Vector3d& direction : directions(kDirections, world.is_level)) {
    for (const VoxelIndex& cell : VoxelRay(frame, centre, centre + world.furthest_m * direction)) {
      if (cell == frontier) {
        continue;
      }
      if (world.map.at(cell) != Occupancy::Free) {
        break;
      }
      for (const VoxelIndex& step : kFaceNeighbours) {
        const VoxelIndex unknown = frontier + step;
        if (reachable.contains(cell) && world.map.in_region(unknown) && world.map.at(unknown) == Occupancy::Unknown &&
            !world.tried.gave_up(unknown) && (serves(world, cell, unknown) || sees_a_face(world, cell, unknown))) {
          return FrontierTarget{frontier, unknown, cell};
        }
      }
    }
  }
  return std::nullopt;
}

// Whether a reachable cell lies within half the body plus one cell.
bool body_comes_near(const SurveyedWorld& world, const ReachableSpace& reachable, const VoxelIndex& cell) {
  const double half_m = 0.5 * world.flyer.body_box(Pose::Identity()).extent().maxCoeff();
  const auto cells = static_cast<std::int32_t>(std::ceil(half_m / world.map.resolution_m())) + 1;
  bool near = false;
  for_each_cell(VoxelBox{cell, cell + VoxelIndex{1, 1, 1}}.grown(cells),
                [&](const VoxelIndex& other) { near = near || reachable.contains(other); });
  return near;
}

// Marks views from some of the found viewpoints as in vain for all cells that they should see, some of them twice.
// Some places are marked as failed.
void look_in_vain(SurveyedWorld& world, const FrontierSurvey& survey) {
  std::map<VoxelIndex, std::vector<VoxelIndex>> sought;
  for (const FrontierTarget& target : survey.targets) {
    sought[target.viewpoint].push_back(target.unknown);
  }
  world.tried.review(world.map, world.current);
  std::size_t number = 0;
  for (const auto& [viewpoint, cells] : sought) {
    if (++number % (1 + sought.size() / 20) != 0) {
      continue;
    }
    for (const VoxelIndex& from : {viewpoint, sought.begin()->first}) {
      for (const VoxelIndex& cell : cells) {
        world.tried.in_vain(world.map, cell, from);
      }
    }
    const Pose goal = pose_looking(world.map.frame().centre_of(viewpoint), 0.0);
    EXPECT_TRUE(world.tried.expect(world.map, {world.current, goal}, cells));
    world.tried.report(number % 8 == 0 ? GoalResult::Failed : GoalResult::Reached);
    world.map.confirm();
    world.tried.review(world.map, goal);
  }
}

// Whether an unknown neighbour was given up.
bool was_given_up(const SurveyedWorld& world, const VoxelIndex& frontier) {
  return std::any_of(kFaceNeighbours.begin(), kFaceNeighbours.end(), [&](const VoxelIndex& step) {
    const VoxelIndex unknown = frontier + step;
    return world.map.in_region(unknown) && world.map.at(unknown) == Occupancy::Unknown &&
           world.tried.gave_up(unknown);
  });
}

TEST(FrontierSurvey, FindsWhatLookingAlongEveryLineFinds) {
  std::mt19937 engine(83);
  std::size_t compared = 0;
  std::size_t targets = 0;
  std::size_t hidden = 0;
  std::size_t given_up = 0;
  std::size_t resting = 0;
  std::size_t in_part = 0;
  std::size_t level_targets = 0;
  std::size_t level_in_part = 0;
  for (int i = 0; i < 100; ++i) {  // the last 60 are level
    SurveyedWorld world = random_world(engine, i >= 40);
    const auto survey_of = [&] {
      return survey_frontiers(world.map, world.flyer, world.sensor, world.current, world.options, world.tried);
    };
    if (i % 2 == 1) {
      look_in_vain(world, survey_of());
      resting += world.tried.any_rests() ? 1U : 0U;
    }
    const FrontierSurvey survey = survey_of();
    const ReachableSpace reachable(world.map, world.flyer, world.current);
    std::vector<FrontierTarget> expected;
    Leftover leftover;
    for (const VoxelIndex& cell : frontier_cells(world.map)) {
      if (const auto target = target_of(world, reachable, cell)) {
        expected.push_back(*target);
      } else if (const auto part =
                     world.sensor.looks_all_around() ? part_target_of(world, reachable, cell) : std::nullopt) {
        expected.push_back(*part);
        ++(world.is_level ? level_in_part : in_part);
      } else {
        ++(was_given_up(world, cell)                 ? leftover.in_vain
           : body_comes_near(world, reachable, cell) ? leftover.unobservable
                                                     : leftover.unreachable);
      }
    }
    if (expected.empty()) {
      continue;  // in this case, the survey tests every place
    }
    ASSERT_EQ(survey.targets.size(), expected.size()) << "world " << i;
    for (std::size_t k = 0; k < expected.size(); ++k) {
      ASSERT_EQ(survey.targets[k].frontier, expected[k].frontier) << "world " << i;
      ASSERT_EQ(survey.targets[k].unknown, expected[k].unknown) << "world " << i;
      ASSERT_EQ(survey.targets[k].viewpoint, expected[k].viewpoint) << "world " << i;
    }
    EXPECT_EQ(survey.leftover, leftover) << "world " << i;
    if (world.is_level) {
      level_targets += expected.size();
      continue;
    }
    ++compared;
    targets += expected.size();
    hidden += leftover.unobservable + leftover.unreachable;
    given_up += leftover.in_vain;
  }
  EXPECT_GE(compared, 38U);
  EXPECT_GT(targets, 30'000U);
  EXPECT_GT(hidden, 30'000U);
  EXPECT_GT(given_up, 100U);
  EXPECT_GT(resting, 10U);
  EXPECT_GT(in_part, 100U);
  EXPECT_GT(level_targets, 1'000U);
  EXPECT_GT(level_in_part, 20U);
}

// Whether any place sees the centre of one of the unknown cells that are left, by a line to every one of them.
bool any_place_sees_any_cell(const SurveyedWorld& world, const std::vector<VoxelIndex>& places) {
  const std::vector<VoxelIndex> frontier = frontier_cells(world.map);
  return std::any_of(frontier.begin(), frontier.end(), [&](const VoxelIndex& cell) {
    return std::any_of(kFaceNeighbours.begin(), kFaceNeighbours.end(), [&](const VoxelIndex& step) {
      const VoxelIndex unknown = cell + step;
      return world.map.in_region(unknown) && world.map.at(unknown) == Occupancy::Unknown &&
             !world.tried.gave_up(unknown) && std::any_of(places.begin(), places.end(), [&](const VoxelIndex& place) {
               return serves(world, place, unknown);
             });
    });
  });
}

TEST(FrontierSurvey, EndsOnlyWhenNoPlaceSeesACell) {
  std::mt19937 engine(97);
  std::size_t missed_by_directions = 0;
  std::size_t ended = 0;
  for (int i = 0; i < 16; ++i) {
    SurveyedWorld world = random_world(engine, i % 4 == 0);
    const ReachableSpace reachable(world.map, world.flyer, world.current);
    const std::vector<VoxelIndex> places = reachable.cells();
    world.tried.review(world.map, world.current);
    for (int round = 0; round < 20; ++round) {  // gives up all that is found, until nothing is
      const FrontierSurvey survey =
          survey_frontiers(world.map, world.flyer, world.sensor, world.current, world.options, world.tried);
      EXPECT_TRUE(survey.exhausted);
      if (survey.targets.empty()) {
        EXPECT_FALSE(any_place_sees_any_cell(world, places)) << "world " << i;
        ++ended;
        break;
      }
      for (const FrontierTarget& target : survey.targets) {
        const bool is_seen =
            serves(world, target.viewpoint, target.unknown) || sees_a_face(world, target.viewpoint, target.unknown);
        missed_by_directions += is_seen && !target_of(world, reachable, target.frontier) &&
                                        !part_target_of(world, reachable, target.frontier)
                                    ? 1U
                                    : 0U;
      }
      for (const FrontierTarget& target : survey.targets) {
        world.tried.in_vain(world.map, target.unknown, target.unknown + VoxelIndex{900, 0, 0});
        world.tried.in_vain(world.map, target.unknown, target.unknown - VoxelIndex{900, 0, 0});
      }
    }
  }
  EXPECT_GT(ended, 12U);
  EXPECT_GT(missed_by_directions, 20U);
}

TEST(FrontierSurvey, TakesCellsSeenInPart) {
  std::mt19937 engine(89);
  std::size_t seen_in_part = 0;
  std::size_t ended = 0;
  for (int i = 0; i < 40; ++i) {
    SurveyedWorld world = random_world(engine);
    world.map.set_log_odds(VoxelBox{{-3, -3, -3}, {4, 4, 4}}, 3.0);  // bars around the sensor
    world.map.set_log_odds(VoxelBox{{-2, -2, -2}, {3, 3, 3}}, -2.0);
    for_each_cell(VoxelBox{{-3, -3, -3}, {4, 4, 4}}, [&](const VoxelIndex& cell) {
      if (engine() % 40 == 0) {
        world.map.set(cell, Occupancy::Free);
      }
    });
    const std::vector<VoxelIndex> places = ReachableSpace(world.map, world.flyer, world.current).cells();
    std::vector<VoxelIndex> left;
    world.tried.review(world.map, world.current);
    for (const VoxelIndex& frontier : frontier_cells(world.map)) {
      for (const VoxelIndex& step : kFaceNeighbours) {
        const VoxelIndex unknown = frontier + step;
        if (!world.map.in_region(unknown) || world.map.at(unknown) != Occupancy::Unknown) {
          continue;
        }
        // Few are left, so that the survey can test every place for them.
        if (engine() % 8 != 0 || std::any_of(places.begin(), places.end(), [&](const VoxelIndex& place) {
              return serves(world, place, unknown);
            })) {
          world.tried.in_vain(world.map, unknown, unknown + VoxelIndex{900, 0, 0});
          world.tried.in_vain(world.map, unknown, unknown - VoxelIndex{900, 0, 0});
        } else {
          left.push_back(unknown);
        }
      }
    }
    const bool expected = std::any_of(left.begin(), left.end(), [&](const VoxelIndex& unknown) {
      return !world.tried.gave_up(unknown) && std::any_of(places.begin(), places.end(), [&](const VoxelIndex& place) {
        return sees_a_face(world, place, unknown);
      });
    });
    const FrontierSurvey survey =
        survey_frontiers(world.map, world.flyer, world.sensor, world.current, world.options, world.tried);
    EXPECT_EQ(survey.targets.empty(), !expected) << "world " << i;
    for (const FrontierTarget& target : survey.targets) {
      EXPECT_TRUE(sees_a_face(world, target.viewpoint, target.unknown)) << "world " << i;
    }
    seen_in_part += survey.targets.size();
    ended += survey.targets.empty() ? 1U : 0U;
  }
  EXPECT_GT(seen_in_part, 40U);
  EXPECT_GT(ended, 2U);
}

FrontierSurvey survey_from_nothing(const SurveyedWorld& world) {
  return survey_frontiers(world.map, world.flyer, world.sensor, world.current, world.options, world.tried);
}

// A platform that throws in the n-th call of `facing`.
class FailingFlyer final : public Platform {
 public:
  explicit FailingFlyer(const FreeFlyer& flyer) : flyer_(flyer) {}
  bool admits(const OccupancyMap& map, const Pose& pose) const override { return flyer_.admits(map, pose); }
  bool admits_cell(const OccupancyMap& map, const VoxelIndex& cell) const override {
    return flyer_.admits_cell(map, cell);
  }
  bool admits_motion(const OccupancyMap& map, const Pose& from, const Pose& to) const override {
    return flyer_.admits_motion(map, from, to);
  }
  Pose facing(const Eigen::Vector3d& position_m, const Eigen::Vector3d& direction) const override {
    if (left > 0 && --left == 0) {
      throw std::runtime_error("it cannot face there");
    }
    return flyer_.facing(position_m, direction);
  }
  double distance_m(const Pose& from, const Pose& to) const override { return flyer_.distance_m(from, to); }
  std::optional<std::vector<Pose>> path(const OccupancyMap& map, const Pose& from, const Pose& to) const override {
    return flyer_.path(map, from, to);
  }
  Box body_box(const Pose& pose) const override { return flyer_.body_box(pose); }
  bool can_tilt() const override { return flyer_.can_tilt(); }

  mutable int left = 0;  // calls until it throws; 0: never

 private:
  FreeFlyer flyer_;
};

// Changes boxes of cells to free, occupied, contested or unknown, also in ways that no scan could.
void change_some_cells(OccupancyMap& map, std::mt19937& engine) {
  const std::int32_t furthest = engine() % 8 == 0 ? 2 * kExtent : kExtent;
  std::uniform_int_distribution<std::int32_t> coordinate(-furthest, furthest);
  std::uniform_int_distribution<std::int32_t> edge(1, 5);
  const VoxelIndex lo{coordinate(engine), coordinate(engine), coordinate(engine)};
  const VoxelBox box{lo, lo + VoxelIndex{edge(engine), edge(engine), edge(engine)}};
  switch (engine() % 5) {
    case 0:
      map.set_log_odds(box, 3.0);
      break;
    case 1:
      map.set_log_odds(box, 0.85 - 3 * 0.4);
      break;
    case 2:
      for_each_cell(box, [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Unknown); });
      break;
    default:
      map.set_log_odds(box, -2.0);
  }
  map.set_log_odds(VoxelBox{{-1, -1, -1}, {2, 2, 2}}, -2.0);  // at the sensor
}

// Encloses the sensor with walls or removes them, so that distant cells become reachable or unreachable without a
// change near them.
void wall_in(OccupancyMap& map, bool closed) {
  map.set_log_odds(VoxelBox{{-3, -3, -3}, {4, 4, 4}}, closed ? 3.0 : -2.0);
  map.set_log_odds(VoxelBox{{-2, -2, -2}, {3, 3, 3}}, -2.0);
}

// The host reports that the robot could not reach the viewpoints of some targets, which then rest.
void fail_to_reach(SurveyedWorld& world, const FrontierSurvey& survey) {
  for (std::size_t i = 0; i < survey.targets.size(); i += 1 + survey.targets.size() / 4) {
    const FrontierTarget& target = survey.targets[i];
    Pose goal = Pose::Identity();
    goal.translation() = world.map.frame().centre_of(target.viewpoint);
    (void)world.tried.expect(world.map, {world.current, goal}, {target.unknown});
    world.tried.report(GoalResult::Failed);
    (void)world.tried.review(world.map, world.current);
  }
}

void expect_equal(const FrontierSurvey& survey, const FrontierSurvey& expected) {
  EXPECT_EQ(survey.frontier_cells, expected.frontier_cells);
  EXPECT_EQ(survey.exhausted, expected.exhausted);
  EXPECT_EQ(survey.leftover, expected.leftover);
  ASSERT_EQ(survey.targets.size(), expected.targets.size());
  for (std::size_t i = 0; i < expected.targets.size(); ++i) {
    ASSERT_EQ(survey.targets[i].frontier, expected.targets[i].frontier);
    ASSERT_EQ(survey.targets[i].unknown, expected.targets[i].unknown);
    ASSERT_EQ(survey.targets[i].viewpoint, expected.targets[i].viewpoint);
  }
}

TEST(FrontierSurveyor, SurveysAChangingMapAsIfItHadNeverSeenIt) {
  std::mt19937 engine(89);
  std::size_t compared = 0;
  std::size_t targets = 0;
  std::size_t failed = 0;
  std::size_t rested = 0;
  std::size_t thrown = 0;
  std::uint64_t operations = 0;
  std::uint64_t operations_from_nothing = 0;
  for (int i = 0; i < 12; ++i) {
    SurveyedWorld world = random_world(engine);
    while (world.flyer.can_tilt() != (i % 3 != 0)) {
      world = random_world(engine);
    }
    world.sensor.reports_no_return = i % 2 == 0;
    const auto flyer = std::make_shared<FailingFlyer>(world.flyer);
    FrontierSurveyor surveyor(flyer, world.sensor, world.options);
    OccupancyMap elsewhere = random_rooms(engine, world.map.resolution_m());
    for (int step = 0; step < 18; ++step) {
      change_some_cells(world.map, engine);
      if (step % 6 == 2 || step % 6 == 4) {
        wall_in(world.map, step % 6 == 2);
      }
      if (step % 8 == 3) {
        look_in_vain(world, survey_from_nothing(world));
        failed += world.tried.size();
      }
      if (step % 4 == 1) {
        fail_to_reach(world, survey_from_nothing(world));
        rested += world.tried.resting().size();
      }
      if (step % 8 == 5) {
        world.tried = TriedViews(world.sensor);
      }
      if (step % 8 == 7) {
        std::swap(world.map, elsewhere);
      }
      if (step % 6 == 5) {
        flyer->left = 20;
        try {
          (void)surveyor.survey(world.map, world.current, world.tried, frontier_cells(world.map));
        } catch (const std::runtime_error&) {
          ++thrown;
        }
        flyer->left = 0;
      }
      const auto compare = [&] {
        const FrontierSurvey survey =
            surveyor.survey(world.map, world.current, world.tried, frontier_cells(world.map));
        const FrontierSurvey expected = survey_from_nothing(world);
        ASSERT_NO_FATAL_FAILURE(expect_equal(survey, expected)) << "world " << i << ", step " << step;
        EXPECT_EQ(surveyor.reachable().cells(), ReachableSpace(world.map, *flyer, world.current).cells());
        ++compared;
        targets += expected.targets.size();
        // The memory saves nothing if every place is tested.
        if (!expected.targets.empty()) {
          operations += survey.ray_operations;
          operations_from_nothing += expected.ray_operations;
        }
      };
      ASSERT_NO_FATAL_FAILURE(compare());
      if (step % 6 == 0) {  // evidence comes and goes, and the map does not change
        const TriedViews before = world.tried;
        for (const FrontierTarget& target : survey_from_nothing(world).targets) {
          if (engine() % 4 == 0) {
            world.tried.in_vain(world.map, target.unknown, target.viewpoint);
          }
        }
        ASSERT_NO_FATAL_FAILURE(compare());
        world.tried = before;
        ASSERT_NO_FATAL_FAILURE(compare());
      }
    }
  }
  EXPECT_EQ(compared, 12U * (18U + 2U * 3U));
  EXPECT_GT(targets, 50'000U);
  EXPECT_GT(failed, 300U);
  EXPECT_GT(rested, 50U);
  EXPECT_GT(thrown, 5U);
  EXPECT_GT(operations_from_nothing, 0U);
  EXPECT_LT(3 * operations, 2 * operations_from_nothing);
}

}  // namespace
}  // namespace vantage
