// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <vantage/map/octomap_bridge.hpp>
#include <vantage/sim/nav2_map_file.hpp>
#include <vantage/sim/world.hpp>

namespace vantage {

namespace {

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace

bool World::is_plan_file(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  return extension == ".yaml" || extension == ".yml";
}

World World::from_file(const std::filesystem::path& path, const MeshFileOptions& options) {
  if (is_plan_file(path)) {
    return from_plan(path.filename().string(), read_nav2_map(path));
  }
  const std::string extension = lower_extension(path);
  if (extension != ".bt" && extension != ".ot") {
    return from_mesh_file(path, options);
  }
  const OccupancyMap map = load_octomap(path).map;
  if (map.counts().free == 0) {
    throw std::runtime_error(path.string() + ": has no free cell to explore");
  }
  return from_map(path.filename().string(), map);
}

}  // namespace vantage
