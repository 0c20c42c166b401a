// SPDX-License-Identifier: MIT
#include <algorithm>
#include <map/instruction_set.hpp>
#include <raytrace/blocking_grid.hpp>
#include <stdexcept>

#include "geometry/box_around.hpp"

namespace vantage {
namespace {

// A table of this many pages takes 1 GiB; it is for 2^42 cells.
constexpr std::size_t kMaxTable = std::size_t{1} << 27U;

// State of the cube of `edge` cells at `from` in a brick, as OccupancyMap::at gives it for a coarser level.
Occupancy coarse_state(const Brick& brick, const VoxelIndex& from, std::int32_t edge, CoarseningPolicy policy) {
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

// Rows of words along x, as bits, of a page and kFurthest words around it.
constexpr std::size_t kRows = 24;
using Rows = std::array<std::uint32_t, kRows * kRows>;

// Leaves the bits all of whose 26 neighbours are set, in the planes [from, to); bits at the rim lose their meaning.
inline void erode(Rows& rows, std::size_t from, std::size_t to) {
  Rows along_x;
  Rows along_y{};
  for (std::size_t i = (from - 1) * kRows; i < (to + 1) * kRows; ++i) {
    along_x[i] = rows[i] & rows[i] << 1U & rows[i] >> 1U;
  }
  for (std::size_t i = (from - 1) * kRows + 1; i + 1 < (to + 1) * kRows; ++i) {
    along_y[i] = along_x[i - 1] & along_x[i] & along_x[i + 1];
  }
  for (std::size_t i = from * kRows; i < to * kRows; ++i) {
    rows[i] = along_y[i - kRows] & along_y[i] & along_y[i + kRows];
  }
}

}  // namespace

std::size_t BlockingGrid::update(const OccupancyMap& map) {
  // The mean of a coarser cell may change its sign while no finest cell changes its state.
  const bool by_mean = level_ > 0 && policy_ == CoarseningPolicy::Mean && map.revision() != revision_;
  const std::vector<VoxelIndex> changed = map.changed_since(by_mean ? 0 : revision_);
  VoxelBox pages;
  for (const VoxelIndex& brick : changed) {
    const VoxelBox words = words_of_brick(brick);
    const VoxelIndex page = page_address(words.lo);
    pages = detail::box_around(pages, {page, page + VoxelIndex{1, 1, 1}});
  }
  reach(pages);
  for (const VoxelIndex& address : changed) {
    const Brick& brick = *map.find_brick(address);
    if (level_ == 0) {
      take_brick(address, brick);
    } else {
      take_coarse(map, address, brick);
    }
  }
  refresh_distances();
  revision_ = map.revision();
  return changed.size();
}

VoxelBox BlockingGrid::words_of_brick(const VoxelIndex& address) const {
  const VoxelIndex cell = Brick::first_cell(address);
  const VoxelIndex lo = word_of({cell.x >> level_, cell.y >> level_, cell.z >> level_});
  const std::int32_t words = level_ == 0 ? 2 : 1;
  return {lo, lo + VoxelIndex{words, words, words}};
}

// Lets the table hold these pages.
void BlockingGrid::reach(const VoxelBox& pages) {
  const VoxelBox larger = pages.empty() ? pages_box_ : detail::box_around(pages_box_, pages);
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

BlockingGrid::Page& BlockingGrid::writable_page(const VoxelIndex& page) {
  Page*& place = table_[place_in_table(page)];
  if (place == &unseen_) {
    place = &pages_.emplace_back();
    place->blocking.fill(~std::uint64_t{0});
    place->address = page;
  }
  return *place;
}

void BlockingGrid::write(Page& page, std::size_t offset, std::uint64_t blocking, std::uint64_t occupied) {
  const bool was_free = page.blocking[offset] == 0;
  page.blocking[offset] = blocking;
  page.occupied[offset] = occupied;
  if ((blocking == 0) != was_free) {
    page.free_words[offset >> 3U] ^= static_cast<std::uint8_t>(1U << (offset & 7U));
    if (!page.stale) {
      page.stale = true;
      stale_.push_back(&page);
    }
  }
}

// The words of a brick lie in one page.
void BlockingGrid::take_brick(const VoxelIndex& address, const Brick& brick) {
  const VoxelIndex first = words_of_brick(address).lo;
  Page& page = writable_page(page_address(first));
  const std::size_t offset = offset_in_page(first);
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    const std::size_t at = offset + (word & 1U) + (word >> 1U & 1U) * 8 + (word >> 2U) * 64;
    const std::uint64_t blocking = ~brick.free(word);
    if (page.blocking[at] != blocking || page.occupied[at] != brick.occupied[word]) {
      write(page, at, blocking, brick.occupied[word]);
    }
  }
}

void BlockingGrid::take_coarse(const OccupancyMap& map, const VoxelIndex& address, const Brick& brick) {
  const auto take = [&](const VoxelIndex& coarse, Occupancy state) {
    const std::uint64_t bit = bit_of(coarse);
    Page& page = writable_page(page_address(word_of(coarse)));
    const std::size_t at = offset_in_page(word_of(coarse));
    write(page, at, (page.blocking[at] & ~bit) | (state == Occupancy::Free ? 0 : bit),
          (page.occupied[at] & ~bit) | (state == Occupancy::Occupied ? bit : 0));
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

// A word is nearer than kFurthest to those of its own page and the pages around it only.
void BlockingGrid::refresh_distances() {
  std::vector<Page*> affected;
  for (const Page* page : stale_) {
    for_each_cell(VoxelBox{page->address, page->address + VoxelIndex{1, 1, 1}}.grown(1), [&](const VoxelIndex& at) {
      if (pages_box_.contains(at) && table_[place_in_table(at)] != &unseen_) {
        affected.push_back(table_[place_in_table(at)]);
      }
    });
  }
  for (Page* page : stale_) {
    page->stale = false;
  }
  stale_.clear();
  std::sort(affected.begin(), affected.end());
  affected.erase(std::unique(affected.begin(), affected.end()), affected.end());
  for (Page* page : affected) {
    find_distances(*page);
  }
}

// The k-th erosion of the free words leaves those with only free words less than k words away.
void BlockingGrid::find_distances(Page& page) {
  Rows rows{};
  for_each_cell({{-1, -1, -1}, {2, 2, 2}}, [&](const VoxelIndex& side) {
    const std::array<std::uint8_t, 64>& free_words = page_at(page.address + side).free_words;
    const std::size_t first =
        static_cast<std::size_t>(side.z + 1) * 8 * kRows + static_cast<std::size_t>(side.y + 1) * 8;
    for (std::size_t row = 0; row < free_words.size(); ++row) {
      rows[first + (row >> 3U) * kRows + (row & 7U)] |= std::uint32_t{free_words[row]}
                                                        << 8U * static_cast<unsigned>(side.x + 1);
    }
  });
  std::array<std::uint32_t, 512> distance{};
  compiled_for(best_instruction_set(), [&] {
    for (std::uint8_t k = 1; k <= kFurthest; ++k) {
      for (std::size_t row = 0; row < 64; ++row) {
        const std::uint32_t bits = rows[((row >> 3U) + 8) * kRows + (row & 7U) + 8] >> 8U;
        for (std::uint32_t x = 0; x < 8; ++x) {
          distance[row * 8 + x] += bits >> x & 1U;
        }
      }
      if (k < kFurthest) {
        erode(rows, 1U + k, kRows - 1U - k);  // what lies further out does not reach the page any more
      }
    }
  });
  for (std::size_t i = 0; i < distance.size(); ++i) {
    page.distance[i] = static_cast<std::uint8_t>(distance[i]);
  }
}

}  // namespace vantage
