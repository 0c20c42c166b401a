// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vantage/arm/kinematic_chain.hpp>

#include "arm/segment_distance.hpp"
#include "support/tracked_arm.hpp"

namespace vantage {
namespace {

Eigen::Matrix4d turn(int axis, double angle_rad) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  matrix(u, u) = matrix(v, v) = std::cos(angle_rad);
  matrix(v, u) = std::sin(angle_rad);
  matrix(u, v) = -std::sin(angle_rad);
  return matrix;
}

Eigen::Matrix4d shift(double x, double y, double z) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topRightCorner<3, 1>() = Eigen::Vector3d(x, y, z);
  return matrix;
}

TEST(KinematicChain, DhChainsGoWhereTheProductOfTheirMatricesGoes) {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> any(-1.5, 1.5);
  std::size_t compared = 0;
  for (int round = 0; round < 60; ++round) {
    std::vector<DhRow> rows(1 + engine() % 7);
    for (DhRow& row : rows) {
      row = {any(engine), any(engine), any(engine), any(engine), {-2.0, 2.0}, engine() % 4 == 0};
    }
    const KinematicChain chain = KinematicChain::from_dh(rows, Pose(shift(0.1, 0.2, 0.3)));
    ASSERT_EQ(chain.joint_count(), rows.size());
    for (int i = 0; i < 20; ++i) {
      const Joints joints = test::random_joints(chain, engine);
      Eigen::Matrix4d expected = Eigen::Matrix4d::Identity();
      const std::vector<Pose> links = chain.link_poses(joints);
      ASSERT_EQ(links.size(), rows.size() + 2);
      for (std::size_t j = 0; j < rows.size(); ++j) {
        const DhRow& row = rows[j];
        expected = expected * turn(2, row.theta_rad + (row.slides ? 0.0 : joints[j])) *
                   shift(0.0, 0.0, row.d_m + (row.slides ? joints[j] : 0.0)) * shift(row.a_m, 0.0, 0.0) *
                   turn(0, row.alpha_rad);
        ASSERT_LT((links[j + 1].matrix() - expected).cwiseAbs().maxCoeff(), 1e-9);
        ASSERT_LE(expected.topRightCorner(3, 1).norm(), chain.reach_m() + 1e-9);
      }
      expected = expected * shift(0.1, 0.2, 0.3);
      ASSERT_LT((chain.sensor_pose(joints).matrix() - expected).cwiseAbs().maxCoeff(), 1e-9);
      ASSERT_LE(expected.topRightCorner(3, 1).norm(), chain.reach_m() + 1e-9);
      ++compared;
    }
  }
  EXPECT_EQ(compared, 1200U);
}

TEST(KinematicChain, TheTrackedArmGoesWhereItsFileSays) {
  const KinematicChain chain = test::tracked_arm();
  ASSERT_EQ(chain.joint_names(), (std::vector<std::string>{"turret", "shoulder", "elbow", "wrist", "pan"}));
  EXPECT_EQ(chain.ranges()[2].max, 2.6);
  std::mt19937_64 engine(2);
  for (int i = 0; i < 1000; ++i) {
    const Joints q = test::random_joints(chain, engine);
    // Camera (z forward, x right, y down) on a head with x forward
    Eigen::Matrix4d camera = Eigen::Matrix4d::Identity();
    camera.topLeftCorner<3, 3>() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    const Eigen::Matrix4d expected = shift(0, 0, 0.25) * turn(2, q[0]) * shift(0, 0, 0.15) * turn(1, q[1]) *
                                     shift(0, 0, 0.45) * turn(1, q[2]) * shift(0, 0, 0.45) * turn(1, q[3]) *
                                     shift(0, 0, 0.05) * turn(2, q[4]) * shift(0.03, 0, 0.02) * camera;
    ASSERT_LT((chain.sensor_pose(q).matrix() - expected).cwiseAbs().maxCoeff(), 1e-9);
    ASSERT_TRUE(chain.link_poses(q).back().isApprox(chain.sensor_pose(q), 1e-12));
  }
  EXPECT_TRUE(optical_axis(chain.sensor_pose(Joints(5, 0.0))).isApprox(Eigen::Vector3d::UnitX(), 1e-9));
  // The reach is about 1 m from the shoulder, as in the paper.
  EXPECT_NEAR((chain.sensor_pose(Joints(5, 0.0)).translation() - Eigen::Vector3d(0, 0, 0.4)).norm(), 0.97, 0.03);
}

// Random chains with all joint types and any number of capsules per link.
TEST(KinematicChain, TheBodyIsWhereTheLinksAre) {
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> any(-1.5, 1.5);
  const auto compare = [&](const KinematicChain& chain) {
    const Joints joints = test::random_joints(chain, engine);
    const std::vector<Pose> links = chain.link_poses(joints);
    const std::vector<Capsule> body = chain.body_at(joints);
    ASSERT_EQ(body.size(), chain.capsules().size());
    for (std::size_t i = 0; i < body.size(); ++i) {
      const Capsule& capsule = chain.capsules()[i];
      ASSERT_EQ(body[i].link, capsule.link);
      ASSERT_EQ(body[i].radius_m, capsule.radius_m);
      ASSERT_LT((body[i].from_m - links[capsule.link] * capsule.from_m).norm(), 1e-9);
      ASSERT_LT((body[i].to_m - links[capsule.link] * capsule.to_m).norm(), 1e-9);
    }
    ASSERT_EQ(chain.touches_itself(links), chain.touches_itself(body));
  };
  std::size_t capsules_in_all = 0;
  for (int round = 0; round < 300; ++round) {
    std::vector<DhRow> rows(1 + engine() % 7);
    for (DhRow& row : rows) {
      row = {any(engine), any(engine), any(engine), any(engine), {-2.0, 2.0}, engine() % 4 == 0};
    }
    std::vector<Capsule> capsules(engine() % 6);
    for (Capsule& capsule : capsules) {
      const auto point = [&] { return Eigen::Vector3d(any(engine), any(engine), any(engine)); };
      capsule = {engine() % (rows.size() + 2), point(), point(), 0.3};
    }
    capsules_in_all += capsules.size();
    compare(KinematicChain::from_dh(rows, Pose(shift(0.1, 0.2, 0.3)), capsules));
  }
  EXPECT_GT(capsules_in_all, 500U);
  for (int i = 0; i < 300; ++i) {
    compare(test::tracked_arm());
  }
  EXPECT_THROW((void)test::tracked_arm().body_at(Joints(4, 0.1)), std::invalid_argument);
}

// Random chains with revolute and prismatic joints.
TEST(KinematicChain, InverseKinematicsTakesAnyChain) {
  std::mt19937_64 engine(8);
  std::uniform_real_distribution<double> any(-1.5, 1.5);
  std::uniform_real_distribution<double> off(-0.2, 0.2);
  for (std::size_t count = 1; count <= 9; ++count) {
    std::size_t found = 0;
    for (int i = 0; i < 60; ++i) {
      std::vector<DhRow> rows(count);
      for (DhRow& row : rows) {
        row = {any(engine), any(engine), any(engine), any(engine), {-2.0, 2.0}, engine() % 4 == 0};
      }
      const KinematicChain chain = KinematicChain::from_dh(rows, Pose(shift(0.1, 0.2, 0.3)));
      Joints guess = test::random_joints(chain, engine);
      const Pose target = chain.sensor_pose(guess);
      for (double& value : guess) {
        value += off(engine);
      }
      if (const auto back = chain.inverse(target, guess)) {
        ++found;
        ASSERT_TRUE(chain.in_range(*back));
        ASSERT_TRUE(chain.sensor_pose(*back).isApprox(target, 1e-5));
      }
    }
    EXPECT_GT(found, 50U) << count << " joints";
  }
}

// Starts from joint values that are off by up to 0.4 each.
TEST(KinematicChain, InverseKinematicsLeadsBackToThePose) {
  const KinematicChain chain = test::tracked_arm();
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> off(-0.4, 0.4);
  for (const bool free_roll : {false, true}) {
    std::size_t found = 0;
    for (int i = 0; i < 2000; ++i) {
      const Joints joints = test::random_joints(chain, engine);
      Joints guess = joints;
      for (double& value : guess) {
        value += off(engine);
      }
      Pose target = chain.sensor_pose(joints);
      if (free_roll) {
        target.rotate(Eigen::AngleAxisd(3.0 * off(engine), Eigen::Vector3d::UnitZ()));
      }
      const auto back = chain.inverse(target, guess, {.free_roll = free_roll});
      if (!back) {
        continue;
      }
      ++found;
      ASSERT_TRUE(chain.in_range(*back));
      const Pose reached = chain.sensor_pose(*back);
      ASSERT_LT((reached.translation() - target.translation()).norm(), 1.1e-6);
      ASSERT_LT((optical_axis(reached) - optical_axis(target)).norm(), 1.1e-6);
      ASSERT_TRUE(free_roll || reached.isApprox(target, 1e-5));
    }
    EXPECT_GT(found, 1900U) << free_roll;
  }
  Pose far = Pose::Identity();
  far.translation().x() = 3.0;
  EXPECT_FALSE(chain.inverse(far, Joints(5, 0.1)).has_value());
  EXPECT_THROW((void)chain.inverse(far, Joints(4, 0.1)), std::invalid_argument);
  EXPECT_THROW((void)chain.sensor_pose(Joints(6, 0.1)), std::invalid_argument);
  EXPECT_FALSE(chain.in_range(Joints(6, 0.1)));
  EXPECT_FALSE(chain.in_range(Joints{0.0, 0.0, -0.1, 0.0, 0.0}));
}

TEST(SegmentDistance, IsTheLeastOverAllPairsOfPoints) {
  std::mt19937_64 engine(4);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const auto point = [&] { return Eigen::Vector3d(any(engine), any(engine), any(engine)); };
  for (int round = 0; round < 400; ++round) {
    const Eigen::Vector3d a0 = point();
    const Eigen::Vector3d a1 = round % 5 == 0 ? a0 : point();
    const Eigen::Vector3d b0 = point();
    const Eigen::Vector3d b1 = round % 7 == 0    ? b0
                               : round % 11 == 0 ? Eigen::Vector3d(b0 + 0.3 * (a1 - a0))
                                                 : point();
    double least = 1e9;
    constexpr int kSteps = 100;
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; j <= kSteps; ++j) {
        const double s = static_cast<double>(i) / kSteps;
        const double t = static_cast<double>(j) / kSteps;
        least = std::min(least, (a0 + s * (a1 - a0) - b0 - t * (b1 - b0)).norm());
      }
    }
    const double distance = segment_distance(a0, a1, b0, b1);
    ASSERT_LE(distance, least + 1e-12);
    ASSERT_GE(distance, least - 0.04);
    ASSERT_NEAR(distance, segment_distance(b1, b0, a0, a1), 1e-12);
  }
}

TEST(KinematicChain, KnowsWhenItTouchesItself) {
  const KinematicChain chain = test::tracked_arm();
  const auto touches = [&](const Joints& joints) { return chain.touches_itself(chain.link_poses(joints)); };
  EXPECT_FALSE(touches({0.0, 0.0, 0.0, 0.0, 0.0})) << "straight up";
  EXPECT_FALSE(touches({0.5, -0.5, 1.8, 0.2, 0.3})) << "bent over its base";
  EXPECT_FALSE(touches({0.0, 1.85, 1.4, 0.0, 0.0})) << "hand before the tracks";
  EXPECT_TRUE(touches({0.0, 1.85, 2.3, 0.0, 0.0})) << "hand on the tracks";
  EXPECT_EQ(chain.joints_before(0), 0U);
  EXPECT_GT(chain.capsules().size(), 6U);
}

std::string complaint(const std::function<void()>& act) {
  try {
    act();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

TEST(KinematicChain, SaysWhatIsWrongWithAFile) {
  const auto read = [](const std::string& text, const char* base = "a", const char* sensor = "b") {
    return complaint([&] { (void)KinematicChain::from_urdf_text(text, base, sensor, "x.urdf"); });
  };
  const auto robot = [](const std::string& joint, const std::string& shape = "") {
    return "<robot name='r'><link name='a'/><link name='b'>" + shape + "</link><link name='c'/>" + joint +
           "<joint name='k' type='fixed'><parent link='a'/><child link='c'/></joint></robot>";
  };
  const std::string good =
      "<joint name='j' type='revolute'><parent link='a'/><child link='b'/><axis xyz='0 0 1'/>"
      "<limit lower='-1' upper='1' effort='1' velocity='1'/></joint>";
  EXPECT_EQ(read(robot(good)), "");
  EXPECT_EQ(complaint([] { (void)KinematicChain::from_urdf("/nowhere/arm.urdf", "a", "b"); }),
            "/nowhere/arm.urdf: cannot be opened");
  EXPECT_EQ(read("this is no robot").find("x.urdf: is no URDF"), 0U);
  EXPECT_EQ(read("").find("x.urdf: is no URDF"), 0U);
  EXPECT_EQ(read(robot(good), "a", "z"), "x.urdf: has no link 'z'");
  EXPECT_EQ(read(robot(good), "b", "a"), "x.urdf: has no chain from link 'b' to link 'a'");
  EXPECT_EQ(read(robot(good), "a", "c"), "x.urdf: has no joint that moves between link 'a' and link 'c'");
  EXPECT_EQ(read(robot("<joint name='j' type='floating'><parent link='a'/><child link='b'/></joint>")),
            "x.urdf: joint 'j' neither turns nor slides");
  EXPECT_EQ(read(robot(good, "<collision><geometry><mesh filename='b.stl'/></geometry></collision>")),
            "x.urdf: a shape of link 'b' is a mesh; it must be a cylinder, a sphere or a box");
  EXPECT_EQ(complaint([] { (void)KinematicChain::from_dh({}); }), "KinematicChain::from_dh needs at least one row");
  const std::vector<DhRow> rows{{.a_m = 0.5, .range = {-1.0, 1.0}}};
  EXPECT_EQ(complaint([&] { (void)KinematicChain::from_dh(rows, Pose::Identity(), {{.link = 3, .radius_m = 0.1}}); }),
            "Capsule::link is 3, must be < 3");
  const auto with = [&](const Eigen::Vector3d& from_m, const Eigen::Vector3d& to_m) {
    return complaint([&] { (void)KinematicChain::from_dh(rows, Pose::Identity(), {{1, from_m, to_m, 0.1}}); });
  };
  const Eigen::Vector3d here = Eigen::Vector3d::Zero();
  EXPECT_EQ(with(here, here), "");
  EXPECT_EQ(with({0.0, std::nan(""), 0.0}, here), "Capsule::from_m is nan, must be finite");
  EXPECT_EQ(with(here, {0.0, 0.0, INFINITY}), "Capsule::to_m is inf, must be finite");
  const std::vector<std::pair<double DhRow::*, std::string>> numbers{
      {&DhRow::a_m, "a_m"}, {&DhRow::alpha_rad, "alpha_rad"}, {&DhRow::d_m, "d_m"}, {&DhRow::theta_rad, "theta_rad"}};
  for (const auto& [number, name] : numbers) {
    for (const double value : {std::nan(""), -std::numeric_limits<double>::infinity()}) {
      std::vector<DhRow> bad = rows;
      bad.front().*number = value;
      EXPECT_EQ(complaint([&] { (void)KinematicChain::from_dh(bad); }),
                "DhRow::" + name + " is " + (std::isnan(value) ? "nan" : "-inf") + ", must be finite");
    }
  }
  Pose no_pose = Pose::Identity();
  no_pose.linear() *= 2.0;
  EXPECT_EQ(complaint([&] { (void)KinematicChain::from_dh(rows, no_pose); }),
            "KinematicChain::from_dh: last_from_sensor is not a rigid transform");
}

// A URDF with one moving joint, followed by `links` links with fixed joints.
std::string long_urdf(std::size_t links) {
  std::string text =
      "<robot name='r'><link name='a'/><link name='l0'/><joint name='j' type='continuous'><parent link='a'/>"
      "<child link='l0'/><axis xyz='0 0 1'/></joint>";
  for (std::size_t i = 1; i < links; ++i) {
    const std::string name = std::to_string(i);
    text.append("<link name='l").append(name).append("'/><joint name='f").append(name).append("' type='fixed'>");
    text.append("<parent link='l").append(std::to_string(i - 1)).append("'/><child link='l").append(name);
    text.append("'/></joint>");
  }
  return text + "</robot>";
}

TEST(KinematicChain, RefusesJointsThatAreNoTree) {
  const auto read = [](const std::string& text, const char* base = "a", const char* sensor = "b") {
    return complaint([&] { (void)KinematicChain::from_urdf_text(text, base, sensor, "x.urdf"); });
  };
  const auto joint = [](const char* name, const char* type, const char* parent, const char* child) {
    return std::string("<joint name='") + name + "' type='" + type + "'><parent link='" + parent +
           "'/><child link='" + child + "'/><axis xyz='0 0 1'/></joint>";
  };
  const std::string links = "<robot name='r'><link name='a'/><link name='b'/><link name='c'/>";
  for (const char* type : {"continuous", "fixed"}) {
    EXPECT_NE(read(links + joint("j", type, "b", "c") + joint("k", type, "c", "b") + "</robot>")
                  .find("x.urdf: its joints lead in a circle from link '"),
              std::string::npos)
        << type;
    EXPECT_NE(read(links + joint("h", type, "a", "b") + joint("j", type, "b", "c") + joint("k", type, "c", "b") +
                   "</robot>")
                  .find("x.urdf: link 'b' is the child of two joints, "),
              std::string::npos)
        << type;
  }
  EXPECT_EQ(read(long_urdf(900), "a", "l899"), "");
  EXPECT_EQ(read(long_urdf(900), "a", "l0"), "") << "all of them hang on the sensor's own link";
  EXPECT_EQ(read(long_urdf(20'000), "a", "l0"), "x.urdf: has 20001 links, must be at most 1000");
  std::string deep = "<robot name='r'>";
  for (int i = 0; i < 100'000; ++i) {
    deep += "<x>";
  }
  EXPECT_EQ(read(deep), "x.urdf: has elements nested more than 100 deep");
}

TEST(KinematicChain, RefusesNumbersOfAFileThatMakeNoArm) {
  const auto read = [](const std::string& axis, const std::string& rest, const std::string& shape) {
    return complaint([&] {
      (void)KinematicChain::from_urdf_text(
          "<robot name='r'><link name='a'/><link name='b'>" + shape +
              "</link><joint name='j' type='revolute'><parent link='a'/><child link='b'/>" + rest + "<axis xyz='" +
              axis + "'/><limit lower='-1' upper='1' effort='1' velocity='1'/></joint></robot>",
          "a", "b", "x.urdf");
    });
  };
  const auto shape = [](const std::string& geometry) {
    return "<collision><geometry>" + geometry + "</geometry></collision>";
  };
  EXPECT_EQ(read("0 0 1", "", ""), "");
  EXPECT_NE(read("0 0 0", "", "").find("x.urdf: the length of the axis of joint 'j' is 0"), std::string::npos);
  EXPECT_NE(read("0 0 1", "<origin xyz='1e9 0 0'/>", "").find("x.urdf: the origin of joint 'j' is 1e+09"),
            std::string::npos);
  EXPECT_NE(read("0 0 1", "", shape("<sphere radius='-1'/>")).find("x.urdf: the radius of a shape of link 'b' is -1"),
            std::string::npos);
  EXPECT_NE(read("0 0 1", "", shape("<sphere radius='large'/>")).find("x.urdf: is no URDF: "), std::string::npos);
  EXPECT_NE(read("0 0 1", "", shape("<cone radius='1'/>")).find("x.urdf: is no URDF: "), std::string::npos);
  EXPECT_NE(read("0 0 1", "", shape("<box size='1 2'/>")).find("x.urdf: is no URDF: "), std::string::npos);
  EXPECT_NE(read("0 0 1", "", shape("<cylinder radius='1' length='0'/>"))
                .find("x.urdf: the length of a shape of link 'b' is 0"),
            std::string::npos);
}

TEST(KinematicChain, ShapesBecomeCapsulesAroundThem) {
  const KinematicChain chain = KinematicChain::from_urdf_text(
      "<robot name='r'><link name='a'/>"
      "<link name='b'><collision><origin xyz='0 0 1'/><geometry><box size='0.2 0.6 "
      "0.2'/></geometry></collision></link>"
      "<link name='fin'><collision><geometry><sphere radius='0.3'/></geometry></collision></link>"
      "<joint name='j' type='continuous'><parent link='a'/><child link='b'/><axis xyz='0 0 1'/></joint>"
      "<joint name='k' type='fixed'><parent link='b'/><child link='fin'/><origin xyz='2 0 0'/></joint></robot>",
      "a", "b");
  ASSERT_EQ(chain.capsules().size(), 2U);
  const Capsule& box = chain.capsules()[0];
  EXPECT_EQ(box.link, 1U);
  EXPECT_TRUE(box.to_m.isApprox(Eigen::Vector3d(0, 0.3, 1)));
  EXPECT_NEAR(box.radius_m, std::sqrt(0.02), 1e-12);
  EXPECT_TRUE(chain.capsules()[1].from_m.isApprox(Eigen::Vector3d(2, 0, 0)));
  EXPECT_NEAR(chain.reach_m(), 2.3, 1e-12);
  EXPECT_NEAR(chain.ranges()[0].max, std::acos(-1.0), 1e-12);
}

}  // namespace
}  // namespace vantage
