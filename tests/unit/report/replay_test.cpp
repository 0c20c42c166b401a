// SPDX-License-Identifier: MIT
#include "report/replay.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <tuple>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/frontier/void_cells.hpp>
#include <vantage/report/run_recorder.hpp>

#include "report/replay_json.hpp"
#include "support/random_maps.hpp"
#include "support/temporary_folder.hpp"

namespace vantage {
namespace {

using Face = std::tuple<std::size_t, VoxelIndex>;  // direction, cell

// By definition: faces of cells of one kind towards free cells.
template <class IsSolid>
std::set<Face> faces_by_definition(const OccupancyMap& map, const IsSolid& is_solid) {
  std::set<Face> faces;
  map.for_each_known([&](const VoxelIndex& free, Occupancy state) {
    for (std::size_t direction = 0; direction < 6 && state == Occupancy::Free; ++direction) {
      const VoxelIndex solid = free - kFaceNeighbours[direction];
      if (is_solid(solid)) {
        faces.emplace(direction, solid);
      }
    }
  });
  return faces;
}

// The faces that a page shows after view `now`. Reports a face that is shown twice.
std::set<Face> faces_shown(const std::array<std::vector<detail::TimedQuad>, 6>& quads, std::size_t now) {
  std::set<Face> faces;
  for (std::size_t direction = 0; direction < 6; ++direction) {
    for (const detail::TimedQuad& quad : quads[direction]) {
      for (std::int32_t v = 0; quad.birth <= now && now < quad.death && v < quad.height; ++v) {
        for (std::int32_t u = 0; u < quad.width; ++u) {
          const VoxelIndex step = direction < 2   ? VoxelIndex{0, u, v}
                                  : direction < 4 ? VoxelIndex{u, 0, v}
                                                  : VoxelIndex{u, v, 0};
          EXPECT_TRUE(faces.emplace(direction, quad.cell + step).second) << "a face is shown twice";
        }
      }
    }
  }
  return faces;
}

std::set<VoxelIndex> cells_shown(const std::vector<detail::TimedCell>& cells, std::size_t now) {
  std::set<VoxelIndex> shown;
  for (const detail::TimedCell& cell : cells) {
    if (cell.birth <= now && now < cell.death) {
      EXPECT_TRUE(shown.insert(cell.cell).second) << "a cell is shown twice";
    }
  }
  return shown;
}

// Random changes of cells and boxes of cells, so that faces can be merged.
void change(OccupancyMap& map, std::mt19937& engine) {
  map.insert(test::random_scan(engine, 60));
  std::uniform_int_distribution<std::int32_t> at(-9, 9);
  std::uniform_int_distribution<std::int32_t> extent(1, 5);
  for (int i = 0; i < 12; ++i) {
    const VoxelIndex lo{at(engine), at(engine), at(engine)};
    const VoxelIndex hi = lo + VoxelIndex{extent(engine), extent(engine), extent(engine)};
    for_each_cell(VoxelBox{lo, hi}, [&](const VoxelIndex& cell) { map.set(cell, static_cast<Occupancy>(i % 3)); });
  }
}

TEST(Replay, ShowsAtEveryMomentWhatTheMapWasThen) {
  const test::TemporaryFolder folder;
  std::size_t moments = 0;
  std::size_t faces = 0;
  std::size_t rectangles = 0;
  for (unsigned seed = 0; seed < 6; ++seed) {
    std::mt19937 engine(seed);
    OccupancyMap map({.resolution_m = 0.25, .region = Box{{-2.5, -2.5, -2.5}, {2.5, 2.5, 2.5}}});
    std::vector<OccupancyMap> maps;
    {
      RunRecorder recorder(folder / "run", {});
      for (int i = 0; i < 6; ++i) {
        change(map, engine);
        Plan plan;
        plan.statistics.void_cells = count_void_cells(map);
        recorder.record(map, Pose::Identity(), plan);
        maps.push_back(map);
      }
    }
    const detail::Replay replay = detail::replay_of(folder / "run");
    ASSERT_EQ(replay.cycles.size(), maps.size());
    for (std::size_t now = 1; now <= maps.size(); ++now) {
      const OccupancyMap& then = maps[now - 1];
      const std::set<Face> surfaces =
          faces_by_definition(then, [&](const VoxelIndex& cell) { return then.at(cell) == Occupancy::Occupied; });
      EXPECT_EQ(faces_shown(replay.surfaces, now), surfaces) << "seed " << seed << ", view " << now;
      const std::vector<VoxelIndex> voids = void_cells(then);
      const std::set<VoxelIndex> is_void(voids.begin(), voids.end());
      EXPECT_EQ(faces_shown(replay.voids, now),
                faces_by_definition(then, [&](const VoxelIndex& cell) { return is_void.contains(cell); }));
      const std::vector<VoxelIndex> frontier = frontier_cells(then);
      EXPECT_EQ(cells_shown(replay.frontiers, now), std::set<VoxelIndex>(frontier.begin(), frontier.end()));
      moments += 1;
      faces += surfaces.size();
    }
    for (const auto& direction : replay.surfaces) {
      rectangles += direction.size();
    }
  }
  EXPECT_EQ(moments, 36U);
  EXPECT_GT(faces, 5000U);
  EXPECT_LT(rectangles, faces / 2) << "faces beside one another are drawn as one";
}

TEST(Replay, TheBoxShownHoldsTheRectanglesOfVoidsWhole) {
  for (std::size_t direction = 0; direction < 6; ++direction) {
    detail::Replay replay;
    replay.bounds = {{0, 0, 0}, {4, 4, 4}};
    replay.voids[direction] = {{.cell = {1, 2, 3}, .width = 10, .height = 20}};
    VoxelIndex hi{4, 4, 4};  // of every cell of the rectangle
    const std::size_t axis = direction / 2;
    for (std::int32_t u = 0; u < 10; ++u) {
      for (std::int32_t v = 0; v < 20; ++v) {
        const VoxelIndex cell = VoxelIndex{1, 2, 3} + VoxelIndex{axis == 0 ? 0 : u,
                                                                 axis == 0   ? u
                                                                 : axis == 1 ? 0
                                                                             : v,
                                                                 axis == 2 ? 0 : v};
        hi = {std::max(hi.x, cell.x + 1), std::max(hi.y, cell.y + 1), std::max(hi.z, cell.z + 1)};
      }
    }
    const nlohmann::json json = detail::replay_json(replay);
    EXPECT_EQ(json.at("lo"), nlohmann::json({0, 0, 0}));
    EXPECT_EQ(json.at("hi"), nlohmann::json({hi.x, hi.y, hi.z})) << direction;
  }
}

}  // namespace
}  // namespace vantage
