// SPDX-License-Identifier: MIT
// Draws a room of 2 m with one pillar and writes the picture to a file.
#include <algorithm>
#include <array>
#include <fstream>
#include <iostream>
#include <vantage/picture/floor_plan.hpp>

int main() {
  vantage::OccupancyMap map({.resolution_m = 0.1});
  map.set_log_odds({{0, 0, 0}, {20, 20, 10}}, -2.0);
  map.set_log_odds({{8, 8, 0}, {12, 12, 10}}, 3.5);
  const vantage::Picture picture =
      vantage::draw_floor_plan(map, {.title = "a pillar", .travelled = {{0.2, 0.2, 0.5}}});
  vantage::write_png(picture, "pillar.png");

  std::array<char, 4> start{};
  std::ifstream("pillar.png", std::ios::binary).read(start.data(), start.size());
  const auto [darkest, brightest] = std::minmax_element(picture.rgb.begin(), picture.rgb.end());
  std::cout << "a picture of " << picture.width << " x " << picture.height << " pixels, from " << int{*darkest}
            << " to " << int{*brightest} << '\n';
  return start == std::array<char, 4>{'\x89', 'P', 'N', 'G'} && *brightest - *darkest > 100 ? 0 : 1;
}
