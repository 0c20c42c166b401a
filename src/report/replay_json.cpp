// SPDX-License-Identifier: MIT
#include "report/replay_json.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <numeric>
#include <vector>

#include "report/base64.hpp"
#include "report/bytes.hpp"
#include "report/record_chunk.hpp"

namespace vantage::detail {
namespace {

using nlohmann::json;

constexpr int kTightly = 9;

std::string packed_columns(const ByteWriter& bytes) { return base64(deflated(bytes.bytes(), kTightly)); }

double to_millimetres(double metres) { return std::round(1000.0 * metres) / 1000.0; }

json point_json(const Eigen::Vector3d& point) {
  return {to_millimetres(point.x()), to_millimetres(point.y()), to_millimetres(point.z())};
}

// Appends one value of each item (column by column).
template <class Items, class Value>
void put_column(ByteWriter& out, const Items& items, const Value& value) {
  for (const auto& item : items) {
    out.word(static_cast<std::uint64_t>(value(item)), 2);
  }
}

template <class Items>
void put_cells(ByteWriter& out, const Items& items, const VoxelIndex& lo) {
  put_column(out, items, [&](const auto& item) { return item.cell.x - lo.x; });
  put_column(out, items, [&](const auto& item) { return item.cell.y - lo.y; });
  put_column(out, items, [&](const auto& item) { return item.cell.z - lo.z; });
}

json quads_json(const std::array<std::vector<TimedQuad>, 6>& directions, const VoxelIndex& lo) {
  json counts = json::array();
  std::vector<TimedQuad> quads;
  for (const std::vector<TimedQuad>& direction : directions) {
    counts.push_back(direction.size());
    quads.insert(quads.end(), direction.begin(), direction.end());
  }
  ByteWriter columns;
  put_cells(columns, quads, lo);
  put_column(columns, quads, [](const TimedQuad& quad) { return quad.width; });
  put_column(columns, quads, [](const TimedQuad& quad) { return quad.height; });
  put_column(columns, quads, [](const TimedQuad& quad) { return quad.birth; });
  put_column(columns, quads, [](const TimedQuad& quad) { return quad.death; });
  return {{"counts", std::move(counts)}, {"data", packed_columns(columns)}};
}

json cells_json(const std::vector<TimedCell>& cells, const VoxelIndex& lo) {
  ByteWriter columns;
  put_cells(columns, cells, lo);
  put_column(columns, cells, [](const TimedCell& cell) { return cell.birth; });
  put_column(columns, cells, [](const TimedCell& cell) { return cell.death; });
  return {{"count", cells.size()}, {"data", packed_columns(columns)}};
}

// Rank of each potential within its cycle: 0 for the lowest, 255 for the highest.
std::vector<std::uint8_t> ranks_of(const std::vector<FieldArrow>& field) {
  std::vector<std::size_t> order(field.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return field[a].phi < field[b].phi; });
  std::vector<std::uint8_t> ranks(field.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    ranks[order[i]] = static_cast<std::uint8_t>(255 * i / std::max<std::size_t>(order.size() - 1, 1));
  }
  return ranks;
}

// Spacing of the samples in cells.
std::int32_t step_of(const std::vector<FieldArrow>& field) {
  std::int32_t step = 0;
  for (const FieldArrow& arrow : field) {
    for (const std::int32_t at : {arrow.cell.x, arrow.cell.y, arrow.cell.z}) {
      step = std::gcd(step, at);  // samples lie on a lattice through cell 0
    }
  }
  return std::max(step, 1);
}

json field_json(const std::vector<RecordedCycle>& cycles, const VoxelIndex& lo) {
  json blocks = json::array();
  std::vector<FieldArrow> arrows;
  ByteWriter ranks;
  for (std::size_t i = 0; i < cycles.size(); ++i) {
    const std::vector<FieldArrow>& field = cycles[i].field;
    if (!field.empty()) {
      blocks.push_back(
          {{"view", i + 1}, {"from", arrows.size()}, {"to", arrows.size() + field.size()}, {"step", step_of(field)}});
      arrows.insert(arrows.end(), field.begin(), field.end());
      for (const std::uint8_t rank : ranks_of(field)) {
        ranks.byte(rank);
      }
    }
  }
  ByteWriter bytes;
  for (const FieldArrow& arrow : arrows) {
    for (const std::int32_t at : {arrow.cell.x - lo.x, arrow.cell.y - lo.y, arrow.cell.z - lo.z}) {
      bytes.word(static_cast<std::uint64_t>(at), 2);
    }
  }
  for (const FieldArrow& arrow : arrows) {
    for (int axis = 0; axis < 3; ++axis) {
      bytes.byte(static_cast<std::uint8_t>(static_cast<std::int8_t>(std::lround(127.0F * arrow.downhill[axis]))));
    }
  }
  const std::string data = bytes.bytes() + ranks.bytes();
  return {{"count", arrows.size()}, {"blocks", std::move(blocks)}, {"data", base64(deflated(data, kTightly))}};
}

json plan_json(const RecordedCycle& cycle) {
  if (!cycle.planned) {
    return json::object();
  }
  json path = json::array();
  for (const Pose& pose : cycle.path) {
    path.push_back(point_json(pose.translation()));
  }
  json candidates = json::array();
  for (const View& view : cycle.candidates) {
    json candidate = point_json(view.pose.translation());
    const Eigen::Vector3d ahead = optical_axis(view.pose);
    for (const double value : {ahead.x(), ahead.y(), ahead.z()}) {
      candidate.push_back(to_millimetres(value));
    }
    candidate.push_back(view.utility);
    candidates.push_back(std::move(candidate));
  }
  return {{"planned", true},
          {"reason", cycle.reason},
          {"path", std::move(path)},
          {"candidates", std::move(candidates)},
          {"stages", {cycle.survey_ms, cycle.choose_ms, cycle.path_ms}}};
}

// The highest cell of a rectangle of faces that look along `direction`.
VoxelIndex last_cell(const TimedQuad& quad, std::size_t direction) {
  const std::int32_t u = quad.width - 1;
  const std::int32_t v = quad.height - 1;
  const std::size_t axis = direction / 2;
  return quad.cell + (axis == 0 ? VoxelIndex{0, u, v} : axis == 1 ? VoxelIndex{u, 0, v} : VoxelIndex{u, v, 0});
}

// Box of all cells that are shown: the known ones, and voids and samples of the field outside them.
VoxelBox extent_of(const Replay& replay) {
  VoxelBox extent = replay.bounds;
  const auto hold = [&extent](const VoxelIndex& cell) {
    extent.lo = {std::min(extent.lo.x, cell.x), std::min(extent.lo.y, cell.y), std::min(extent.lo.z, cell.z)};
    extent.hi = {std::max(extent.hi.x, cell.x + 1), std::max(extent.hi.y, cell.y + 1),
                 std::max(extent.hi.z, cell.z + 1)};
  };
  for (std::size_t direction = 0; direction < replay.voids.size(); ++direction) {
    for (const TimedQuad& quad : replay.voids[direction]) {
      hold(quad.cell);
      hold(last_cell(quad, direction));
    }
  }
  for (const RecordedCycle& cycle : replay.cycles) {
    for (const FieldArrow& arrow : cycle.field) {
      hold(arrow.cell);
    }
  }
  return extent;
}

}  // namespace

json replay_json(const Replay& replay) {
  const VoxelBox extent = extent_of(replay);
  json travelled = json::array();
  for (const Eigen::Vector3d& point : replay.run.travelled) {
    travelled.push_back(point_json(point));
  }
  json cycles = json::array();
  for (const RecordedCycle& cycle : replay.cycles) {
    cycles.push_back(plan_json(cycle));
  }
  const RangeSensor& sensor = replay.sensor;
  return {{"cell_m", replay.run.resolution_m},
          {"lo", {extent.lo.x, extent.lo.y, extent.lo.z}},
          {"hi", {extent.hi.x, extent.hi.y, extent.hi.z}},
          {"surfaces", quads_json(replay.surfaces, extent.lo)},
          {"voids", quads_json(replay.voids, extent.lo)},
          {"frontiers", cells_json(replay.frontiers, extent.lo)},
          {"field", field_json(replay.cycles, extent.lo)},
          {"known_cells", replay.known_cells},
          {"cycles", std::move(cycles)},
          {"travelled", std::move(travelled)},
          {"sensor",
           {{"pinhole", sensor.projection == RangeSensor::Projection::Pinhole},
            {"horizontal_rad", sensor.horizontal_angle_rad()},
            {"vertical_rad", sensor.vertical_angle_rad()},
            {"max_range_m", sensor.max_range_m}}}};
}

}  // namespace vantage::detail
