// SPDX-License-Identifier: MIT
#include <vantage/sim/triangle_mesh.hpp>

namespace vantage {
namespace {

VoxelIndex unit(int axis, std::int32_t sign) {
  return {axis == 0 ? sign : 0, axis == 1 ? sign : 0, axis == 2 ? sign : 0};
}

// Builds one face of a solid cell. Along each of its four edges the surface continues flat, turns away at a convex
// edge (the face is shortened by the inset) or turns towards the empty side at a concave one (it is extended by
// the inset), so that the inset surface is closed.
class FaceBuilder {
 public:
  FaceBuilder(const VoxelGrid<std::uint8_t>& solid, const VoxelFrame& frame, double inset_m, bool outside_solid)
      : solid_(solid), frame_(frame), inset_m_(inset_m), outside_solid_(outside_solid) {}

  void add(TriangleMesh& mesh, const VoxelIndex& cell, int axis, std::int32_t sign) const {
    const Box box = frame_.box_of(cell);
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    Eigen::Vector3d corner;
    corner[axis] = sign > 0 ? box.max[axis] - inset_m_ : box.min[axis] + inset_m_;
    const VoxelIndex outward = unit(axis, sign);
    const std::array<double, 2> across{box.min[u] - run_on(cell, outward, unit(u, -1)),
                                       box.max[u] + run_on(cell, outward, unit(u, 1))};
    const std::array<double, 2> along{box.min[v] - run_on(cell, outward, unit(v, -1)),
                                      box.max[v] + run_on(cell, outward, unit(v, 1))};
    const auto at = [&](std::size_t i, std::size_t j) {
      corner[u] = across[i];
      corner[v] = along[j];
      return corner;
    };
    mesh.add_quad(at(0, 0), at(1, 0), at(1, 1), at(0, 1));
  }

  bool is_solid(const VoxelIndex& cell) const { return solid_.contains(cell) ? solid_[cell] != 0 : outside_solid_; }

 private:
  double run_on(const VoxelIndex& cell, const VoxelIndex& outward, const VoxelIndex& tangent) const {
    if (is_solid(cell + tangent + outward)) {
      return inset_m_;
    }
    return is_solid(cell + tangent) ? 0.0 : -inset_m_;
  }

  const VoxelGrid<std::uint8_t>& solid_;
  const VoxelFrame& frame_;
  double inset_m_;
  bool outside_solid_;
};

}  // namespace

Box TriangleMesh::bounds() const {
  Box bounds;
  for (const auto& triangle : triangles) {
    for (const std::uint32_t vertex : triangle) {
      bounds.extend(vertices[vertex].cast<double>());
    }
  }
  return bounds;
}

void TriangleMesh::append(const TriangleMesh& other, const Pose& this_from_other, double scale) {
  const auto first = static_cast<std::uint32_t>(vertices.size());
  vertices.reserve(vertices.size() + other.vertices.size());
  for (const Eigen::Vector3f& vertex : other.vertices) {
    vertices.push_back((this_from_other * (scale * vertex.cast<double>())).cast<float>());
  }
  triangles.reserve(triangles.size() + other.triangles.size());
  for (const auto& triangle : other.triangles) {
    triangles.push_back({triangle[0] + first, triangle[1] + first, triangle[2] + first});
  }
}

void TriangleMesh::add_quad(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                            const Eigen::Vector3d& d) {
  const auto first = static_cast<std::uint32_t>(vertices.size());
  for (const Eigen::Vector3d& corner : {a, b, c, d}) {
    vertices.push_back(corner.cast<float>());
  }
  triangles.push_back({first, first + 1, first + 2});
  triangles.push_back({first, first + 2, first + 3});
}

void TriangleMesh::add_box(const Box& box) {
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    for (const double level : {box.min[axis], box.max[axis]}) {
      const auto at = [&](double across, double along) {
        Eigen::Vector3d corner;
        corner[axis] = level;
        corner[u] = across;
        corner[v] = along;
        return corner;
      };
      add_quad(at(box.min[u], box.min[v]), at(box.max[u], box.min[v]), at(box.max[u], box.max[v]),
               at(box.min[u], box.max[v]));
    }
  }
}

TriangleMesh surface_of_cells(const VoxelGrid<std::uint8_t>& solid, const VoxelFrame& frame, double inset_m,
                              bool outside_solid) {
  TriangleMesh mesh;
  const FaceBuilder faces(solid, frame, inset_m, outside_solid);
  // Solid cells just outside the grid have faces towards it.
  for_each_cell(outside_solid ? solid.box().grown(1) : solid.box(), [&](const VoxelIndex& cell) {
    if (!faces.is_solid(cell)) {
      return;
    }
    for (int axis = 0; axis < 3; ++axis) {
      for (const std::int32_t sign : {-1, 1}) {
        if (!faces.is_solid(cell + unit(axis, sign))) {
          faces.add(mesh, cell, axis, sign);
        }
      }
    }
  });
  return mesh;
}

}  // namespace vantage
