// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/raytrace/cell_set.hpp>
#include <vector>

namespace vantage::detail {

/// A copy of a map in a form made for ray casting: bit planes in words of 4 x 4 x 4 cells (the same layout as in
/// Brick), and for every word the distance to the nearest word with a cell that stops a ray. A cell stops a ray
/// unless it is known free.
///
/// Words are stored in blocks of 2 x 2 x 2, and blocks in pages of 4 x 4 x 4. Both exist only where the map has
/// bricks; a dense table finds the pages. All unseen space shares one page and one block, which stop every ray.
class BlockingGrid {
  struct Page;
  struct Block;

 public:
  class Reader;

  /// Upper limit of a distance. It equals the side of a page, so a page depends only on its 26 neighbours.
  static constexpr std::uint8_t kFurthest = 8;

  /// Creates an empty grid whose cells have an edge of 2^level finest cells.
  BlockingGrid(int level, CoarseningPolicy policy) : level_(level), policy_(policy) {
    nothing_.blocking.fill(~std::uint64_t{0});
    unseen_.blocks.fill(&nothing_);
  }
  ~BlockingGrid() = default;
  BlockingGrid(BlockingGrid&&) = delete;  // the table points into the grid
  BlockingGrid& operator=(BlockingGrid&&) = delete;
  BlockingGrid(const BlockingGrid&) = delete;
  BlockingGrid& operator=(const BlockingGrid&) = delete;

  /// Applies the changes of the map since the last call. Returns the number of bricks that were read. Throws
  /// std::length_error if the known cells are too far apart.
  std::size_t update(const OccupancyMap& map);

  /// See RayCaster::suppose.
  void suppose(const CellSet& stopping);

  /// The cells of a word that stop rays.
  [[nodiscard]] std::uint64_t blocking(const VoxelIndex& word) const {
    return page_of(word).block_of(word).blocking[offset_in_block(word)];
  }
  /// The occupied cells of a word.
  [[nodiscard]] std::uint64_t occupied(const VoxelIndex& word) const {
    return page_of(word).block_of(word).occupied[offset_in_block(word)];
  }
  /// Distance d of a word, in words: no word less than d words away, along every axis, stops a ray. 0 if this word
  /// does.
  [[nodiscard]] std::uint8_t distance(const VoxelIndex& word) const { return page_of(word).distance_of(word); }
  /// State of a cell.
  [[nodiscard]] Occupancy at(const VoxelIndex& cell) const {
    const VoxelIndex word = CellSet::word_of(cell);
    const std::uint64_t bit = CellSet::bit_of(cell);
    if ((blocking(word) & bit) == 0) {
      return Occupancy::Free;
    }
    return (occupied(word) & bit) != 0 ? Occupancy::Occupied : Occupancy::Unknown;
  }
  /// Memory in use, in bytes.
  [[nodiscard]] std::size_t memory_bytes() const {
    return table_.size() * sizeof(void*) + pages_.size() * sizeof(Page) + blocks_.size() * sizeof(Block);
  }

 private:
  static constexpr std::int32_t kPageSide = 8;  // words along an edge
  static constexpr std::size_t kPageBlocks = 64;
  static constexpr std::size_t kPageRows = 64;  // rows of words along x

  using RowBits = std::array<std::uint8_t, kPageRows>;  // a bit for every word of a row

  // The words of a brick, in the order of Brick.
  struct alignas(64) Block {
    std::array<std::uint64_t, Brick::kWords> blocking{};
    std::array<std::uint64_t, Brick::kWords> occupied{};
  };
  struct Page {
    std::array<Block*, kPageBlocks> blocks{};         // never null: unseen blocks point to nothing_
    std::array<std::uint64_t, kPageRows> distance{};  // a byte for every word of a row
    RowBits free_words{};                             // words without a cell that stops rays
    VoxelIndex address;
    bool stale = false;  // distances must be recomputed

    [[nodiscard]] const Block& block_of(const VoxelIndex& word) const { return *blocks[block_in_page(word)]; }
    [[nodiscard]] std::uint8_t distance_of(const VoxelIndex& word) const {
      return static_cast<std::uint8_t>(distance[row_in_page(word)] >> 8U * static_cast<unsigned>(word.x & 7));
    }
  };

  static VoxelIndex page_address(const VoxelIndex& word) { return {word.x >> 3, word.y >> 3, word.z >> 3}; }
  static std::size_t block_in_page(const VoxelIndex& word) {
    return static_cast<std::size_t>((word.x >> 1 & 3) | (word.y >> 1 & 3) << 2 | (word.z >> 1 & 3) << 4);
  }
  static std::size_t offset_in_block(const VoxelIndex& word) {
    return static_cast<std::size_t>((word.x & 1) | (word.y & 1) << 1 | (word.z & 1) << 2);
  }
  static std::size_t row_in_page(const VoxelIndex& word) {
    return static_cast<std::size_t>((word.y & 7) | (word.z & 7) << 3);
  }
  [[nodiscard]] std::size_t place_in_table(const VoxelIndex& page) const {
    const VoxelIndex at = page - pages_box_.lo;
    return static_cast<std::size_t>(at.x) + static_cast<std::size_t>(at.y) * row_ +
           static_cast<std::size_t>(at.z) * plane_;
  }
  [[nodiscard]] const Page& page_at(const VoxelIndex& page) const {
    return pages_box_.contains(page) ? *table_[place_in_table(page)] : unseen_;
  }
  [[nodiscard]] const Page& page_of(const VoxelIndex& word) const { return page_at(page_address(word)); }

  void reach(const VoxelBox& pages);
  Page& writable_page(const VoxelIndex& page);
  Block& writable_block(Page& page, const VoxelIndex& word);
  void set_free(Page& page, const VoxelIndex& word, bool is_free);
  void make_stale(Page& page);
  void take_brick(const VoxelIndex& address, const Brick& brick);
  void take_coarse(const OccupancyMap& map, const VoxelIndex& address, const Brick& brick);
  [[nodiscard]] VoxelBox words_of_brick(const VoxelIndex& address) const;
  void refresh_distances();
  [[nodiscard]] RowBits find_distances(Page& page) const;

  int level_;
  CoarseningPolicy policy_;
  OccupancyMap::Revision revision_ = 0;
  VoxelBox pages_box_;
  std::size_t row_ = 0;       // pages per row of the table
  std::size_t plane_ = 0;     // pages per xy plane of the table
  std::vector<Page*> table_;  // covers pages_box_; never null: unseen pages point to unseen_
  std::deque<Page> pages_;
  std::deque<Block> blocks_;
  std::vector<Page*> stale_;
  Page unseen_;
  Block nothing_;
};

/// Reads words of a grid that does not change meanwhile. Caches the last page, so it is fast for neighbouring words.
class BlockingGrid::Reader {
 public:
  /// The grid must outlive the reader.
  explicit Reader(const BlockingGrid& grid) : grid_(&grid), page_(&grid.page_of({})) {}

  /// See BlockingGrid::blocking.
  [[nodiscard]] std::uint64_t blocking(const VoxelIndex& word) {
    return page_of(word).block_of(word).blocking[offset_in_block(word)];
  }
  /// See BlockingGrid::distance.
  [[nodiscard]] std::uint8_t distance(const VoxelIndex& word) { return page_of(word).distance_of(word); }

 private:
  const Page& page_of(const VoxelIndex& word) {
    const std::int32_t differing = (word.x ^ last_.x) | (word.y ^ last_.y) | (word.z ^ last_.z);
    if ((differing & ~(kPageSide - 1)) != 0) {
      page_ = &grid_->page_of(word);
      last_ = word;
    }
    return *page_;
  }

  const BlockingGrid* grid_;
  const Page* page_;
  VoxelIndex last_;  // a word of the cached page
};

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/raytrace/impl/blocking_grid.ipp>
#endif
