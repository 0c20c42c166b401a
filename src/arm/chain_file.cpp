// SPDX-License-Identifier: MIT
#include <console_bridge/console.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <mutex>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vantage/arm/kinematic_chain.hpp>
#include <vector>

#include <vantage/map/impl/file_bytes.hpp>
#include "arm/chain_parts.hpp"
#include "arm/xml_extent.hpp"

namespace vantage {
namespace {

// During its lifetime, messages of the URDF parser are stored instead of printed.
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

constexpr std::size_t kMostBytes = std::size_t{1} << 24U;
constexpr double kMostM = 1000.0;  // largest length or slide
constexpr double kLeastM = 1e-6;   // smallest size of a shape
constexpr double kMostTurnRad = 1000.0;
constexpr double kLeastAxis = 1e-6;

Pose from_urdf_pose(const urdf::Pose& pose) {
  Pose result = Pose::Identity();
  result.linear() = Eigen::Quaterniond(pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z)
                        .normalized()
                        .toRotationMatrix();
  result.translation() = Eigen::Vector3d(pose.position.x, pose.position.y, pose.position.z);
  return result;
}

// A capsule around a solid with its centre at `link_from_shape`: half the segment length along `axis`, and the
// radius.
Capsule capsule_about(std::size_t link, const Pose& link_from_shape, Eigen::Index axis, double half_m,
                      double radius_m) {
  const Eigen::Vector3d end = half_m * Eigen::Vector3d::Unit(axis);
  return {link, link_from_shape * -end, link_from_shape * end, radius_m};
}

}  // namespace

// Converts a URDF to a chain.
class UrdfReader {
 public:
  UrdfReader(const std::string& text, std::string name) : name_(std::move(name)) {
    const ParserMessages messages;
    check_text(text);
    model_ = urdf::parseURDF(text);
    // The parser skips shapes that it cannot read and only logs a message. So every logged error is treated as a
    // failure.
    if (!model_ || !messages.first().empty()) {
      refuse(messages.first().empty() ? "is no URDF" : std::string("is no URDF: ").append(messages.first()));
    }
    check_tree();
  }

  KinematicChain chain(const std::string& base, const std::string& sensor) {
    const auto parts = std::make_shared<KinematicChain::Parts>();
    const urdf::LinkConstSharedPtr first = link(base);
    std::vector<urdf::LinkConstSharedPtr> links;  // from the sensor to the link after the base
    for (urdf::LinkConstSharedPtr at = link(sensor); at != first; at = at->getParent()) {
      if (!at->parent_joint) {
        refuse(std::string("has no chain from link '").append(base).append("' to link '").append(sensor).append("'"));
      }
      links.push_back(at);
    }
    add_capsules(*parts, *first, 0, links.empty() ? nullptr : links.back().get());
    for (std::size_t i = links.size(); i-- > 0;) {
      add_joint(*parts, *links[i]);
      add_capsules(*parts, *links[i], parts->chain.getNrOfSegments(), i > 0 ? links[i - 1].get() : nullptr);
    }
    if (parts->ranges.empty()) {
      refuse("has no joint that moves between link '" + base + "' and link '" + sensor + "'");
    }
    KinematicChain::finish(*parts);
    return KinematicChain(parts);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const { throw std::runtime_error(name_ + ": " + what); }

  // The parser recurses into nested elements and into chains of links. These limits protect its stack.
  void check_text(std::string_view text) const {
    constexpr std::size_t kMostLinks = 1000;
    constexpr std::size_t kDeepest = 100;
    if (text.size() > kMostBytes) {
      refuse("has " + std::to_string(text.size()) + " bytes, must be at most " + std::to_string(kMostBytes));
    }
    const detail::XmlExtent extent = detail::xml_extent(text, "link");
    if (extent.depth > kDeepest) {
      refuse("has elements nested more than " + std::to_string(kDeepest) + " deep");
    }
    if (extent.named > kMostLinks) {
      refuse("has " + std::to_string(extent.named) + " links, must be at most " + std::to_string(kMostLinks));
    }
  }

  // Checks that every link has at most one parent and that no link is its own ancestor.
  void check_tree() {
    std::map<std::string, const urdf::Joint*> joint_to;  // key: child link
    for (const auto& [name, joint] : model_->joints_) {
      const auto [found, is_new] = joint_to.try_emplace(joint->child_link_name, joint.get());
      if (!is_new) {
        untie();
        refuse("link '" + joint->child_link_name + "' is the child of two joints, '" + found->second->name +
               "' and '" + name + "'");
      }
    }
    for (const auto& [name, link] : model_->links_) {
      std::size_t steps = 0;
      for (auto up = joint_to.find(name); up != joint_to.end(); up = joint_to.find(up->second->parent_link_name)) {
        if (++steps > joint_to.size()) {
          untie();
          refuse("its joints lead in a circle from link '" + name + "'");
        }
      }
    }
  }

  // Removes the ownership of children. In a cycle of links the memory would otherwise never be freed.
  void untie() {
    for (const auto& [name, link] : model_->links_) {
      link->child_links.clear();
    }
  }

  double checked(double value, double least, double most, const std::string& what) const {
    if (!(value >= least && value <= most)) {
      std::ostringstream message;
      message << what << " is " << value << ", must be in [" << least << ", " << most << "]";
      refuse(message.str());
    }
    return value;
  }

  Pose checked(const urdf::Pose& pose, const std::string& what) const {
    for (const double value : {pose.position.x, pose.position.y, pose.position.z}) {
      (void)checked(value, -kMostM, kMostM, "the origin of " + what);
    }
    Pose result = from_urdf_pose(pose);
    if (!result.linear().allFinite()) {
      refuse("the origin of " + what + " has angles that are not finite");
    }
    return result;
  }

  urdf::LinkConstSharedPtr link(const std::string& name) const {
    urdf::LinkConstSharedPtr found = model_->getLink(name);
    if (!found) {
      refuse("has no link '" + name + "'");
    }
    return found;
  }

  void add_joint(KinematicChain::Parts& parts, const urdf::Link& link) const {
    const urdf::Joint& joint = *link.parent_joint;
    const std::string named = "joint '" + joint.name + "'";
    const Pose parent_from_link = checked(joint.parent_to_joint_origin_transform, named);
    if (joint.type == urdf::Joint::FIXED) {
      parts.add(KDL::Segment(link.name, KDL::Joint(joint.name, KDL::Joint::None), frame_of(parent_from_link)));
      return;
    }
    const bool turns = joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::CONTINUOUS;
    if (!turns && joint.type != urdf::Joint::PRISMATIC) {
      refuse(named + " neither turns nor slides");
    }
    const Eigen::Vector3d given_axis(joint.axis.x, joint.axis.y, joint.axis.z);
    (void)checked(given_axis.norm(), kLeastAxis, 1.0 / kLeastAxis, "the length of the axis of " + named);
    const Eigen::Vector3d axis = parent_from_link.linear() * given_axis;  // any length
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
      const double most = turns ? kMostTurnRad : kMostM;
      parts.ranges.push_back({checked(joint.limits->lower, -most, most, "the lower limit of " + named),
                              checked(joint.limits->upper, -most, most, "the upper limit of " + named)});
    } else {
      refuse(named + " has no limits, lower <= upper");
    }
  }

  // Adds the shapes of a link and of all links fixed to it, except `next`, the next link of the chain.
  void add_capsules(KinematicChain::Parts& parts, const urdf::Link& link, std::size_t number,
                    const urdf::Link* next) const {
    std::vector<std::pair<const urdf::Link*, Pose>> waiting{{&link, Pose::Identity()}};
    while (!waiting.empty()) {
      const auto [at, number_from_at] = waiting.back();
      waiting.pop_back();
      for (const urdf::CollisionSharedPtr& collision : at->collision_array) {
        const std::string named = "a shape of link '" + at->name + "'";
        parts.capsules.push_back(
            capsule_of(*collision->geometry, number, number_from_at * checked(collision->origin, named), named));
      }
      for (std::size_t i = at->child_joints.size(); i-- > 0;) {
        const urdf::Joint& joint = *at->child_joints[i];
        const urdf::LinkConstSharedPtr child = model_->getLink(joint.child_link_name);
        if (joint.type == urdf::Joint::FIXED && child.get() != next) {
          waiting.emplace_back(child.get(), number_from_at * checked(joint.parent_to_joint_origin_transform,
                                                                     "joint '" + joint.name + "'"));
        }
      }
    }
  }

  Capsule capsule_of(const urdf::Geometry& shape, std::size_t link, const Pose& link_from_shape,
                     const std::string& named) const {
    const auto length = [&](double value, const char* what) {
      return checked(value, kLeastM, kMostM, std::string("the ") + what + " of " + named);
    };
    if (const auto* sphere = dynamic_cast<const urdf::Sphere*>(&shape)) {
      return capsule_about(link, link_from_shape, 0, 0.0, length(sphere->radius, "radius"));
    }
    if (const auto* cylinder = dynamic_cast<const urdf::Cylinder*>(&shape)) {
      return capsule_about(link, link_from_shape, 2, 0.5 * length(cylinder->length, "length"),
                           length(cylinder->radius, "radius"));
    }
    if (const auto* box = dynamic_cast<const urdf::Box*>(&shape)) {
      const Eigen::Vector3d half =
          0.5 * Eigen::Vector3d(length(box->dim.x, "size"), length(box->dim.y, "size"), length(box->dim.z, "size"));
      Eigen::Index longest = 0;
      half.maxCoeff(&longest);
      Eigen::Vector3d across = half;
      across[longest] = 0.0;
      return capsule_about(link, link_from_shape, longest, half[longest], across.norm());
    }
    refuse(named + " is a mesh; it must be a cylinder, a sphere or a box");
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
  return from_urdf_text(detail::file_bytes(path, kMostBytes), base_link, sensor_link, path.string());
}

}  // namespace vantage
