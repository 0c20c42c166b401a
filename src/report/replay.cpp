// SPDX-License-Identifier: MIT
#include "report/replay.hpp"

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/frontier/void_cells.hpp>
#include <vantage/geometry/raster_order.hpp>
#include <vantage/report/run_record_reader.hpp>

namespace vantage::detail {
namespace {

using Planes = std::unordered_map<VoxelIndex, BrickPlane>;

// For each direction of kFaceNeighbours, the cells of a brick whose neighbour there is free.
std::array<BrickPlane, 6> faces_of(const OccupancyMap& map, const VoxelIndex& brick, const BrickPlane& cells) {
  std::array<BrickPlane, 6> faces{};
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    for_each_offset(cells[word], word, [&](std::size_t offset) {
      const VoxelIndex cell = Brick::cell_at(brick, offset);
      for (std::size_t direction = 0; direction < faces.size(); ++direction) {
        if (map.at(cell + kFaceNeighbours[direction]) == Occupancy::Free) {
          faces[direction][word] |= std::uint64_t{1} << (offset & 63U);
        }
      }
    });
  }
  return faces;
}

// Bricks whose faces or frontier may have changed.
std::vector<VoxelIndex> touched_by(const std::vector<BrickState>& changes) {
  std::vector<VoxelIndex> touched;
  touched.reserve(7 * changes.size());
  for (const BrickState& change : changes) {
    touched.push_back(change.brick);
    for (const VoxelIndex& step : kFaceNeighbours) {
      touched.push_back(change.brick + step);
    }
  }
  std::sort(touched.begin(), touched.end(), RasterOrder{});
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  return touched;
}

Planes planes_of(const std::vector<VoxelIndex>& cells) {
  Planes planes;
  for (const VoxelIndex& cell : cells) {
    const std::size_t offset = Brick::offset_of(cell);
    planes[Brick::of_cell(cell)][offset >> 6U] |= std::uint64_t{1} << (offset & 63U);
  }
  return planes;
}

// What the replay shows, kept up to date cycle by cycle.
class Follower {
 public:
  explicit Follower(OccupancyMap map) : map_(std::move(map)) {}

  void follow(const RecordedCycle& cycle, std::uint16_t now) {
    apply_changes(cycle, map_);
    for (const VoxelIndex& brick : touched_by(cycle.changes)) {
      const Brick* cells = map_.find_brick(brick);
      surfaces_.set(brick, cells == nullptr ? std::array<BrickPlane, 6>{} : faces_of(map_, brick, cells->occupied),
                    now);
      frontiers_.set(brick, frontier_plane(map_, brick), now);
    }
    if (cycle.planned && (cycle.view.void_cells > 0 || !void_bricks_.empty())) {
      follow_voids(now);
    }
  }
  [[nodiscard]] std::size_t known_cells() const {
    const OccupancyMap::Counts counts = map_.counts();
    return counts.free + counts.occupied;
  }
  void finish(Replay& replay) const {
    replay.surfaces = surfaces_.quads();
    replay.voids = voids_.quads();
    replay.frontiers = frontiers_.stays();
    replay.bounds = map_.bounds();
  }

 private:
  // Void faces are hidden as soon as the cells before them change; only the next plan recounts the voids.
  void follow_voids(std::uint16_t now) {
    const Planes planes = planes_of(void_cells(map_));
    for (const VoxelIndex& brick : std::exchange(void_bricks_, {})) {
      if (planes.find(brick) == planes.end()) {
        voids_.set(brick, {}, now);
      }
    }
    for (const auto& [brick, cells] : planes) {
      voids_.set(brick, faces_of(map_, brick, cells), now);
      void_bricks_.push_back(brick);
    }
  }

  OccupancyMap map_;
  FaceHistory surfaces_;
  FaceHistory voids_;
  PlaneHistory frontiers_;
  std::vector<VoxelIndex> void_bricks_;
};

}  // namespace

Replay replay_of(const std::filesystem::path& record) {
  RunRecordReader reader(record);
  Replay replay;
  replay.sensor = reader.sensor();
  std::optional<Follower> follower;
  while (std::optional<RecordedCycle> cycle = reader.next()) {
    if (replay.cycles.size() + 1 >= kNever) {
      break;
    }
    if (!follower) {
      follower.emplace(reader.new_map());
    }
    follower->follow(*cycle, static_cast<std::uint16_t>(replay.cycles.size() + 1));
    replay.known_cells.push_back(follower->known_cells());
    cycle->changes.clear();
    replay.cycles.push_back(std::move(*cycle));
  }
  if (follower) {
    follower->finish(replay);
  }
  replay.run = reader.run();
  return replay;
}

}  // namespace vantage::detail
