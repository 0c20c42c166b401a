// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vantage/sim/mesh_file.hpp>
#include <vantage/sim/triangle_scene.hpp>
#include <vantage/sim/world.hpp>

#include "sim/cell_worlds.hpp"

namespace vantage {
namespace {

std::string complaint(const std::function<void()>& act) {
  try {
    act();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

class MeshFile : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& text) {
    const std::filesystem::path path = std::filesystem::path(::testing::TempDir()) / name;
    std::ofstream(path) << text;
    return path;
  }
};

TEST_F(MeshFile, ReadsTrianglesAndTurnsYUpIntoZUp) {
  const auto path = write("one.obj", "v 0 0 0\nv 1 0 0\nv 0 2 3\nf 1 2 3\n");
  const TriangleMesh mesh = read_mesh_file(path);
  ASSERT_EQ(mesh.triangles.size(), 1U);
  EXPECT_TRUE(mesh.bounds().max.isApprox(Eigen::Vector3d(1, 2, 3)));
  const TriangleMesh turned = read_mesh_file(path, {.up = MeshFileOptions::Up::Y, .scale = 0.1});
  EXPECT_TRUE(turned.bounds().min.isApprox(Eigen::Vector3d(0, -0.3, 0), 1e-6));
  EXPECT_TRUE(turned.bounds().max.isApprox(Eigen::Vector3d(0.1, 0, 0.2), 1e-6));
}

// A triangle that extends 1 along x, 2 along y and 3 along z in its file.
std::string collada_triangle(const std::string& up_axis, const std::string& metres) {
  return "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">"
         "<asset><unit meter=\"" +
         metres + "\"/><up_axis>" + up_axis +
         "</up_axis></asset><library_geometries><geometry id=\"g\"><mesh><source id=\"p\">"
         "<float_array id=\"a\" count=\"9\">0 0 0 1 0 0 0 2 3</float_array><technique_common>"
         "<accessor source=\"#a\" count=\"3\" stride=\"3\"><param name=\"X\" type=\"float\"/>"
         "<param name=\"Y\" type=\"float\"/><param name=\"Z\" type=\"float\"/></accessor></technique_common></source>"
         "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices><triangles count=\"1\">"
         "<input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 1 2</p></triangles></mesh></geometry>"
         "</library_geometries><library_visual_scenes><visual_scene id=\"s\"><node>"
         "<instance_geometry url=\"#g\"/></node></visual_scene></library_visual_scenes><scene>"
         "<instance_visual_scene url=\"#s\"/></scene></COLLADA>";
}

std::string gltf_triangle() {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
         R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,)"
         R"("componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,2,3]}],)"
         R"("bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":)"
         R"("data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAEAAAEBA"}]})";
}

TEST_F(MeshFile, KnowsItsAxisAndUpOverrules) {
  const Eigen::Vector3d as_it_is(1, 2, 3);
  const Eigen::Vector3d turned(1, 3, 2);  // y up: depth is the z of the file
  const auto extent = [](const std::filesystem::path& path, const MeshFileOptions& options) {
    return Eigen::Vector3d(read_mesh_file(path, options).bounds().extent());
  };
  const auto y_up = write("y.dae", collada_triangle("Y_UP", "1"));
  const auto z_up = write("z.DAE", collada_triangle("Z_UP", "1"));
  const auto gltf = write("y.gltf", gltf_triangle());
  const auto obj = write("two.obj", "v 0 0 0\nv 1 0 0\nv 0 2 3\nf 1 2 3\n");
  for (const auto& [path, by_itself] : {std::pair{y_up, turned}, {z_up, as_it_is}, {gltf, turned}, {obj, as_it_is}}) {
    EXPECT_TRUE(extent(path, {}).isApprox(by_itself, 1e-6)) << path << " " << extent(path, {}).transpose();
    EXPECT_TRUE(extent(path, {.up = MeshFileOptions::Up::Y}).isApprox(turned, 1e-6)) << path;
    EXPECT_TRUE(extent(path, {.up = MeshFileOptions::Up::Z}).isApprox(as_it_is, 1e-6)) << path;
  }
  // Not mirrored, and in the unit of the file.
  EXPECT_TRUE(read_mesh_file(y_up).bounds().min.isApprox(Eigen::Vector3d(0, -3, 0), 1e-6));
  EXPECT_TRUE(read_mesh_file(z_up).bounds().max.isApprox(Eigen::Vector3d(1, 2, 3), 1e-6));
  const auto small = write("small.dae", collada_triangle("Z_UP", "0.01"));
  EXPECT_TRUE(extent(small, {}).isApprox(0.01 * as_it_is, 1e-5)) << extent(small, {}).transpose();
  for (const std::string blank : {" ", "\n\t"}) {
    const auto spaced = write("spaced.dae", collada_triangle(blank + "Z_UP" + blank, blank + "0.01" + blank));
    EXPECT_TRUE(extent(spaced, {}).isApprox(0.01 * as_it_is, 1e-5)) << extent(spaced, {}).transpose();
    EXPECT_TRUE(extent(spaced, {.up = MeshFileOptions::Up::Y}).isApprox(0.01 * turned, 1e-5));
  }
}

TEST_F(MeshFile, SaysWhatIsWrongAndWhere) {
  const std::string missing = complaint([] { (void)read_mesh_file("/nowhere/house.ply"); });
  EXPECT_EQ(missing, "/nowhere/house.ply: there is no such file");
  const auto empty = write("empty.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  EXPECT_NE(complaint([&] { (void)read_mesh_file(empty); }).find(empty.string() + ": "), std::string::npos);
  const auto cloud = write("cloud.ply",
                           "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
                           "property float z\nend_header\n0 0 0\n1 1 1\n");
  EXPECT_NE(complaint([&] { (void)read_mesh_file(cloud); }).find(cloud.string() + ": "), std::string::npos);
  const auto nan = write("nan.ply",
                         "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                         "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                         "0 0 0\n1 nan 1\n0 1 0\n3 0 1 2\n");
  EXPECT_EQ(complaint([&] { (void)read_mesh_file(nan); }), nan.string() + ": vertex 1 is not finite");
  const auto garbage = write("garbage.ply", "this is no mesh");
  EXPECT_NE(complaint([&] { (void)read_mesh_file(garbage); }).find("cannot be read as a mesh"), std::string::npos);
  for (const char* unit : {"abc", "-1", "0", "1 m", ""}) {
    const auto dae = write("unit.dae", collada_triangle("Z_UP", unit));
    EXPECT_EQ(complaint([&] { (void)read_mesh_file(dae); }),
              dae.string() + ": its unit is meter=\"" + unit + "\", must be a number > 0");
  }
  EXPECT_EQ(complaint([&] { (void)read_mesh_file(nan, {.scale = 0.0}); }),
            "MeshFileOptions::scale is 0, must be > 0");
}

TEST(World, AnUnknownNameListsThoseThereAre) {
  EXPECT_EQ(
      complaint([] { (void)World::by_name("moon"); }),
      "there is no world \"moon\"; there are rooms, office, maze, two-storey, table, crates-open, crates-closed");
  EXPECT_EQ(complaint([] { (void)World::by_name("maze", {.length_m = 1.0}); }),
            "WorldOptions::length_m is 1, must be 0 or in [4, 200]");
  EXPECT_EQ(complaint([] { (void)World::by_name("rooms", {.width_m = 8.0}); }),
            "WorldOptions::width_m is 8, must be 0: rooms has a size of its own");
}

TEST(World, RoomsIsTheCubeOfThePaper) {
  const World rooms = World::by_name("rooms");
  EXPECT_TRUE(rooms.region.min.isZero());
  EXPECT_TRUE(rooms.region.max.isApprox(Eigen::Vector3d::Constant(10.2)));
  const World other = World::by_name("rooms", {.seed = 7});
  EXPECT_EQ(rooms.mesh.triangles, other.mesh.triangles);
}

TEST(World, SeedsMakeTheGeneratedWorlds) {
  for (const char* name : {"office", "maze"}) {
    const World one = World::by_name(name, {.seed = 1});
    EXPECT_EQ(one.mesh.vertices, World::by_name(name, {.seed = 1}).mesh.vertices) << name;
    EXPECT_NE(one.mesh.vertices, World::by_name(name, {.seed = 2}).mesh.vertices) << name;
    const World large = World::by_name(name, {.seed = 1, .length_m = 40.0, .width_m = 24.0});
    EXPECT_NEAR(large.region.max.x(), 40.0, 1.7) << name;
    EXPECT_NEAR(large.region.max.y(), 24.0, 1.7) << name;
  }
}

// A generated world is closed: every ray from an empty place hits a surface within the region, inside a cell and not
// on its border.
TEST(World, GeneratedWorldsAreClosedAndMeetRaysInsideTheirCells) {
  std::mt19937 engine(5);
  std::normal_distribution<double> normal;
  std::size_t rays = 0;
  const std::pair<const char*, SolidCells> worlds[]{{"rooms", rooms_cells()},
                                                    {"office", office_cells({})},
                                                    {"maze", maze_cells({})},
                                                    {"two-storey", two_storey_cells()}};
  for (const auto& [name, solid] : worlds) {
    const World world = World::by_name(name);
    const TriangleScene scene(world.mesh);
    const VoxelFrame frame{0.2};
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int i = 0; i < 4000; ++i) {
      const Eigen::Vector3d share(unit(engine), unit(engine), unit(engine));
      const Eigen::Vector3d origin = world.region.min + share.cwiseProduct(world.region.extent());
      if (solid[frame.cell_of(origin)] != 0) {
        continue;
      }
      const Eigen::Vector3d direction = Eigen::Vector3d(normal(engine), normal(engine), normal(engine)).normalized();
      const auto range_m = scene.hit_distance(origin, direction, 100.0);
      ASSERT_TRUE(range_m.has_value()) << name;
      const Eigen::Vector3d hit = origin + *range_m * direction;
      ASSERT_TRUE(world.region.contains(hit)) << name << " " << hit.transpose();
      const Eigen::Vector3d in_cell = (hit - frame.centre_of(frame.cell_of(hit))).cwiseAbs();
      EXPECT_EQ(solid[frame.cell_of(hit)], 1) << name << " " << hit.transpose();
      EXPECT_LT((in_cell.array() - 0.09).abs().minCoeff(), 1e-4) << name << " " << hit.transpose();
      ++rays;
    }
  }
  EXPECT_GT(rays, 8'000U);
}

TEST(World, TheTableStandsWhereTheReferenceDataHasIt) {
  const World table = World::by_name("table");
  const TriangleScene scene(table.mesh);
  EXPECT_NEAR(*scene.hit_distance({0.1, 0.2, 1.5}, {0, 0, -1}, 5.0), 1.5 - 0.427277, 1e-5);
  EXPECT_NEAR(*scene.hit_distance({-1.0, 0.1, 0.41}, {1, 0, 0}, 5.0), 0.6, 1e-5);
  EXPECT_NEAR(*scene.hit_distance({0.1, 1.0, 0.41}, {0, -1, 0}, 5.0), 0.5, 1e-5);
  EXPECT_NEAR(*scene.hit_distance({1.0, 1.0, 1.0}, {1, 0, 0}, 5.0), 0.8, 2e-3);
}

TEST(World, AMapIsAClosedTruth) {
  OccupancyMap map({.resolution_m = 0.1});
  map.assume_free({{0.01, 0.01, 0.01}, {0.99, 0.99, 0.99}});
  map.set({5, 5, 5}, Occupancy::Occupied);
  const World world = World::from_map("cube", map);
  const TriangleScene scene(world.mesh);
  EXPECT_NEAR(*scene.hit_distance({0.55, 0.55, 0.15}, {0, 0, 1}, 5.0), 0.355, 1e-5);
  EXPECT_NEAR(*scene.hit_distance({0.15, 0.55, 0.15}, {0, 0, 1}, 5.0), 0.855, 1e-5);
  EXPECT_THROW((void)World::from_map("nothing", OccupancyMap()), std::invalid_argument);
  map.set({30'000, 30'000, 30'000}, Occupancy::Occupied);  // two cells, and a box that fits into no memory
  EXPECT_NE(complaint([&] { (void)World::from_map("wide", map); }).find("World::from_map: count of cells"),
            std::string::npos);
}

TEST(World, ReadsARealHouse) {
  const char* data = std::getenv("VANTAGE_DATA");
  if (data == nullptr) {
    GTEST_SKIP() << "VANTAGE_DATA is not set: no real mesh to read";
  }
  const World house =
      World::from_mesh_file(std::filesystem::path(data) / "environments/aws_small_house/small_house_visual.ply");
  EXPECT_EQ(house.mesh.triangles.size(), 145'840U);
  EXPECT_EQ(house.name, "small_house_visual.ply");
  EXPECT_NEAR(house.region.extent().x(), 19.0, 1.0);
}

}  // namespace
}  // namespace vantage
