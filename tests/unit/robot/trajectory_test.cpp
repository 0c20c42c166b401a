// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vantage/robot/trajectory.hpp>
#include <vantage/robot/turning.hpp>
#include <vector>

namespace vantage {
namespace {

using Points = std::vector<Eigen::Vector3d>;
const MotionModel kFlyer{.max_speed_m_s = 2.0, .max_acceleration_m_s2 = 3.0, .max_yaw_rate_rad_s = 1.5};
const Trajectory::Admits kEverywhere = [](const Eigen::Vector3d&, const Eigen::Vector3d&) { return true; };

MotionState at_rest(const Eigen::Vector3d& position) { return {position, Eigen::Vector3d::Zero()}; }

// Speed, acceleration and continuity, by differences over short steps.
void expect_within_limits(const Trajectory& way, const MotionState& start, const MotionModel& motion) {
  constexpr double kStepS = 1e-3;
  MotionState before = way.at(0.0);
  EXPECT_LT((before.position_m - start.position_m).norm(), 1e-9);
  EXPECT_LT((before.velocity_m_s - start.velocity_m_s).norm(), 1e-9);
  for (double t = kStepS; t < way.duration_s() + 2.0 * kStepS; t += kStepS) {
    const MotionState now = way.at(t);
    EXPECT_LE(now.velocity_m_s.norm(), motion.max_speed_m_s + 1e-9);
    EXPECT_LE((now.velocity_m_s - before.velocity_m_s).norm(), motion.max_acceleration_m_s2 * kStepS + 1e-6);
    const Eigen::Vector3d mean = 0.5 * (now.velocity_m_s + before.velocity_m_s);
    EXPECT_LT((now.position_m - before.position_m - kStepS * mean).norm(),
              motion.max_acceleration_m_s2 * kStepS * kStepS);
    before = now;
  }
  EXPECT_EQ(way.at(way.duration_s()).velocity_m_s.norm(), 0.0);
}

Points random_corners(std::mt19937& random, std::size_t count) {
  std::uniform_real_distribution<double> metres(-3.0, 3.0);
  Points corners;
  for (std::size_t i = 0; i < count; ++i) {
    corners.emplace_back(metres(random), metres(random), 0.3 * metres(random));
  }
  return corners;
}

TEST(Trajectory, TakesTheTimeOfAStraightWay) {
  for (const double length : {0.01, 0.5, 1.3, 1.4, 20.0}) {
    const Points corners{{0, 0, 0}, {0.25 * length, 0, 0}, {length, 0, 0}};  // a corner that turns nowhere
    const auto way = Trajectory::through(at_rest(corners[0]), corners, kFlyer, kEverywhere);
    ASSERT_TRUE(way);
    // 16 speeds at the corner: it loses a little where the best lies between two of them.
    EXPECT_NEAR(way->duration_s(), kFlyer.travel_time_s(length), 0.01 * kFlyer.travel_time_s(length));
    EXPECT_GE(way->duration_s(), kFlyer.travel_time_s(length) - 1e-9);
    EXPECT_EQ(way->at(1e3).position_m, corners.back());
    EXPECT_EQ(way->passes_at_s().size(), 3U);
    expect_within_limits(*way, at_rest(corners[0]), kFlyer);
  }
  EXPECT_NEAR(kFlyer.travel_time_s(0.75), 1.0, 1e-12);
  EXPECT_NEAR(kFlyer.travel_time_s(10.0), 5.0 + 2.0 / 3.0, 1e-12);
}

// In small steps: towards the end as hard as it can while it can still stop there, else it brakes.
double travelled_in_steps_s(const MotionModel& motion, double length_m, double speed_m_s) {
  constexpr double kStepS = 1e-4;
  const double most = motion.max_acceleration_m_s2 * kStepS;
  double left_m = length_m;
  double speed = speed_m_s;
  double time_s = 0.0;
  while (std::abs(left_m) > 1e-3 || std::abs(speed) > 1e-2) {
    const double wanted = std::copysign(
        std::min(motion.max_speed_m_s, std::sqrt(2.0 * motion.max_acceleration_m_s2 * std::abs(left_m))), left_m);
    speed += std::clamp(wanted - speed, -most, most);
    left_m -= kStepS * speed;
    time_s += kStepS;
  }
  return time_s;
}

TEST(MotionModel, TravelTimeFromAnySpeedIsThatOfSmallSteps) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    const double length = i % 10 == 0 ? 0.0 : 4.0 * std::abs(share(random));
    const double speed = kFlyer.max_speed_m_s * share(random);
    EXPECT_NEAR(kFlyer.travel_time_s(length, speed), travelled_in_steps_s(kFlyer, length, speed), 0.05)
        << length << " m from " << speed << " m/s";
    EXPECT_EQ(kFlyer.travel_time_s(length, 0.0), kFlyer.travel_time_s(length));
  }
}

TEST(Trajectory, StaysWithinTheLimitsFromAnyStateOfMotion) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  std::size_t cases = 0;
  for (int i = 0; i < 100; ++i) {
    const Points corners = random_corners(random, 1 + static_cast<std::size_t>(i) % 6);
    MotionState start = at_rest(corners[0] + 0.1 * Eigen::Vector3d(share(random), share(random), share(random)));
    start.velocity_m_s = Eigen::Vector3d(share(random), share(random), share(random)) * 2.0 / std::sqrt(3.0);
    const auto way = Trajectory::through(start, corners, kFlyer, kEverywhere);
    ASSERT_TRUE(way);
    expect_within_limits(*way, start, kFlyer);
    EXPECT_LT((way->at(way->duration_s()).position_m - corners.back()).norm(), 1e-9);
    const Trajectory braked = way->braked(0.3 * way->duration_s(), kFlyer);
    expect_within_limits(braked, start, kFlyer);
    ++cases;
  }
  EXPECT_EQ(cases, 100U);
}

// The oracle: every pair of speeds before and after every corner, not only equal ones, on a fine grid.
double exhaustive_s(const Points& corners, const MotionModel& motion) {
  constexpr int kGrid = 30;
  const double a = motion.max_acceleration_m_s2;
  struct Round {
    double before_m, after_m, seconds, first, last;
  };
  const auto straight_s = [&](double length, double first, double last) {
    if (length < 0.0 || std::abs(first * first - last * last) > 2.0 * a * length) {
      return 1e9;
    }
    const double peak = std::min(motion.max_speed_m_s, std::sqrt(a * length + 0.5 * (first * first + last * last)));
    const double changing = (2.0 * peak * peak - first * first - last * last) / (2.0 * a);
    return (2.0 * peak - first - last) / a + (peak > 0.0 ? (length - changing) / peak : 0.0);
  };
  std::vector<std::pair<Round, double>> reached{{{0, 0, 0, 0, 0}, 0.0}};
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const double length = (corners[i] - corners[i - 1]).norm();
    std::vector<Round> rounds{{0, 0, 0, 0, 0}};
    if (i + 1 < corners.size()) {
      const Eigen::Vector3d in = (corners[i] - corners[i - 1]).normalized();
      const Eigen::Vector3d out = (corners[i + 1] - corners[i]).normalized();
      for (int j = 1; j <= kGrid; ++j) {
        for (int k = 1; k <= kGrid; ++k) {
          const double first = motion.max_speed_m_s * j / kGrid;
          const double last = motion.max_speed_m_s * k / kGrid;
          const double seconds = (last * out - first * in).norm() / a;
          rounds.push_back({0.5 * first * seconds, 0.5 * last * seconds, seconds, first, last});
        }
      }
    }
    std::vector<std::pair<Round, double>> next;
    for (const Round& round : rounds) {
      double best = 1e9;
      for (const auto& [from, time] : reached) {
        best = std::min(
            best, time + from.seconds + straight_s(length - from.after_m - round.before_m, from.last, round.first));
      }
      if (best < 1e8) {
        next.emplace_back(round, best);
      }
    }
    reached = std::move(next);
  }
  return reached.front().second;
}

TEST(Trajectory, IsAsFastAsAnExhaustiveSearchOnShortPaths) {
  std::mt19937 random(2);
  std::size_t cases = 0;
  double sum = 0.0;
  for (int i = 0; i < 30; ++i) {
    const Points corners = random_corners(random, 3 + static_cast<std::size_t>(i) % 2);
    const auto way = Trajectory::through(at_rest(corners[0]), corners, kFlyer, kEverywhere);
    ASSERT_TRUE(way);
    // It may round the first corner before it is at full speed, as the search may; it may leave corners out, which
    // the search may not.
    const double best_s = exhaustive_s(corners, kFlyer);
    EXPECT_LE(way->duration_s(), 1.05 * best_s);
    sum += way->duration_s() / best_s;
    ++cases;
  }
  EXPECT_EQ(cases, 30U);
  EXPECT_LT(sum / 30.0, 1.02);
}

TEST(Trajectory, RoundsACornerOnlyAsFarAsItMay) {
  const Points corners{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}};
  // A pillar on the inside of the corner.
  const Eigen::Vector3d pillar(2.8, 0.2, 0.0);
  const Trajectory::Admits past = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    for (double t = 0.0; t <= 1.0; t += 0.02) {
      if ((from + t * (to - from) - pillar).norm() < 0.15) {
        return false;
      }
    }
    return true;
  };
  const auto wide = Trajectory::through(at_rest(corners[0]), corners, kFlyer, kEverywhere);
  const auto narrow = Trajectory::through(at_rest(corners[0]), corners, kFlyer, past);
  ASSERT_TRUE(wide && narrow);
  const auto nearest = [&](const Trajectory& way) {
    double nearest_m = 1e9;
    for (const Eigen::Vector3d& point : way.points_from(0.0)) {
      nearest_m = std::min(nearest_m, (point - pillar).norm());
    }
    return nearest_m;
  };
  EXPECT_LT(nearest(*wide), 0.15);
  EXPECT_GE(nearest(*narrow), 0.15 - 1e-3);
  EXPECT_GT(narrow->duration_s(), wide->duration_s());
  EXPECT_LT(narrow->duration_s(), 2.0 * kFlyer.travel_time_s(3.0));  // it need not stop
  expect_within_limits(*narrow, at_rest(corners[0]), kFlyer);
}

TEST(Trajectory, SwingsOverWithoutAStop) {
  const MotionState moving{{0, 0, 0}, {2, 0, 0}};
  const Points aside{{0, 0, 0}, {3, 3, 0}};
  const auto way = Trajectory::through(moving, aside, kFlyer, kEverywhere);
  ASSERT_TRUE(way);
  double slowest = 2.0;
  for (double t = 0.0; t < 0.5 * way->duration_s(); t += 0.01) {
    slowest = std::min(slowest, way->at(t).velocity_m_s.norm());
  }
  EXPECT_GT(slowest, 1.0);
  EXPECT_LT(way->duration_s(), kFlyer.travel_time_s(3.0 * std::numbers::sqrt2));
  // Nothing is free but the way it came: it can only brake.
  const Trajectory::Admits ahead = [](const Eigen::Vector3d&, const Eigen::Vector3d& to) { return to.x() < 0.3; };
  EXPECT_FALSE(Trajectory::through(moving, aside, kFlyer, ahead));
}

TEST(Trajectory, ChordsAreNearTheCurve) {
  const Points corners{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}};
  const auto way = Trajectory::through(at_rest(corners[0]), corners, kFlyer, kEverywhere);
  ASSERT_TRUE(way);
  const Points points = way->points_from(0.2);
  EXPECT_LT((points.front() - way->at(0.2).position_m).norm(), 1e-12);
  for (double t = 0.2; t < way->duration_s(); t += 0.003) {
    const Eigen::Vector3d on = way->at(t).position_m;
    double off_m = 1e9;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const Eigen::Vector3d chord = points[i] - points[i - 1];
      const double share = std::clamp((on - points[i - 1]).dot(chord) / chord.squaredNorm(), 0.0, 1.0);
      off_m = std::min(off_m, (points[i - 1] + share * chord - on).norm());
    }
    EXPECT_LT(off_m, 1.01e-4);
  }
}

Eigen::Matrix3d yawed(double degrees) {
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

TEST(Turning, KeepsItsLimitsAndItsTime) {
  std::size_t cases = 0;
  for (const bool limited : {false, true}) {
    MotionModel motion = kFlyer;
    motion.max_yaw_acceleration_rad_s2 = limited ? std::optional(4.0) : std::nullopt;
    for (const double degrees : {1.0, 20.0, 90.0, 175.0, -140.0}) {
      Turning turning(yawed(10.0));
      const Eigen::Matrix3d goal = yawed(10.0 + degrees);
      const double angle = turning.angle_to_rad(goal);
      constexpr double kStepS = 0.01;
      double time_s = 0.0;
      while (turning.angle_to_rad(goal) > 1e-9 && time_s < 10.0) {
        const Eigen::Vector3d before = turning.rate_rad_s();
        turning.advance(goal, kStepS, motion);
        time_s += kStepS;
        EXPECT_LE(turning.rate_rad_s().norm(), motion.max_yaw_rate_rad_s + 1e-9);
        if (limited) {
          EXPECT_LE((turning.rate_rad_s() - before).norm(), 4.0 * kStepS + 1e-9);
        }
      }
      EXPECT_NEAR(time_s, motion.turn_time_s(angle), 5.0 * kStepS) << degrees;
      EXPECT_GT(time_s, motion.turn_time_s(angle) - kStepS);
      ++cases;
    }
  }
  EXPECT_EQ(cases, 10U);
}

TEST(Turning, TurnsBackFromAFullTurn) {
  MotionModel motion = kFlyer;
  motion.max_yaw_acceleration_rad_s2 = 4.0;
  Turning turning(yawed(0.0));
  for (int i = 0; i < 50; ++i) {
    turning.advance(yawed(120.0), 0.01, motion);
  }
  EXPECT_GT(turning.rate_rad_s().z(), 1.0);
  for (int i = 0; i < 300; ++i) {
    turning.advance(yawed(-20.0), 0.01, motion);
  }
  EXPECT_LT(turning.angle_to_rad(yawed(-20.0)), 1e-9);
  EXPECT_EQ(turning.rate_rad_s().norm(), 0.0);
}

TEST(MotionModel, RefusesWhatNoRobotDoes) {
  EXPECT_NO_THROW(MotionModel{}.validate());
  const auto refused = [](MotionModel model) { EXPECT_THROW(model.validate(), std::invalid_argument); };
  refused({.max_speed_m_s = 0.0});
  refused({.max_acceleration_m_s2 = -1.0});
  refused({.max_yaw_rate_rad_s = std::nan("")});
  refused({.max_yaw_acceleration_rad_s2 = 0.0});
  refused({.scan_rate_hz = 0.0});
  refused({.planning_latency_s = -0.1});
}

}  // namespace
}  // namespace vantage
