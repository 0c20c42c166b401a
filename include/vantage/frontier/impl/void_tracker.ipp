// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <functional>
#include <iterator>
#include <optional>
#include <span>
#include <utility>
#include <vantage/frontier/void_tracker.hpp>
#include <vantage/geometry/raster_order.hpp>

#include <vantage/frontier/impl/hull_change.hpp>
#include <vantage/frontier/impl/lattice_point.hpp>
#include <vantage/frontier/impl/on_facet.hpp>
#include <vantage/geometry/impl/box_overlap.hpp>
#include <vantage/geometry/impl/plane_distance.hpp>
#include <vantage/map/impl/brick_plane.hpp>
#include <vantage/map/impl/connected_cells.hpp>

namespace vantage {
namespace detail {

// A hull of n corners has 2 n - 4 triangles. One with many more is made anew from its corners.
inline constexpr std::size_t kTrianglesPerCorner = 8;

// Whether all cells that can become known lie in one plane, so that the hull is always empty.
inline bool is_one_layer(const OccupancyMap& map) {
  if (!map.region()) {
    return false;
  }
  const VoxelIndex extent = map.region()->extent();
  return std::min({extent.x, extent.y, extent.z}) <= 1;
}

}  // namespace detail

VANTAGE_INLINE VoidTracker::VoidTracker(const OccupancyMap& map)
    : map_(&map), connected_(std::make_unique<detail::ConnectedCells>()) {
  update();
}
VANTAGE_INLINE VoidTracker::VoidTracker(VoidTracker&&) noexcept = default;
VANTAGE_INLINE VoidTracker& VoidTracker::operator=(VoidTracker&&) noexcept = default;
VANTAGE_INLINE VoidTracker::~VoidTracker() = default;

VANTAGE_INLINE bool VoidTracker::update() {
  std::vector<VoxelIndex> touched = map_->changed_since(revision_);
  revision_ = map_->revision();
  if (touched.empty() || detail::is_one_layer(*map_)) {
    return false;
  }
  if (hull_.empty()) {
    start_anew();
    return true;
  }
  widen(touched);
  const bool shrunk = has_lost_a_corner();
  if (shrunk) {
    shrink(touched);
  }
  std::vector<VoxelIndex> outside;
  for (const VoxelIndex& address : touched) {
    if (Stored* const brick = find(address)) {
      refresh(*brick);
      collect_outside(*brick, outside);
    }
  }
  if (hull_.empty()) {
    start_anew();
  } else if (!outside.empty()) {
    LatticeHull grown = hull_;
    grown.insert(outside);
    reshape(std::move(grown));
  }
  return shrunk || !outside.empty();
}

VANTAGE_INLINE bool VoidTracker::has_lost_a_corner() const {
  return !std::all_of(corners_.begin(), corners_.end(),
                      [&](const VoxelIndex& corner) { return map_->at(corner) == Occupancy::Occupied; });
}

// Rebuilds everything from all occupied cells.
VANTAGE_INLINE void VoidTracker::start_anew() {
  numbers_ = {};
  bricks_.clear();
  cell_count_ = 0;
  *connected_ = {};
  behind_ = {};
  hull_ = {};
  planes_.clear();
  corners_.clear();
  tiles_ = VoidTiles(*map_);
  std::vector<VoxelIndex> cells;
  map_->for_each_brick([&](const VoxelIndex& address, const Brick& brick) {
    store(address, {});
    detail::append(brick.occupied, address, cells);
  });
  reshape(LatticeHull(cells));
}

// Stores the touched bricks that are new in the map, adds their tiles, and finds the cells inside the hull in tiles
// that were not searched before.
VANTAGE_INLINE void VoidTracker::widen(const std::vector<VoxelIndex>& touched) {
  const std::size_t before = tiles_.tiles().size();
  std::optional<detail::HullChange> whole;
  for (const VoxelIndex& address : touched) {
    if (find(address) == nullptr) {
      BrickPlane inside{};
      if (tiles_.contains(Brick::of_cell(address))) {
        detail::HullChange& hull = whole ? *whole : whole.emplace(detail::HullChange({}, {planes_, corners_}));
        hull.for_each_brick({address, address + VoxelIndex{1, 1, 1}},
                            [&](const VoxelIndex&, const BrickPlane& cells) { inside = cells; });
      }
      store(address, inside);
    }
  }
  for (const VoxelIndex& address : touched) {
    tiles_.add(address);
  }
  for (std::size_t tile = before; tile < tiles_.tiles().size(); ++tile) {
    apply(whole ? *whole : whole.emplace(detail::HullChange({}, {planes_, corners_})), tiles_.tiles()[tile], nullptr);
  }
}

// Replaces the hull by the hull of those corners that are still occupied. Appends to `touched` the bricks of the map
// in which the hull has changed, because their occupied cells may now lie outside.
VANTAGE_INLINE void VoidTracker::shrink(std::vector<VoxelIndex>& touched) {
  std::vector<VoxelIndex> left;
  std::copy_if(corners_.begin(), corners_.end(), std::back_inserter(left),
               [&](const VoxelIndex& corner) { return map_->at(corner) == Occupancy::Occupied; });
  reshape(LatticeHull(left), &touched);
}

// Replaces the hull where the set of cells inside it has changed.
VANTAGE_INLINE void VoidTracker::reshape(LatticeHull hull, std::vector<VoxelIndex>* reshaped) {
  std::vector<LatticeHull::Plane> planes = hull.planes();
  std::vector<VoxelIndex> corners = hull.corners();
  detail::HullChange change({planes_, corners_}, {planes, corners});
  for (const VoxelIndex& tile : tiles_.tiles()) {
    apply(change, tile, reshaped);
  }
  // The cost of a hull follows its triangles.
  hull_ =
      hull.triangle_count() > detail::kTrianglesPerCorner * corners.size() ? LatticeHull(corners) : std::move(hull);
  planes_ = std::move(planes);
  corners_ = std::move(corners);
}

// Applies a change of the hull to the bricks of a tile, and appends those of the map to `reshaped`.
VANTAGE_INLINE void VoidTracker::apply(detail::HullChange& change, const VoxelIndex& tile,
                                       std::vector<VoxelIndex>* reshaped) {
  const BrickPlane* const held = tiles_.held(tile);
  const auto holds = [&](const VoxelBox& bricks) { return held != nullptr && detail::overlaps(*held, tile, bricks); };
  const auto visit = [&](const VoxelIndex& address, const BrickPlane& inside) {
    Stored& brick = *find(address);
    brick.inside = inside;
    refresh(brick);
    if (reshaped != nullptr) {
      reshaped->push_back(address);
    }
  };
  const std::int64_t growth = change.growth(VoidTiles::bricks_of(tile), std::cref(holds), std::cref(visit));
  cell_count_ += static_cast<std::size_t>(growth);
  if (growth != 0) {  // a hull that changes contains the other one
    connected_->changed(tile);
  }
}

VANTAGE_INLINE const VoidTracker::Stored* VoidTracker::find(const VoxelIndex& address) const {
  const BrickDirectory::Number number = numbers_.find(address);
  return number == BrickDirectory::kNone ? nullptr : &bricks_[number];
}

VANTAGE_INLINE VoidTracker::Stored* VoidTracker::find(const VoxelIndex& address) {
  return const_cast<Stored*>(std::as_const(*this).find(address));
}

// As a brick with no cell known, which is how its cells were counted before.
VANTAGE_INLINE void VoidTracker::store(const VoxelIndex& address, const BrickPlane& inside) {
  numbers_.place(address) = static_cast<BrickDirectory::Number>(bricks_.size());
  bricks_.push_back({address, inside, inside});
}

// The region needs no test: it is a box, so the hull of cells inside it stays inside it.
VANTAGE_INLINE void VoidTracker::refresh(Stored& brick) {
  const Brick* const known = map_->find_brick(brick.address);
  BrickPlane voids = brick.inside;
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    voids[word] &= ~(known == nullptr ? 0 : known->known[word]);
  }
  if (voids != brick.voids) {
    cell_count_ += detail::size_of(voids) - detail::size_of(brick.voids);
    brick.voids = voids;
    connected_->changed(Brick::of_cell(brick.address));
  }
}

VANTAGE_INLINE void VoidTracker::collect_outside(const Stored& brick, std::vector<VoxelIndex>& cells) const {
  if (const Brick* const known = map_->find_brick(brick.address)) {
    BrickPlane outside = known->occupied;
    for (std::size_t word = 0; word < Brick::kWords; ++word) {
      outside[word] &= ~brick.inside[word];
    }
    detail::append(outside, brick.address, cells);
  }
}

// The void cells of a tile. `whole` leads from an empty hull to this one.
VANTAGE_INLINE void VoidTracker::fill(detail::HullChange& whole, const VoxelIndex& tile,
                                      std::span<BrickPlane> bricks) const {
  if (tiles_.contains(tile)) {
    whole.for_each_brick(VoidTiles::bricks_of(tile), [&](const VoxelIndex& address, const BrickPlane& inside) {
      const Stored* const brick = find(address);
      bricks[detail::ConnectedCells::in_tile(address)] = brick == nullptr ? inside : brick->voids;
    });
  }
}

VANTAGE_INLINE bool VoidTracker::contains(const VoxelIndex& cell) const {
  const VoxelIndex brick = Brick::of_cell(cell);
  if (const Stored* const stored = find(brick)) {
    const std::size_t offset = Brick::offset_of(cell);
    return detail::has(stored->voids, offset);
  }
  return !hull_.empty() && tiles_.contains(Brick::of_cell(brick)) &&
         std::all_of(planes_.begin(), planes_.end(), [&](const LatticeHull::Plane& plane) {
           return detail::distance_from(plane.plane(), detail::lattice_point(cell)) <= detail::kOnFacet;
         });
}

VANTAGE_INLINE std::vector<VoxelIndex> VoidTracker::cells() const {
  std::vector<VoxelIndex> cells;
  cells.reserve(cell_count_);
  detail::HullChange whole({}, {planes_, corners_});
  for (const VoxelIndex& tile : tiles_.tiles()) {
    whole.for_each_brick(VoidTiles::bricks_of(tile), [&](const VoxelIndex& address, const BrickPlane& inside) {
      const Stored* const brick = find(address);
      detail::append(brick == nullptr ? inside : brick->voids, address, cells);
    });
  }
  std::sort(cells.begin(), cells.end(), RasterOrder{});
  return cells;
}

VANTAGE_INLINE BrickSet VoidTracker::cells_behind(std::span<const VoxelIndex> frontier,
                                                  std::span<const VoxelBox> near) {
  std::vector<VoxelIndex> starts;
  for (const VoxelIndex& cell : frontier) {
    for (const VoxelIndex& step : kFaceNeighbours) {
      const Stored* const brick = find(Brick::of_cell(cell + step));
      const std::size_t offset = Brick::offset_of(cell + step);
      if (brick == nullptr || detail::has(brick->voids, offset)) {
        starts.push_back(cell + step);
      }
    }
  }
  detail::HullChange whole({}, {planes_, corners_});
  connected_->connect(
      starts, [&](const VoxelIndex& tile, std::span<BrickPlane> bricks) { fill(whole, tile, bricks); },
      [&](const VoxelIndex& brick, const BrickPlane& cells) { (void)behind_.assign(brick, cells); });
  VoxelTable<std::optional<bool>> is_near;  // by tile
  BrickSet cells;
  behind_.for_each_brick([&](const VoxelIndex& brick, const BrickPlane& behind) {
    const VoxelIndex tile = Brick::of_cell(brick);
    std::optional<bool>& near_here = is_near.place(tile);
    if (!near_here) {
      near_here = std::any_of(near.begin(), near.end(), [box = VoidTiles::cells_of(tile)](const VoxelBox& one) {
        return !detail::box_overlap(one, box).empty();
      });
    }
    if (*near_here) {
      (void)cells.assign(brick, behind);
    }
  });
  return cells;
}

}  // namespace vantage
