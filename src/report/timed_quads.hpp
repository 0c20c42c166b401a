// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "report/plane_history.hpp"

namespace vantage::detail {

/// A rectangle of cell faces that look the same way, lie in one plane and have the same times.
struct TimedQuad {
  VoxelIndex cell;           ///< the lowest cell of the rectangle
  std::uint16_t width = 1;   ///< in cells: along y for faces towards +-x, along x for the others
  std::uint16_t height = 1;  ///< in cells: along y for faces towards +-z, along z for the others
  std::uint16_t birth = 0;   ///< view after which it appears
  std::uint16_t death = kNever;
};

/// Merges faces that all look along `direction` (as in kFaceNeighbours) into rectangles that cover each face
/// exactly once.
[[nodiscard]] std::vector<TimedQuad> merged(const std::vector<TimedCell>& faces, std::size_t direction);

/// The history of the faces between cells of one kind and free cells.
class FaceHistory {
 public:
  /// Sets the faces of a brick after view `now`; `faces[i]` look towards direction i of kFaceNeighbours.
  void set(const VoxelIndex& brick, const std::array<BrickPlane, 6>& faces, std::uint16_t now);
  /// All rectangles, by direction.
  [[nodiscard]] std::array<std::vector<TimedQuad>, 6> quads() const;

 private:
  std::array<PlaneHistory, 6> directions_;
};

}  // namespace vantage::detail
