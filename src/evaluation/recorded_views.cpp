// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <random>
#include <stdexcept>
#include <utility>
#include <vantage/evaluation/recorded_views.hpp>
#include <vantage/frontier/void_cells.hpp>

#include <vantage/frontier/impl/hull_rows.hpp>

namespace vantage {
namespace {

double mean_of(const std::vector<double>& values) {
  return values.empty() ? 0.0
                        : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// The cells seen so far and their number.
class SeenCells {
 public:
  explicit SeenCells(std::size_t cells) : seen_(cells, false) {}

  [[nodiscard]] std::size_t count() const { return count_; }
  void add(const std::vector<std::uint32_t>& cells) {
    for (const std::uint32_t cell : cells) {
      count_ += seen_[cell] ? 0U : 1U;
      seen_[cell] = true;
    }
  }
  [[nodiscard]] std::size_t missing(const std::vector<std::uint32_t>& cells) const {
    return static_cast<std::size_t>(
        std::count_if(cells.begin(), cells.end(), [&](std::uint32_t cell) { return !seen_[cell]; }));
  }

 private:
  std::vector<bool> seen_;
  std::size_t count_ = 0;
};

VoxelBox joined(const VoxelBox& a, const VoxelBox& b) {
  return {{std::min(a.lo.x, b.lo.x), std::min(a.lo.y, b.lo.y), std::min(a.lo.z, b.lo.z)},
          {std::max(a.hi.x, b.hi.x), std::max(a.hi.y, b.hi.y), std::max(a.hi.z, b.hi.z)}};
}

// Numbers the cells of a box.
class CellNumbers {
 public:
  // Throws std::invalid_argument if there are too many.
  explicit CellNumbers(const VoxelBox& box)
      : box_(box),
        width_(static_cast<std::uint64_t>(std::int64_t{box.hi.x} - box.lo.x)),
        depth_(static_cast<std::uint64_t>(std::int64_t{box.hi.y} - box.lo.y)) {
    const auto height = static_cast<std::uint64_t>(std::int64_t{box.hi.z} - box.lo.z);
    constexpr double kMost = 2147483648.0;
    if (static_cast<double>(width_) * static_cast<double>(depth_) * static_cast<double>(height) > kMost) {
      throw std::invalid_argument("RecordedViews: the cells known are too far apart");
    }
    count_ = static_cast<std::size_t>(width_ * depth_ * height);
  }

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::uint32_t of(const VoxelIndex& cell) const {
    const auto dx = static_cast<std::uint64_t>(cell.x - box_.lo.x);
    const auto dy = static_cast<std::uint64_t>(cell.y - box_.lo.y);
    const auto dz = static_cast<std::uint64_t>(cell.z - box_.lo.z);
    return static_cast<std::uint32_t>((dz * depth_ + dy) * width_ + dx);
  }
  [[nodiscard]] std::vector<std::uint32_t> of(const std::vector<VoxelIndex>& cells) const {
    std::vector<std::uint32_t> numbers(cells.size());
    std::transform(cells.begin(), cells.end(), numbers.begin(), [&](const VoxelIndex& cell) { return of(cell); });
    return numbers;
  }

 private:
  VoxelBox box_;
  std::uint64_t width_;
  std::uint64_t depth_;
  std::size_t count_ = 0;
};

// Calls `visit(VoxelIndex)` for all cells inside the hull of the occupied ones, known or not.
template <class Visit>
void for_each_cell_in_hull(const OccupancyMap& map, const Visit& visit) {
  const LatticeHull hull = occupied_hull(map);
  if (hull.empty()) {
    return;
  }
  const detail::HullRows rows(detail::planes_of(hull), 0);
  const VoxelBox box = map.bounds();
  const detail::HullRow whole{1.0 * box.lo.x, box.hi.x - 1.0};
  for (std::int32_t z = box.lo.z; z < box.hi.z; ++z) {
    for (std::int32_t y = box.lo.y; y < box.hi.y; ++y) {
      const auto [first, last] = rows.within(whole, y, z).cells();
      for (std::int32_t x = first; x < last; ++x) {
        visit(VoxelIndex{x, y, z});
      }
    }
  }
}

}  // namespace

double ViewOrderCurve::volume_area() const { return mean_of(volume); }

double ViewOrderCurve::surface_area() const { return mean_of(surface); }

double ViewOrderCurve::void_area() const {
  return mean_of(std::vector<double>(void_cells.begin(), void_cells.end()));
}

RecordedViews::RecordedViews(std::vector<Scan> scans, const OccupancyMapOptions& options,
                             const std::optional<Box>& object)
    : scans_(std::move(scans)), options_(options), object_(object) {
  if (scans_.empty()) {
    throw std::invalid_argument("RecordedViews: there is no scan");
  }
  if (object_ && object_->empty()) {
    throw std::invalid_argument("RecordedViews: the box of the object is empty");
  }
  struct Cells {
    std::vector<VoxelIndex> known;
    std::vector<VoxelIndex> hit;
  };
  OccupancyMapOptions counted = options_;
  counted.region = object_ ? object_ : options_.region;
  std::vector<Cells> cells;
  OccupancyMap of_all(counted);
  VoxelBox box;
  for (const Scan& scan : scans_) {
    OccupancyMap of_one(counted);
    of_one.insert(scan);
    of_all.insert(scan);
    box = cells.empty() ? of_one.bounds() : joined(box, of_one.bounds());
    Cells& of_view = cells.emplace_back();
    of_one.for_each_known([&](const VoxelIndex& cell, Occupancy state) {
      of_view.known.push_back(cell);
      if (state == Occupancy::Occupied) {
        of_view.hit.push_back(cell);
      }
    });
  }
  const CellNumbers numbers(box);
  box_cells_ = numbers.count();
  std::vector<bool> in_hull(box_cells_, false);
  for_each_cell_in_hull(of_all, [&](const VoxelIndex& cell) {
    in_hull[numbers.of(cell)] = true;
    ++void_cells_;
  });
  for (const Cells& of_view : cells) {
    known_.push_back(numbers.of(of_view.known));
    hit_.push_back(numbers.of(of_view.hit));
    std::copy_if(known_.back().begin(), known_.back().end(), std::back_inserter(inside_.emplace_back()),
                 [&](std::uint32_t cell) { return in_hull[cell]; });
  }
}

bool RecordedViews::show_any() const {
  return std::any_of(known_.begin(), known_.end(), [](const auto& cells) { return !cells.empty(); });
}

// With an object the map has a region that ends with what is known around it, because nothing beyond counts.
OccupancyMap RecordedViews::map_before() const {
  if (!object_) {
    return OccupancyMap(options_);
  }
  const Eigen::Vector3d cell = Eigen::Vector3d::Constant(options_.resolution_m);
  Box all{object_->min - cell, object_->max + cell};  // with the cells that its faces cut
  for (const Scan& scan : scans_) {
    all.extend(scan.world_from_sensor.translation() + cell);
    all.extend(scan.world_from_sensor.translation() - cell);
  }
  OccupancyMapOptions options = options_;
  options.region = options_.region.value_or(all);
  OccupancyMap map(options);
  map.assume_free(all);
  const VoxelBox unknown{map.frame().cell_of(object_->min), map.frame().cell_of(object_->max) + VoxelIndex{1, 1, 1}};
  for_each_cell(unknown, [&](const VoxelIndex& index) { map.set(index, Occupancy::Unknown); });
  return map;
}

ViewOrderCurve RecordedViews::curve(std::string name, std::vector<std::size_t> order) const {
  SeenCells known(box_cells_);
  SeenCells hit(box_cells_);
  SeenCells inside(box_cells_);
  ViewOrderCurve result{.name = std::move(name), .order = std::move(order)};
  for (const std::size_t view : result.order) {
    known.add(known_.at(view));
    hit.add(hit_.at(view));
    result.volume.push_back(static_cast<double>(known.count()));
    inside.add(inside_.at(view));
    result.surface.push_back(static_cast<double>(hit.count()));
    result.void_cells.push_back(void_cells_ - inside.count());
  }
  for (std::size_t view = 0; view < size(); ++view) {  // box of everything that the views make known
    known.add(known_[view]);
    hit.add(hit_[view]);
  }
  for (double& value : result.volume) {
    value /= std::max(1.0, static_cast<double>(known.count()));
  }
  for (double& value : result.surface) {
    value /= std::max(1.0, static_cast<double>(hit.count()));
  }
  return result;
}

std::vector<std::size_t> RecordedViews::recorded_order() const {
  std::vector<std::size_t> order(size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  return order;
}

ViewOrderCurve RecordedViews::evenly_spaced(std::string name) const {
  ViewOrderCurve result{.name = std::move(name), .order = recorded_order()};
  for (std::size_t count = 1; count <= size(); ++count) {
    std::vector<std::size_t> spread;
    for (std::size_t i = 0; i < count; ++i) {
      spread.push_back(count == 1 ? 0 : (2 * i * (size() - 1) + (count - 1)) / (2 * (count - 1)));
    }
    const ViewOrderCurve of_these = curve("", spread);
    result.volume.push_back(of_these.volume.back());
    result.surface.push_back(of_these.surface.back());
    result.void_cells.push_back(of_these.void_cells.back());
  }
  return result;
}

std::vector<std::size_t> RecordedViews::random_order(std::size_t start, std::uint64_t seed) const {
  std::vector<std::size_t> order = recorded_order();
  std::swap(order.front(), order.at(start));
  std::mt19937_64 engine(seed);
  for (std::size_t i = order.size();
       i-- > 2;) {  // Fisher-Yates by hand, so that it is the same with every standard library
    std::swap(order[i], order[1 + engine() % i]);
  }
  return order;
}

std::vector<std::size_t> RecordedViews::greedy_order(std::size_t start, Measure measure) const {
  const auto& cells = measure == Measure::Volume ? known_ : measure == Measure::Surface ? hit_ : inside_;
  SeenCells seen(box_cells_);
  seen.add(cells.at(start));
  std::vector<std::size_t> order{start};
  std::vector<std::size_t> left = recorded_order();
  left.erase(left.begin() + static_cast<std::ptrdiff_t>(start));
  while (!left.empty()) {
    const auto best = std::max_element(left.begin(), left.end(), [&](std::size_t a, std::size_t b) {
      return seen.missing(cells[a]) < seen.missing(cells[b]);
    });
    seen.add(cells[*best]);
    order.push_back(*best);
    left.erase(best);
  }
  return order;
}

std::vector<std::size_t> chosen_order(const RecordedViews& views, std::size_t start, const ChooseView& choose) {
  OccupancyMap map = views.map_before();
  std::vector<std::size_t> order{start};
  std::vector<std::size_t> left = views.recorded_order();
  left.erase(left.begin() + static_cast<std::ptrdiff_t>(start));
  map.insert(views.scans().at(start));
  while (!left.empty()) {
    const std::size_t next = choose(map, order.back(), left);
    const auto found = std::find(left.begin(), left.end(), next);
    if (found == left.end()) {
      throw std::logic_error("chosen_order: a view was chosen that is not left");
    }
    left.erase(found);
    map.insert(views.scans()[next]);
    order.push_back(next);
  }
  return order;
}

}  // namespace vantage
