// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vantage/evaluation/test_objects.hpp>
#include <vector>

#include <vantage/geometry/impl/dice.hpp>

namespace vantage {
namespace {

using Eigen::Vector3d;
constexpr double kTurn = 2.0 * std::numbers::pi;

// A surface: a point for u and v in [0, 1]. The outer side is where du x dv points.
using Patch = std::function<Vector3d(double u, double v)>;

void add_patch(TriangleMesh& mesh, const Patch& patch, int along_u, int along_v) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int i = 0; i <= along_u; ++i) {
    for (int j = 0; j <= along_v; ++j) {
      mesh.vertices.push_back(
          patch(static_cast<double>(i) / along_u, static_cast<double>(j) / along_v).cast<float>());
    }
  }
  const auto row = static_cast<std::uint32_t>(along_v) + 1;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(along_u); ++i) {
    for (std::uint32_t j = 0; j + 1 < row; ++j) {
      const std::uint32_t at = first + i * row + j;
      mesh.triangles.push_back({at, at + row, at + row + 1});
      mesh.triangles.push_back({at, at + row + 1, at + 1});
    }
  }
}

// A round tube along a curve, with a separate cap at each end.
void add_tube(TriangleMesh& mesh, const std::function<Vector3d(double)>& curve,
              const std::function<double(double)>& radius_m, int pieces) {
  const auto ring = [&](double u, double v) -> Vector3d {
    constexpr double kStep = 1e-4;
    const Vector3d ahead = (curve(u + kStep) - curve(u - kStep)).normalized();
    const Vector3d aside =
        ahead.cross(std::abs(ahead.z()) < 0.9 ? Vector3d::UnitZ() : Vector3d::UnitX()).normalized();
    const Vector3d across = ahead.cross(aside);
    return curve(u) + radius_m(u) * (std::cos(kTurn * v) * aside - std::sin(kTurn * v) * across);
  };
  constexpr int kAround = 12;
  add_patch(mesh, ring, pieces, kAround);
  if ((curve(0.0) - curve(1.0)).norm() > 1e-6) {
    add_patch(
        mesh, [&](double u, double v) -> Vector3d { return curve(0.0) + u * (ring(0.0, v) - curve(0.0)); }, 1,
        kAround);
    add_patch(
        mesh, [&](double u, double v) -> Vector3d { return curve(1.0) + (1.0 - u) * (ring(1.0, v) - curve(1.0)); }, 1,
        kAround);
  }
}

void add_rod(TriangleMesh& mesh, const Vector3d& from, const Vector3d& to, double radius_m) {
  add_tube(
      mesh, [&](double u) -> Vector3d { return from + u * (to - from); }, [=](double) { return radius_m; }, 8);
}

// A level ring of wire about the z axis.
void add_ring(TriangleMesh& mesh, double radius_m, double height_m, double wire_m) {
  add_tube(
      mesh,
      [=](double u) -> Vector3d {
        return {radius_m * std::cos(kTurn * u), radius_m * std::sin(kTurn * u), height_m};
      },
      [=](double) { return wire_m; }, 48);
}

// A profile of (radius, height) turned about z. It goes from the axis at the bottom along the outside, then along
// the inside down to the axis.
void add_turned(TriangleMesh& mesh, const std::vector<Eigen::Vector2d>& profile) {
  const auto last = static_cast<double>(profile.size() - 1);
  const auto at = [&](double u) -> Eigen::Vector2d {
    const auto i = std::min(static_cast<std::size_t>(u * last + 1e-9), profile.size() - 2);
    const double share = u * last - static_cast<double>(i);
    return profile[i] + share * (profile[i + 1] - profile[i]);
  };
  add_patch(
      mesh,
      [&](double u, double v) -> Vector3d {
        const Eigen::Vector2d p = at(1.0 - u);
        return {p.x() * std::cos(kTurn * v), p.x() * std::sin(kTurn * v), p.y()};
      },
      4 * static_cast<int>(last), 64);
}

void add_slab(TriangleMesh& mesh, const Vector3d& min, const Vector3d& max) { mesh.add_box({min, max}); }

TriangleMesh chair(detail::Dice& dice) {
  TriangleMesh mesh;
  const double half = 0.18 + 0.06 * dice.share();
  const double seat = 0.42 + 0.06 * dice.share();
  const double top = seat + 0.4 + 0.1 * dice.share();
  const double rod = 0.010 + 0.008 * dice.share();
  add_slab(mesh, {-half, -half, seat}, {half, half, seat + 0.02});
  for (const double x : {-half + rod, half - rod}) {
    for (const double y : {-half + rod, half - rod}) {
      add_rod(mesh, {x, y, 0.0}, {x, y, seat - 1e-3}, rod);
    }
    add_rod(mesh, {x, -half + rod, 0.15}, {x, half - rod, 0.15}, 0.7 * rod);
    add_rod(mesh, {x, half - rod, seat + 0.021}, {1.02 * x, half + 0.05, top}, rod);
  }
  const auto slats = 3 + dice.below(4);
  for (std::size_t i = 0; i < slats; ++i) {
    const double x =
        (half - 2 * rod) * (2.0 * (static_cast<double>(i) + 1.0) / (static_cast<double>(slats) + 1.0) - 1.0);
    add_rod(mesh, {x, half - rod, seat + 0.021}, {1.02 * x, half + 0.05, top}, 0.6 * rod);
  }
  add_slab(mesh, {-1.05 * half, half + 0.03, top}, {1.05 * half, half + 0.06, top + 0.05});
  return mesh;
}

TriangleMesh basket(detail::Dice& dice) {
  TriangleMesh mesh;
  const double bottom = 0.10 + 0.05 * dice.share();
  const double top = bottom + 0.06 * dice.share();
  const double height = 0.2 + 0.1 * dice.share();
  const double wire = 0.003 + 0.002 * dice.share();
  for (int i = 0; i < 6; ++i) {
    const double share = i / 5.0;
    add_ring(mesh, bottom + share * (top - bottom), wire + share * height, wire);
  }
  for (int i = 0; i < 16; ++i) {
    const double a = kTurn * i / 16.0;
    const Vector3d out(std::cos(a), std::sin(a), 0.0);
    add_rod(mesh, bottom * out + wire * Vector3d::UnitZ(), top * out + (wire + height) * Vector3d::UnitZ(), wire);
    if (i < 8) {
      add_rod(mesh, bottom * out + wire * Vector3d::UnitZ(), -bottom * out + wire * Vector3d::UnitZ(), wire);
    }
  }
  return mesh;
}

TriangleMesh lamp(detail::Dice& dice) {
  TriangleMesh mesh;
  const double foot = 0.10 + 0.04 * dice.share();
  const double height = 0.4 + 0.2 * dice.share();
  const double shade = 0.12 + 0.05 * dice.share();
  add_turned(mesh, {{0.0, 0.0}, {foot, 0.0}, {foot, 0.02}, {0.3 * foot, 0.03}, {0.0, 0.03}});
  add_rod(mesh, {0, 0, 0.031}, {0, 0, height}, 0.008);
  const double low = height - 0.1;
  add_turned(mesh, {{shade, low},
                    {0.6 * shade, low + 0.18},
                    {0.6 * shade - 0.004, low + 0.18},
                    {shade - 0.004, low},
                    {shade, low}});
  return mesh;
}

TriangleMesh mug(detail::Dice& dice) {
  TriangleMesh mesh;
  const double radius = 0.038 + 0.02 * dice.share();
  const double height = 0.08 + 0.05 * dice.share();
  const double wall = 0.004;
  add_turned(
      mesh,
      {{0.0, 0.0}, {radius, 0.0}, {radius, height}, {radius - wall, height}, {radius - wall, wall}, {0.0, wall}});
  add_tube(
      mesh,
      [=](double u) -> Vector3d {
        const double a = std::numbers::pi * (u - 0.5);
        return {radius + 0.03 * std::cos(a), 0.0, 0.5 * height + 0.32 * height * std::sin(a)};
      },
      [](double) { return 0.006; }, 16);
  return mesh;
}

TriangleMesh vase(detail::Dice& dice) {
  TriangleMesh mesh;
  const double height = 0.25 + 0.15 * dice.share();
  const double belly = 0.07 + 0.04 * dice.share();
  const double neck = 0.03 + 0.02 * dice.share();
  const double wall = 0.006;
  add_turned(mesh, {{0.0, 0.0},
                    {0.6 * belly, 0.0},
                    {belly, 0.35 * height},
                    {neck, 0.8 * height},
                    {1.4 * neck, height},
                    {1.4 * neck - wall, height},
                    {neck - wall, 0.8 * height},
                    {belly - wall, 0.35 * height},
                    {0.6 * belly - wall, wall},
                    {0.0, wall}});
  return mesh;
}

TriangleMesh shelf(detail::Dice& dice) {
  TriangleMesh mesh;
  const double wide = 0.6 + 0.4 * dice.share();
  const double deep = 0.25 + 0.15 * dice.share();
  const double high = 0.9 + 0.5 * dice.share();
  constexpr double kBoard = 0.018;
  const auto rows = 2 + dice.below(3);
  add_slab(mesh, {0, 0, 0}, {kBoard, deep, high});
  add_slab(mesh, {wide - kBoard, 0, 0}, {wide, deep, high});
  add_slab(mesh, {kBoard, deep - kBoard, 0}, {wide - kBoard, deep, high});
  for (std::size_t i = 0; i <= rows; ++i) {
    const double z = (high - kBoard) * static_cast<double>(i) / static_cast<double>(rows);
    add_slab(mesh, {kBoard, 0, z}, {wide - kBoard, deep - kBoard, z + kBoard});
  }
  add_slab(mesh, {0.4 * wide, 0.02, kBoard}, {0.4 * wide + kBoard, deep - kBoard, high - kBoard});
  return mesh;
}

TriangleMesh blob(detail::Dice& dice) {
  TriangleMesh mesh;
  struct Wave {
    Vector3d direction;
    double height;
    double phase;
  };
  std::vector<Wave> waves(8);
  for (Wave& wave : waves) {
    wave = {(2.0 + 3.0 * dice.share()) * dice.direction(), 0.05 + 0.1 * dice.share(), kTurn * dice.share()};
  }
  const double size = 0.12 + 0.1 * dice.share();
  add_patch(
      mesh,
      [&](double u, double v) -> Vector3d {
        const double a = std::numbers::pi * u;
        const Vector3d out(std::sin(a) * std::cos(kTurn * v), std::sin(a) * std::sin(kTurn * v), std::cos(a));
        double r = 1.0;
        for (const Wave& wave : waves) {
          r += wave.height * std::sin(wave.direction.dot(out) + wave.phase);
        }
        return size * r * out;
      },
      64, 128);
  return mesh;
}

TriangleMesh banana(detail::Dice& dice) {
  TriangleMesh mesh;
  const double bend = 0.08 + 0.04 * dice.share();
  const double thick = 0.015 + 0.01 * dice.share();
  const double arc = 1.2 + 0.8 * dice.share();
  add_tube(
      mesh,
      [=](double u) -> Vector3d {
        const double a = arc * (u - 0.5);
        return {bend * std::sin(a), bend * (1.0 - std::cos(a)), thick};
      },
      [=](double u) { return thick * (0.15 + 0.85 * std::sqrt(std::max(0.0, 1.0 - std::pow(2.0 * u - 1.0, 4)))); },
      32);
  return mesh;
}

TriangleMesh crate(detail::Dice& dice) {
  TriangleMesh mesh;
  const Vector3d size(0.2 + 0.2 * dice.share(), 0.15 + 0.2 * dice.share(), 0.1 + 0.2 * dice.share());
  add_slab(mesh, Vector3d::Zero(), size);
  add_slab(mesh, {0.3 * size.x(), 0.3 * size.y(), size.z()}, {0.6 * size.x(), 0.8 * size.y(), 1.4 * size.z()});
  return mesh;
}

using Maker = TriangleMesh (*)(detail::Dice&);
constexpr std::array<std::string_view, 9> kObjectNames{"chair", "basket", "lamp",   "mug",  "vase",
                                                       "shelf", "blob",   "banana", "crate"};
constexpr std::array<Maker, 9> kMakers{chair, basket, lamp, mug, vase, shelf, blob, banana, crate};

}  // namespace

TriangleMesh generated_object(std::string_view name, std::uint64_t seed) {
  const auto at = std::find(kObjectNames.begin(), kObjectNames.end(), name);
  if (at == kObjectNames.end()) {
    std::string names;
    for (const std::string_view known : kObjectNames) {
      names += (names.empty() ? "" : ", ") + std::string(known);
    }
    throw std::invalid_argument("there is no object '" + std::string(name) + "'; there are: " + names);
  }
  detail::Dice dice(seed, static_cast<std::uint64_t>(at - kObjectNames.begin()));
  const TriangleMesh drawn = kMakers[static_cast<std::size_t>(at - kObjectNames.begin())](dice);
  Pose onto_ground = Pose::Identity();
  onto_ground.translation().z() = -drawn.bounds().min.z();
  TriangleMesh standing;
  standing.append(drawn, onto_ground);
  return standing;
}

std::span<const std::string_view> generated_object_names() { return kObjectNames; }

}  // namespace vantage
