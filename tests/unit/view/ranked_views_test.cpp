// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vantage/raytrace/following_caster.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vector>

#include <vantage/view/impl/ranked_views.hpp>

namespace vantage {
namespace {

struct RankedOne {
  int number = 0;
  double value = 0.0;
  std::uint64_t operations = 0;
  std::vector<std::size_t> rays = {};  // with which it was evaluated
};

// Values with few rays are off. Which candidates are left, and in which order, is computed from the definition.
TEST(RankViews, TheBestAreToldApartWithMoreRays) {
  OccupancyMap map({.resolution_m = 0.1});
  map.set({0, 0, 0}, Occupancy::Free);
  FollowingCaster looking;
  looking.follow(map, RangeSensor::preset("kinect"));
  const std::size_t all = looking.rays().size();
  const std::size_t medium = looking.medium_rays().size();
  const std::size_t few = looking.sparse_rays().size();
  EXPECT_LT(few, medium);
  EXPECT_LT(medium, all);
  std::mt19937 engine(31);
  std::uniform_real_distribution<double> draw(0.0, 1.0);
  const auto before = [](const RankedOne& a, const RankedOne& b) { return a.value > b.value; };
  for (const std::size_t count : {0U, 1U, 4U, 5U, 6U, 40U}) {
    for (const std::size_t best : {1U, 2U, 5U, 9U}) {
      constexpr std::size_t kFinalists = 5;
      std::vector<std::vector<double>> values(count);  // with few, medium and all rays
      std::vector<RankedOne> candidates(count);
      for (std::size_t i = 0; i < count; ++i) {
        values[i] = {draw(engine), draw(engine), draw(engine)};
        candidates[i].number = static_cast<int>(i);
      }
      const auto value_of = [&](int number, std::size_t rays) {
        return values[static_cast<std::size_t>(number)][rays == few ? 0 : rays == medium ? 1 : 2];
      };
      std::vector<RankedOne> expected = candidates;
      const auto rank = [&](std::size_t rays, std::size_t first) {
        const auto end = expected.begin() + static_cast<std::ptrdiff_t>(std::min(first, expected.size()));
        std::for_each(expected.begin(), end, [&](RankedOne& one) { one.value = value_of(one.number, rays); });
        std::sort(expected.begin(), end, before);
      };
      const bool is_many = count > kFinalists;
      if (is_many) {
        rank(few, count);
        expected.resize(kFinalists);
      }
      if (is_many && best < kFinalists) {
        rank(medium, kFinalists);
      }
      rank(all, is_many ? best : count);

      std::uint64_t operations = 0;
      detail::rank_views(
          looking, 2, candidates, kFinalists, best, operations,
          [&](RankedOne& candidate, const ViewRays& rays) {
            candidate.value = value_of(candidate.number, rays.size());
            candidate.operations += 10;
            candidate.rays.push_back(rays.size());
          },
          before);
      ASSERT_EQ(candidates.size(), expected.size());
      std::size_t evaluated = is_many ? count - kFinalists : 0;
      for (std::size_t i = 0; i < candidates.size(); ++i) {
        EXPECT_EQ(candidates[i].number, expected[i].number);
        EXPECT_EQ(candidates[i].value, expected[i].value);
        EXPECT_EQ(candidates[i].rays.back() == all, !is_many || i < best);
        evaluated += candidates[i].rays.size();
      }
      EXPECT_EQ(operations, 10 * evaluated);
    }
  }
}

}  // namespace
}  // namespace vantage
