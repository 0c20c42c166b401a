// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <stdexcept>
#include <vantage/map/impl/instruction_set.hpp>
#include <vantage/raytrace/impl/blocking_grid.hpp>

#include <vantage/geometry/impl/box_around.hpp>
#include <vantage/geometry/impl/prefetch.hpp>

namespace vantage::detail {

// Pointers to this many pages take 1 GiB and cover 2^42 cells.
inline constexpr std::size_t kMaxTable = std::size_t{1} << 27U;

// State of the coarse cell that covers the cube of `edge` cells at `from` in a brick, as OccupancyMap::at defines it.
inline Occupancy coarse_state(const Brick& brick, const VoxelIndex& from, std::int32_t edge,
                              CoarseningPolicy policy) {
  int known = 0;
  int sum = 0;
  int largest = -128;
  for_each_cell({from, from + VoxelIndex{edge, edge, edge}}, [&](const VoxelIndex& cell) {
    const std::size_t offset = Brick::offset_of(cell);
    if (brick.at(offset) != Occupancy::Unknown) {
      ++known;
      sum += brick.log_odds[offset];
      largest = std::max<int>(largest, brick.log_odds[offset]);
    }
  });
  if (known == 0) {
    return Occupancy::Unknown;
  }
  return (policy == CoarseningPolicy::Max ? largest : sum) >= 0 ? Occupancy::Occupied : Occupancy::Free;
}

inline void prefetch_planes(const Brick& brick) {
  prefetch(brick.known.data());
  prefetch(brick.occupied.data());
}

// The rows of a page and of the kFurthest words around it, one bit per word along x. The rows of a plane are stored
// side by side.
inline constexpr std::size_t kSpan = 24;
inline constexpr std::size_t kFirstRow = 8;  // index of the page's first row in a plane, and of its first plane
using Rows = std::array<std::uint32_t, kSpan * kSpan>;

// Collects the rows of 27 pages. The pages are sorted by z, then y, then x.
inline void gather(const std::array<const std::array<std::uint8_t, 64>*, 27>& pages, Rows& rows) {
  for (std::size_t side = 0; side < 9; ++side) {
    const std::uint8_t* const low = pages[3 * side]->data();
    const std::uint8_t* const middle = pages[3 * side + 1]->data();
    const std::uint8_t* const high = pages[3 * side + 2]->data();
    for (std::size_t z = 0; z < 8; ++z) {
      std::uint32_t* const to = &rows[(side / 3 * 8 + z) * kSpan + side % 3 * 8];
      VANTAGE_INDEPENDENT
      for (std::size_t y = 0; y < 8; ++y) {
        const std::size_t from = z * 8 + y;
        to[y] = low[from] | std::uint32_t{middle[from]} << 8U | std::uint32_t{high[from]} << 16U;
      }
    }
  }
}

// Erosion: in the planes [from, to), keeps the bits whose 26 neighbours are all set. Bits at the border become
// invalid.
inline void erode(Rows& rows, std::size_t from, std::size_t to) {
  Rows in_plane;
  VANTAGE_INDEPENDENT
  for (std::size_t i = (from - 1) * kSpan + 1; i < (to + 1) * kSpan - 1; ++i) {
    const std::uint32_t along_y = rows[i - 1] & rows[i] & rows[i + 1];
    in_plane[i] = along_y & along_y << 1U & along_y >> 1U;
  }
  VANTAGE_INDEPENDENT
  for (std::size_t i = from * kSpan + 1; i < to * kSpan - 1; ++i) {
    rows[i] = in_plane[i - kSpan] & in_plane[i] & in_plane[i + kSpan];
  }
}

// Transposes 8 x 8 bits: bit x of byte k becomes bit k of byte x.
inline std::uint64_t transposed(std::uint64_t bits) {
  std::uint64_t moves = (bits ^ bits >> 7U) & 0x00AA00AA00AA00AAU;
  bits ^= moves ^ moves << 7U;
  moves = (bits ^ bits >> 14U) & 0x0000CCCC0000CCCCU;
  bits ^= moves ^ moves << 14U;
  moves = (bits ^ bits >> 28U) & 0x00000000F0F0F0F0U;
  return bits ^ moves ^ moves << 28U;
}

// The number of set bits of each byte.
inline std::uint64_t bits_of_bytes(std::uint64_t bytes) {
  bytes -= bytes >> 1U & 0x5555555555555555U;
  bytes = (bytes & 0x3333333333333333U) + (bytes >> 2U & 0x3333333333333333U);
  return (bytes + (bytes >> 4U)) & 0x0F0F0F0F0F0F0F0FU;
}

// A bit for every byte that is not zero. Bytes must be at most 15.
inline std::uint8_t bytes_set(std::uint64_t bytes) {
  const std::uint64_t tops = (bytes + 0x7F7F7F7F7F7F7F7FU) & 0x8080808080808080U;
  return static_cast<std::uint8_t>((tops >> 7U) * 0x0102040810204080U >> 56U);
}

// Whether any of these words of a page touches the adjacent page on this side.
inline bool meet(const std::array<std::uint8_t, 64>& words, const VoxelIndex& side) {
  const auto first = [](std::int32_t along) { return along > 0 ? std::size_t{7} : std::size_t{0}; };
  const auto last = [](std::int32_t along) { return along < 0 ? std::size_t{0} : std::size_t{7}; };
  unsigned met = 0;
  for (std::size_t z = first(side.z); z <= last(side.z); ++z) {
    for (std::size_t y = first(side.y); y <= last(side.y); ++y) {
      met |= words[z * 8 + y];
    }
  }
  return (met & (side.x < 0 ? 0x01U : side.x > 0 ? 0x80U : 0xFFU)) != 0;
}

VANTAGE_INLINE std::size_t BlockingGrid::update(const OccupancyMap& map) {
  struct Changed {
    VoxelIndex address;
    const Brick* brick;
  };
  // The mean of a coarse cell may change its sign although no finest cell changes its state, so all bricks are read
  // again.
  const bool by_mean = level_ > 0 && policy_ == CoarseningPolicy::Mean && map.revision() != revision_;
  std::vector<Changed> changed;
  VoxelBox pages;
  map.for_each_changed_since(by_mean ? 0 : revision_, [&](const VoxelIndex& address, const Brick& brick) {
    changed.push_back({address, &brick});
    const VoxelIndex page = page_address(words_of_brick(address).lo);
    pages = box_around(pages, {page, page + VoxelIndex{1, 1, 1}});
    prefetch_planes(brick);
  });
  reach(pages);
  for (const Changed& one : changed) {
    if (level_ == 0) {
      take_brick(one.address, *one.brick);
    } else {
      take_coarse(map, one.address, *one.brick);
    }
  }
  refresh_distances();
  revision_ = map.revision();
  return changed.size();
}

VANTAGE_INLINE void BlockingGrid::suppose(const CellSet& stopping) {
  const VoxelBox& box = stopping.box();
  if (box.empty()) {
    return;
  }
  const VoxelBox words{CellSet::word_of(box.lo),
                       CellSet::word_of(box.hi - VoxelIndex{1, 1, 1}) + VoxelIndex{1, 1, 1}};
  reach({page_address(words.lo), page_address(words.hi - VoxelIndex{1, 1, 1}) + VoxelIndex{1, 1, 1}});
  CellSet within(box);
  for_each_cell(words, [&](const VoxelIndex& word) {
    within.insert_word(word, ~std::uint64_t{0});
    Page& page = writable_page(page_address(word));
    Block& block = writable_block(page, word);
    // Inside the box, exactly the occupied cells and those of `stopping` stop rays. Outside, nothing changes.
    std::uint64_t& blocking = block.blocking[offset_in_block(word)];
    blocking = (blocking & ~within.word(word)) | block.occupied[offset_in_block(word)] | stopping.word(word);
    set_free(page, word, blocking == 0);
  });
  refresh_distances();
}

VANTAGE_INLINE VoxelBox BlockingGrid::words_of_brick(const VoxelIndex& address) const {
  const VoxelIndex cell = Brick::first_cell(address);
  const VoxelIndex lo = CellSet::word_of({cell.x >> level_, cell.y >> level_, cell.z >> level_});
  // The cells of a coarser grid are so large that a brick lies in one word.
  const std::int32_t words = level_ == 0 ? 2 : 1;
  return {lo, lo + VoxelIndex{words, words, words}};
}

// Enlarges the table so that it covers these pages. Throws std::length_error if it would become too large.
VANTAGE_INLINE void BlockingGrid::reach(const VoxelBox& pages) {
  const VoxelBox larger = pages.empty() ? pages_box_ : box_around(pages_box_, pages);
  if (larger == pages_box_) {
    return;
  }
  const VoxelIndex extent = larger.extent();
  if (static_cast<double>(extent.x) * extent.y * extent.z > static_cast<double>(kMaxTable)) {
    throw std::length_error("the known cells lie too far apart for tracing rays");
  }
  pages_box_ = larger;
  row_ = static_cast<std::size_t>(extent.x);
  plane_ = row_ * static_cast<std::size_t>(extent.y);
  table_.assign(larger.size(), &unseen_);
  for (Page& page : pages_) {
    table_[place_in_table(page.address)] = &page;
  }
}

// Before the first write, an unseen page gets its own storage. All others go on sharing the unseen one. `page` must
// be in the table. Likewise for blocks, below.
VANTAGE_INLINE BlockingGrid::Page& BlockingGrid::writable_page(const VoxelIndex& page) {
  Page*& place = table_[place_in_table(page)];
  if (place == &unseen_) {
    place = &pages_.emplace_back();
    place->blocks.fill(&nothing_);
    place->address = page;
  }
  return *place;
}

VANTAGE_INLINE BlockingGrid::Block& BlockingGrid::writable_block(Page& page, const VoxelIndex& word) {
  Block*& place = page.blocks[block_in_page(word)];
  if (place == &nothing_) {
    place = &blocks_.emplace_back(nothing_);
  }
  return *place;
}

VANTAGE_INLINE void BlockingGrid::make_stale(Page& page) {
  if (!page.stale) {
    page.stale = true;
    stale_.push_back(&page);
  }
}

// Records whether no cell of a word stops a ray.
VANTAGE_INLINE void BlockingGrid::set_free(Page& page, const VoxelIndex& word, bool is_free) {
  std::uint8_t& row = page.free_words[row_in_page(word)];
  const auto bit = static_cast<std::uint8_t>(1U << static_cast<unsigned>(word.x & 7));
  if (((row & bit) != 0) != is_free) {
    row ^= bit;
    make_stale(page);
  }
}

// All words of a brick lie in the same page.
VANTAGE_INLINE void BlockingGrid::take_brick(const VoxelIndex& address, const Brick& brick) {
  const VoxelIndex first = words_of_brick(address).lo;
  Page& page = writable_page(page_address(first));
  Block& block = writable_block(page, first);
  for (std::size_t i = 0; i < Brick::kWords; ++i) {
    const std::uint64_t was = block.blocking[i];
    block.blocking[i] = ~brick.free(i);
    block.occupied[i] = brick.occupied[i];
    if ((block.blocking[i] == 0) != (was == 0)) {
      const auto at = static_cast<std::int32_t>(i);
      set_free(page, first + VoxelIndex{at & 1, at >> 1 & 1, at >> 2}, block.blocking[i] == 0);
    }
  }
}

// Up to level 3, a brick consists of whole coarse cells. At higher levels a coarse cell covers several bricks, so the
// map is asked for its state.
VANTAGE_INLINE void BlockingGrid::take_coarse(const OccupancyMap& map, const VoxelIndex& address,
                                              const Brick& brick) {
  const auto take = [&](const VoxelIndex& coarse, Occupancy state) {
    const VoxelIndex word = CellSet::word_of(coarse);
    const std::uint64_t bit = CellSet::bit_of(coarse);
    Page& page = writable_page(page_address(word));
    Block& block = writable_block(page, word);
    const std::size_t at = offset_in_block(word);
    block.blocking[at] = (block.blocking[at] & ~bit) | (state == Occupancy::Free ? 0 : bit);
    block.occupied[at] = (block.occupied[at] & ~bit) | (state == Occupancy::Occupied ? bit : 0);
    set_free(page, word, block.blocking[at] == 0);
  };
  const VoxelIndex cell = Brick::first_cell(address);
  const VoxelIndex first{cell.x >> level_, cell.y >> level_, cell.z >> level_};
  constexpr int kBrickLevel = 3;
  if (level_ > kBrickLevel) {
    take(first, map.at(first, level_, policy_));
    return;
  }
  const std::int32_t count = Brick::kSide >> level_;
  const std::int32_t edge = 1 << level_;
  for_each_cell({{0, 0, 0}, {count, count, count}}, [&](const VoxelIndex& c) {
    take(first + c, coarse_state(brick, {c.x * edge, c.y * edge, c.z * edge}, edge, policy_));
  });
}

// If the distance of a word changes because another word starts or stops blocking rays, the distances of a chain of
// neighbouring words between them change too. So changes spread from page to page across the borders, and no other
// page needs a look.
VANTAGE_INLINE void BlockingGrid::refresh_distances() {
  for (std::size_t i = 0; i < stale_.size(); ++i) {  // the list may grow in the loop
    const VoxelIndex address = stale_[i]->address;
    const RowBits changed = find_distances(*stale_[i]);
    if (changed == RowBits{}) {
      continue;
    }
    for_each_cell({{-1, -1, -1}, {2, 2, 2}}, [&](const VoxelIndex& side) {
      const VoxelIndex beside = address + side;
      if (pages_box_.contains(beside) && meet(changed, side)) {
        Page* const page = table_[place_in_table(beside)];
        if (page != &unseen_) {  // the distance there is 0 anyway
          make_stale(*page);
        }
      }
    });
  }
  for (Page* page : stale_) {
    page->stale = false;
  }
  stale_.clear();
}

// The k-th erosion of the free words keeps the words that have only free words within k words along every axis. The
// distance of a word is the number of erosions, the 0th included, that keep it. Returns the words whose distance has
// changed.
VANTAGE_INLINE BlockingGrid::RowBits BlockingGrid::find_distances(Page& page) const {
  std::array<const RowBits*, 27> around{};
  std::size_t next = 0;
  for_each_cell({{-1, -1, -1}, {2, 2, 2}},
                [&](const VoxelIndex& side) { around[next++] = &page_at(page.address + side).free_words; });
  RowBits changed{};
  compiled_for(best_instruction_set(), [&] {
    Rows rows;
    gather(around, rows);
    std::array<std::uint64_t, kPageRows> survived{};  // byte k of a row: the words kept by the k-th erosion
    for (std::size_t k = 0; k < kFurthest; ++k) {
      if (k > 0) {
        erode(rows, k, kSpan - k);  // words further out no longer affect the page
      }
      std::uint32_t any = 0;
      for (std::size_t row = 0; row < kPageRows; ++row) {
        const std::uint32_t left = rows[((row >> 3U) + kFirstRow) * kSpan + (row & 7U) + kFirstRow] >> 8U & 0xFFU;
        survived[row] |= std::uint64_t{left} << 8U * k;
        any |= left;
      }
      if (any == 0) {
        break;
      }
    }
    for (std::size_t row = 0; row < kPageRows; ++row) {
      const std::uint64_t distance = bits_of_bytes(transposed(survived[row]));
      changed[row] = bytes_set(distance ^ page.distance[row]);
      page.distance[row] = distance;
    }
  });
  return changed;
}

}  // namespace vantage::detail
