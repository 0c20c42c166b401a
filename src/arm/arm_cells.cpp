// SPDX-License-Identifier: MIT
// Which cells an arm may touch, and where its sensor can be.
#include <algorithm>
#include <memory>
#include <utility>
#include <vantage/arm/arm.hpp>
#include <vector>

#include <vantage/robot/impl/swept_sphere.hpp>
#include "arm/arm_memory.hpp"
#include "arm/clear_space.hpp"
#include "arm/postures.hpp"
#include "arm/segment_distance.hpp"

namespace vantage {

// The cells within reach that are clear or declared clear.
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

std::shared_ptr<const detail::ClearSpace> Arm::clear_space(const OccupancyMap& map) const {
  return memory_->clear_space(map, [&] { return detail::ClearSpace(map.frame(), passable_cells(map)); });
}

// The clear space of the map, plus all cells that the body touches at these joint values. So the arm can leave a
// position where it already touches something.
std::shared_ptr<const detail::ClearSpace> Arm::clear_space_from(const OccupancyMap& map, const Joints& first) const {
  std::shared_ptr<const detail::ClearSpace> space = clear_space(map);
  std::vector<VoxelIndex> touched;
  for (const Capsule& capsule : chain_.body_at(first)) {
    const Eigen::Vector3d from = options_.world_from_base * capsule.from_m;
    const Eigen::Vector3d to = options_.world_from_base * capsule.to_m;
    const double radius_m = capsule.radius_m + options_.margin_m;
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(radius_m);
    const VoxelFrame& frame = map.frame();
    for_each_cell(
        {frame.cell_of(from.cwiseMin(to) - reach), frame.cell_of(from.cwiseMax(to) + reach) + VoxelIndex{1, 1, 1}},
        [&](const VoxelIndex& cell) {
          if (!space->is_clear(cell) && space->rings().contains(cell) &&
              detail::distance_to_segment(frame.box_of(cell), from, to) < radius_m) {
            touched.push_back(cell);
          }
        });
  }
  if (touched.empty()) {
    return space;
  }
  VoxelGrid<std::uint8_t> clear = space->rings();
  for (const VoxelIndex& cell : touched) {
    clear[cell] = 1;
  }
  return std::make_shared<const detail::ClearSpace>(map.frame(), std::move(clear));
}

bool Arm::admits_cell(const OccupancyMap& map, const VoxelIndex& cell) const {
  const Eigen::Vector3d centre = options_.world_from_base.inverse() * map.frame().centre_of(cell);
  const std::shared_ptr<const detail::ClearSpace> space = clear_space(map);
  if (!space->is_clear(cell)) {
    return false;
  }
  Memory::Asking asking(*memory_, *space, postures_->size());
  return asking.any_admitted(postures_->in_cell(capability().frame().cell_of(centre)), [&](std::uint32_t posture) {
    return obstacle(*space, chain_.body_at(postures_->joints(posture)));
  });
}

VoxelGrid<std::uint8_t> Arm::admitted_cells(const OccupancyMap& map, const VoxelBox& box) const {
  const std::shared_ptr<const detail::ClearSpace> space = clear_space(map);
  Memory::Asking asking(*memory_, *space, postures_->size());
  enum class Answer : std::uint8_t { Unasked, Refused, Admitted };
  VoxelGrid<Answer> answers(capability().cells(), Answer::Unasked);
  const auto admitted_in = [&](const VoxelIndex& cell) {
    if (!answers.contains(cell)) {
      return false;
    }
    if (answers[cell] == Answer::Unasked) {
      const bool any = asking.any_admitted(postures_->in_cell(cell), [&](std::uint32_t posture) {
        return obstacle(*space, chain_.body_at(postures_->joints(posture)));
      });
      answers[cell] = any ? Answer::Admitted : Answer::Refused;
    }
    return answers[cell] == Answer::Admitted;
  };
  const Pose base_from_world = options_.world_from_base.inverse();
  VoxelGrid<std::uint8_t> admitted(box);
  for_each_cell(box, [&](const VoxelIndex& cell) {
    if (space->is_clear(cell)) {
      const Eigen::Vector3d centre = base_from_world * map.frame().centre_of(cell);
      admitted[cell] = admitted_in(capability().frame().cell_of(centre)) ? 1 : 0;
    }
  });
  return admitted;
}

std::vector<Pose> Arm::admitted_poses(const OccupancyMap& map) const {
  const std::shared_ptr<const detail::ClearSpace> space = clear_space(map);
  std::vector<Pose> poses;
  for (std::uint32_t posture = 0; posture < postures_->size(); ++posture) {
    if (!obstacle(*space, chain_.body_at(postures_->joints(posture)))) {
      poses.push_back(options_.world_from_base * postures_->pose(posture));
    }
  }
  return poses;
}

}  // namespace vantage
