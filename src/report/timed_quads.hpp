// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "report/plane_history.hpp"

namespace vantage::detail {

/// Faces of cells that look the same way, lie in one plane and share their times: a rectangle of them.
struct TimedQuad {
  VoxelIndex cell;           ///< its lowest cell
  std::uint16_t width = 1;   ///< cells along y for faces towards +-x, along x for the others
  std::uint16_t height = 1;  ///< cells along z, for faces towards +-z along y
  std::uint16_t birth = 0;   ///< the view after which it was first seen
  std::uint16_t death = kNever;
};

/// Rectangles that cover each of `faces`, which all look along `direction` (as in kFaceNeighbours), exactly once.
[[nodiscard]] std::vector<TimedQuad> merged(const std::vector<TimedCell>& faces, std::size_t direction);

/// The faces between cells of one kind and free cells, over time.
class FaceHistory {
 public:
  /// The faces towards direction `i` of kFaceNeighbours of a brick are `faces[i]` after view `now`.
  void set(const VoxelIndex& brick, const std::array<BrickPlane, 6>& faces, std::uint16_t now);
  /// By direction.
  [[nodiscard]] std::array<std::vector<TimedQuad>, 6> quads() const;

 private:
  std::array<PlaneHistory, 6> directions_;
};

}  // namespace vantage::detail
