// SPDX-License-Identifier: MIT
// A depth camera looks at a wall from 1 m, and the map knows it.
#include <iostream>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/vision/depth_camera.hpp>
#include <vector>

int main() {
  const vantage::DepthCamera camera{.width = 64, .height = 48, .fx = 50.0, .fy = 50.0, .cx = 31.5, .cy = 23.5};
  const vantage::DepthImage wall{camera.width, camera.height, std::vector<float>(camera.width * camera.height, 1.0F)};
  const vantage::DepthScan seen = depth_scan(wall, camera, vantage::pose_looking({0.05, 0.05, 0.05}, 0.0));
  vantage::OccupancyMap map({.resolution_m = 0.1});
  map.insert(seen.scan);
  std::cout << seen.report.used << " pixels on a wall\n";
  return seen.report.used > 2000 && map.at({10, 0, 0}) == vantage::Occupancy::Occupied &&
                 map.at({5, 0, 0}) == vantage::Occupancy::Free
             ? 0
             : 1;
}
