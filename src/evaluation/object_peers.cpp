// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vantage/evaluation/object_peers.hpp>
#include <vantage/robot/way_around.hpp>
#include <vantage/view/candidate_views.hpp>

#include <vantage/geometry/impl/dice.hpp>

namespace vantage {
namespace {

constexpr std::array<std::string_view, 4> kPeerNames{"evenly-spaced", "furthest-view", "oracle-greedy",
                                                     "random-views"};

std::vector<Pose> admitted_views(const ObjectPeerSetup& setup, const std::vector<Pose>& views) {
  std::vector<Pose> admitted;
  for (const Pose& view : views) {
    const Pose pose = setup.platform->facing(view.translation(), optical_axis(view));
    if (setup.platform->admits(setup.truth->map(), pose)) {
      admitted.push_back(pose);
    }
  }
  return admitted;
}

// Views on a golden-angle spiral from the top of the first shell to its bottom, evenly spread.
std::vector<Pose> spiral_views(const ObjectPeerSetup& setup, std::size_t count, double turned_rad) {
  const Eigen::Vector3d middle = setup.scene->box.centre();
  const double radius_m = setup.scene->radii_m.front();
  const double golden_rad = std::numbers::pi * (3.0 - std::sqrt(5.0));
  std::vector<Pose> views;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(count);
    const double angle = turned_rad + golden_rad * static_cast<double>(i);
    const double level = std::sqrt(1.0 - z * z);
    const Eigen::Vector3d direction(level * std::cos(angle), level * std::sin(angle), z);
    views.push_back(pose_looking_along(middle + radius_m * direction, -direction));
  }
  return views;
}

// As many views of a list as are wanted, evenly spread over it.
std::vector<Pose> spread_over(const std::vector<Pose>& views, std::size_t wanted) {
  std::vector<Pose> taken;
  for (std::size_t i = 0; i < wanted; ++i) {
    taken.push_back(views[(2 * i + 1) * views.size() / (2 * wanted)]);
  }
  return taken;
}

std::vector<Pose> evenly_spaced(const ObjectPeerSetup& setup) {
  detail::Dice dice(setup.seed);
  const double turned_rad = 2.0 * std::numbers::pi * dice.share();
  constexpr std::size_t kMost = 100;  // at most this many times as many views are tried as are wanted
  for (std::size_t count = setup.views; count <= kMost * setup.views; ++count) {
    const std::vector<Pose> admitted = admitted_views(setup, spiral_views(setup, count, turned_rad));
    if (admitted.size() >= setup.views) {
      return spread_over(admitted, setup.views);
    }
  }
  throw std::invalid_argument("evenly-spaced: the robot's body fits nowhere on the shell of views");
}

// Takes the views of a list in an order that the derived class decides.
class ListPeer : public ObjectPeer {
 public:
  ListPeer(std::string_view name, const ObjectPeerSetup& setup, std::vector<Pose> views)
      : name_(name), setup_(setup), views_(std::move(views)), left_(views_.size()) {
    std::iota(left_.begin(), left_.end(), std::size_t{0});
  }
  [[nodiscard]] std::string_view name() const override { return name_; }

  [[nodiscard]] Plan plan(const OccupancyMap& map, const Pose& current) override {
    if (planned_ && map.revision() == planned_->first) {
      return planned_->second;
    }
    came(current);
    Plan plan;
    while (const std::optional<std::size_t> next = best()) {
      const Pose& goal = views_[*next];
      std::erase(left_, *next);
      if ((goal.translation() - current.translation()).norm() < 1e-6) {
        continue;
      }
      if (auto path = way_around(map, *setup_.platform, current, goal, setup_.scene->box.centre())) {
        plan.outcome = Outcome::Move;
        plan.goal.pose = goal;
        plan.path = std::move(*path);
        plan.reason = "the next view";
        break;
      }
    }
    if (plan.path.empty()) {
      plan.outcome = left_.empty() ? Outcome::Blocked : Outcome::Explored;
      plan.reason = left_.empty() ? "the views of this order are used up" : "no view shows more";
    }
    planned_ = {map.revision(), plan};
    return plan;
  }

 protected:
  // Called with the pose of the sensor before each new plan.
  virtual void came(const Pose&) {}
  // Index of the next view among those left; none: no other shows more.
  [[nodiscard]] virtual std::optional<std::size_t> best() = 0;
  [[nodiscard]] const std::vector<Pose>& views() const { return views_; }
  [[nodiscard]] const std::vector<std::size_t>& left() const { return left_; }

 private:
  std::string_view name_;
  ObjectPeerSetup setup_;
  std::vector<Pose> views_;
  std::vector<std::size_t> left_;
  std::optional<std::pair<OccupancyMap::Revision, Plan>> planned_;
};

// Takes the views in the order of the list.
class OrderedPeer final : public ListPeer {
 public:
  OrderedPeer(std::string_view name, const ObjectPeerSetup& setup, std::vector<Pose> views, bool begins)
      : ListPeer(name, setup, std::move(views)), begins_(begins) {}
  [[nodiscard]] std::optional<Pose> first_view() override {
    return begins_ ? std::optional(views().front()) : std::nullopt;
  }

 private:
  [[nodiscard]] std::optional<std::size_t> best() override {
    return left().empty() ? std::nullopt : std::optional(left().front());
  }

  bool begins_;
};

class FurthestPeer final : public ListPeer {
 public:
  using ListPeer::ListPeer;
  [[nodiscard]] std::optional<Pose> first_view() override { return std::nullopt; }

 private:
  void came(const Pose& pose) override { taken_.push_back(pose.translation()); }
  [[nodiscard]] std::optional<std::size_t> best() override {
    std::optional<std::size_t> furthest;
    double most_m = -1.0;
    for (const std::size_t i : left()) {
      double nearest_m = std::numeric_limits<double>::infinity();
      for (const Eigen::Vector3d& place : taken_) {
        nearest_m = std::min(nearest_m, (views()[i].translation() - place).norm());
      }
      if (nearest_m > most_m) {
        most_m = nearest_m;
        furthest = i;
      }
    }
    return furthest;
  }

  std::vector<Eigen::Vector3d> taken_;
};

class OraclePeer final : public ListPeer {
 public:
  OraclePeer(std::string_view name, const ObjectPeerSetup& setup, std::vector<Pose> views)
      : ListPeer(name, setup, std::move(views)), surface_(*setup.surface), seen_(surface_.samples().size()) {
    for (const Pose& view : this->views()) {
      shown_.push_back(surface_.visible_from(view));
    }
  }
  [[nodiscard]] std::optional<Pose> first_view() override {
    const std::optional<std::size_t> first = best();
    return first ? std::optional(views()[*first]) : std::nullopt;
  }

 private:
  void came(const Pose& pose) override {
    for (const std::uint32_t sample : surface_.visible_from(pose)) {
      seen_[sample] = true;
    }
  }
  [[nodiscard]] std::optional<std::size_t> best() override {
    std::optional<std::size_t> most;
    std::ptrdiff_t shows = 0;
    for (const std::size_t i : left()) {
      const std::ptrdiff_t news =
          std::count_if(shown_[i].begin(), shown_[i].end(), [&](std::uint32_t sample) { return !seen_[sample]; });
      if (news > shows) {
        shows = news;
        most = i;
      }
    }
    return most;
  }

  SeenSurface surface_;
  std::vector<bool> seen_;
  std::vector<std::vector<std::uint32_t>> shown_;  // by each view
};

}  // namespace

std::unique_ptr<ObjectPeer> make_object_peer(std::string_view name, const ObjectPeerSetup& setup) {
  if (setup.platform == nullptr || setup.scene == nullptr || setup.truth == nullptr || setup.surface == nullptr ||
      setup.views == 0) {
    throw std::invalid_argument("ObjectPeerSetup needs a platform, a scene, a truth, a surface and views > 0");
  }
  if (name == "evenly-spaced") {
    return std::make_unique<OrderedPeer>(name, setup, evenly_spaced(setup), true);
  }
  std::vector<Pose> views = admitted_views(setup, views_around(setup.scene->box.centre(), setup.scene->radii_m));
  if (name == "random-views") {
    detail::Dice dice(setup.seed);
    for (std::size_t i = views.size(); i > 1; --i) {
      std::swap(views[i - 1], views[dice.below(i)]);
    }
    return std::make_unique<OrderedPeer>(name, setup, std::move(views), false);
  }
  if (name == "furthest-view") {
    return std::make_unique<FurthestPeer>(name, setup, std::move(views));
  }
  if (name == "oracle-greedy") {
    return std::make_unique<OraclePeer>(name, setup, std::move(views));
  }
  std::string names;
  for (const std::string_view known : kPeerNames) {
    names += (names.empty() ? "" : ", ") + std::string(known);
  }
  throw std::invalid_argument("there is no planner '" + std::string(name) + "' to compare with; there are: " + names);
}

std::span<const std::string_view> object_peer_names() { return kPeerNames; }

}  // namespace vantage
