// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <vantage/robot/reachable_space.hpp>

namespace vantage {
namespace {

// The nearest admitted cell to which the platform can move, the current one first. Ties are broken by the order of
// the cells.
std::optional<VoxelIndex> nearest_admitted(const OccupancyMap& map, const Platform& platform, const Pose& current,
                                           const AdmittedCells& admitted) {
  const VoxelFrame& frame = map.frame();
  const VoxelIndex home = frame.cell_of(current.translation());
  std::vector<VoxelIndex> candidates;
  // A body pressed against a wall must be able to move away by half its size plus one cell.
  constexpr std::int32_t kMostCells = 16;
  const double half_m = 0.5 * platform.body_box(current).extent().maxCoeff();
  const std::int32_t near = std::clamp(frame.cells_up_to(half_m) + 1, 2, kMostCells);
  for_each_cell(VoxelBox{home, home + VoxelIndex{1, 1, 1}}.grown(near), [&](const VoxelIndex& cell) {
    if (admitted.contains(cell)) {
      candidates.push_back(cell);
    }
  });
  const auto distance_m = [&](const VoxelIndex& cell) {
    return cell == home ? -1.0 : (frame.centre_of(cell) - current.translation()).norm();
  };
  std::stable_sort(candidates.begin(), candidates.end(),
                   [&](const VoxelIndex& a, const VoxelIndex& b) { return distance_m(a) < distance_m(b); });
  for (const VoxelIndex& cell : candidates) {
    Pose there = current;
    there.translation() = frame.centre_of(cell);
    if (platform.admits_motion(map, current, there)) {
      return cell;
    }
  }
  return std::nullopt;
}

// For each offset in a brick and each face: the offset of the neighbour, and whether it lies in the next brick.
struct FaceStep {
  std::uint16_t offset;
  bool leaves;
};
using FaceSteps = std::array<std::array<FaceStep, kFaceNeighbours.size()>, Brick::kCells>;

consteval FaceSteps face_steps() {
  FaceSteps steps{};
  for (std::size_t offset = 0; offset < Brick::kCells; ++offset) {
    for (std::size_t face = 0; face < kFaceNeighbours.size(); ++face) {
      const VoxelIndex cell = Brick::cell_at(offset) + kFaceNeighbours[face];
      steps[offset][face] = {static_cast<std::uint16_t>(Brick::offset_of(cell)),
                             Brick::of_cell(cell) != VoxelIndex{0, 0, 0}};
    }
  }
  return steps;
}
constexpr FaceSteps kFaceSteps = face_steps();

}  // namespace

ReachableSpace::ReachableSpace(const OccupancyMap& map, const Platform& platform, const Pose& current) {
  AdmittedCells admitted;
  admitted.follow(map, platform);
  *this = ReachableSpace(map, platform, current, admitted);
}

ReachableSpace::ReachableSpace(const OccupancyMap& map, const Platform& platform, const Pose& current,
                               const AdmittedCells& admitted)
    : frame_(map.frame()) {
  if (map.frame().addressable(current.translation())) {
    start_ = nearest_admitted(map, platform, current, admitted);
  }
  if (start_) {
    flood(admitted);
  } else if (platform.admits(map, current)) {
    stands_at_m_ = current.translation();
    take(map.frame().cell_of(current.translation()));
  }
}

// Breadth-first search over the faces of cells; neighbours in the order of kFaceNeighbours.
// NOLINTNEXTLINE(readability-function-size): one loop and its table
void ReachableSpace::flood(const AdmittedCells& admitted) {
  constexpr std::uint32_t kUnmet = 0xFFFFFFFFU;  // neighbour brick that was not looked up yet
  constexpr std::uint32_t kNone = kUnmet - 1;    // neighbour brick without an admitted cell
  struct Flooded {
    BrickPlane left;  // admitted, not yet reached
    std::array<std::uint32_t, kFaceNeighbours.size()> beside{};
  };
  std::vector<Flooded> bricks;  // by number
  const auto meet = [&](const VoxelIndex& address) {
    const BrickPlane* cells = admitted.cells().find(address);
    if (cells == nullptr || *cells == BrickPlane{}) {
      return kNone;
    }
    const std::uint32_t number = number_.store(address);
    if (number == bricks.size()) {
      bricks.push_back({*cells, {}});
      bricks.back().beside.fill(kUnmet);
    }
    return number;
  };
  std::vector<std::uint32_t> places;  // of the reached cells: 512 times the number of the brick plus the offset
  const auto reach = [&](std::uint32_t brick, std::size_t offset) {
    number_.values(brick)[offset] = static_cast<std::uint32_t>(cells_.size());
    cells_.push_back(Brick::first_cell(number_.address(brick)) + Brick::cell_at(offset));
    places.push_back(static_cast<std::uint32_t>(brick * Brick::kCells + offset));
  };
  const auto reach_if_left = [&](std::uint32_t brick, std::size_t offset) {
    std::uint64_t& word = bricks[brick].left[offset >> 6U];
    const std::uint64_t bit = std::uint64_t{1} << (offset & 63U);
    if ((word & bit) != 0) {
      word &= ~bit;
      reach(brick, offset);
    }
  };
  reach_if_left(meet(Brick::of_cell(*start_)), Brick::offset_of(*start_));
  for (std::size_t next = 0; next < places.size(); ++next) {
    const auto brick = static_cast<std::uint32_t>(places[next] / Brick::kCells);
    const std::size_t offset = places[next] % Brick::kCells;
    for (std::size_t face = 0; face < kFaceNeighbours.size(); ++face) {
      const FaceStep step = kFaceSteps[offset][face];
      std::uint32_t other = brick;
      if (step.leaves) {
        other = bricks[brick].beside[face];
        if (other == kUnmet) {
          other = meet(number_.address(brick) + kFaceNeighbours[face]);
          bricks[brick].beside[face] = other;
        }
      }
      if (other != kNone) {
        reach_if_left(other, step.offset);
      }
    }
  }
  planes_.reserve(bricks.size());
  for (std::size_t number = 0; number < bricks.size(); ++number) {
    BrickPlane reached = *admitted.cells().find(number_.address(number));
    for (std::size_t word = 0; word < Brick::kWords; ++word) {
      reached[word] &= ~bricks[number].left[word];
    }
    planes_.push_back(reached);
  }
}

bool ReachableSpace::any_in(const VoxelBox& cells) const {
  if (cells.empty()) {
    return false;
  }
  const auto any_of = [&](const VoxelIndex& brick, const BrickPlane& reached) {
    const VoxelIndex first = Brick::first_cell(brick);
    bool found = cells.contains(first) && cells.contains(first + VoxelIndex{7, 7, 7}) && reached != BrickPlane{};
    for (std::size_t word = 0; word < Brick::kWords && !found; ++word) {
      for_each_offset(reached[word], word,
                      [&](std::size_t offset) { found = found || cells.contains(first + Brick::cell_at(offset)); });
    }
    return found;
  };
  const VoxelBox bricks{Brick::of_cell(cells.lo),
                        Brick::of_cell(cells.hi - VoxelIndex{1, 1, 1}) + VoxelIndex{1, 1, 1}};
  const VoxelIndex extent = bricks.extent();
  if (1.0 * extent.x * extent.y * extent.z > static_cast<double>(planes_.size())) {
    for (std::size_t number = 0; number < planes_.size(); ++number) {
      if (any_of(number_.address(number), planes_[number])) {
        return true;
      }
    }
    return false;
  }
  for (std::int32_t z = bricks.lo.z; z < bricks.hi.z; ++z) {
    for (std::int32_t y = bricks.lo.y; y < bricks.hi.y; ++y) {
      for (std::int32_t x = bricks.lo.x; x < bricks.hi.x; ++x) {
        const BrickDirectory::Number number = number_.number_of({x, y, z});
        if (number != BrickDirectory::kNone && any_of({x, y, z}, planes_[number])) {
          return true;
        }
      }
    }
  }
  return false;
}

ReachableSpace::ReachableSpace(const VoxelFrame& frame, const std::vector<VoxelIndex>& cells) : frame_(frame) {
  std::for_each(cells.begin(), cells.end(), [&](const VoxelIndex& cell) { take(cell); });
}

void ReachableSpace::take(const VoxelIndex& cell) {
  const std::uint32_t brick = number_.store(Brick::of_cell(cell));
  const std::size_t offset = Brick::offset_of(cell);
  if (brick == planes_.size()) {
    planes_.emplace_back();
  }
  planes_[brick][offset >> 6U] |= std::uint64_t{1} << (offset & 63U);
  number_.values(brick)[offset] = static_cast<std::uint32_t>(cells_.size());
  start_ = cells_.empty() ? cell : start_;
  cells_.push_back(cell);
}

}  // namespace vantage
