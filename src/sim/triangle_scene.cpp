// SPDX-License-Identifier: MIT
#include <embree3/rtcore.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vantage/sim/triangle_scene.hpp>

namespace vantage {

struct TriangleScene::Embree {
  explicit Embree(TriangleMesh triangles);
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;
  Embree(Embree&&) = delete;
  Embree& operator=(Embree&&) = delete;
  ~Embree() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }

  TriangleMesh mesh;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
};

namespace {

// The nearest point of a triangle, by the Voronoi region that holds the point. (Ericson, Real-Time Collision
// Detection, 5.1.5)
Eigen::Vector3d nearest_on_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                    const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  const double d1 = ab.dot(p - a);
  const double d2 = ac.dot(p - a);
  if (d1 <= 0.0 && d2 <= 0.0) {
    return a;
  }
  const double d3 = ab.dot(p - b);
  const double d4 = ac.dot(p - b);
  if (d3 >= 0.0 && d4 <= d3) {
    return b;
  }
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    return a + d1 / (d1 - d3) * ab;
  }
  const double d5 = ab.dot(p - c);
  const double d6 = ac.dot(p - c);
  if (d6 >= 0.0 && d5 <= d6) {
    return c;
  }
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    return a + d2 / (d2 - d6) * ac;
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  }
  const double sum = va + vb + vc;
  return sum > 0.0 ? Eigen::Vector3d(a + ab * (vb / sum) + ac * (vc / sum)) : a;
}

struct NearestQuery {
  const TriangleMesh* mesh = nullptr;
  Eigen::Vector3d point;
  double nearest_m = 0.0;
};

bool visit_triangle(RTCPointQueryFunctionArguments* arguments) {
  auto& query = *static_cast<NearestQuery*>(arguments->userPtr);
  const auto& triangle = query.mesh->triangles[arguments->primID];
  const auto corner = [&](std::size_t i) {
    return Eigen::Vector3d(query.mesh->vertices[triangle[i]].cast<double>());
  };
  const double distance_m = (nearest_on_triangle(query.point, corner(0), corner(1), corner(2)) - query.point).norm();
  if (distance_m < query.nearest_m) {
    query.nearest_m = distance_m;
    arguments->query->radius = static_cast<float>(distance_m);
    return true;
  }
  return false;
}

}  // namespace

TriangleScene::Embree::Embree(TriangleMesh triangles) : mesh(std::move(triangles)) {
  mesh.vertices.emplace_back(0.0F, 0.0F,
                             0.0F);    // Embree reads 16 bytes per vertex, so the last one needs a successor
  device = rtcNewDevice("threads=1");  // one thread builds, so the hierarchy and its ties are always the same
  if (device == nullptr) {
    throw std::runtime_error("Embree could not be started");
  }
  scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh.vertices.data(), 0,
                             sizeof(Eigen::Vector3f), mesh.vertices.size() - 1);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                             sizeof(mesh.triangles[0]), mesh.triangles.size());
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
}

TriangleScene::TriangleScene(const TriangleMesh& mesh) {
  for (const auto& triangle : mesh.triangles) {
    if (std::max({triangle[0], triangle[1], triangle[2]}) >= mesh.vertices.size()) {
      throw std::invalid_argument("TriangleMesh::triangles names a vertex that is not there");
    }
  }
  embree_ = std::make_shared<const Embree>(mesh);
}

std::optional<double> TriangleScene::hit_distance(const Eigen::Vector3d& origin_m, const Eigen::Vector3d& direction,
                                                  double max_distance_m) const {
  RTCRayHit ray{};
  ray.ray.org_x = static_cast<float>(origin_m.x());
  ray.ray.org_y = static_cast<float>(origin_m.y());
  ray.ray.org_z = static_cast<float>(origin_m.z());
  ray.ray.dir_x = static_cast<float>(direction.x());
  ray.ray.dir_y = static_cast<float>(direction.y());
  ray.ray.dir_z = static_cast<float>(direction.z());
  ray.ray.tfar = static_cast<float>(max_distance_m);
  ray.ray.mask = ~0U;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(embree_->scene, &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
    return std::nullopt;
  }
  return static_cast<double>(ray.ray.tfar);
}

double TriangleScene::distance(const Eigen::Vector3d& point_m, double max_distance_m) const {
  NearestQuery nearest{&embree_->mesh, point_m, max_distance_m};
  RTCPointQuery query{};
  query.x = static_cast<float>(point_m.x());
  query.y = static_cast<float>(point_m.y());
  query.z = static_cast<float>(point_m.z());
  query.radius = static_cast<float>(max_distance_m);
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(embree_->scene, &query, &context, &visit_triangle, &nearest);
  return nearest.nearest_m;
}

bool TriangleScene::touches(const Eigen::Vector3d& from_m, const Eigen::Vector3d& to_m, double radius_m) const {
  constexpr double kRoundingM = 1e-4;
  constexpr double kLeastStepM = 1e-3;
  constexpr double kMostStepM = 1.0;
  const double length_m = (to_m - from_m).norm();
  if (length_m > 0.0 && hit_distance(from_m, (to_m - from_m) / length_m, length_m)) {
    return true;
  }
  // The sphere may move by its clearance without touching anything.
  for (double s = 0.0;;) {
    const Eigen::Vector3d centre = length_m > 0.0 ? Eigen::Vector3d(from_m + s / length_m * (to_m - from_m)) : from_m;
    const double clearance_m = distance(centre, radius_m + kMostStepM) - radius_m;
    if (clearance_m < -kRoundingM) {
      return true;
    }
    if (s >= length_m) {
      return false;
    }
    s = std::min(length_m, s + std::max(clearance_m, kLeastStepM));
  }
}

}  // namespace vantage
