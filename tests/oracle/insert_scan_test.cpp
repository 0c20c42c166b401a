// SPDX-License-Identifier: MIT
// The same real and random scans in octomap::OcTree::insertPointCloud and OccupancyMap::insert.
#include <bzlib.h>
#include <gtest/gtest.h>
#include <octomap/OcTree.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <sstream>
#include <vantage/map/occupancy_map.hpp>

#include "support/random_maps.hpp"
#include "support/real_data.hpp"

namespace vantage {
namespace {

// OctoMap uses float: a ray this close to a cell edge, metres, may pass on the other side.
constexpr double kEdge_m = 1e-4;

struct Ray {
  Eigen::Vector3d from;
  Eigen::Vector3d to;
};

// Whether the segment intersects the box grown by `margin` (shrunk if negative).
bool meets(const Ray& ray, const Box& box, double margin) {
  double enter = 0.0;
  double leave = 1.0;
  const Eigen::Vector3d step = ray.to - ray.from;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double lo = box.min[axis] - margin - ray.from[axis];
    const double hi = box.max[axis] + margin - ray.from[axis];
    if (step[axis] == 0.0) {
      if (lo > 0.0 || hi < 0.0) {
        return false;
      }
      continue;
    }
    enter = std::max(enter, std::min(lo / step[axis], hi / step[axis]));
    leave = std::min(leave, std::max(lo / step[axis], hi / step[axis]));
  }
  return enter <= leave;
}

struct Agreement {
  std::size_t cells = 0;
  std::size_t occupied = 0;
  std::size_t excused = 0;
  std::size_t unexcused = 0;
  std::string first_unexcused;
};

octomap::OcTreeKey key_of(const VoxelIndex& cell) {
  const auto key = [](std::int32_t i) { return static_cast<octomap::key_type>(i + 32768); };
  return {key(cell.x), key(cell.y), key(cell.z)};
}

class SideBySide {
 public:
  SideBySide(double resolution_m, RayPolicy policy)
      : map_(OccupancyMapOptions::octomap(resolution_m)), tree_(resolution_m), policy_(policy) {
    tree_.setProbHit(octomap::probability(0.85));
    tree_.setProbMiss(octomap::probability(-0.4));
    tree_.setClampingThresMin(octomap::probability(-2.0));
    tree_.setClampingThresMax(octomap::probability(3.5));
  }

  void insert(Scan scan) {
    // With one ray per end cell, a return on a face would redirect the whole ray, so neither map gets such returns.
    const auto on_face = [&](const Eigen::Vector3f& point) {
      const Eigen::Vector3d world = scan.world_from_sensor * point.cast<double>() / map_.resolution_m();
      return ((world.array() - world.array().round()).abs() * map_.resolution_m() < 2e-5).any();
    };
    if (policy_ == RayPolicy::EachEndCell) {
      std::erase_if(scan.points, on_face);
    }
    octomap::Pointcloud cloud;
    const Eigen::Vector3d origin = scan.world_from_sensor.translation();
    for (const Eigen::Vector3f& point : scan.points) {
      const Eigen::Vector3d world = scan.world_from_sensor * point.cast<double>();
      const Eigen::Vector3f rounded = world.cast<float>();
      cloud.push_back(rounded.x(), rounded.y(), rounded.z());
      const bool to_centre = policy_ == RayPolicy::EachEndCell;
      rays_.push_back({origin, to_centre ? map_.frame().centre_of(map_.frame().cell_of(world)) : world});
    }
    const Eigen::Vector3f from = origin.cast<float>();
    tree_.insertPointCloud(cloud, {from.x(), from.y(), from.z()}, -1.0, true, policy_ == RayPolicy::EachEndCell);
    map_.insert(scan, policy_);
  }

  Agreement compare() const {
    Agreement agreement;
    map_.for_each_known([&](const VoxelIndex& cell, Occupancy state) {
      ++agreement.cells;
      agreement.occupied += state == Occupancy::Occupied ? 1U : 0U;
      const octomap::OcTreeNode* node = tree_.search(key_of(cell));
      const bool agrees = node != nullptr && tree_.isNodeOccupied(node) == (state == Occupancy::Occupied) &&
                          std::abs(node->getLogOdds() - map_.log_odds(cell).value()) <= 1e-4;
      if (!agrees) {
        judge(cell, agreement);
      }
    });
    for (auto leaf = tree_.begin_leafs(); leaf != tree_.end_leafs(); ++leaf) {
      const octomap::OcTreeKey key = leaf.getIndexKey();
      const VoxelIndex cell{key[0] - 32768, key[1] - 32768, key[2] - 32768};
      EXPECT_EQ(leaf.getDepth(), 16U);
      if (map_.at(cell) == Occupancy::Unknown) {
        judge(cell, agreement);
      }
    }
    return agreement;
  }

 private:
  // A difference is accepted if a ray only touches the cell, or ends on a face of it (OctoMap then stops before the
  // cell): the ray, or its end, intersects the grown cell but not the shrunk one.
  void judge(const VoxelIndex& cell, Agreement& agreement) const {
    const Box box = map_.frame().box_of(cell);
    const auto grazes = [&](const Ray& ray) { return meets(ray, box, kEdge_m) && !meets(ray, box, -kEdge_m); };
    const bool excused = std::any_of(rays_.begin(), rays_.end(), [&](const Ray& ray) {
      return grazes(ray) || grazes({ray.to, ray.to});
    });
    ++(excused ? agreement.excused : agreement.unexcused);
    if (!excused && agreement.first_unexcused.empty()) {
      std::ostringstream text;
      const octomap::OcTreeNode* node = tree_.search(key_of(cell));
      text << "cell (" << cell.x << ", " << cell.y << ", " << cell.z << "): ours "
           << map_.log_odds(cell).value_or(NAN) << ", OctoMap " << (node == nullptr ? NAN : node->getLogOdds());
      agreement.first_unexcused = text.str();
    }
  }

  OccupancyMap map_;
  octomap::OcTree tree_;
  RayPolicy policy_;
  std::vector<Ray> rays_;
};

// Inserts the scans with both policies. At most one cell in 10,000 may be an accepted difference.
void expect_agreement(const std::vector<Scan>& scans, double resolution_m, std::size_t least_cells) {
  for (const RayPolicy policy : {RayPolicy::EveryReturn, RayPolicy::EachEndCell}) {
    SideBySide both(resolution_m, policy);
    for (const Scan& scan : scans) {
      both.insert(scan);
    }
    const Agreement agreement = both.compare();
    const char* name = policy == RayPolicy::EveryReturn ? "every_return" : "each_end_cell";
    EXPECT_EQ(agreement.unexcused, 0U) << name << ": " << agreement.first_unexcused;
    EXPECT_GT(agreement.cells, least_cells) << name;
    EXPECT_GT(agreement.occupied, 0U) << name;
    EXPECT_LE(agreement.excused, agreement.cells / 10'000) << name;
    testing::Test::RecordProperty(std::string(name) + "_cells", std::to_string(agreement.cells));
    testing::Test::RecordProperty(std::string(name) + "_excused", std::to_string(agreement.excused));
  }
}

Pose pose_of(const Eigen::Vector3d& translation, const Eigen::Quaterniond& rotation) {
  return Eigen::Translation3d(translation) * rotation.normalized();
}

// A scan of every `keep`-th point of `points_m` (world), in the sensor frame.
Scan scan_at(const Pose& world_from_sensor, const std::vector<Eigen::Vector3d>& points_m, std::size_t keep) {
  Scan scan;
  scan.world_from_sensor = world_from_sensor;
  for (std::size_t i = 0; i < points_m.size(); i += keep) {
    scan.points.push_back(points_m[i].cast<float>());
  }
  return scan;
}

TEST(InsertScanLikeOctomap, RandomScans) {
  std::mt19937 engine(41);
  for (int world = 0; world < 12; ++world) {
    std::vector<Scan> scans;
    for (int i = 0; i < 6; ++i) {
      scans.push_back(test::random_scan(engine, 400, std::numeric_limits<double>::infinity()));
      scans.back().no_return.clear();  // OctoMap has no such rays
    }
    expect_agreement(scans, world % 2 == 0 ? 0.05 : 0.1, 15'000);
  }
}

std::string read_bz2(const std::filesystem::path& path) {
  std::string text;
  BZFILE* file = BZ2_bzopen(path.c_str(), "rb");
  char buffer[1 << 16];
  for (int read = 0; file != nullptr && (read = BZ2_bzread(file, buffer, sizeof buffer)) > 0;) {
    text.append(buffer, static_cast<std::size_t>(read));
  }
  BZ2_bzclose(file);
  return text;
}

std::string read_gz(const std::filesystem::path& path) {
  std::string text;
  const gzFile file = gzopen(path.c_str(), "rb");
  char buffer[1 << 16];
  for (int read = 0; file != nullptr && (read = gzread(file, buffer, sizeof buffer)) > 0;) {
    text.append(buffer, static_cast<std::size_t>(read));
  }
  gzclose(file);
  return text;
}

std::vector<Eigen::Vector3d> read_points(std::istream& stream, std::size_t most) {
  std::vector<Eigen::Vector3d> points;
  Eigen::Vector3d point;
  while (points.size() < most && stream >> point.x() >> point.y() >> point.z()) {
    points.push_back(point);
  }
  return points;
}

TEST(InsertScanLikeOctomap, ALaserScan) {
  VANTAGE_REAL_DATA(path, "octomaps/scan.dat.bz2");
  std::istringstream stream(read_bz2(path));
  const std::vector<Eigen::Vector3d> points = read_points(stream, 1'000'000);
  ASSERT_EQ(points.size(), 88'206U);
  // Off the lattice: from the corner of four cells, all diagonal rays would pass along edges.
  const Pose pose = pose_of({0.0123, 0.0217, 0.0171}, Eigen::Quaterniond(0.9, 0.1, -0.2, 0.3));
  expect_agreement({scan_at(pose, points, 4)}, 0.05, 100'000);
}

TEST(InsertScanLikeOctomap, TheTenRangeScansOfTheBunny) {
  VANTAGE_REAL_DATA(folder, "object_scans/stanford_bunny_range");
  std::ifstream conf(folder / "bun.conf");
  std::string line;
  std::vector<Scan> scans;
  while (std::getline(conf, line)) {
    std::istringstream words(line);
    std::string kind;
    std::string name;
    Eigen::Vector3d t;
    Eigen::Quaterniond q;
    if (!(words >> kind >> name >> t.x() >> t.y() >> t.z() >> q.x() >> q.y() >> q.z() >> q.w()) || kind != "bmesh") {
      continue;
    }
    const std::string text = read_gz(folder / (name + ".gz"));
    const std::size_t vertices_at = text.find("element vertex ") + 15;
    std::istringstream body(text.substr(text.find("end_header\n") + 11));
    std::vector<Eigen::Vector3d> points = read_points(body, std::stoul(text.substr(vertices_at)));
    // The scanner looks along its own -z; the distance can be chosen.
    const Eigen::Vector3d viewpoint(0.0031, 0.1012, 0.4017);
    for (Eigen::Vector3d& point : points) {
      point -= viewpoint;
    }
    const Pose world_from_scan = pose_of(t, q.conjugate());
    scans.push_back(scan_at(world_from_scan * Eigen::Translation3d(viewpoint), points, 10));
  }
  ASSERT_EQ(scans.size(), 10U);
  expect_agreement(scans, 0.005, 40'000);
}

TEST(InsertScanLikeOctomap, DepthImagesOfAKitchen) {
  VANTAGE_REAL_DATA(folder, "rgbd/7scenes_redkitchen_40");
  std::vector<Scan> scans;
  for (int frame = 0; frame < 1000; frame += 100) {
    char name[32];
    std::snprintf(name, sizeof name, "frame-%06d", frame);
    std::ifstream file(folder / (std::string(name) + ".pose.txt"));
    Eigen::Matrix4d matrix;
    for (int i = 0; i < 16; ++i) {
      file >> matrix(i / 4, i % 4);
    }
    ASSERT_TRUE(file) << name;
    const cv::Mat depth = cv::imread((folder / (std::string(name) + ".depth.png")).string(), cv::IMREAD_UNCHANGED);
    ASSERT_EQ(depth.type(), CV_16UC1) << name;
    std::vector<Eigen::Vector3d> points;
    for (int v = 0; v < depth.rows; v += 6) {
      for (int u = 0; u < depth.cols; u += 6) {
        const double z = depth.at<std::uint16_t>(v, u) * 1e-3;
        if (z > 0.0 && z < 65.0) {
          points.emplace_back(z * (u - 320.0) / 585.0, z * (v - 240.0) / 585.0, z);
        }
      }
    }
    const Eigen::Quaterniond rotation(Eigen::Matrix3d(matrix.topLeftCorner<3, 3>()));
    scans.push_back(scan_at(pose_of(matrix.topRightCorner<3, 1>(), rotation), points, 1));
  }
  ASSERT_EQ(scans.size(), 10U);
  expect_agreement(scans, 0.02, 200'000);
}

TEST(InsertScanLikeOctomap, LidarKeyframes) {
  VANTAGE_REAL_DATA(folder, "lidar/kitti07_keyframes_5_gtsam_points");
  std::ifstream graph(folder / "graph.txt");
  std::string id;
  Eigen::Vector3d t;
  Eigen::Quaterniond q;
  std::vector<Scan> scans;
  while (scans.size() < 5 && graph >> id >> t.x() >> t.y() >> t.z() >> q.x() >> q.y() >> q.z() >> q.w()) {
    std::ifstream file(folder / ("00000" + std::to_string(scans.size()) + ".points.bin"), std::ios::binary);
    std::vector<Eigen::Vector3d> points;
    float xyz[3];
    while (file.read(reinterpret_cast<char*>(xyz), sizeof xyz)) {
      points.emplace_back(xyz[0], xyz[1], xyz[2]);
    }
    ASSERT_GT(points.size(), 15'000U);
    scans.push_back(scan_at(pose_of(t, q), points, 10));
  }
  ASSERT_EQ(scans.size(), 5U);
  expect_agreement(scans, 0.2, 200'000);
}

}  // namespace
}  // namespace vantage
