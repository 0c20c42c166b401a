// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/sim/seen_surface.hpp>

namespace vantage {
namespace {

// Slow reference: whether a segment intersects a triangle, by solving a linear system.
bool meets(const std::array<Eigen::Vector3d, 3>& triangle, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  Eigen::Matrix3d system;
  system << from - to, triangle[1] - triangle[0], triangle[2] - triangle[0];
  if (std::abs(system.determinant()) < 1e-12) {
    return false;
  }
  const Eigen::Vector3d at = system.inverse() * (from - triangle[0]);
  return at[0] > 0.0 && at[0] < 1.0 && at[1] >= 0.0 && at[2] >= 0.0 && at[1] + at[2] <= 1.0;
}

TEST(SeenSurface, SeesWhatTryingAllTrianglesSays) {
  std::mt19937 engine(17);
  std::uniform_real_distribution<double> metre(-0.3, 0.3);
  const RangeSensor sensor = RangeSensor::pinhole(64, 48, 0.7, 0.5, 0.6, 1.6);
  std::size_t pairs = 0;
  std::size_t visible_pairs = 0;
  for (int scene = 0; scene < 20; ++scene) {
    TriangleMesh mesh;
    for (std::uint32_t i = 0; i < 12; ++i) {
      for (int corner = 0; corner < 3; ++corner) {
        mesh.vertices.emplace_back(Eigen::Vector3d(metre(engine), metre(engine), metre(engine)).cast<float>());
      }
      mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    SeenSurface surface(TriangleScene(mesh), sample_surface(mesh, 200), sensor);
    std::vector<bool> seen(surface.samples().size());
    for (int view = 0; view < 5; ++view) {
      const Eigen::Vector3d out = Eigen::Vector3d(metre(engine), metre(engine), metre(engine)).normalized();
      const Pose pose =
          pose_looking_along(1.2 * out, -out + 0.5 * Eigen::Vector3d(0.0, metre(engine), metre(engine)));
      surface.add(pose);
      const std::vector<std::uint32_t> visible = surface.visible_from(pose);
      for (std::uint32_t i = 0; i < seen.size(); ++i) {
        const auto& [point, normal] = surface.samples()[i];
        const Eigen::Vector3d back = pose.translation() - point;
        bool expected = sensor.in_view(pose.inverse() * point) && back.norm() >= sensor.min_range_m &&
                        back.norm() <= sensor.max_range_m &&
                        normal.dot(back.normalized()) > std::cos(85.0 * std::numbers::pi / 180.0);
        for (const auto& [a, b, c] : mesh.triangles) {
          const std::array<Eigen::Vector3d, 3> triangle{
              mesh.vertices[a].cast<double>(), mesh.vertices[b].cast<double>(), mesh.vertices[c].cast<double>()};
          expected = expected && !meets(triangle, point + 1e-5 * normal, pose.translation());
        }
        const bool found = std::binary_search(visible.begin(), visible.end(), i);
        EXPECT_EQ(found, expected) << "scene " << scene << ", view " << view << ", sample " << i;
        ++pairs;
        visible_pairs += found ? 1U : 0U;
        seen[i] = seen[i] || found;
      }
    }
    EXPECT_EQ(surface.seen_count(), static_cast<std::size_t>(std::count(seen.begin(), seen.end(), true)));
  }
  EXPECT_EQ(pairs, 20'000U);
  EXPECT_GT(visible_pairs, 2'000U);
}

// Five sides of a box on the ground can be seen, the bottom cannot; a wall hides the box from one side.
TEST(SeenSurface, TellsWhatCanBeSeenAtAll) {
  TriangleMesh mesh;
  const Box box{{-0.1, -0.1, 0.0}, {0.1, 0.1, 0.2}};
  mesh.add_box(box);
  TriangleMesh world = mesh;
  world.add_quad({-2.0, -2.0, -0.001}, {2.0, -2.0, -0.001}, {2.0, 2.0, -0.001}, {-2.0, 2.0, -0.001});
  const RangeSensor sensor = RangeSensor::pinhole(64, 64, 1.0, 1.0, 0.0, 4.0);
  SeenSurface surface(TriangleScene(world), sample_surface(mesh, 6'000), sensor);
  for (const SurfaceSample& sample : surface.samples()) {
    const Eigen::Vector3d inwards = sample.point - 1e-3 * sample.normal;
    EXPECT_TRUE(box.contains(inwards)) << "the side is the outer one, whatever the winding";
  }
  EXPECT_EQ(surface.share(), 0.0);
  const FreeFlyer anyhow({.radius_m = 0.0});
  const std::vector<Eigen::Vector3d> places{{1.0, 1.0, 1.0}, {-1.0, -1.0, 1.0}};
  EXPECT_NEAR(static_cast<double>(surface.observable_count(anyhow, places)) / 6'000.0, 5.0 / 6.0, 0.02);
  surface.add(pose_looking_along({1.0, 1.0, 1.0}, {-1.0, -1.0, -0.9}));
  EXPECT_NEAR(surface.share(), 0.5, 0.02) << "three sides of six";
  EXPECT_EQ(surface.observable_count(anyhow, {}), surface.seen_count());
  // From high up, a horizontal sensor does not have the box in view.
  const FreeFlyer level({.radius_m = 0.0, .yaw_only = true});
  const std::vector<Eigen::Vector3d> high{{-0.5, -0.5, 3.0}};
  EXPECT_EQ(surface.observable_count(level, high), surface.seen_count());
  EXPECT_GT(surface.observable_count(anyhow, high), surface.seen_count());
}

TEST(SeenSurface, RefusesAMeshWithoutArea) { EXPECT_THROW((void)sample_surface({}), std::invalid_argument); }

}  // namespace
}  // namespace vantage
