// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vantage/map/scan.hpp>
#include <vector>

namespace vantage::test {

/// One of the ten range scans of the Stanford bunny: points in its own frame, metres, and its pose.
struct BunnyScan {
  std::string name;
  Pose world_from_scan = Pose::Identity();
  std::vector<Eigen::Vector3f> points;
};

inline std::string unpacked(const std::filesystem::path& file) {
  std::string text;
  const gzFile in = gzopen(file.c_str(), "rb");
  EXPECT_NE(in, nullptr) << file;
  std::vector<char> buffer(1U << 16U);
  for (int read = 0; in != nullptr && (read = gzread(in, buffer.data(), unsigned(buffer.size()))) > 0;) {
    text.append(buffer.data(), std::size_t(read));
  }
  gzclose(in);
  return text;
}

/// Reads the scans that `bun.conf` lists: p_world = R(q)^T p + t.
inline std::vector<BunnyScan> bunny_scans(const std::filesystem::path& folder) {
  std::vector<BunnyScan> scans;
  std::ifstream list(folder / "bun.conf");
  std::string line;
  while (std::getline(list, line)) {
    std::istringstream words(line);
    std::string kind;
    BunnyScan scan;
    Eigen::Vector3d t;
    Eigen::Quaterniond q;
    if (!(words >> kind >> scan.name >> t.x() >> t.y() >> t.z() >> q.x() >> q.y() >> q.z() >> q.w()) ||
        kind != "bmesh") {
      continue;
    }
    scan.world_from_scan.linear() = q.normalized().toRotationMatrix().transpose();
    scan.world_from_scan.translation() = t;
    std::istringstream file(unpacked(folder / (scan.name + ".gz")));
    std::size_t vertices = 0;
    for (std::string word; file >> word && word != "end_header";) {
      if (word == "vertex") {
        file >> vertices;
      }
    }
    scan.points.resize(vertices);
    for (Eigen::Vector3f& point : scan.points) {
      file >> point.x() >> point.y() >> point.z();
    }
    EXPECT_TRUE(file.good()) << scan.name;
    scans.push_back(std::move(scan));
  }
  return scans;
}

}  // namespace vantage::test
