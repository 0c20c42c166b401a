// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <fstream>
#include <map>
#include <random>
#include <stdexcept>
#include <tuple>
#include <vantage/report/map_export.hpp>
#include <vector>

#include "support/random_maps.hpp"
#include "support/temporary_folder.hpp"

namespace vantage {
namespace {

using Edge = std::pair<std::tuple<float, float, float>, std::tuple<float, float, float>>;

std::size_t count_occupied(const OccupancyMap& map) { return map.counts().occupied; }

std::size_t count_open_faces(const OccupancyMap& map) {
  std::size_t faces = 0;
  map.for_each_known([&](const VoxelIndex& cell, Occupancy state) {
    for (const VoxelIndex& step : kFaceNeighbours) {
      faces += state == Occupancy::Occupied && map.at(cell + step) != Occupancy::Occupied ? 1U : 0U;
    }
  });
  return faces;
}

// Read by Assimp: the mesh has the expected number of triangles, is closed, faces outwards and has the volume of the
// cells.
TEST(MapExport, MeshIsTheClosedSurfaceOfTheOccupiedCells) {
  const test::TemporaryFolder folder;
  std::size_t maps = 0;
  for (unsigned seed = 0; seed < 5; ++seed) {
    std::mt19937 engine(seed);
    const OccupancyMap map = test::random_map(engine, 0.25);
    const std::filesystem::path file = folder / "mesh.ply";
    write_ply_mesh(map, file);
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile(file.string(), 0);
    ASSERT_NE(scene, nullptr) << importer.GetErrorString();
    ASSERT_EQ(scene->mNumMeshes, 1U);
    const aiMesh& mesh = *scene->mMeshes[0];
    EXPECT_EQ(mesh.mNumFaces, 2 * count_open_faces(map));
    EXPECT_TRUE(mesh.HasVertexColors(0));
    double volume = 0.0;
    std::map<Edge, int> edges;
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      const aiFace& face = mesh.mFaces[i];
      ASSERT_EQ(face.mNumIndices, 3U);
      Eigen::Matrix3d corners;
      for (unsigned k = 0; k < 3; ++k) {
        const aiVector3D& from = mesh.mVertices[face.mIndices[k]];
        const aiVector3D& to = mesh.mVertices[face.mIndices[(k + 1) % 3]];
        corners.col(k) = Eigen::Vector3d(from.x, from.y, from.z);
        ++edges[{{from.x, from.y, from.z}, {to.x, to.y, to.z}}];
      }
      volume += corners.determinant() / 6.0;
    }
    EXPECT_NEAR(volume, static_cast<double>(count_occupied(map)) * 0.25 * 0.25 * 0.25, 1e-3);
    const bool closed = std::all_of(edges.begin(), edges.end(), [&](const auto& entry) {
      const auto back = edges.find({entry.first.second, entry.first.first});
      return back != edges.end() && back->second == entry.second;
    });
    EXPECT_TRUE(closed);
    maps += 1;
  }
  EXPECT_EQ(maps, 5U);
}

TEST(MapExport, PointsAreTheCentresOfTheOccupiedCells) {
  const test::TemporaryFolder folder;
  std::mt19937 engine(7);
  const OccupancyMap map = test::random_map(engine, 0.25);
  const std::filesystem::path file = folder / "points.ply";
  write_ply_points(map, file);
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(file.string(), 0);
  ASSERT_NE(scene, nullptr) << importer.GetErrorString();
  const aiMesh& mesh = *scene->mMeshes[0];
  EXPECT_EQ(mesh.mNumVertices, count_occupied(map));
  EXPECT_TRUE(mesh.HasVertexColors(0));
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D& p = mesh.mVertices[i];
    const Eigen::Vector3d point(p.x, p.y, p.z);
    const VoxelIndex cell = map.frame().cell_of(point);
    EXPECT_EQ(map.at(cell), Occupancy::Occupied);
    EXPECT_LT((map.frame().centre_of(cell) - point).norm(), 1e-5);
  }
}

TEST(MapExport, NamesWhatCannotBeWritten) {
  const test::TemporaryFolder folder;
  EXPECT_THROW(write_ply_mesh(OccupancyMap(), folder / "no/such/folder.ply"), std::runtime_error);
  EXPECT_THROW(write_paraview(folder / "nothing", folder / "nowhere"), std::runtime_error);
}

}  // namespace
}  // namespace vantage
