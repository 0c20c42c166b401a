// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vantage/compiler.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/voxel.hpp>
#include <vantage/map/brick.hpp>
#include <vantage/map/brick_directory.hpp>
#include <vantage/map/map_identity.hpp>
#include <vantage/map/occupancy.hpp>
#include <vantage/map/scan.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// The beam model of Shade & Newman 2011, eq. 11-13, with OctoMap's clamping.
struct OccupancyMapOptions {
  double resolution_m = 0.1;                 ///< edge of a cell, > 0
  double log_odds_hit = 0.85;                ///< added where a ray ends, > 0 (S&N VI: l_occ)
  double log_odds_miss = -0.4;               ///< added where a ray passes, < 0 (S&N VI: l_free)
  double log_odds_min = -2.0;                ///< lower clamp, < 0
  double log_odds_max = 3.5;                 ///< upper clamp, > 0; a cell at log-odds >= 0 is occupied, as in OctoMap
  std::optional<Box> region = std::nullopt;  ///< only cells whose centre lies in it are ever known; none: no limit
  /// Whether a scan leaves occupied cells alone that its rays pass beside a surface it sees: those that touch a cell
  /// in which one of its rays ends, and the unbroken run of occupied cells that ends with a ray. A surface fills a
  /// part of its cells only, and rays at a small angle pass the free part: if they count (false, as in OctoMap), many
  /// of them wear the surface away, and false frontiers open behind it.
  bool keep_grazed_cells = true;
  /// The most that the map may hold, in bytes as `memory_bytes` counts them; 0: no limit. What would need a new brick
  /// beyond it is refused and counted (ScanReport::cells_refused, OccupancyMap::cells_refused), and stays unknown;
  /// what the map holds goes on being updated. A scan's own work space comes on top: at most 1 GB.
  std::size_t max_bytes = 0;

  /// The semantics of `octomap::OcTree::insertPointCloud`, update for update.
  [[nodiscard]] static OccupancyMapOptions octomap(double resolution_m) {
    return {.resolution_m = resolution_m, .keep_grazed_cells = false};
  }
};

/// How rays are drawn from the returns of a scan.
enum class RayPolicy : std::uint8_t {
  EveryReturn,  ///< one ray to every return
  EachEndCell,  ///< one ray to the centre of every cell that holds a return (OctoMap's `discretize`): faster
};

/// How a coarser cell speaks for the known finest cells in it (unknown ones have no say), as OctoMap's inner nodes.
enum class CoarseningPolicy : std::uint8_t { Max, Mean };

/// A three-state map of cells, unknown, free or occupied, that grows with what has been seen.
///
///     OccupancyMap map({.resolution_m = 0.1});
///     map.insert(scan);
///     if (map.at(map.frame().cell_of(point)) == Occupancy::Free) ...
///
/// Storage is sparse bricks of 8 x 8 x 8 cells (brick.hpp), so memory follows the volume seen, never its bounding
/// box. Cells are aligned as OctoMap aligns them, which makes conversion exact both ways (octomap_bridge.hpp).
///
/// Every call that changes the map makes one new revision; `changed_since` tells any number of readers, each at its
/// own pace, which bricks hold a cell whose *state* has changed. Reading from several threads is safe while nobody
/// writes.
class OccupancyMap {
 public:
  /// Number of a state of the map.
  using Revision = std::uint64_t;
  /// Known cells by state.
  struct Counts {
    std::size_t free = 0;      ///< cells known to be free
    std::size_t occupied = 0;  ///< cells known to be occupied
  };

  OccupancyMap() : OccupancyMap(OccupancyMapOptions{}) {}
  /// Throws std::invalid_argument naming the option at fault.
  explicit OccupancyMap(const OccupancyMapOptions& options);
  ~OccupancyMap() = default;
  /// The same cells, with a change log and an identity of its own.
  OccupancyMap(const OccupancyMap& other) = default;
  /// The same.
  OccupancyMap& operator=(const OccupancyMap& other) = default;
  /// Leaves `other` an empty map with the same options.
  OccupancyMap(OccupancyMap&& other);  // NOLINT(performance-noexcept-move-constructor): it gets an identity
  OccupancyMap& operator=(OccupancyMap&& other);  // NOLINT(performance-noexcept-move-constructor)
  /// Each becomes what the other was; whatever follows one follows it to its new place.
  void swap(OccupancyMap& other);

  // --- reading
  /// The options it was made with.
  [[nodiscard]] const OccupancyMapOptions& options() const { return options_; }
  /// Where cells lie in the world.
  [[nodiscard]] const VoxelFrame& frame() const { return frame_; }
  /// Edge of a cell, metres.
  [[nodiscard]] double resolution_m() const { return frame_.size_m; }
  /// The cells of the region of interest; none: every cell.
  [[nodiscard]] const std::optional<VoxelBox>& region() const { return region_; }
  /// Whether a cell may ever be known.
  [[nodiscard]] bool in_region(const VoxelIndex& cell) const { return !region_ || region_->contains(cell); }

  /// State of a cell.
  [[nodiscard]] Occupancy at(const VoxelIndex& cell) const {
    const Brick* brick = find_brick(Brick::of_cell(cell));
    return brick == nullptr ? Occupancy::Unknown : brick->at(Brick::offset_of(cell));
  }
  /// Whether a cell is free although rays have ended in it since it was last free for sure (at the lower clamp): its
  /// log-odds are none that misses alone could make. Such a cell holds a piece of a surface that rays at a grazing
  /// angle have worn away, and neither it nor what lies behind it should be counted upon. Hits that add up to a whole
  /// number of misses go unnoticed: seven of eight pass by the default constants, none does where a hit is a multiple
  /// of a miss.
  [[nodiscard]] bool contested(const VoxelIndex& cell) const;
  /// Whether a cell is free, but was occupied before: rays through its free part have worn away a surface in it, or
  /// what was there has gone. Unlike a contested cell it stays so when it is free for sure.
  [[nodiscard]] bool worn(const VoxelIndex& cell) const {
    const Brick* brick = find_brick(Brick::of_cell(cell));
    return brick != nullptr && brick->worn(Brick::offset_of(cell));
  }
  /// Whether a cell is free and not contested: what sight passes, and a body may touch.
  [[nodiscard]] bool is_clear(const VoxelIndex& cell) const {
    const Brick* brick = find_brick(Brick::of_cell(cell));
    return brick != nullptr && is_clear(*brick, Brick::offset_of(cell));
  }
  /// Log-odds of a cell; none where it is unknown.
  [[nodiscard]] std::optional<double> log_odds(const VoxelIndex& cell) const;
  /// Log-odds of the cell of 2^level finest cells an edge at `coarse` (in units of that cell); none if all of it is
  /// unknown. `level` is in [0, 16].
  [[nodiscard]] std::optional<double> log_odds(const VoxelIndex& coarse, int level, CoarseningPolicy policy) const;
  /// State of a coarser cell: unknown if all of it is, else by its log-odds.
  [[nodiscard]] Occupancy at(const VoxelIndex& coarse, int level, CoarseningPolicy policy) const;

  /// Known cells by state; walks all bricks.
  [[nodiscard]] Counts counts() const;
  /// The smallest box that holds every known cell.
  [[nodiscard]] VoxelBox bounds() const;
  /// Bytes held, directory included.
  [[nodiscard]] std::size_t memory_bytes() const;
  /// How many bricks it holds: at least a 512th of its known cells.
  [[nodiscard]] std::size_t brick_count() const { return bricks_.size(); }
  /// How many updates of cells were refused since it was made (OccupancyMapOptions::max_bytes).
  [[nodiscard]] std::size_t cells_refused() const { return cells_refused_; }
  /// What one step of the stored log-odds is worth: 0.05 for the default options, which it represents exactly.
  [[nodiscard]] double log_odds_step() const { return step_; }

  /// The cells of one of its bricks that are free and not contested.
  [[nodiscard]] BrickPlane clear_plane(const Brick& brick) const {
    BrickPlane clear{};
    for (std::size_t word = 0; word < Brick::kWords; ++word) {
      clear[word] = brick.free(word);
      for_each_offset(clear[word], word, [&](std::size_t offset) {
        clear[word] &= ~(std::uint64_t{shows_a_hit(brick.log_odds[offset])} << (offset & 63U));
      });
    }
    return clear;
  }
  /// The brick at an address (in units of bricks), or null where nothing has been seen. Valid while the map lives.
  [[nodiscard]] const Brick* find_brick(const VoxelIndex& brick) const {
    const BrickDirectory::Number number = directory_.find(brick);
    return number == BrickDirectory::kNone ? nullptr : &bricks_[number].cells;
  }
  /// Calls `visit(brick address, const Brick&)` for every brick, in order of creation.
  template <class Visit>
  void for_each_brick(Visit&& visit) const {
    for (const Stored& stored : bricks_) {
      visit(stored.address, stored.cells);
    }
  }
  /// Calls `visit(VoxelIndex, Occupancy)` for every known cell.
  template <class Visit>
  void for_each_known(Visit&& visit) const {
    for_each_brick([&](const VoxelIndex& address, const Brick& brick) {
      for (std::size_t word = 0; word < Brick::kWords; ++word) {
        for_each_offset(brick.known[word], word, [&](std::size_t offset) {
          visit(Brick::first_cell(address) + Brick::cell_at(offset), brick.at(offset));
        });
      }
    });
  }
  /// Calls `visit(VoxelIndex)` for every clear cell.
  template <class Visit>
  void for_each_clear(Visit&& visit) const {
    for_each_brick([&](const VoxelIndex& address, const Brick& brick) {
      const BrickPlane clear = clear_plane(brick);
      for (std::size_t word = 0; word < Brick::kWords; ++word) {
        for_each_offset(clear[word], word,
                        [&](std::size_t offset) { visit(Brick::first_cell(address) + Brick::cell_at(offset)); });
      }
    });
  }

  /// Which map this is; what it was made from does not matter (see KnownMap).
  [[nodiscard]] const MapIdentity& identity() const { return identity_; }

  // --- what changed
  /// Grows by one with every call that writes to the map, a scan that confirms what is known included; 0 for a new
  /// map.
  [[nodiscard]] Revision revision() const { return revision_; }
  /// Addresses of the bricks in which a cell changed its state after `revision`, the latest first. Costs what it
  /// returns. Throws std::invalid_argument if `revision` is still to come.
  [[nodiscard]] std::vector<VoxelIndex> changed_since(Revision revision) const;
  /// Calls `visit(brick address, const Brick&)` for the same bricks in the same order. Errors as changed_since.
  template <class Visit>
  void for_each_changed_since(Revision revision, Visit&& visit) const {
    require_past(revision);
    for (BrickDirectory::Number number = newest_; number != BrickDirectory::kNone;) {
      const Stored& stored = bricks_[number];
      if (stored.changed <= revision) {
        break;
      }
      visit(stored.address, stored.cells);
      number = stored.older;
    }
  }

  /// Calls `visit(brick address, const Brick&)` for the bricks that were written to after `revision`, in order of
  /// creation: those in which a cell may have become contested or clear, or changed its state. Costs a look at every
  /// brick's revision besides. Errors as changed_since.
  template <class Visit>
  void for_each_written_since(Revision revision, Visit&& visit) const {
    require_past(revision);
    for (std::size_t number = 0; number < written_.size(); ++number) {
      if (written_[number] > revision) {
        visit(bricks_[number].address, bricks_[number].cells);
      }
    }
  }

  // --- writing
  /// Integrates one scan: each cell gets at most one update, a hit beats a miss (the semantics of
  /// octomap::OcTree::insertPointCloud). The sensor's own cell counts as passed. Throws std::invalid_argument if the
  /// pose is not rigid or `max_range_m` is not positive; rays that cannot be used are skipped and counted. What of a
  /// ray lies outside the region costs nothing but its few numbers.
  ScanReport insert(const Scan& scan, RayPolicy policy = RayPolicy::EveryReturn);
  /// Makes a new revision and changes nothing, as a scan does that confirms what is known.
  void confirm() { ++revision_; }
  /// Sets the state of a cell outright, at the clamping limit, and forgets what it was; Unknown forgets that it was
  /// seen. Outside the region: no effect. Throws std::invalid_argument for a cell that cannot be addressed
  /// (kFurthestVoxel).
  void set(const VoxelIndex& cell, Occupancy occupancy);
  /// Sets the log-odds of a cell, clamped and rounded to a step, but never across 0: what is below stays free. As
  /// when a scan changes them, an occupied cell that becomes free is worn. Outside the region: no effect. Throws
  /// std::invalid_argument for NaN and for a cell that cannot be addressed.
  void set_log_odds(const VoxelIndex& cell, double log_odds) {
    require_addressable(cell, "OccupancyMap::set_log_odds");
    set_log_odds(VoxelBox{cell, cell + VoxelIndex{1, 1, 1}}, log_odds);
  }
  /// The most cells that a box to be written may have, those outside the region left out: a cube of 1024.
  static constexpr std::size_t kMaxBoxCells = std::size_t{1} << 30U;
  /// The same for every cell of a box, in one revision. Throws std::invalid_argument where the box holds more than
  /// kMaxBoxCells of the region.
  void set_log_odds(const VoxelBox& cells, double log_odds);
  /// Declares the still unknown cells that `box` touches free, as a host may for the space its robot stands in.
  /// Throws std::invalid_argument for a box that is empty or cannot be addressed, or holds more than kMaxBoxCells of
  /// the region.
  void assume_free(const Box& box);

 private:
  struct Stored {
    Brick cells;
    VoxelIndex address;
    Revision changed = 0;                                  // the last revision in which a cell changed its state
    BrickDirectory::Number newer = BrickDirectory::kNone;  // neighbours in the order of `changed`
    BrickDirectory::Number older = BrickDirectory::kNone;
  };
  friend class ScanInserter;

  // Whether log-odds of a free cell are none that misses alone could make.
  [[nodiscard]] bool shows_a_hit(std::int8_t steps) const { return steps > min_steps_ && steps % miss_steps_ != 0; }
  [[nodiscard]] bool is_clear(const Brick& brick, std::size_t offset) const {
    return brick.at(offset) == Occupancy::Free && !shows_a_hit(brick.log_odds[offset]);
  }
  void require_past(Revision revision) const;
  static void require_addressable(const VoxelIndex& cell, const char* what);
  [[nodiscard]] VoxelBox writable(const VoxelBox& cells, const char* what) const;
  // kNone where the map is full.
  BrickDirectory::Number brick_for(const VoxelIndex& address);
  void mark_changed(BrickDirectory::Number number);
  enum class Past : std::uint8_t { Kept, Forgotten };
  void write(const VoxelIndex& cell, Occupancy state, std::int8_t steps, Past past);
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
  std::deque<Stored> bricks_;
  std::vector<Revision> written_;  // of each brick, the last revision that wrote to it
  std::size_t cells_refused_ = 0;
  Revision revision_ = 0;
  BrickDirectory::Number newest_ = BrickDirectory::kNone;
};

}  // namespace vantage
