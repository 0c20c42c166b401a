// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vantage/robot/trajectory.hpp>

#include <vantage/robot/impl/steady_motion.hpp>

namespace vantage {
namespace detail {

inline constexpr std::size_t kSpeeds = 16;       // tried at a corner, from 0 to the fastest it admits
inline constexpr std::size_t kCornersAhead = 4;  // that a robot on the move may swing to
inline constexpr std::size_t kSwings = 8;        // places where a robot that brakes would stand, tried as a corner

}  // namespace detail

// The least time over the speeds at all corners, by dynamic programming from the end.
class Trajectory::Search {
 public:
  Search(const MotionState& start, std::span<const Eigen::Vector3d> corners, const MotionModel& motion,
         const Admits& admits, bool rounds)
      : start_(start), motion_(motion), admits_(admits), rounds_(rounds) {
    for (const Eigen::Vector3d& corner : corners) {
      if (vertices_.empty() || (corner - vertices_.back()).norm() > detail::kSamePlaceM) {
        vertices_.push_back(corner);
      }
      vertex_of_.push_back(vertices_.size() - 1);
    }
    reckon_speeds();
    stages_.resize(vertices_.size());
    stages_.back().corner.at = vertices_.back();
    for (std::size_t i = vertices_.size() - 1; i-- > 1;) {
      stages_[i] = stage(vertices_[i - 1], i);
    }
  }

  // None if no swing is admitted; a trajectory whose corners are not all admitted says so by `admitted`.
  std::optional<Trajectory> best(bool& admitted) {
    const double speed = start_.velocity_m_s.norm();
    if (speed < detail::kSamePlaceM && vertices_.size() == 1 &&
        (vertices_[0] - start_.position_m).norm() < detail::kSamePlaceM) {
      Trajectory stays(start_.position_m);
      stays.passes_at_s_.assign(vertex_of_.size(), 0.0);
      admitted = true;
      return stays;
    }
    const std::size_t ahead = std::min(vertices_.size(), detail::kCornersAhead);
    for (std::size_t to = 0; to < ahead; ++to) {
      if (speed < detail::kSamePlaceM) {
        const bool is_there =
            vertices_.size() > 1 && (vertices_[0] - start_.position_m).norm() <= detail::kSamePlaceM;
        if (!is_there || to == 1) {
          try_swings(start_.position_m, 0.0, to);
        }
        continue;
      }
      const double stops_after_m = speed * speed / (2.0 * motion_.max_acceleration_m_s2);
      try_swings(start_.position_m, 0.0, to);  // straight on
      for (std::size_t k = 1; k <= detail::kSwings; ++k) {
        const double ahead_m = stops_after_m * static_cast<double>(k) / static_cast<double>(detail::kSwings);
        try_swings(start_.position_m + ahead_m / speed * start_.velocity_m_s, ahead_m, to);
      }
    }
    if (best_s_ == detail::kNever) {
      return std::nullopt;
    }
    return assembled(admitted);
  }

 private:
  // A corner between two straight pieces. At a speed s the parabola from the one to the other takes
  // 2 s sin(turn / 2) / a, and begins and ends s^2 sin(turn / 2) / a from the corner.
  struct Corner {
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    Eigen::Vector3d in = Eigen::Vector3d::Zero();
    Eigen::Vector3d out = Eigen::Vector3d::Zero();
    double sharpness = 0.0;  // sin(turn / 2) / a
    double fastest = 0.0;

    [[nodiscard]] double speed(std::size_t level) const {
      return fastest * static_cast<double>(level) / static_cast<double>(detail::kSpeeds - 1);
    }
    [[nodiscard]] std::size_t levels() const { return fastest > 0.0 ? detail::kSpeeds : 1; }
    [[nodiscard]] double reach_m(double speed) const { return speed * speed * sharpness; }
    [[nodiscard]] double time_s(double speed) const { return 2.0 * speed * sharpness; }
  };

  // A corner, and what is the best from it on to the end for every speed at it.
  struct Stage {
    Corner corner;
    double length_out = 0.0;                          // to the next corner
    std::array<double, detail::kSpeeds> left_s{};     // from where its parabola begins to the end
    std::array<std::size_t, detail::kSpeeds> next{};  // level at the next corner
  };

  // How a robot gets from its state onto a straight line to a corner.
  struct Swing {
    double lasts_s = 0.0;
    Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();
    Eigen::Vector3d ends_at = Eigen::Vector3d::Zero();
    Eigen::Vector3d direction = Eigen::Vector3d::Zero();
    double speed = 0.0;
    double length = 0.0;    // from its end to the corner
    std::size_t level = 0;  // of speed at the corner
  };

  // No speed at a corner from which it could not come to rest at the end, or which it could not have got up to.
  void reckon_speeds() {
    const double a = motion_.max_acceleration_m_s2;
    within_reach_.assign(vertices_.size(), 0.0);
    double length = 0.0;
    for (std::size_t i = vertices_.size() - 1; i-- > 0;) {
      length += (vertices_[i + 1] - vertices_[i]).norm();
      within_reach_[i] = std::sqrt(2.0 * a * length);
    }
    const double gone = start_.velocity_m_s.squaredNorm() / (2.0 * a);  // to get up to its speed now, or to lose it
    length = 2.0 * gone + (vertices_[0] - start_.position_m).norm();
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      length += i == 0 ? 0.0 : (vertices_[i] - vertices_[i - 1]).norm();
      within_reach_[i] = std::min(within_reach_[i], std::sqrt(2.0 * a * length));
    }
  }

  [[nodiscard]] bool admits_curve(const MotionState& from, const Eigen::Vector3d& acceleration,
                                  double seconds) const {
    const int chords = detail::chords_of(acceleration.norm(), seconds);
    Eigen::Vector3d at = from.position_m;
    for (int i = 1; i <= chords; ++i) {
      const Eigen::Vector3d next = detail::moved(from, acceleration, seconds * i / chords).position_m;
      if (!admits_(at, next)) {
        return false;
      }
      at = next;
    }
    return true;
  }

  [[nodiscard]] bool admits_corner(const Corner& corner, double speed) const {
    const double seconds = corner.time_s(speed);
    return seconds <= 0.0 || admits_curve({corner.at - corner.reach_m(speed) * corner.in, speed * corner.in},
                                          speed / seconds * (corner.out - corner.in), seconds);
  }

  // The corner `i` for one who comes from `before`, and the best from there on.
  [[nodiscard]] Stage stage(const Eigen::Vector3d& before, std::size_t i) const {
    Stage made;
    made.corner.at = vertices_[i];
    if (i + 1 == vertices_.size()) {
      return made;  // at rest at the end
    }
    Corner& corner = made.corner;
    corner.in = vertices_[i] - before;
    corner.out = vertices_[i + 1] - vertices_[i];
    made.length_out = corner.out.norm();
    const double shorter = std::min(corner.in.norm(), made.length_out);
    corner.in.normalize();
    corner.out /= made.length_out;
    const double half_sine = 0.5 * (corner.out - corner.in).norm();
    corner.sharpness = half_sine / motion_.max_acceleration_m_s2;
    if (rounds_) {
      corner.fastest = std::min({motion_.max_speed_m_s, within_reach_[i],
                                 corner.sharpness > 0.0 ? std::sqrt(shorter / corner.sharpness) : detail::kNever});
      constexpr double kSlower = 0.8;
      constexpr int kSteps = 10;
      for (int step = 0; step < kSteps && !admits_corner(corner, corner.fastest); ++step) {
        corner.fastest *= step + 1 < kSteps ? kSlower : 0.0;
      }
    }
    relax(made, stages_[i + 1]);
    return made;
  }

  void relax(Stage& stage, const Stage& next) const {
    for (std::size_t level = 0; level < stage.corner.levels(); ++level) {
      const double speed = stage.corner.speed(level);
      const auto [left_s, chosen] = on_to(next, stage.length_out - stage.corner.reach_m(speed), speed);
      stage.left_s[level] = stage.corner.time_s(speed) + left_s;
      stage.next[level] = chosen;
    }
  }

  // The time from a speed on the line to a corner, `length` before it, to the end, and the best level at that corner.
  [[nodiscard]] std::pair<double, std::size_t> on_to(const Stage& next, double length, double speed) const {
    std::pair<double, std::size_t> best{detail::kNever, 0};
    for (std::size_t level = 0; level < next.corner.levels(); ++level) {
      const double last = next.corner.speed(level);
      const double time =
          next.left_s[level] + detail::straight_time_s(length - next.corner.reach_m(last), speed, last, motion_);
      if (time < best.first) {
        best = {time, level};
      }
    }
    return best;
  }

  // Swings by a parabola that is tangent to the velocity now, and to the line from `turn` (`ahead_m` straight ahead)
  // to the corner `to`. At a speed s after the swing it takes 2 ahead / |velocity|, and ends s time / 2 past `turn`.
  void try_swings(const Eigen::Vector3d& turn, double ahead_m, std::size_t to) {
    const Eigen::Vector3d line = vertices_[to] - turn;
    const double length = line.norm();
    const Eigen::Vector3d& velocity = start_.velocity_m_s;
    const double speed = velocity.norm();
    const Eigen::Vector3d direction = length > detail::kSamePlaceM ? Eigen::Vector3d(line / length)
                                      : speed > 0.0                ? Eigen::Vector3d(velocity / speed)
                                                                   : Eigen::Vector3d::Zero();
    const Stage next =
        to > 0 && (vertices_[to - 1] - turn).norm() < detail::kSamePlaceM ? stages_[to] : stage(turn, to);
    const double along = velocity.dot(direction);
    if (ahead_m <= 0.0) {
      constexpr double kAligned = 1e-6;
      if (speed - along <= kAligned * speed) {
        try_swing({0.0, Eigen::Vector3d::Zero(), turn, direction, along, length}, next, to);
      }
      return;
    }
    const double lasts_s = 2.0 * ahead_m / speed;
    const double change = motion_.max_acceleration_m_s2 * lasts_s;
    const double room = along * along - speed * speed + change * change;
    if (room < 0.0) {
      return;  // it would have to turn more tightly
    }
    const double slowest = std::max(0.0, along - std::sqrt(room));
    double fastest = std::min(motion_.max_speed_m_s, along + std::sqrt(room));
    if (std::abs(fastest) < detail::kSamePlaceM) {
      fastest = 0.0;  // it comes to rest, but for rounding
    }
    constexpr int kAfter = 5;
    for (int k = 0; k <= kAfter && slowest <= fastest; ++k) {
      const double after = slowest + (fastest - slowest) * k / kAfter;
      const double past_m = 0.5 * after * lasts_s;
      try_swing({lasts_s, (after * direction - velocity) / lasts_s, turn + past_m * direction, direction, after,
                 length - past_m},
                next, to);
    }
  }

  void try_swing(Swing swing, const Stage& next, std::size_t to) {
    const auto [left_s, level] = on_to(next, swing.length, swing.speed);
    if (swing.lasts_s + left_s < best_s_ &&
        (swing.lasts_s <= 0.0 || admits_curve(start_, swing.acceleration, swing.lasts_s)) &&
        admits_(swing.ends_at, next.corner.at)) {
      best_s_ = swing.lasts_s + left_s;
      swing.level = level;
      swing_ = swing;
      first_ = next;
      to_ = to;
    }
  }

  [[nodiscard]] Trajectory assembled(bool& admitted) {
    admitted = true;
    Trajectory made(start_.position_m);
    std::vector<double> passed(vertices_.size(), 0.0);
    if (swing_.lasts_s > 0.0) {
      made.add(swing_.lasts_s, start_, swing_.acceleration, false);
    }
    Eigen::Vector3d at = swing_.ends_at;
    Eigen::Vector3d direction = swing_.direction;
    double speed = swing_.speed;
    double length = swing_.length;
    stages_[to_] = first_;
    for (std::size_t i = to_, level = swing_.level;; level = stages_[i++].next[level]) {
      const Corner& corner = stages_[i].corner;
      const double last = corner.speed(level);
      const double reach_m = corner.reach_m(last);
      made.add_straight(at, direction, length - reach_m, speed, last, motion_);
      passed[i] = made.duration_s_ + 0.5 * corner.time_s(last);
      if (i + 1 == vertices_.size()) {
        break;
      }
      if (const double seconds = corner.time_s(last); seconds > 0.0) {
        admitted = admitted && admits_corner(corner, last);
        made.add(seconds, {corner.at - reach_m * corner.in, last * corner.in},
                 last / seconds * (corner.out - corner.in), false);
      }
      at = corner.at + reach_m * corner.out;
      direction = corner.out;
      speed = last;
      length = stages_[i].length_out - reach_m;
    }
    made.end_m_ = vertices_.back();
    for (const std::size_t vertex : vertex_of_) {
      made.passes_at_s_.push_back(passed[vertex]);
    }
    return made;
  }

  MotionState start_;
  const MotionModel& motion_;
  const Admits& admits_;
  bool rounds_;
  std::vector<Eigen::Vector3d> vertices_;  // corners, none twice in a row
  std::vector<std::size_t> vertex_of_;     // each corner's
  std::vector<double> within_reach_;       // speeds
  std::vector<Stage> stages_;              // of each vertex, for one who comes from the vertex before
  double best_s_ = detail::kNever;
  Swing swing_;
  Stage first_;
  std::size_t to_ = 0;
};

VANTAGE_INLINE std::optional<Trajectory> Trajectory::through(const MotionState& start,
                                                             std::span<const Eigen::Vector3d> corners,
                                                             const MotionModel& motion, const Admits& admits) {
  bool admitted = false;
  std::optional<Trajectory> made = Search(start, corners, motion, admits, true).best(admitted);
  if (made && !admitted) {  // something stands between a corner and the widest way round it
    made = Search(start, corners, motion, admits, false).best(admitted);
  }
  return made;
}

VANTAGE_INLINE std::optional<Trajectory> Trajectory::through(const MotionState& start, std::span<const Pose> path,
                                                             const MotionModel& motion, const Admits& admits) {
  std::vector<Eigen::Vector3d> corners;
  corners.reserve(path.size());
  for (const Pose& pose : path) {
    corners.emplace_back(pose.translation());
  }
  return through(start, std::span<const Eigen::Vector3d>(corners), motion, admits);
}

VANTAGE_INLINE void Trajectory::add(double lasts_s, const MotionState& from, const Eigen::Vector3d& acceleration_m_s2,
                                    bool is_straight) {
  if (lasts_s > 0.0) {
    pieces_.push_back({duration_s_, lasts_s, from, acceleration_m_s2, is_straight});
    duration_s_ += lasts_s;
  }
}

VANTAGE_INLINE void Trajectory::add_straight(const Eigen::Vector3d& from_m, const Eigen::Vector3d& direction,
                                             double length_m, double speed_m_s, double last_speed_m_s,
                                             const MotionModel& motion) {
  const double a = motion.max_acceleration_m_s2;
  const double peak =
      std::max({detail::peak_speed(length_m, speed_m_s, last_speed_m_s, motion), speed_m_s, last_speed_m_s});
  const double gains_m = (peak * peak - speed_m_s * speed_m_s) / (2.0 * a);
  const double loses_m = (peak * peak - last_speed_m_s * last_speed_m_s) / (2.0 * a);
  const double cruises_m = std::max(0.0, length_m - gains_m - loses_m);
  add((peak - speed_m_s) / a, {from_m, speed_m_s * direction}, a * direction, true);
  if (peak > 0.0) {
    add(cruises_m / peak, {from_m + gains_m * direction, peak * direction}, Eigen::Vector3d::Zero(), true);
  }
  add((peak - last_speed_m_s) / a, {from_m + (gains_m + cruises_m) * direction, peak * direction}, -a * direction,
      true);
}

VANTAGE_INLINE Trajectory Trajectory::braked(double time_s, const MotionModel& motion) const {
  const MotionState then = at(time_s);
  Trajectory made(then.position_m);
  for (Piece piece : pieces_) {
    if (piece.starts_s < time_s) {
      piece.lasts_s = std::min(piece.lasts_s, time_s - piece.starts_s);
      made.pieces_.push_back(piece);
    }
  }
  made.duration_s_ = std::min(time_s, duration_s_);
  made.passes_at_s_ = passes_at_s_;
  const double speed = then.velocity_m_s.norm();
  if (speed > 0.0) {
    const Eigen::Vector3d direction = then.velocity_m_s / speed;
    const double lasts_s = speed / motion.max_acceleration_m_s2;
    made.add(lasts_s, then, -motion.max_acceleration_m_s2 * direction, true);
    made.end_m_ = then.position_m + 0.5 * lasts_s * then.velocity_m_s;
  }
  return made;
}

VANTAGE_INLINE MotionState Trajectory::at(double time_s) const {
  if (time_s >= duration_s_) {
    return {end_m_, Eigen::Vector3d::Zero()};
  }
  const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), time_s,
                                      [](double time, const Piece& piece) { return time < piece.starts_s; });
  const Piece& piece = *std::prev(after);
  return detail::moved(piece.from, piece.acceleration_m_s2, std::clamp(time_s - piece.starts_s, 0.0, piece.lasts_s));
}

VANTAGE_INLINE std::vector<Eigen::Vector3d> Trajectory::points_from(double time_s) const {
  std::vector<Eigen::Vector3d> points{at(time_s).position_m};
  for (const Piece& piece : pieces_) {
    const double from_s = std::max(0.0, time_s - piece.starts_s);
    if (from_s >= piece.lasts_s) {
      continue;
    }
    const int chords =
        piece.is_straight ? 1 : detail::chords_of(piece.acceleration_m_s2.norm(), piece.lasts_s - from_s);
    for (int i = 1; i <= chords; ++i) {
      const double then_s = from_s + (piece.lasts_s - from_s) * i / chords;
      points.push_back(detail::moved(piece.from, piece.acceleration_m_s2, then_s).position_m);
    }
  }
  return points;
}

}  // namespace vantage
