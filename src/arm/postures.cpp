// SPDX-License-Identifier: MIT
#include "arm/postures.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace vantage {
namespace {

// Weight of a rotation when start configurations are compared: one radian counts like this many metres.
constexpr float kGuessMetresPerRadian = 0.3F;

}  // namespace

Arm::Postures::Postures(const KinematicChain& chain, const CapabilityMapOptions& options)
    : joint_count_(chain.joint_count()), capability_(draw(chain, options, *this)) {
  sort_by_cell();
}

// Configurations are rounded to single precision first, so that the map matches what is stored.
CapabilityMap Arm::Postures::draw(const KinematicChain& chain, const CapabilityMapOptions& options, Postures& into) {
  const auto forward = [&](std::span<const double> drawn) -> std::optional<Pose> {
    Joints joints;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      const JointRange& range = chain.ranges()[i];
      joints.push_back(std::clamp(static_cast<double>(static_cast<float>(drawn[i])), range.min, range.max));
    }
    const std::vector<Pose> links = chain.link_poses(joints);
    if (chain.touches_itself(links)) {
      return std::nullopt;
    }
    const Pose& base_from_sensor = links.back();
    for (const double value : joints) {
      into.joints_.push_back(static_cast<float>(value));
    }
    into.positions_.push_back(base_from_sensor.translation().cast<float>());
    into.turns_.push_back(Eigen::Quaterniond(base_from_sensor.linear()).cast<float>());
    return base_from_sensor;
  };
  return {forward, chain.ranges(), options};
}

void Arm::Postures::sort_by_cell() {
  const VoxelGrid<std::uint8_t> cells(capability_.cells());
  std::vector<std::size_t> cell_of(size());
  first_in_cell_.assign(cells.size() + 1, 0);
  for (std::uint32_t posture = 0; posture < size(); ++posture) {
    const VoxelIndex cell = capability_.frame().cell_of(positions_[posture].cast<double>());
    // Rounding to single precision may move it out of the box.
    const VoxelIndex last = cells.box().hi - VoxelIndex{1, 1, 1};
    cell_of[posture] =
        cells.offset_of({std::clamp(cell.x, cells.box().lo.x, last.x), std::clamp(cell.y, cells.box().lo.y, last.y),
                         std::clamp(cell.z, cells.box().lo.z, last.z)});
    ++first_in_cell_[cell_of[posture] + 1];
  }
  std::partial_sum(first_in_cell_.begin(), first_in_cell_.end(), first_in_cell_.begin());
  std::vector<std::uint32_t> next(first_in_cell_.begin(), first_in_cell_.end() - 1);
  sorted_.resize(size());
  for (std::uint32_t posture = 0; posture < size(); ++posture) {
    sorted_[next[cell_of[posture]]++] = posture;
  }
}

Joints Arm::Postures::joints(std::uint32_t posture) const {
  const auto first = joints_.begin() + static_cast<std::ptrdiff_t>(posture * joint_count_);
  return {first, first + static_cast<std::ptrdiff_t>(joint_count_)};
}

Pose Arm::Postures::pose(std::uint32_t posture) const {
  Pose pose = Pose::Identity();
  pose.linear() = turns_[posture].cast<double>().normalized().toRotationMatrix();
  pose.translation() = positions_[posture].cast<double>();
  return pose;
}

std::span<const std::uint32_t> Arm::Postures::in_cell(const VoxelIndex& cell) const {
  const VoxelBox& box = capability_.cells();
  if (!box.contains(cell)) {
    return {};
  }
  const VoxelIndex at = cell - box.lo;
  const VoxelIndex extent = box.extent();
  const auto offset =
      (static_cast<std::size_t>(at.z) * static_cast<std::size_t>(extent.y) + static_cast<std::size_t>(at.y)) *
          static_cast<std::size_t>(extent.x) +
      static_cast<std::size_t>(at.x);
  return std::span(sorted_).subspan(first_in_cell_[offset], first_in_cell_[offset + 1] - first_in_cell_[offset]);
}

std::vector<std::uint32_t> Arm::Postures::near(const Pose& base_from_sensor, std::size_t count,
                                               bool free_roll) const {
  const Eigen::Vector3f position = base_from_sensor.translation().cast<float>();
  const Eigen::Quaternionf turn = Eigen::Quaterniond(base_from_sensor.linear()).cast<float>();
  const Eigen::Vector3f axis = optical_axis(base_from_sensor).cast<float>();
  std::vector<std::pair<float, std::uint32_t>> found;
  const VoxelIndex home = capability_.frame().cell_of(base_from_sensor.translation());
  for_each_cell(VoxelBox{home, home + VoxelIndex{1, 1, 1}}.grown(1), [&](const VoxelIndex& cell) {
    for (const std::uint32_t posture : in_cell(cell)) {
      const float angle =
          free_roll ? std::acos(std::clamp((turns_[posture] * Eigen::Vector3f::UnitZ()).dot(axis), -1.0F, 1.0F))
                    : turns_[posture].angularDistance(turn);
      found.emplace_back((positions_[posture] - position).norm() + kGuessMetresPerRadian * angle, posture);
    }
  });
  const auto kept = static_cast<std::ptrdiff_t>(std::min(count, found.size()));
  std::partial_sort(found.begin(), found.begin() + kept, found.end());
  std::vector<std::uint32_t> nearest;
  for (auto one = found.begin(); one != found.begin() + kept; ++one) {
    nearest.push_back(one->second);
  }
  return nearest;
}

}  // namespace vantage
