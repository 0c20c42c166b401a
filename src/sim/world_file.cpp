// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <vantage/map/octomap_bridge.hpp>
#include <vantage/sim/world.hpp>

namespace vantage {

World World::from_file(const std::filesystem::path& path, const MeshFileOptions& options) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
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
