// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vantage/arm/arm.hpp>
#include <vantage/map/known_map.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vector>

#include "arm/clear_space.hpp"

namespace vantage {

// A cache of results of an arm. It never changes a result, and concurrent use is safe.
class Arm::Memory {
 public:
  // The clear space of the current state of a map. Calls `make()` if the map or its revision differs from the last
  // call.
  template <class Make>
  [[nodiscard]] std::shared_ptr<const detail::ClearSpace> clear_space(const OccupancyMap& map, Make&& make) {
    const std::lock_guard lock(mutex_);
    if (space_ == nullptr || !map_.is(map) || revision_ != map.revision()) {
      space_ = nullptr;  // stays null if one of the next lines throws
      map_ = KnownMap(map);
      revision_ = map.revision();
      space_ = std::make_shared<const detail::ClearSpace>(make());
    }
    return space_;
  }

  // Holds the lock for a series of queries.
  class Asking {
   public:
    Asking(Memory& memory, const detail::ClearSpace& space, std::size_t postures)
        : memory_(memory), lock_(memory.mutex_), space_(space) {
      const VoxelBox& box = space.rings().box();
      if (memory.refuting_.size() != postures || memory.cell_m_ != space.frame().size_m || memory.box_ != box) {
        memory.refuting_.assign(postures, kNone);
        memory.cell_m_ = space.frame().size_m;
        memory.box_ = box;
      }
    }
    // Whether any of these postures is free of collisions. `obstacle(posture)` returns a cell that the posture must
    // not touch. It is called again only after that cell has become clear, because a posture touches the same cells
    // in every map.
    template <class Obstacle>
    [[nodiscard]] bool any_admitted(std::span<const std::uint32_t> postures, Obstacle&& obstacle) {
      return std::any_of(postures.begin(), postures.end(), [&](std::uint32_t posture) {
        std::size_t& refuting = memory_.refuting_[posture];
        if (refuting != kNone && space_.rings().values()[refuting] == 0) {
          return false;
        }
        const std::optional<VoxelIndex> found = obstacle(posture);
        refuting = found && space_.rings().contains(*found) ? space_.rings().offset_of(*found) : kNone;
        return !found;
      });
    }

   private:
    Memory& memory_;
    std::lock_guard<std::mutex> lock_;
    const detail::ClearSpace& space_;
  };

 private:
  static constexpr auto kNone = static_cast<std::size_t>(-1);

  std::mutex mutex_;
  KnownMap map_;
  OccupancyMap::Revision revision_ = 0;
  std::shared_ptr<const detail::ClearSpace> space_;
  double cell_m_ = 0.0;  // grid for which the following cells are valid
  VoxelBox box_;
  std::vector<std::size_t> refuting_;  // per posture: the obstacle found last
};

}  // namespace vantage
