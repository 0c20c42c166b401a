// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vantage/compiler.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/voxel.hpp>
#include <vantage/map/brick.hpp>
#include <vantage/map/brick_directory.hpp>
#include <vantage/map/brick_store.hpp>
#include <vantage/map/map_identity.hpp>
#include <vantage/map/occupancy.hpp>
#include <vantage/map/occupancy_map_options.hpp>
#include <vantage/map/scan.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// How the value of a coarse cell is computed from the known finest cells inside it. Unknown cells are ignored, as in
/// the inner nodes of OctoMap.
enum class CoarseningPolicy : std::uint8_t { Max, Mean };

/// A sparse occupancy map with three states: unknown, free and occupied. It grows with the observed volume.
///
///     OccupancyMap map({.resolution_m = 0.1});
///     map.insert(scan);
///     if (map.at(map.frame().cell_of(point)) == Occupancy::Free) ...
///
/// Cells are stored in bricks of 8 x 8 x 8 (brick.hpp), so memory depends on the observed volume and not on the
/// bounding box. Cells are aligned as in OctoMap, so conversion is exact both ways (octomap_bridge.hpp).
///
/// Every call that writes creates one new revision. `changed_since` reports the bricks in which the *state* of a cell
/// has changed since a revision, so any number of readers can follow the map. Reads may be concurrent, writes not.
class OccupancyMap {
 public:
  /// A counter of the states of the map.
  using Revision = std::uint64_t;
  /// Number of known cells by state.
  struct Counts {
    std::size_t free = 0;      ///< cells known to be free
    std::size_t occupied = 0;  ///< cells known to be occupied
  };

  OccupancyMap() : OccupancyMap(OccupancyMapOptions{}) {}
  /// Throws std::invalid_argument, which names the option that is out of range.
  explicit OccupancyMap(const OccupancyMapOptions& options);
  /// The same map, of which about `resident_bytes` (at least 65536) of bricks stay in memory. Bricks that were not
  /// written to for longest go to a file in `folder` and come back when they are used; those that are only read stay
  /// until a later scan. If the disk is full, updates that need a new brick are refused and counted, as beyond
  /// `max_bytes`, which counts all bricks. The file has no name and ends with the process; a copy has its own. If the
  /// disk fails, the kernel may end the process by SIGBUS. Throws std::runtime_error if the folder takes no file.
  OccupancyMap(const OccupancyMapOptions& options, const std::string& folder, std::size_t resident_bytes);
  ~OccupancyMap() = default;
  /// Copies the cells and the change log. The copy gets its own identity. Throws std::runtime_error if the bricks are
  /// in a file and there is no room on its disk for another.
  OccupancyMap(const OccupancyMap& other) = default;
  /// Copies the cells and the change log into this map, which gets a new identity. Throws as the copy constructor;
  /// this map is then unchanged.
  OccupancyMap& operator=(const OccupancyMap& other);
  /// Takes over the map. `other` becomes an empty map in memory with the same options.
  OccupancyMap(OccupancyMap&& other);  // NOLINT(performance-noexcept-move-constructor): it allocates
  /// Takes over `other` into this map. `other` becomes an empty map in memory with the same options.
  OccupancyMap& operator=(OccupancyMap&& other);  // NOLINT(performance-noexcept-move-constructor)
  /// Exchanges two maps, identities included.
  void swap(OccupancyMap& other);

  // --- reading
  /// The options that were passed to the constructor.
  [[nodiscard]] const OccupancyMapOptions& options() const { return options_; }
  /// Converts between cells and metres in the world frame.
  [[nodiscard]] const VoxelFrame& frame() const { return frame_; }
  /// Edge length of a cell, metres.
  [[nodiscard]] double resolution_m() const { return frame_.size_m; }
  /// The cells of the region of interest; nullopt if every cell can be known.
  [[nodiscard]] const std::optional<VoxelBox>& region() const { return region_; }
  /// Whether a cell can become known.
  [[nodiscard]] bool in_region(const VoxelIndex& cell) const { return !region_ || region_->contains(cell); }

  /// State of a cell.
  [[nodiscard]] Occupancy at(const VoxelIndex& cell) const {
    const Brick* brick = find_brick(Brick::of_cell(cell));
    return brick == nullptr ? Occupancy::Unknown : brick->at(Brick::offset_of(cell));
  }
  /// Whether the log-odds of a free cell show that a ray has ended in it since it was last at the lower clamp: they
  /// are not a whole number of misses. Such a cell may hold a surface that rays at a grazing angle have erased, so
  /// no body should be there. Hits that add up to a whole number of misses go unnoticed: every
  /// eighth hit with the default constants, every hit if a hit is a multiple of a miss.
  [[nodiscard]] bool contested(const VoxelIndex& cell) const;
  /// Whether a cell is free and not contested: a robot may occupy it.
  [[nodiscard]] bool is_clear(const VoxelIndex& cell) const {
    const Brick* brick = find_brick(Brick::of_cell(cell));
    return brick != nullptr && is_clear(*brick, Brick::offset_of(cell));
  }
  /// Log-odds of a cell; nullopt if it is unknown.
  [[nodiscard]] std::optional<double> log_odds(const VoxelIndex& cell) const;
  /// Log-odds of a coarse cell; its edge is 2^level finest cells, and `coarse` is its index in that unit. nullopt if
  /// all cells inside are unknown. Throws std::invalid_argument if `level` is not in [0, 16].
  [[nodiscard]] std::optional<double> log_odds(const VoxelIndex& coarse, int level, CoarseningPolicy policy) const;
  /// State of a coarse cell: unknown if all cells inside are unknown, else by its log-odds. Errors as log_odds.
  [[nodiscard]] Occupancy at(const VoxelIndex& coarse, int level, CoarseningPolicy policy) const;

  /// Number of known cells by state. Visits all bricks.
  [[nodiscard]] Counts counts() const;
  /// The smallest box that contains all known cells; empty if there are none.
  [[nodiscard]] VoxelBox bounds() const { return may_have_shrunk_ ? box_of_known() : bounds_; }
  /// Bytes of the map, directory included, in memory or on disk, none shared.
  [[nodiscard]] std::size_t memory_bytes() const;
  /// What of it is in memory: equal free bricks (`assign`) count once. Bricks on disk that were read add to it.
  [[nodiscard]] std::size_t resident_bytes() const;
  /// The number of bricks.
  [[nodiscard]] std::size_t brick_count() const { return bricks_.size(); }
  /// The number of cell updates refused so far because of OccupancyMapOptions::max_bytes or the size of a scan.
  [[nodiscard]] std::size_t cells_refused() const { return cells_refused_; }
  /// Log-odds of one stored step: 0.05 for the default options, which are then stored without rounding.
  [[nodiscard]] double log_odds_step() const { return step_; }

  /// The clear cells (see `is_clear`) of a brick of this map.
  [[nodiscard]] BrickPlane clear_plane(const Brick& brick) const {
    BrickPlane clear = brick.free();
    for (std::size_t word = 0; word < Brick::kWords; ++word) {
      for_each_offset(clear[word], word, [&](std::size_t offset) {
        clear[word] &= ~(std::uint64_t{shows_a_hit(brick.log_odds[offset])} << (offset & 63U));
      });
    }
    return clear;
  }
  /// The brick at an address (in units of bricks), or null if it is not stored. Valid until the map is written to.
  [[nodiscard]] const Brick* find_brick(const VoxelIndex& brick) const {
    const BrickDirectory::Number number = directory_.find(brick);
    return number == BrickDirectory::kNone ? nullptr : &bricks_[number];
  }
  /// Calls `visit(brick address, const Brick&)` for every brick, in order of creation.
  template <class Visit>
  void for_each_brick(Visit&& visit) const {
    for (std::size_t number = 0; number < bricks_.size(); ++number) {
      visit(entries_[number].address, bricks_[number]);
    }
  }
  /// Calls `visit(VoxelIndex, Occupancy)` for every known cell.
  template <class Visit>
  void for_each_known(Visit&& visit) const {
    for_each_brick([&](const VoxelIndex& address, const Brick& brick) {
      for_each_offset(brick.known,
                      [&](std::size_t offset) { visit(Brick::cell_at(address, offset), brick.at(offset)); });
    });
  }
  /// Calls `visit(VoxelIndex)` for every clear cell.
  template <class Visit>
  void for_each_clear(Visit&& visit) const {
    for_each_brick([&](const VoxelIndex& address, const Brick& brick) {
      const BrickPlane clear = clear_plane(brick);
      for_each_offset(clear, [&](std::size_t offset) { visit(Brick::cell_at(address, offset)); });
    });
  }

  /// The identity of this map, see KnownMap.
  [[nodiscard]] const MapIdentity& identity() const { return identity_; }

  // --- what changed
  /// The current revision. It grows by one with every call that writes, also with a scan that changes no state. It is
  /// 0 for a new map.
  [[nodiscard]] Revision revision() const { return revision_; }
  /// Addresses of the bricks in which a cell changed its state after `revision`, most recent first. The cost is
  /// linear in the result. Throws std::invalid_argument if `revision` is in the future.
  [[nodiscard]] std::vector<VoxelIndex> changed_since(Revision revision) const;
  /// Calls `visit(brick address, const Brick&)` for the bricks of changed_since, in the same order. Errors as
  /// changed_since.
  template <class Visit>
  void for_each_changed_since(Revision revision, Visit&& visit) const {
    require_past(revision);
    for (BrickDirectory::Number number = newest_; number != BrickDirectory::kNone;) {
      const Entry& entry = entries_[number];
      if (entry.changed <= revision) {
        break;
      }
      visit(entry.address, bricks_[number]);
      number = entry.older;
    }
  }

  /// Calls `visit(brick address, const Brick&)` for the bricks that were written to after `revision`, in order of
  /// creation: those in which a cell may have become contested or clear, or changed its state. It compares the
  /// revision of every brick. Errors as changed_since.
  template <class Visit>
  void for_each_written_since(Revision revision, Visit&& visit) const {
    require_past(revision);
    for (std::size_t number = 0; number < written_.size(); ++number) {
      if (written_[number] > revision) {
        visit(entries_[number].address, bricks_[number]);
      }
    }
  }

  // --- writing
  /// Integrates one scan. Each cell gets at most one update, and a hit has priority over a miss, as in
  /// octomap::OcTree::insertPointCloud. The cell of the sensor counts as passed. Rays that cannot be used are skipped
  /// and counted. Throws std::invalid_argument if the pose is not rigid or `max_range_m` is not positive.
  ScanReport insert(const Scan& scan, RayPolicy policy = RayPolicy::EveryReturn);
  /// Integrates one scan whose points lie in the memory of the host; they are not copied. The points may be in any
  /// frame whose pose is `world_from_sensor`. Throws as the overload above.
  ScanReport insert(const ScanView& scan, RayPolicy policy = RayPolicy::EveryReturn);
  /// Creates a new revision without a change, like a scan that only confirms known states.
  void confirm() { ++revision_; }
  /// Sets the state of a cell with log-odds at the clamping limit. Unknown makes the cell unseen. No effect
  /// outside the region. Throws std::invalid_argument if the cell is not addressable (kFurthestVoxel).
  void set(const VoxelIndex& cell, Occupancy occupancy);
  /// Sets the state of all cells of a brick in one revision: log-odds, limits and what readers are told are those of
  /// `set` for each cell in order of its offset. `brick` is an address in units of bricks, `known` and `occupied` are
  /// bit planes (brick.hpp). No effect if no cell of the brick is inside the region. Throws std::invalid_argument if
  /// the brick holds a cell that is not addressable, or if an occupied cell is not known.
  void assign(const VoxelIndex& brick, const BrickPlane& known, const BrickPlane& occupied);
  /// Sets the log-odds of a cell, clamped and rounded to a step; a negative value stays negative. No effect
  /// outside the region. Throws std::invalid_argument for NaN and for a cell that is not addressable.
  void set_log_odds(const VoxelIndex& cell, double log_odds) {
    require_addressable(cell, "OccupancyMap::set_log_odds");
    set_log_odds(VoxelBox{cell, cell + VoxelIndex{1, 1, 1}}, log_odds);
  }
  /// The largest number of cells (inside the region) in a box to write: a cube of 1024.
  static constexpr std::size_t kMaxBoxCells = std::size_t{1} << 30U;
  /// Sets the log-odds of every cell of a box in one revision. Throws std::invalid_argument as for a single cell, and
  /// if the box holds more than kMaxBoxCells cells of the region.
  void set_log_odds(const VoxelBox& cells, double log_odds);
  /// Declares the unknown cells that `box` touches as free, for example the space of the robot itself. World frame,
  /// metres. Throws std::invalid_argument if the box is empty, not addressable, or holds more than kMaxBoxCells cells
  /// of the region.
  void assume_free(const Box& box);

 private:
  // What is known of a brick without its cells, which may be on disk.
  struct Entry {
    VoxelIndex address;
    Revision changed = 0;                                  // the last revision that changed the state of a cell
    BrickDirectory::Number newer = BrickDirectory::kNone;  // links of the list sorted by `changed`
    BrickDirectory::Number older = BrickDirectory::kNone;
  };
  static constexpr std::size_t kBytesOfEntry = sizeof(Entry) + sizeof(void*) + sizeof(Revision);
  friend class MapFollower;
  friend class ScanInserter;

  // Whether these log-odds of a free cell cannot result from misses alone.
  [[nodiscard]] bool shows_a_hit(std::int8_t steps) const { return steps > min_steps_ && steps % miss_steps_ != 0; }
  [[nodiscard]] bool is_clear(const Brick& brick, std::size_t offset) const {
    return brick.at(offset) == Occupancy::Free && !shows_a_hit(brick.log_odds[offset]);
  }
  void require_past(Revision revision) const;
  static void require_addressable(const VoxelIndex& cell, const char* what);
  static void require_addressable_brick(const VoxelIndex& brick, const char* what);
  [[nodiscard]] BrickPlane in_region(const VoxelIndex& brick, BrickPlane cells) const;
  [[nodiscard]] VoxelBox writable(const VoxelBox& cells, const char* what) const;
  // Returns kNone if the memory limit is reached or the disk is full.
  BrickDirectory::Number brick_for(const VoxelIndex& address);
  // A brick, to write to in this revision.
  Brick& writing(BrickDirectory::Number number) {
    written_[number] = revision_;
    return bricks_.to_write(number);
  }
  void mark_changed(BrickDirectory::Number number);
  void write(const VoxelIndex& cell, Occupancy state, std::int8_t steps);
  std::size_t write_brick(const VoxelIndex& address, const BrickPlane& which, const Brick& cells);
  void note_unknown(const VoxelIndex& address, const BrickPlane& cells);
  void begin_revision();
  void grow_bounds(const VoxelBox& cells);
  void grow_bounds(const VoxelIndex& address, const Brick& brick);
  [[nodiscard]] VoxelBox box_of_known() const;
  [[nodiscard]] std::int8_t to_steps(double log_odds) const;

  MapIdentity identity_;
  OccupancyMapOptions options_;
  VoxelFrame frame_;
  std::optional<VoxelBox> region_;
  double step_ = 0.05;
  std::int8_t hit_steps_ = 0;
  std::int8_t miss_steps_ = 0;
  std::int8_t min_steps_ = 0;
  std::int8_t max_steps_ = 0;

  BrickDirectory directory_;
  BrickStore bricks_;
  std::deque<Entry> entries_;      // per brick
  VoxelBox bounds_;                // of the known cells, unless it may have shrunk
  bool may_have_shrunk_ = false;   // a cell at the border of `bounds_` became unknown
  std::vector<Revision> written_;  // per brick: the last revision that wrote to it
  std::size_t cells_refused_ = 0;
  Revision revision_ = 0;
  BrickDirectory::Number newest_ = BrickDirectory::kNone;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/map/impl/assign_brick.ipp>
#include <vantage/map/impl/insert_scan.ipp>
#include <vantage/map/impl/map_bounds.ipp>
#include <vantage/map/impl/occupancy_map.ipp>
#endif
