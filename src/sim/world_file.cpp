// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <vantage/map/octomap_bridge.hpp>
#include <vantage/sim/nav2_map_file.hpp>
#include <vantage/sim/world.hpp>

namespace vantage {

World::FileKind World::kind_of_file(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".yaml" || extension == ".yml") {
    return FileKind::Plan;
  }
  return extension == ".bt" || extension == ".ot" ? FileKind::OctoMap : FileKind::Mesh;
}

World World::from_file(const std::filesystem::path& path, const MeshFileOptions& options) {
  const FileKind kind = kind_of_file(path);
  if (kind == FileKind::Plan) {
    return from_plan(path.filename().string(), read_nav2_map(path));
  }
  if (kind == FileKind::Mesh) {
    return from_mesh_file(path, options);
  }
  const OccupancyMap map = load_octomap(path).map;
  if (map.counts().free == 0) {
    throw std::runtime_error(path.string() + ": has no free cell to explore");
  }
  try {
    return from_map(path.filename().string(), map);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
}

}  // namespace vantage
