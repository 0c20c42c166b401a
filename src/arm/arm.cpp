// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vantage/arm/arm.hpp>

#include <vantage/settings/impl/option_rule.hpp>
#include "arm/arm_memory.hpp"
#include "arm/clear_space.hpp"
#include "arm/postures.hpp"
#include "arm/rrt_connect.hpp"
#include "arm/segment_distance.hpp"

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

// The number of steps such that no joint moves more than `step_rad` per step.
int steps_of(const Joints& from, const Joints& to, double step_rad) {
  double most = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    most = std::max(most, std::abs(to[i] - from[i]));
  }
  return std::max(1, static_cast<int>(std::ceil(most / step_rad)));
}

// Shortcuts a path: skips every corner that a straight motion can bypass, trying the furthest corner first.
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
      postures_(std::make_shared<const Postures>(chain, options.capability)),
      memory_(std::make_shared<Memory>()) {}

const CapabilityMap& Arm::capability() const { return postures_->capability(); }

Pose Arm::sensor_pose(std::span<const double> joints) const {
  return options_.world_from_base * chain_.sensor_pose(joints);
}

// --- the body

// A cell that the body touches although it is not clear. Assumes that the body does not touch itself.
std::optional<VoxelIndex> Arm::obstacle(const detail::ClearSpace& space, std::span<const Capsule> body) const {
  // From the sensor inwards, because the outer parts collide most often.
  for (auto capsule = body.rbegin(); capsule != body.rend(); ++capsule) {
    if (chain_.joints_before(capsule->link) == 0) {
      continue;
    }
    const auto found =
        space.obstacle(options_.world_from_base * capsule->from_m, options_.world_from_base * capsule->to_m,
                       capsule->radius_m + options_.margin_m);
    if (found) {
      return found;
    }
  }
  return std::nullopt;
}

bool Arm::keeps_to(const detail::ClearSpace& space, std::span<const double> joints) const {
  const std::vector<Capsule> body = chain_.body_at(joints);
  return !chain_.touches_itself(body) && !obstacle(space, body);
}

bool Arm::moves_in(const detail::ClearSpace& space, const Joints& from, const Joints& to) const {
  const int steps = steps_of(from, to, options_.joint_step_rad);
  for (int step = steps; step > 0; --step) {
    if (!keeps_to(space, between(from, to, static_cast<double>(step) / steps))) {
      return false;
    }
  }
  return true;
}

bool Arm::admits_joints(const OccupancyMap& map, std::span<const double> joints) const {
  return chain_.in_range(joints) && keeps_to(*clear_space(map), joints);
}

// --- poses

std::optional<Joints> Arm::configuration(const Pose& world_from_sensor) const {
  if (!is_rigid(world_from_sensor) || world_from_sensor.translation().norm() > 1e6) {
    return std::nullopt;
  }
  const Pose base_from_sensor = options_.world_from_base.inverse() * world_from_sensor;
  for (const std::uint32_t posture : postures_->near(base_from_sensor, options_.guesses, false)) {
    auto joints = chain_.inverse(base_from_sensor, postures_->joints(posture));
    if (joints && !chain_.touches_itself(chain_.body_at(*joints))) {
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
    if (!joints || chain_.touches_itself(chain_.body_at(*joints))) {
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

// --- paths

bool Arm::admits_motion(const OccupancyMap& map, const Pose& from, const Pose& to) const {
  const std::optional<Joints> first = configuration(from);
  std::optional<Joints> last = first ? configuration(to) : std::nullopt;
  if (first && !last) {
    last = chain_.inverse(options_.world_from_base.inverse() * to, *first, {.free_roll = true});
  }
  if (!last) {
    return false;
  }
  return moves_in(*clear_space_from(map, *first), *first, *last);
}

std::optional<std::vector<Joints>> Arm::joint_path(const OccupancyMap& map, const Pose& from, const Pose& to) const {
  const std::optional<Joints> first = configuration(from);
  const std::optional<Joints> last = first ? configuration(to) : std::nullopt;
  if (!last || !admits_joints(map, *last)) {
    return std::nullopt;
  }
  const std::shared_ptr<const detail::ClearSpace> space = clear_space_from(map, *first);
  const auto admits_straight = [&](const Joints& a, const Joints& b) { return moves_in(*space, a, b); };
  if (admits_straight(*first, *last)) {
    return std::vector<Joints>{*first, *last};
  }
  const JointSpace joint_space{.ranges = chain_.ranges(),
                               .admits = [&](const Joints& joints) { return keeps_to(*space, joints); },
                               .admits_motion = admits_straight};
  const auto way = rrt_connect(joint_space, *first, *last, options_.path_iterations, options_.seed);
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
