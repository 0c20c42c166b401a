// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vantage/sim/seen_surface.hpp>

#include <vantage/geometry/impl/dice.hpp>

namespace vantage {
namespace {

const double kLeastCosine = std::cos(85.0 * std::numbers::pi / 180.0);

// Offset from the surface, as a share of the viewing distance, that puts a point on one side of it in single
// precision.
constexpr double kOffSurface = 1e-5;

// Counts how many of 16 directions on one side of a surface leave the object.
int open_directions(const TriangleScene& scene, const Eigen::Vector3d& point, const Eigen::Vector3d& side,
                    double size_m) {
  detail::Dice dice(7);
  int open = 0;
  for (int i = 0; i < 16; ++i) {
    const Eigen::Vector3d direction = (side + 0.95 * dice.direction()).normalized();
    open += scene.hit_distance(point + kOffSurface * size_m * side, direction, size_m) ? 0 : 1;
  }
  return open;
}

}  // namespace

std::vector<SurfaceSample> sample_surface(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed) {
  std::vector<double> areas;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d corner = mesh.vertices[a].cast<double>();
    const Eigen::Vector3d ab = mesh.vertices[b].cast<double>() - corner;
    const Eigen::Vector3d ac = mesh.vertices[c].cast<double>() - corner;
    areas.push_back((areas.empty() ? 0.0 : areas.back()) + 0.5 * ab.cross(ac).norm());
  }
  if (areas.empty() || !(areas.back() > 0.0)) {
    throw std::invalid_argument("sample_surface: the mesh has no area");
  }
  const TriangleScene scene(mesh);
  const double size_m = mesh.bounds().extent().norm();
  detail::Dice dice(seed);
  std::vector<SurfaceSample> samples;
  samples.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto at = std::upper_bound(areas.begin(), areas.end() - 1, dice.share() * areas.back());
    const auto& [a, b, c] = mesh.triangles[static_cast<std::size_t>(at - areas.begin())];
    double u = dice.share();
    double v = dice.share();
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    const Eigen::Vector3d corner = mesh.vertices[a].cast<double>();
    const Eigen::Vector3d ab = mesh.vertices[b].cast<double>() - corner;
    const Eigen::Vector3d ac = mesh.vertices[c].cast<double>() - corner;
    SurfaceSample sample{corner + u * ab + v * ac, ab.cross(ac).normalized()};
    if (open_directions(scene, sample.point, sample.normal, size_m) == 0 &&
        open_directions(scene, sample.point, -sample.normal, size_m) > 0) {
      sample.normal = -sample.normal;
    }
    samples.push_back(sample);
  }
  return samples;
}

SeenSurface::SeenSurface(const TriangleScene& scene, std::vector<SurfaceSample> samples, const RangeSensor& sensor)
    : scene_(scene), samples_(std::move(samples)), sensor_(sensor), seen_(samples_.size()) {
  sensor_.validate();
}

bool SeenSurface::exposed(const SurfaceSample& sample, const Eigen::Vector3d& from) const {
  const Eigen::Vector3d back = from - sample.point;
  const double distance_m = back.norm();
  if (distance_m < std::max(sensor_.min_range_m, 1e-9) || distance_m > sensor_.max_range_m ||
      sample.normal.dot(back) <= kLeastCosine * distance_m) {
    return false;
  }
  const double off_m = kOffSurface * distance_m;
  return !scene_.hit_distance(sample.point + off_m * sample.normal, back / distance_m, distance_m);
}

std::vector<std::uint32_t> SeenSurface::visible_from(const Pose& world_from_sensor) const {
  const Pose sensor_from_world = world_from_sensor.inverse();
  std::vector<std::uint32_t> visible;
  for (std::uint32_t i = 0; i < samples_.size(); ++i) {
    if (sensor_.in_view(sensor_from_world * samples_[i].point) &&
        exposed(samples_[i], world_from_sensor.translation())) {
      visible.push_back(i);
    }
  }
  return visible;
}

void SeenSurface::add(const Pose& world_from_sensor) {
  for (const std::uint32_t sample : visible_from(world_from_sensor)) {
    seen_count_ += seen_[sample] ? 0U : 1U;
    seen_[sample] = true;
  }
}

double SeenSurface::share() const {
  return samples_.empty() ? 1.0 : static_cast<double>(seen_count_) / static_cast<double>(samples_.size());
}

// Places are tried in random order, because what one place does not see, its neighbour rarely sees either.
std::size_t SeenSurface::observable_count(const Platform& platform, std::span<const Eigen::Vector3d> places) const {
  std::vector<Eigen::Vector3d> shuffled(places.begin(), places.end());
  detail::Dice dice(1);
  for (std::size_t i = shuffled.size(); i > 1; --i) {
    std::swap(shuffled[i - 1], shuffled[dice.below(i)]);
  }
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < samples_.size(); ++i) {
    const SurfaceSample& sample = samples_[i];
    count +=
        seen_[i] || std::any_of(shuffled.begin(), shuffled.end(), [&](const Eigen::Vector3d& place) {
          const Eigen::Vector3d towards = sample.point - place;
          return exposed(sample, place) &&
                 (platform.can_tilt() || sensor_.in_view(platform.facing(place, towards).inverse() * sample.point));
        });
  }
  return count;
}

}  // namespace vantage
