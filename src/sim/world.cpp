// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>
#include <vantage/sim/world.hpp>

#include <vantage/settings/impl/option_rule.hpp>
#include "sim/cell_worlds.hpp"
#include "sim/crate_worlds.hpp"

namespace vantage {
namespace {

using Builder = World (*)(const WorldOptions&);

struct Named {
  std::string_view name;
  Builder build;
  bool sized = false;  // whether it takes WorldOptions::length_m and width_m
};

World rooms_world(const WorldOptions&) { return world_of_cells("rooms", rooms_cells()); }
World office_world(const WorldOptions& options) { return world_of_cells("office", office_cells(options)); }
World maze_world(const WorldOptions& options) { return world_of_cells("maze", maze_cells(options)); }
World two_storey_world(const WorldOptions&) { return world_of_cells("two-storey", two_storey_cells()); }

World table_world(const WorldOptions&) {
  World world;
  world.name = "table";
  world.region = {{-1.8, -1.8, 0.0}, {1.8, 1.8, 2.0}};
  constexpr double kBehind = 1e-3;  // walls lie just outside the region, so never on the border of its cells
  const Eigen::Vector3d behind = Eigen::Vector3d::Constant(kBehind);
  world.mesh.add_box({world.region.min - behind, world.region.max + behind});
  world.mesh.add_box({{-0.4, -0.5, 0.387277}, {0.4, 0.5, 0.427277}});
  return world;
}

World crates_open(const WorldOptions&) { return crates_open_world(); }
World crates_closed(const WorldOptions&) { return crates_closed_world(); }

constexpr std::array<Named, 7> kWorlds{{{"rooms", &rooms_world},
                                        {"office", &office_world, true},
                                        {"maze", &maze_world, true},
                                        {"two-storey", &two_storey_world},
                                        {"table", &table_world},
                                        {"crates-open", &crates_open},
                                        {"crates-closed", &crates_closed}}};

void validate(const WorldOptions& options, const Named& world) {
  const auto check = [&](double metres, const char* option) {
    detail::require_option(metres == 0.0 || (metres >= 4.0 && metres <= 200.0), option, metres, "0 or in [4, 200]");
    if (!world.sized) {
      detail::require_option(metres == 0.0, option, metres,
                             "0: " + std::string(world.name) + " has a size of its own");
    }
  };
  check(options.length_m, "WorldOptions::length_m");
  check(options.width_m, "WorldOptions::width_m");
}

}  // namespace

World World::by_name(std::string_view name, const WorldOptions& options) {
  const auto found = std::find_if(kWorlds.begin(), kWorlds.end(), [&](const Named& w) { return w.name == name; });
  if (found != kWorlds.end()) {
    validate(options, *found);
    return found->build(options);
  }
  std::string message = "there is no world \"" + std::string(name) + "\"; there are";
  for (std::size_t i = 0; i < kWorlds.size(); ++i) {
    message += (i == 0 ? " " : ", ") + std::string(kWorlds[i].name);
  }
  throw std::invalid_argument(message);
}

const std::vector<std::string_view>& World::names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    all.reserve(std::size(kWorlds));
    for (const Named& world : kWorlds) {
      all.push_back(world.name);
    }
    return all;
  }();
  return names;
}

World World::from_mesh_file(const std::filesystem::path& path, const MeshFileOptions& options) {
  World world;
  world.name = path.filename().string();
  world.mesh = read_mesh_file(path, options);
  world.region = world.mesh.bounds();
  return world;
}

World World::from_plan(std::string name, GroundPlan plan) {
  plan.validate();
  World world;
  world.name = std::move(name);
  world.mesh = plan.walls();
  world.region = plan.bounds();
  world.plan = std::move(plan);
  return world;
}

World World::from_map(std::string name, const OccupancyMap& map) {
  if (map.counts().free == 0) {
    throw std::invalid_argument("World::from_map: the map has no free cell");
  }
  constexpr std::size_t kMostWorldCells = 1'000'000'000;  // of a byte each
  detail::require_option(map.bounds().size() <= kMostWorldCells,
                         "World::from_map: count of cells in the map's bounds", map.bounds().size(),
                         "at most 1000000000");
  VoxelGrid<std::uint8_t> solid(map.bounds(), 1);
  map.for_each_known([&](const VoxelIndex& cell, Occupancy occupancy) {
    if (occupancy == Occupancy::Free) {
      solid[cell] = 0;
    }
  });
  constexpr double kInsetShare = 0.05;  // as in the built-in worlds: 1 cm of 0.2 m
  World world;
  world.name = std::move(name);
  world.mesh = surface_of_cells(solid, map.frame(), kInsetShare * map.resolution_m());
  world.region = map.frame().box_of(map.bounds());
  return world;
}

}  // namespace vantage
