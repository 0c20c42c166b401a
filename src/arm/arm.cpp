// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vantage/arm/arm.hpp>

#include "arm/postures.hpp"
#include "arm/rrt_connect.hpp"
#include "arm/segment_distance.hpp"
#include "map/option_rule.hpp"
#include "robot/swept_sphere.hpp"

namespace vantage {
namespace {

ArmOptions checked(const ArmOptions& options) {
  const auto above_0 = [](double value) { return std::isfinite(value) && value > 0.0; };
  if (!is_rigid(options.world_from_base)) {
    throw std::invalid_argument("ArmOptions::world_from_base is not a rigid transform");
  }
  detail::require_option(std::isfinite(options.margin_m) && options.margin_m >= 0.0, "ArmOptions::margin_m",
                         options.margin_m, ">= 0");
  detail::require_option(above_0(options.joint_step_rad), "ArmOptions::joint_step_rad", options.joint_step_rad,
                         "> 0");
  detail::require_option(above_0(options.pose_step_rad), "ArmOptions::pose_step_rad", options.pose_step_rad, "> 0");
  detail::require_option(options.path_iterations > 0, "ArmOptions::path_iterations", options.path_iterations, "> 0");
  detail::require_option(options.guesses > 0, "ArmOptions::guesses", options.guesses, "> 0");
  return options;
}

Joints between(const Joints& from, const Joints& to, double share) {
  Joints joints(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    joints[i] = from[i] + share * (to[i] - from[i]);
  }
  return joints;
}

// So many steps of at most `step_rad` in each joint.
int steps_of(const Joints& from, const Joints& to, double step_rad) {
  double most = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    most = std::max(most, std::abs(to[i] - from[i]));
  }
  return std::max(1, static_cast<int>(std::ceil(most / step_rad)));
}

// What is left of a way when every corner goes that a straight motion makes needless, the furthest tried first.
template <class AdmitsMotion>
std::vector<Joints> shortcut(const std::vector<Joints>& way, AdmitsMotion&& admits_motion) {
  std::vector<Joints> kept{way.front()};
  for (std::size_t at = 0; at + 1 < way.size();) {
    std::size_t next = way.size() - 1;
    while (next > at + 1 && !admits_motion(way[at], way[next])) {
      --next;
    }
    kept.push_back(way[next]);
    at = next;
  }
  return kept;
}

}  // namespace

Arm::Arm(const KinematicChain& chain, const ArmOptions& options)
    : chain_(chain),
      options_(checked(options)),
      postures_(std::make_shared<const Postures>(chain, options.capability)) {}

const CapabilityMap& Arm::capability() const { return postures_->capability(); }

Pose Arm::sensor_pose(std::span<const double> joints) const {
  return options_.world_from_base * chain_.sensor_pose(joints);
}

// --- what is clear
// ---------------------------------------------------------------------------------------------------

bool Arm::declared(const Eigen::Vector3d& point_m) const {
  return std::any_of(options_.declared_clear.begin(), options_.declared_clear.end(),
                     [&](const Box& box) { return box.contains(point_m); });
}

bool Arm::passable(const OccupancyMap& map, const VoxelIndex& cell) const {
  return map.is_clear(cell) || (map.at(cell) == Occupancy::Unknown && declared(map.frame().centre_of(cell)));
}

// The same for every cell the arm can touch: a path asks millions of times.
VoxelGrid<std::uint8_t> Arm::passable_cells(const OccupancyMap& map) const {
  const VoxelFrame& frame = map.frame();
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(chain_.reach_m() + options_.margin_m + 2.0 * frame.size_m);
  const Eigen::Vector3d base = options_.world_from_base.translation();
  VoxelGrid<std::uint8_t> clear({frame.cell_of(base - reach), frame.cell_of(base + reach) + VoxelIndex{1, 1, 1}});
  for (const Box& box : options_.declared_clear) {
    const Box near{box.min.cwiseMax(base - reach), box.max.cwiseMin(base + reach)};
    for_each_cell(frame.cells_centred_in(near), [&](const VoxelIndex& cell) {
      if (clear.contains(cell) && map.at(cell) == Occupancy::Unknown) {
        clear[cell] = 1;
      }
    });
  }
  map.for_each_clear([&](const VoxelIndex& cell) {
    if (clear.contains(cell)) {
      clear[cell] = 1;
    }
  });
  return clear;
}

// --- where the body is
// ------------------------------------------------------------------------------------------------

template <class Clear>
bool Arm::keeps_to(const VoxelFrame& frame, std::span<const double> joints, Clear&& clear) const {
  const std::vector<Pose> links = chain_.link_poses(joints);
  if (chain_.touches_itself(links)) {
    return false;
  }
  // From the sensor inwards: what is furthest out collides most.
  return std::all_of(chain_.capsules().rbegin(), chain_.capsules().rend(), [&](const Capsule& capsule) {
    if (chain_.joints_before(capsule.link) == 0) {
      return true;
    }
    const Pose world_from_link = options_.world_from_base * links[capsule.link];
    return detail::swept_sphere_is_clear(frame, world_from_link * capsule.from_m, world_from_link * capsule.to_m,
                                         capsule.radius_m + options_.margin_m, clear);
  });
}

template <class Clear>
bool Arm::moves_in(const VoxelFrame& frame, const Joints& from, const Joints& to, Clear&& clear) const {
  const int steps = steps_of(from, to, options_.joint_step_rad);
  for (int step = steps; step > 0; --step) {
    if (!keeps_to(frame, between(from, to, static_cast<double>(step) / steps), clear)) {
      return false;
    }
  }
  return true;
}

void Arm::clear_touched(const VoxelFrame& frame, const Joints& joints, VoxelGrid<std::uint8_t>& clear) const {
  const std::vector<Pose> links = chain_.link_poses(joints);
  for (const Capsule& capsule : chain_.capsules()) {
    const Pose world_from_link = options_.world_from_base * links[capsule.link];
    const Eigen::Vector3d from = world_from_link * capsule.from_m;
    const Eigen::Vector3d to = world_from_link * capsule.to_m;
    const double radius_m = capsule.radius_m + options_.margin_m;
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(radius_m);
    for_each_cell(
        {frame.cell_of(from.cwiseMin(to) - reach), frame.cell_of(from.cwiseMax(to) + reach) + VoxelIndex{1, 1, 1}},
        [&](const VoxelIndex& cell) {
          if (clear.contains(cell) && clear[cell] == 0 &&
              detail::distance_to_segment(frame.box_of(cell), from, to) < radius_m) {
            clear[cell] = 1;
          }
        });
  }
}

bool Arm::admits_joints(const OccupancyMap& map, std::span<const double> joints) const {
  return chain_.in_range(joints) &&
         keeps_to(map.frame(), joints, [&](const VoxelIndex& cell) { return passable(map, cell); });
}

// --- poses
// ------------------------------------------------------------------------------------------------------------

std::optional<Joints> Arm::configuration(const Pose& world_from_sensor) const {
  if (!is_rigid(world_from_sensor) || world_from_sensor.translation().norm() > 1e6) {
    return std::nullopt;
  }
  const Pose base_from_sensor = options_.world_from_base.inverse() * world_from_sensor;
  for (const std::uint32_t posture : postures_->near(base_from_sensor, options_.guesses, false)) {
    auto joints = chain_.inverse(base_from_sensor, postures_->joints(posture));
    if (joints && !chain_.touches_itself(chain_.link_poses(*joints))) {
      return joints;
    }
  }
  return std::nullopt;
}

bool Arm::admits(const OccupancyMap& map, const Pose& pose) const {
  const std::optional<Joints> joints = configuration(pose);
  return joints && admits_joints(map, *joints);
}

Pose Arm::facing(const Eigen::Vector3d& position_m, const Eigen::Vector3d& direction) const {
  Pose wanted = pose_looking_along(position_m, direction);
  const Pose base_from_wanted = options_.world_from_base.inverse() * wanted;
  const std::vector<std::uint32_t> guesses = postures_->near(base_from_wanted, options_.guesses, true);
  const auto reached = [&](const Pose& target, std::uint32_t posture) -> std::optional<Pose> {
    const auto joints = chain_.inverse(target, postures_->joints(posture), {.free_roll = true});
    if (!joints || chain_.touches_itself(chain_.link_poses(*joints))) {
      return std::nullopt;
    }
    return sensor_pose(*joints);
  };
  for (const std::uint32_t posture : guesses) {
    if (const std::optional<Pose> pose = reached(base_from_wanted, posture)) {
      return *pose;
    }
  }
  for (const std::uint32_t posture : guesses) {
    Pose there = postures_->pose(posture);
    there.translation() = base_from_wanted.translation();
    if (const std::optional<Pose> pose = reached(there, posture)) {
      return *pose;
    }
  }
  return wanted;
}

double Arm::distance_m(const Pose& from, const Pose& to) const {
  return (to.translation() - from.translation()).norm();
}

Box Arm::body_box(const Pose& pose) const {
  double radius_m = 0.0;
  const std::vector<Pose> links = chain_.link_poses(postures_->joints(0));
  for (const Capsule& capsule : chain_.capsules()) {
    if (chain_.joints_before(capsule.link) == chain_.joint_count()) {
      const Eigen::Vector3d sensor = links.back().translation();
      const Pose& link = links[capsule.link];
      radius_m = std::max(
          radius_m, capsule.radius_m - segment_distance(link * capsule.from_m, link * capsule.to_m, sensor, sensor));
    }
  }
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(std::max(radius_m, 1e-9));
  return {pose.translation() - reach, pose.translation() + reach};
}

// --- cells
// ------------------------------------------------------------------------------------------------------------

bool Arm::admits_cell(const OccupancyMap& map, const VoxelIndex& cell) const {
  const Eigen::Vector3d centre = options_.world_from_base.inverse() * map.frame().centre_of(cell);
  if (!passable(map, cell)) {
    return false;
  }
  const auto postures = postures_->in_cell(capability().frame().cell_of(centre));
  const auto is_clear = [&](const VoxelIndex& touched) { return passable(map, touched); };
  return std::any_of(postures.begin(), postures.end(), [&](std::uint32_t posture) {
    return keeps_to(map.frame(), postures_->joints(posture), is_clear);
  });
}

VoxelGrid<std::uint8_t> Arm::admitted_cells(const OccupancyMap& map, const VoxelBox& box) const {
  const VoxelGrid<std::uint8_t> clear = passable_cells(map);
  const auto is_clear = [&](const VoxelIndex& cell) { return clear.value_or(cell, 0) != 0; };
  enum class Answer : std::uint8_t { Unasked, Refused, Admitted };
  VoxelGrid<Answer> answers(capability().cells(), Answer::Unasked);
  const auto admitted_in = [&](const VoxelIndex& cell) {
    if (!answers.contains(cell)) {
      return false;
    }
    if (answers[cell] == Answer::Unasked) {
      const auto postures = postures_->in_cell(cell);
      answers[cell] = std::any_of(postures.begin(), postures.end(),
                                  [&](std::uint32_t posture) {
                                    return keeps_to(map.frame(), postures_->joints(posture), is_clear);
                                  })
                          ? Answer::Admitted
                          : Answer::Refused;
    }
    return answers[cell] == Answer::Admitted;
  };
  const Pose base_from_world = options_.world_from_base.inverse();
  VoxelGrid<std::uint8_t> admitted(box);
  for_each_cell(box, [&](const VoxelIndex& cell) {
    if (is_clear(cell)) {
      const Eigen::Vector3d centre = base_from_world * map.frame().centre_of(cell);
      admitted[cell] = admitted_in(capability().frame().cell_of(centre)) ? 1 : 0;
    }
  });
  return admitted;
}

std::vector<Pose> Arm::admitted_poses(const OccupancyMap& map) const {
  const VoxelGrid<std::uint8_t> clear = passable_cells(map);
  const auto is_clear = [&](const VoxelIndex& cell) { return clear.value_or(cell, 0) != 0; };
  std::vector<Pose> poses;
  for (std::uint32_t posture = 0; posture < postures_->size(); ++posture) {
    if (keeps_to(map.frame(), postures_->joints(posture), is_clear)) {
      poses.push_back(options_.world_from_base * postures_->pose(posture));
    }
  }
  return poses;
}

// --- ways
// -------------------------------------------------------------------------------------------------------------

bool Arm::admits_motion(const OccupancyMap& map, const Pose& from, const Pose& to) const {
  const std::optional<Joints> first = configuration(from);
  std::optional<Joints> last = first ? configuration(to) : std::nullopt;
  if (first && !last) {
    last = chain_.inverse(options_.world_from_base.inverse() * to, *first, {.free_roll = true});
  }
  if (!last) {
    return false;
  }
  VoxelGrid<std::uint8_t> clear = passable_cells(map);
  clear_touched(map.frame(), *first, clear);
  return moves_in(map.frame(), *first, *last, [&](const VoxelIndex& cell) { return clear.value_or(cell, 0) != 0; });
}

std::optional<std::vector<Joints>> Arm::joint_path(const OccupancyMap& map, const Pose& from, const Pose& to) const {
  const std::optional<Joints> first = configuration(from);
  const std::optional<Joints> last = first ? configuration(to) : std::nullopt;
  if (!last || !admits_joints(map, *last)) {
    return std::nullopt;
  }
  const VoxelFrame& frame = map.frame();
  VoxelGrid<std::uint8_t> clear = passable_cells(map);
  clear_touched(frame, *first, clear);
  const auto is_clear = [&](const VoxelIndex& cell) { return clear.value_or(cell, 0) != 0; };
  const auto admits_straight = [&](const Joints& a, const Joints& b) { return moves_in(frame, a, b, is_clear); };
  if (admits_straight(*first, *last)) {
    return std::vector<Joints>{*first, *last};
  }
  const JointSpace space{.ranges = chain_.ranges(),
                         .admits = [&](const Joints& joints) { return keeps_to(frame, joints, is_clear); },
                         .admits_motion = admits_straight};
  const auto way = rrt_connect(space, *first, *last, options_.path_iterations, options_.seed);
  if (!way) {
    return std::nullopt;
  }
  return shortcut(*way, admits_straight);
}

std::optional<std::vector<Pose>> Arm::path(const OccupancyMap& map, const Pose& from, const Pose& to) const {
  const auto way = joint_path(map, from, to);
  if (!way) {
    return std::nullopt;
  }
  std::vector<Pose> poses{from};
  for (std::size_t i = 1; i < way->size(); ++i) {
    const Joints& a = (*way)[i - 1];
    const Joints& b = (*way)[i];
    const int steps = steps_of(a, b, options_.pose_step_rad);
    for (int step = 1; step <= steps; ++step) {
      poses.push_back(sensor_pose(between(a, b, static_cast<double>(step) / steps)));
    }
  }
  poses.back() = to;
  return poses;
}

}  // namespace vantage
