// SPDX-License-Identifier: MIT
#include <console_bridge/console.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <mutex>
#include <numbers>
#include <stdexcept>
#include <vantage/arm/kinematic_chain.hpp>

#include "arm/chain_parts.hpp"

namespace vantage {
namespace {

// While it lives, what the parser has to say is kept instead of printed.
class ParserMessages final : public console_bridge::OutputHandler {
 public:
  ParserMessages() : lock_(one_at_a_time()) { console_bridge::useOutputHandler(this); }
  ~ParserMessages() override { console_bridge::restorePreviousOutputHandler(); }
  ParserMessages(const ParserMessages&) = delete;
  ParserMessages& operator=(const ParserMessages&) = delete;
  ParserMessages(ParserMessages&&) = delete;
  ParserMessages& operator=(ParserMessages&&) = delete;

  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR && first_.empty()) {
      first_ = text;
    }
  }
  [[nodiscard]] const std::string& first() const { return first_; }

 private:
  static std::mutex& one_at_a_time() {
    static std::mutex mutex;
    return mutex;
  }
  std::lock_guard<std::mutex> lock_;
  std::string first_;
};

Pose from_urdf_pose(const urdf::Pose& pose) {
  Pose result = Pose::Identity();
  result.linear() = Eigen::Quaterniond(pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z)
                        .normalized()
                        .toRotationMatrix();
  result.translation() = Eigen::Vector3d(pose.position.x, pose.position.y, pose.position.z);
  return result;
}

// A capsule about a solid whose middle is at `link_from_shape`: half its length along `axis`, and its radius.
Capsule capsule_about(std::size_t link, const Pose& link_from_shape, Eigen::Index axis, double half_m,
                      double radius_m) {
  const Eigen::Vector3d end = half_m * Eigen::Vector3d::Unit(axis);
  return {link, link_from_shape * -end, link_from_shape * end, radius_m};
}

}  // namespace

// One URDF on its way to a chain.
class UrdfReader {
 public:
  UrdfReader(const std::string& text, std::string name) : name_(std::move(name)) {
    const ParserMessages messages;
    model_ = urdf::parseURDF(text);
    if (!model_) {
      refuse(messages.first().empty() ? "is no URDF" : std::string("is no URDF: ").append(messages.first()));
    }
  }

  KinematicChain chain(const std::string& base, const std::string& sensor) {
    const auto parts = std::make_shared<KinematicChain::Parts>();
    const urdf::LinkConstSharedPtr first = link(base);
    std::vector<urdf::LinkConstSharedPtr> links;  // from the sensor to the one after the base
    for (urdf::LinkConstSharedPtr at = link(sensor); at != first; at = at->getParent()) {
      if (!at->parent_joint) {
        refuse(std::string("has no chain from link '").append(base).append("' to link '").append(sensor).append("'"));
      }
      links.push_back(at);
    }
    add_capsules(*parts, *first, 0, Pose::Identity(), links.empty() ? nullptr : links.back().get());
    for (std::size_t i = links.size(); i-- > 0;) {
      add_joint(*parts, *links[i]);
      add_capsules(*parts, *links[i], parts->chain.getNrOfSegments(), Pose::Identity(),
                   i > 0 ? links[i - 1].get() : nullptr);
    }
    if (parts->ranges.empty()) {
      refuse("has no joint that moves between link '" + base + "' and link '" + sensor + "'");
    }
    KinematicChain::finish(*parts);
    return KinematicChain(parts);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const { throw std::runtime_error(name_ + ": " + what); }

  urdf::LinkConstSharedPtr link(const std::string& name) const {
    urdf::LinkConstSharedPtr found = model_->getLink(name);
    if (!found) {
      refuse("has no link '" + name + "'");
    }
    return found;
  }

  void add_joint(KinematicChain::Parts& parts, const urdf::Link& link) const {
    const urdf::Joint& joint = *link.parent_joint;
    const Pose parent_from_link = from_urdf_pose(joint.parent_to_joint_origin_transform);
    if (joint.type == urdf::Joint::FIXED) {
      parts.add(KDL::Segment(link.name, KDL::Joint(joint.name, KDL::Joint::None), frame_of(parent_from_link)));
      return;
    }
    const bool turns = joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::CONTINUOUS;
    if (!turns && joint.type != urdf::Joint::PRISMATIC) {
      refuse("joint '" + joint.name + "' neither turns nor slides");
    }
    const Eigen::Vector3d axis =
        parent_from_link.linear() * Eigen::Vector3d(joint.axis.x, joint.axis.y, joint.axis.z);
    const Eigen::Vector3d origin = parent_from_link.translation();
    parts.add(
        KDL::Segment(link.name,
                     KDL::Joint(joint.name, {origin.x(), origin.y(), origin.z()}, {axis.x(), axis.y(), axis.z()},
                                turns ? KDL::Joint::RotAxis : KDL::Joint::TransAxis),
                     frame_of(parent_from_link)));
    parts.names.push_back(joint.name);
    if (joint.type == urdf::Joint::CONTINUOUS) {
      parts.ranges.push_back({-std::numbers::pi, std::numbers::pi});
    } else if (joint.limits && joint.limits->lower <= joint.limits->upper) {
      parts.ranges.push_back({joint.limits->lower, joint.limits->upper});
    } else {
      refuse("joint '" + joint.name + "' has no limits, lower <= upper");
    }
  }

  // The shapes of a link and of all that is fixed to it but `next`, which is the chain's own.
  void add_capsules(KinematicChain::Parts& parts, const urdf::Link& link, std::size_t number,
                    const Pose& number_from_link, const urdf::Link* next) const {
    for (const urdf::CollisionSharedPtr& collision : link.collision_array) {
      parts.capsules.push_back(
          capsule_of(*collision->geometry, number, number_from_link * from_urdf_pose(collision->origin), link.name));
    }
    for (const urdf::JointSharedPtr& joint : link.child_joints) {
      const urdf::LinkConstSharedPtr child = model_->getLink(joint->child_link_name);
      if (joint->type == urdf::Joint::FIXED && child.get() != next) {
        add_capsules(parts, *child, number,
                     number_from_link * from_urdf_pose(joint->parent_to_joint_origin_transform), next);
      }
    }
  }

  Capsule capsule_of(const urdf::Geometry& shape, std::size_t link, const Pose& link_from_shape,
                     const std::string& link_name) const {
    if (const auto* sphere = dynamic_cast<const urdf::Sphere*>(&shape)) {
      return capsule_about(link, link_from_shape, 0, 0.0, sphere->radius);
    }
    if (const auto* cylinder = dynamic_cast<const urdf::Cylinder*>(&shape)) {
      return capsule_about(link, link_from_shape, 2, 0.5 * cylinder->length, cylinder->radius);
    }
    if (const auto* box = dynamic_cast<const urdf::Box*>(&shape)) {
      const Eigen::Vector3d half = 0.5 * Eigen::Vector3d(box->dim.x, box->dim.y, box->dim.z);
      Eigen::Index longest = 0;
      half.maxCoeff(&longest);
      Eigen::Vector3d across = half;
      across[longest] = 0.0;
      return capsule_about(link, link_from_shape, longest, half[longest], across.norm());
    }
    refuse("link '" + link_name + "' has a mesh for a collision shape; it must be cylinders, spheres or boxes");
  }

  std::string name_;
  urdf::ModelInterfaceSharedPtr model_;
};

KinematicChain KinematicChain::from_urdf_text(const std::string& text, std::string_view base_link,
                                              std::string_view sensor_link, const std::string& name) {
  return UrdfReader(text, name).chain(std::string(base_link), std::string(sensor_link));
}

KinematicChain KinematicChain::from_urdf(const std::filesystem::path& path, std::string_view base_link,
                                         std::string_view sensor_link) {
  std::ifstream file(path);
  if (!file) {
    throw std::runtime_error(path.string() + ": cannot be opened");
  }
  const std::string text(std::istreambuf_iterator<char>(file), {});
  return from_urdf_text(text, base_link, sensor_link, path.string());
}

}  // namespace vantage
