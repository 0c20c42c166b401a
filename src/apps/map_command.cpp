// SPDX-License-Identifier: MIT
#include "apps/map_command.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>
#include <stdexcept>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/frontier/void_cells.hpp>
#include <vantage/map/octomap_bridge.hpp>

#include <vantage/map/impl/whole_file.hpp>

namespace vantage::apps {
namespace {

// Removes the rounding noise of a multiple of the resolution: -7.52, not -7.5200000000000005.
double plain(double metres) { return std::round(metres * 1e9) / 1e9; }

void print(const nlohmann::json& summary, std::ostream& out) {
  const nlohmann::json& cells = summary.at("cells");
  const nlohmann::json& bounds = summary.at("bounds_m");
  out << summary.at("file").get<std::string>() << '\n'
      << "  resolution  " << summary.at("resolution_m") << " m\n"
      << "  free        " << cells.at("free") << " cells, " << cells.at("frontier") << " of them frontier\n"
      << "  occupied    " << cells.at("occupied") << " cells\n"
      << "  void        " << cells.at("void") << " cells (unknown, inside the hull of the occupied ones)\n";
  out << "  bounds     ";
  constexpr const char* kAxes[] = {"x", "y", "z"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    out << ' ' << kAxes[axis] << ' ' << bounds.at(axis) << " to " << bounds.at(axis + 3) << (axis < 2 ? "," : " m\n");
  }
  out << "  memory      " << summary.at("memory_mb") << " MB\n";
}

}  // namespace

nlohmann::json map_summary(const std::filesystem::path& file, std::size_t max_bytes) {
  const OccupancyMap map = load_octomap(file, {.map = {.max_bytes = max_bytes}}).map;
  if (map.cells_refused() > 0) {
    throw std::runtime_error(file.string() + ": its map needs more than the " + std::to_string(max_bytes) +
                             " bytes of --memory-limit");
  }
  const OccupancyMap::Counts counts = map.counts();
  const Box bounds = map.frame().box_of(map.bounds());
  return {{"file", file.string()},
          {"resolution_m", map.resolution_m()},
          {"cells",
           {{"free", counts.free},
            {"occupied", counts.occupied},
            {"frontier", count_frontier_cells(map)},
            {"void", count_void_cells(map)}}},
          {"bounds_m",
           {plain(bounds.min.x()), plain(bounds.min.y()), plain(bounds.min.z()), plain(bounds.max.x()),
            plain(bounds.max.y()), plain(bounds.max.z())}},
          {"memory_mb", static_cast<double>(map.memory_bytes()) / 1e6}};
}

int run_map_command(const std::filesystem::path& file, const std::string& json, std::ostream& out,
                    std::size_t max_bytes) {
  const nlohmann::json summary = map_summary(file, max_bytes);
  // a file name may be no UTF-8
  const std::string text = summary.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  if (json == "-") {
    out << text;
    return 0;
  }
  if (!json.empty()) {
    detail::write_whole_file(json, text);
  }
  print(summary, out);
  return 0;
}

}  // namespace vantage::apps
