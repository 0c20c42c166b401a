// SPDX-License-Identifier: MIT
#include "report/cycle_codec.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <vantage/geometry/raster_order.hpp>
#include <vantage/map/brick.hpp>

#include "report/bytes.hpp"

namespace vantage::detail {
namespace {

constexpr float kUnit = 127.0F;                            // the value of 1 in a component of a direction
constexpr std::size_t kMostBricks = std::size_t{1} << 22;  // 3 GB as a map

bool brick_is_addressable(const VoxelIndex& brick) {
  constexpr std::int32_t kFurthest = kFurthestVoxel / Brick::kSide;
  const auto is_near = [](std::int32_t i) { return i >= -kFurthest && i < kFurthest; };
  return is_near(brick.x) && is_near(brick.y) && is_near(brick.z);
}

void put(ByteWriter& out, const Pose& pose) {
  const Eigen::Quaterniond q(pose.linear());
  for (const double value :
       {pose.translation().x(), pose.translation().y(), pose.translation().z(), q.x(), q.y(), q.z(), q.w()}) {
    out.real(value);
  }
}

// Not with Eigen's comma initialiser: if reading throws in the middle of one, its assertion ends the process.
Eigen::Vector3d point_from(ByteReader& in) {
  Eigen::Vector3d point;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    point[axis] = in.real();
  }
  return point;
}

Pose pose_from(ByteReader& in) {
  const Eigen::Vector3d at = point_from(in);
  Eigen::Quaterniond q;
  for (Eigen::Index i = 0; i < 4; ++i) {
    q.coeffs()[i] = in.real();  // x, y, z, w
  }
  const double length = q.norm();
  constexpr double kOff = 1e-3;
  if (!at.allFinite() || !(std::abs(length - 1.0) < kOff)) {
    throw std::runtime_error("a pose is invalid");
  }
  Pose pose = Pose::Identity();
  pose.linear() = q.normalized().toRotationMatrix();
  pose.translation() = at;
  return pose;
}

void put(ByteWriter& out, const std::optional<double>& value) { out.real(value.value_or(std::nan(""))); }

std::optional<double> optional_from(ByteReader& in) {
  const double value = in.real();
  return std::isnan(value) ? std::nullopt : std::optional(value);
}

// Writes a cell as its difference from the previous one.
void put(ByteWriter& out, const VoxelIndex& at, VoxelIndex& before) {
  out.integer(std::int64_t{at.x} - before.x);
  out.integer(std::int64_t{at.y} - before.y);
  out.integer(std::int64_t{at.z} - before.z);
  before = at;
}

VoxelIndex index_from(ByteReader& in, VoxelIndex& before) {
  const auto step = [&in](std::int32_t from) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(in.integer()) + static_cast<std::uint32_t>(from));
  };
  before.x = step(before.x);
  before.y = step(before.y);
  before.z = step(before.z);
  return before;
}

void put_view(ByteWriter& out, const ViewRecord& view) {
  out.count(view.view);
  put(out, view.pose);
  put(out, view.coverage);
  put(out, view.surface_coverage);
  put(out, view.seen_coverage);
  put(out, view.time_s);
  for (const double value : {view.path_length_m, view.insert_ms, view.plan_ms, view.utility}) {
    out.real(value);
  }
  out.count(view.frontier_cells);
  out.count(view.void_cells);
  out.byte(static_cast<std::uint8_t>(view.outcome));
  out.count(view.passed.size());
  for (const Eigen::Vector3d& point : view.passed) {
    out.real(point.x());
    out.real(point.y());
    out.real(point.z());
  }
}

ViewRecord view_from(ByteReader& in) {
  ViewRecord view;
  view.view = static_cast<std::size_t>(in.count());
  view.pose = pose_from(in);
  view.coverage = optional_from(in);
  view.surface_coverage = optional_from(in);
  view.seen_coverage = optional_from(in);
  view.time_s = optional_from(in);
  for (double* value : {&view.path_length_m, &view.insert_ms, &view.plan_ms, &view.utility}) {
    *value = in.real();
  }
  view.frontier_cells = static_cast<std::size_t>(in.count());
  view.void_cells = static_cast<std::size_t>(in.count());
  view.outcome = static_cast<Outcome>(in.byte());
  if (view.outcome > Outcome::Blocked) {
    throw std::runtime_error("there is no such outcome");
  }
  view.passed.resize(in.length(24));
  for (Eigen::Vector3d& point : view.passed) {
    point = point_from(in);
  }
  return view;
}

void put_plan(ByteWriter& out, const RecordedCycle& cycle) {
  out.text(cycle.reason);
  out.count(cycle.path.size());
  for (const Pose& pose : cycle.path) {
    put(out, pose);
  }
  out.count(cycle.candidates.size());
  for (const View& view : cycle.candidates) {
    put(out, view.pose);
    out.real(view.utility);
  }
  out.count(cycle.leftover.unreachable);
  out.count(cycle.leftover.unobservable);
  out.count(cycle.leftover.in_vain);
  out.real(cycle.survey_ms);
  out.real(cycle.choose_ms);
  out.real(cycle.path_ms);
  out.count(cycle.field.size());
  VoxelIndex before;
  for (const FieldArrow& arrow : cycle.field) {
    put(out, arrow.cell, before);
  }
  for (const FieldArrow& arrow : cycle.field) {
    for (int axis = 0; axis < 3; ++axis) {
      out.byte(static_cast<std::uint8_t>(static_cast<std::int8_t>(std::lround(kUnit * arrow.downhill[axis]))));
    }
  }
  for (const FieldArrow& arrow : cycle.field) {
    out.small_real(arrow.phi);
  }
}

void read_plan(ByteReader& in, RecordedCycle& cycle) {
  cycle.reason = in.text();
  cycle.path.resize(in.length(56));
  for (Pose& pose : cycle.path) {
    pose = pose_from(in);
  }
  cycle.candidates.resize(in.length(64));
  for (View& view : cycle.candidates) {
    view.pose = pose_from(in);
    view.utility = in.real();
  }
  cycle.leftover.unreachable = static_cast<std::size_t>(in.count());
  cycle.leftover.unobservable = static_cast<std::size_t>(in.count());
  cycle.leftover.in_vain = static_cast<std::size_t>(in.count());
  cycle.survey_ms = in.real();
  cycle.choose_ms = in.real();
  cycle.path_ms = in.real();
  cycle.field.resize(in.length(10));
  VoxelIndex before;
  for (FieldArrow& arrow : cycle.field) {
    arrow.cell = index_from(in, before);
  }
  for (FieldArrow& arrow : cycle.field) {
    for (int axis = 0; axis < 3; ++axis) {
      arrow.downhill[axis] = static_cast<float>(static_cast<std::int8_t>(in.byte())) / kUnit;
    }
  }
  for (FieldArrow& arrow : cycle.field) {
    arrow.phi = in.small_real();
  }
}

// Writes a bit mask of the words that differ, then these words.
void put_difference(ByteWriter& out, const BrickPlane& now, const BrickPlane& before) {
  std::uint8_t differ = 0;
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    differ = static_cast<std::uint8_t>(differ | (now[word] != before[word] ? 1U << word : 0U));
  }
  out.byte(differ);
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    if (now[word] != before[word]) {
      out.word(now[word] ^ before[word], 8);
    }
  }
}

void read_difference(ByteReader& in, BrickPlane& plane) {
  const std::uint8_t differ = in.byte();
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    if ((differ >> word & 1U) != 0) {
      plane[word] ^= in.word(8);
    }
  }
}

}  // namespace

std::string encode(const RecordedCycle& cycle, BrickStates& before) {
  ByteWriter out;
  put_view(out, cycle.view);
  out.byte(cycle.planned ? 1 : 0);
  if (cycle.planned) {
    put_plan(out, cycle);
  }
  out.count(cycle.changes.size());
  VoxelIndex last;
  for (const BrickState& now : cycle.changes) {
    BrickState& was = before.try_emplace(now.brick, BrickState{.brick = now.brick}).first->second;
    put(out, now.brick, last);
    put_difference(out, now.known, was.known);
    put_difference(out, now.occupied, was.occupied);
    was = now;
  }
  return out.bytes();
}

RecordedCycle decode(std::string_view bytes, BrickStates& before) {
  ByteReader in(bytes);
  RecordedCycle cycle;
  cycle.view = view_from(in);
  cycle.planned = in.byte() != 0;
  if (cycle.planned) {
    read_plan(in, cycle);
  }
  cycle.changes.resize(in.length(5));
  VoxelIndex last;
  for (BrickState& change : cycle.changes) {
    const bool is_first = &change == cycle.changes.data();
    const VoxelIndex previous = last;
    const VoxelIndex brick = index_from(in, last);
    if (!brick_is_addressable(brick) || (!is_first && !RasterOrder{}(previous, brick))) {
      throw std::runtime_error("a brick lies outside any map, or out of order");
    }
    if (before.size() >= kMostBricks && before.find(brick) == before.end()) {
      throw std::runtime_error("the map has more than " + std::to_string(kMostBricks) + " bricks");
    }
    BrickState& state = before.try_emplace(brick, BrickState{.brick = brick}).first->second;
    read_difference(in, state.known);
    read_difference(in, state.occupied);
    change = state;
  }
  if (!in.spent()) {
    throw std::runtime_error("it is longer than what it holds");
  }
  return cycle;
}

}  // namespace vantage::detail
