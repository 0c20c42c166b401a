// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vantage/robot/capability_map.hpp>

namespace vantage {
namespace {

using Key = std::array<long, 3>;
const std::array<JointRange, 3> kRanges{{{-3.0, 3.0}, {-1.2, 1.9}, {0.0, 2.4}}};

/// A turret with two links of 0.6 m and 0.4 m; the sensor looks along the last link.
Pose turret(std::span<const double> joints) {
  const Eigen::AngleAxisd yaw(joints[0], Eigen::Vector3d::UnitZ());
  const Eigen::AngleAxisd shoulder(joints[1], Eigen::Vector3d::UnitY());
  const Eigen::AngleAxisd elbow(joints[2], Eigen::Vector3d::UnitY());
  return Eigen::Translation3d(0.0, 0.0, 0.3) * yaw * shoulder * Eigen::Translation3d(0.0, 0.0, 0.6) * elbow *
         Eigen::Translation3d(0.0, 0.0, 0.4);
}

/// The bin of a direction by exhaustive search: the bin on the same face of the cube whose bounding planes enclose
/// the direction.
std::size_t slow_bin(int edge, const Eigen::Vector3d& direction) {
  const auto n = static_cast<std::size_t>(edge);
  for (std::size_t bin = 0; bin < 6 * n * n; ++bin) {
    const auto axis = static_cast<Eigen::Index>(bin / (n * n) / 2);
    const double towards = bin / (n * n) % 2 == 1 ? direction[axis] : -direction[axis];
    const auto between = [&](double across, std::size_t step) {
      const double quarter = std::acos(-1.0) / 4.0;
      const double lo = std::tan(quarter * (2.0 * static_cast<double>(step) / edge - 1.0));
      const double hi = std::tan(quarter * (2.0 * static_cast<double>(step + 1) / edge - 1.0));
      return across > lo * towards && across < hi * towards;
    };
    if (towards > 0.0 && between(direction[(axis + 1) % 3], bin % n) &&
        between(direction[(axis + 2) % 3], bin / n % n)) {
      return bin;
    }
  }
  return 6 * n * n;
}

TEST(CapabilityMap, HoldsWhatWasDrawnAndNothingElse) {
  std::size_t cells_compared = 0;
  for (const int edge : {1, 4, 7}) {
    std::map<Key, std::set<std::size_t>> drawn;
    std::vector<Pose> poses;
    const CapabilityMapOptions options{.cell_m = 0.1, .direction_bins_per_edge = edge, .samples = 20'000, .seed = 5};
    const auto forward = [&](std::span<const double> joints) -> std::optional<Pose> {
      const Pose pose = turret(joints);
      if (pose.translation().z() < 0.0) {
        return std::nullopt;
      }
      const Eigen::Vector3d p = pose.translation();
      const auto floor = [](double metres) { return std::lround(std::floor(metres / 0.1)); };
      drawn[{floor(p.x()), floor(p.y()), floor(p.z())}].insert(slow_bin(edge, optical_axis(pose)));
      poses.push_back(pose);
      return pose;
    };
    const CapabilityMap map(forward, kRanges, options);
    ASSERT_GT(poses.size(), 10'000U);
    for (const Pose& pose : poses) {
      ASSERT_TRUE(map.contains(pose.translation(), optical_axis(pose)));
      ASSERT_TRUE(map.contains(map.frame().cell_of(pose.translation())));
    }
    EXPECT_EQ(map.reachable_cells(), drawn.size());
    for_each_cell(map.cells().grown(2), [&](const VoxelIndex& cell) {
      const auto found = drawn.find({cell.x, cell.y, cell.z});
      const std::set<std::size_t> expected = found == drawn.end() ? std::set<std::size_t>{} : found->second;
      std::set<std::size_t> bins;
      for (const Eigen::Vector3d& direction : map.directions_at(cell)) {
        bins.insert(slow_bin(edge, direction));
        ASSERT_TRUE(map.contains(map.frame().centre_of(cell), direction));
      }
      ASSERT_EQ(bins, expected);
      ASSERT_EQ(map.directions_in(cell), expected.size());
      ++cells_compared;
    });
    EXPECT_FALSE(map.contains(Eigen::Vector3d(0.0, 0.0, 5.0), Eigen::Vector3d::UnitX()));
    EXPECT_FALSE(map.contains(poses[0].translation(), Eigen::Vector3d::Zero()));
  }
  EXPECT_GT(cells_compared, 3U * 5000U);
}

TEST(CapabilityMap, BinsCoverEveryDirectionOnceAndHoldTheirMiddles) {
  const CapabilityMap map(turret, kRanges, {.cell_m = 0.2, .direction_bins_per_edge = 5, .samples = 100});
  ASSERT_EQ(map.bin_count(), 150U);
  for (std::size_t bin = 0; bin < map.bin_count(); ++bin) {
    EXPECT_EQ(map.bin_of(map.middle_of(bin)), bin);
    EXPECT_NEAR(map.middle_of(bin).norm(), 1.0, 1e-12);
  }
  std::mt19937_64 engine(2);
  std::normal_distribution<double> normal;
  std::set<std::size_t> met;
  for (int i = 0; i < 20'000; ++i) {
    const Eigen::Vector3d direction(normal(engine), normal(engine), normal(engine));
    const std::size_t bin = map.bin_of(direction);
    ASSERT_EQ(bin, slow_bin(5, direction));
    ASSERT_GT(direction.normalized().dot(map.middle_of(bin)), std::cos(0.32)) << "bins are about 18 degrees wide";
    met.insert(bin);
  }
  EXPECT_EQ(met.size(), 150U);
}

TEST(CapabilityMap, AgreesWithTheReachOfTheArm) {
  const CapabilityMap map(turret, kRanges, {.cell_m = 0.1, .samples = 100'000});
  for_each_cell(map.cells(), [&](const VoxelIndex& cell) {
    const double from_shoulder_m = (map.frame().centre_of(cell) - Eigen::Vector3d(0.0, 0.0, 0.3)).norm();
    if (map.contains(cell)) {
      EXPECT_LT(from_shoulder_m, 1.0 + 0.09);
    }
  });
  // Straight up with a straight elbow, the sensor looks up and never down.
  EXPECT_TRUE(map.contains(Eigen::Vector3d(0.01, 0.0, 1.27), Eigen::Vector3d(0.05, 0.02, 1.0)));
  EXPECT_FALSE(map.contains(Eigen::Vector3d(0.01, 0.0, 1.27), Eigen::Vector3d(0.0, 0.0, -1.0)));
}

TEST(CapabilityMap, TheSeedDecidesAndAFileKeepsAll) {
  const CapabilityMapOptions options{.cell_m = 0.07, .direction_bins_per_edge = 6, .samples = 5000, .seed = 3};
  const CapabilityMap one(turret, kRanges, options);
  EXPECT_TRUE(one == CapabilityMap(turret, kRanges, options));
  CapabilityMapOptions other = options;
  other.seed = 4;
  EXPECT_FALSE(one == CapabilityMap(turret, kRanges, other));
  const auto path = std::filesystem::path(::testing::TempDir()) / "turret.capability";
  one.save(path);
  EXPECT_TRUE(one == CapabilityMap::load(path));
}

std::string complaint_about(const std::filesystem::path& path) {
  try {
    (void)CapabilityMap::load(path);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(CapabilityMap, ADamagedFileIsRefusedSayingWhatIsWrong) {
  const auto path = std::filesystem::path(::testing::TempDir()) / "damaged.capability";
  CapabilityMap(turret, kRanges, {.cell_m = 0.2, .samples = 300}).save(path);
  std::ifstream file(path, std::ios::binary);
  const std::string whole(std::istreambuf_iterator<char>(file), {});
  const auto write = [&](const std::string& text) { std::ofstream(path, std::ios::binary) << text; };
  ASSERT_GT(whole.size(), 500U);
  for (std::size_t kept = 0; kept < whole.size(); kept += kept < 150 ? 1 : 97) {
    write(whole.substr(0, kept));
    const std::string complaint = complaint_about(path);
    ASSERT_EQ(complaint.find(path.string() + ": is "), 0U) << kept << " bytes: " << complaint;
    ASSERT_TRUE(kept < 25 || complaint.find("truncated") != std::string::npos) << complaint;
  }
  std::mt19937_64 engine(1);
  for (int i = 0; i < 500; ++i) {
    std::string damaged = whole;
    const std::size_t at = engine() % damaged.size();
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << engine() % 8));
    write(damaged);
    ASSERT_EQ(complaint_about(path).find(path.string() + ": "), 0U) << "byte " << at;
  }
  write(whole + "x");
  EXPECT_EQ(complaint_about(path), path.string() + ": goes on after its end");
  EXPECT_EQ(complaint_about("/nowhere/arm"), "/nowhere/arm: cannot be opened");
  EXPECT_THROW(CapabilityMap(turret, kRanges, {.samples = 1}).save("/nowhere/arm"), std::runtime_error);
}

TEST(CapabilityMap, BadOptionsAreNamed) {
  const auto complaint = [](const CapabilityMapOptions& options, std::span<const JointRange> ranges) -> std::string {
    try {
      (void)CapabilityMap(turret, ranges, options);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(complaint({.cell_m = 0.0}, kRanges), "CapabilityMapOptions::cell_m is 0, must be > 0");
  EXPECT_EQ(complaint({.direction_bins_per_edge = 33}, kRanges),
            "CapabilityMapOptions::direction_bins_per_edge is 33, must be in [1, 32]");
  EXPECT_EQ(complaint({.samples = 0}, kRanges), "CapabilityMapOptions::samples is 0, must be > 0");
  EXPECT_EQ(complaint({}, {}), "CapabilityMap needs at least one joint");
  const std::array<JointRange, 3> empty{{{0.0, 1.0}, {1.0, 0.5}, {0.0, 1.0}}};
  EXPECT_EQ(complaint({}, empty), "JointRange::min is 1, must be finite and <= max");
  EXPECT_THROW(CapabilityMap([](auto) { return std::nullopt; }, kRanges, {.samples = 10}), std::invalid_argument);
}

}  // namespace
}  // namespace vantage
