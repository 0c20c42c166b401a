// SPDX-License-Identifier: MIT
// Stereo on pictures that others took, against the truth they measured.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <utility>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/vision/recording.hpp>
#include <vantage/vision/stereo_matcher.hpp>
#include <vector>

#include "support/real_data.hpp"

namespace vantage {
namespace {

// A grey .pfm image, rows from the top.
std::vector<float> read_pfm(const std::filesystem::path& file, std::size_t& width, std::size_t& height) {
  std::ifstream in(file, std::ios::binary);
  std::string kind;
  double scale = 0.0;
  in >> kind >> width >> height >> scale;
  in.get();
  EXPECT_EQ(kind, "Pf");
  EXPECT_LT(scale, 0.0) << "little-endian";
  std::vector<float> values(width * height);
  for (std::size_t row = height; row-- > 0;) {
    in.read(reinterpret_cast<char*>(values.data() + row * width), std::streamsize(width * sizeof(float)));
  }
  EXPECT_TRUE(in.good());
  return values;
}

double median_of(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
  return values.at(values.size() / 2);
}

TEST(RealStereo, MotorcycleAgainstTheTruth) {
  VANTAGE_REAL_DATA(folder, "stereo/middlebury2014_motorcycle");
  const StereoRig motorcycle = read_middlebury_calibration(folder / "calib.txt");
  std::size_t width = 0;
  std::size_t height = 0;
  const std::vector<float> truth = read_pfm(folder / "motorcycle_disp.pfm", width, height);
  ASSERT_EQ(width, motorcycle.width);
  for (const StereoMethod method : {StereoMethod::SemiGlobal, StereoMethod::Block}) {
    const bool block = method == StereoMethod::Block;
    const StereoMatcher matcher(motorcycle, {.method = method, .disparities_px = 80, .window_px = block ? 15 : 5});
    const StereoDepth seen = matcher.match(folder / "motorcycle_left.png", folder / "motorcycle_right.png");
    std::size_t known = 0;
    std::size_t bad = 0;
    std::vector<double> error_m;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      known += std::isfinite(truth[i]) ? 1U : 0U;
      if (std::isfinite(truth[i]) && std::isfinite(seen.disparity_px[i])) {
        bad += std::abs(seen.disparity_px[i] - truth[i]) > 2.0F ? 1U : 0U;
        error_m.push_back(std::abs(double(seen.depth.z_m[i]) - motorcycle.depth_m(double(truth[i]))));
      }
    }
    ASSERT_GT(error_m.size(), 100'000U);
    const double bad_share = double(bad) / double(error_m.size());
    const double density = double(error_m.size()) / double(known);
    const double median_m = median_of(error_m);
    std::printf("%s: bad-2.0 %.2f %%, median depth error %.1f mm, density %.1f %%\n", block ? "block" : "semi-global",
                100.0 * bad_share, 1000.0 * median_m, 100.0 * density);
    EXPECT_LT(bad_share, 0.08);
    EXPECT_LT(median_m, 0.02);
    EXPECT_GT(density, 0.6);
  }
}

// Free cells of one pair in which the next one measures a surface, as a share of the cells that it hits. Noise alone
// does that: at a share x of the range the depth of a match has a standard deviation of x^2 cells, and two such
// depths are more than a cell apart the wrong way round with the probability Q(1 / (sqrt(2) x^2)), 24 % at the end of
// the range and 2 % half-way. 15 % is what surfaces spread over the outer half would show; wrong matches, poses or
// calibration show more.
TEST(RealStereo, KittiPairsContradictEachOtherSeldom) {
  VANTAGE_REAL_DATA(folder, "stereo/kitti_odometry_seq1_30");
  const OccupancyMapOptions options{.resolution_m = 0.2};
  const Recording recording = Recording::open("kitti-stereo", folder, {.cell_m = options.resolution_m});
  ASSERT_EQ(recording.frames().size(), 30U);
  OccupancyMap all(options);
  OccupancyMap before(options);
  std::size_t hits = 0;
  std::size_t contradicted = 0;
  for (std::size_t i = 0; i < recording.frames().size(); ++i) {
    const Scan scan = recording.read(i).scan.scan;
    OccupancyMap now(options);
    now.insert(scan);
    if (i > 0) {
      now.for_each_known([&](const VoxelIndex& cell, Occupancy state) {
        hits += state == Occupancy::Occupied ? 1U : 0U;
        contradicted += state == Occupancy::Occupied && before.at(cell) == Occupancy::Free ? 1U : 0U;
      });
    }
    all.insert(scan);
    before = std::move(now);
  }
  const double share = double(contradicted) / double(hits);
  const OccupancyMap::Counts counts = all.counts();
  std::printf(
      "30 pairs: %zu of %zu surface cells were free in the pair before, %.1f %%; map: %zu free, %zu occupied\n",
      contradicted, hits, 100.0 * share, counts.free, counts.occupied);
  EXPECT_GT(hits, 50'000U);
  EXPECT_GT(counts.occupied, 5'000U);
  EXPECT_LT(share, 0.15);
}

}  // namespace
}  // namespace vantage
