// SPDX-License-Identifier: MIT
#include "support/qhull.hpp"

extern "C" {
#include <libqhull_r/libqhull_r.h>
}

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>

#include <vantage/geometry/impl/plane_distance.hpp>

namespace vantage::test {
namespace {

Eigen::Vector3d point_of(const VoxelIndex& cell) { return {1.0 * cell.x, 1.0 * cell.y, 1.0 * cell.z}; }

// Whether all cells lie in one plane. Tested before Qhull runs, because it takes this as an error.
bool flat(std::span<const VoxelIndex> cells) {
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const VoxelIndex& cell : cells) {
    const Eigen::Vector3d from_first = point_of(cell) - point_of(cells.front());
    spread += from_first * from_first.transpose();
  }
  return Eigen::FullPivLU<Eigen::Matrix3d>(spread).rank() < 3;
}

struct FreeQhull {
  void operator()(qhT* qhull) const {
    qh_freeqhull(qhull, qh_ALL);
    int current = 0;
    int total = 0;
    qh_memfreeshort(qhull, &current, &total);
    delete qhull;
  }
};

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

}  // namespace

QhullHull::QhullHull(std::span<const VoxelIndex> cells) {
  if (cells.size() < 4 || flat(cells)) {
    return;
  }
  // Coordinates relative to the first cell: far from the origin, the offsets of the planes would lose digits.
  const Eigen::Vector3d origin = point_of(cells.front());
  std::vector<coordT> coordinates;
  for (const VoxelIndex& cell : cells) {
    const Eigen::Vector3d local = point_of(cell) - origin;
    coordinates.insert(coordinates.end(), local.data(), local.data() + 3);
  }
  const std::unique_ptr<std::FILE, CloseFile> messages(std::tmpfile());
  const std::unique_ptr<qhT, FreeQhull> qhull(new qhT{});
  qh_zero(qhull.get(), messages.get());
  std::string command = "qhull";
  const int error = qh_new_qhull(qhull.get(), 3, static_cast<int>(cells.size()), coordinates.data(), False,
                                 command.data(), nullptr, messages.get());
  if (error != 0) {
    throw std::runtime_error("Qhull gave up with error " + std::to_string(error));
  }
  for (const facetT* facet = qhull->facet_list; facet != nullptr && facet->next != nullptr; facet = facet->next) {
    const Eigen::Vector3d normal(facet->normal[0], facet->normal[1], facet->normal[2]);
    planes_.push_back({normal, facet->offset - normal.dot(origin)});
  }
  for (const vertexT* vertex = qhull->vertex_list; vertex != nullptr && vertex->next != nullptr;
       vertex = vertex->next) {
    corners_.push_back(cells[static_cast<std::size_t>(qh_pointid(qhull.get(), vertex->point))]);
  }
}

bool QhullHull::contains(const VoxelIndex& cell, double tolerance) const {
  return !empty() && std::all_of(planes_.begin(), planes_.end(), [&](const HullPlane& plane) {
    return detail::distance_from(plane, point_of(cell)) <= tolerance;
  });
}

QhullHull qhull_of_occupied(const OccupancyMap& map) {
  std::vector<VoxelIndex> cells;
  map.for_each_known([&](const VoxelIndex& cell, Occupancy state) {
    if (state == Occupancy::Occupied) {
      cells.push_back(cell);
    }
  });
  return QhullHull(cells);
}

}  // namespace vantage::test
