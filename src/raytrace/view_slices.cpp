// SPDX-License-Identifier: MIT
#include <algorithm>
#include <raytrace/sliced_word.hpp>
#include <raytrace/view_slices.hpp>
#include <raytrace/word_rows.hpp>
#include <span>

namespace vantage {
namespace {

constexpr std::int32_t kColumn = 32;  // cells from one column of rows to the next

}  // namespace

// A beam is widest where it ends.
bool ViewSlices::begin(const SliceBeam& beam, std::int64_t last) {
  beam_ = beam;
  layers_.clear();
  rows_.clear();
  constexpr std::int32_t kWidest = 128;
  const LateralCells widest = beam.cells_in(last, last + 3);
  return std::max(widest.extent(0), widest.extent(1)) <= kWidest;
}

void ViewSlices::read(std::size_t number, std::int64_t slice) {
  layers_.resize(std::max(layers_.size(), number + 1));
  Layer& layer = layers_[number];
  layer.is_read = true;
  const std::int64_t last = slice + beam_.left_in_layer(slice) - 1;
  const LateralCells cells = beam_.cells_in(std::max<std::int64_t>(last - 3, 0), last);
  layer.first_u = cells.lo[0] & ~3;
  layer.first_v = cells.lo[1] & ~3;
  layer.end_u = (cells.hi[0] | 3) + 1;
  layer.end_v = (cells.hi[1] | 3) + 1;
  const std::int32_t columns = (layer.end_u - layer.first_u + kColumn - 1) / kColumn;
  const std::int32_t rows = layer.end_v - layer.first_v + SliceWindows::kHeight;
  layer.rows = static_cast<std::size_t>(rows);
  layer.first = rows_.size();
  rows_.resize(rows_.size() + kPlanes * static_cast<std::size_t>(columns) * layer.rows);
  const std::int32_t along = beam_.along(slice) >> 2;
  if (!read_rows(layer, along)) {
    rows_.resize(layer.first);
    layer.free = free_from(layer, along);
  }
}

std::int32_t ViewSlices::free_from(const Layer& layer, std::int32_t along) {
  std::int32_t free = BlockingGrid::kFurthest;
  for (std::int32_t v = layer.first_v; v < layer.end_v; v += 4) {
    for (std::int32_t u = layer.first_u; u < layer.end_u; u += 4) {
      free = std::min<std::int32_t>(free, reader_.distance(beam_.axes.at(along, u >> 2, v >> 2)));
    }
  }
  return free;
}

// False: no cell stops a ray.
bool ViewSlices::read_rows(const Layer& layer, std::int32_t along) {
  constexpr std::int32_t kWords = kColumn / 4;
  std::array<std::uint64_t, kWords> words{};
  std::uint64_t any_of_layer = 0;
  for (std::int32_t first_u = layer.first_u; first_u < layer.end_u; first_u += kColumn) {
    const std::int32_t width = std::min(kWords, (layer.end_u - first_u) / 4);
    const auto column = static_cast<std::size_t>((first_u - layer.first_u) / kColumn);
    std::uint64_t* const rows = &rows_[layer.first + kPlanes * column * layer.rows];
    for (std::int32_t v = layer.first_v; v < layer.end_v; v += 4) {
      std::uint64_t any = 0;
      for (std::int32_t u = 0; u < width; ++u) {
        words[static_cast<std::size_t>(u)] = reader_.blocking(beam_.axes.at(along, (first_u >> 2) + u, v >> 2));
        any |= words[static_cast<std::size_t>(u)];
      }
      any_of_layer |= any;
      if (any == 0) {
        continue;
      }
      compiled_for(set_, [&words, major = beam_.axes.major] {
        VANTAGE_INDEPENDENT
        for (std::size_t i = 0; i < words.size(); ++i) {
          words[i] = in_slices(words[i], major);
        }
      });
      const WordRows of_words = rows_of_words(std::span(words).first(static_cast<std::size_t>(width)), set_);
      for (std::size_t i = 0; i < of_words.size(); ++i) {
        const std::size_t at = i / 4 * layer.rows + static_cast<std::size_t>(v - layer.first_v) + i % 4;
        const std::size_t of_any = at + (kAny - i / 4) * layer.rows;
        rows[at] |= of_words[i];
        rows[of_any] |= of_words[i];
        if (column > 0) {
          std::uint64_t* const before = rows - kPlanes * layer.rows;
          before[at] |= std::uint64_t{of_words[i]} << 32U;
          before[of_any] |= std::uint64_t{of_words[i]} << 32U;
        }
      }
    }
  }
  return any_of_layer != 0;
}

bool ViewSlices::any_stops(std::int64_t slice, const LateralCells& cells) const {
  const Layer& layer = layers_[number_of(slice)];
  const std::int32_t column = (cells.lo[0] - layer.first_u) / kColumn;
  const std::int32_t lo = cells.lo[0] - layer.first_u - column * kColumn;
  const std::int32_t hi = lo + cells.extent(0) - 1;
  if (hi >= 2 * kColumn) {
    return true;  // as far as one row can tell
  }
  const std::uint64_t* const rows = rows_of(layer, column, kAny);
  std::uint64_t any = 0;
  for (std::int32_t v = cells.lo[1]; v <= cells.hi[1]; ++v) {
    any |= rows[v - layer.first_v];
  }
  return (any & ~std::uint64_t{0} << lo & ~std::uint64_t{0} >> (63 - hi)) != 0;
}

ViewSlices::Slices ViewSlices::cut(std::int64_t first, std::int64_t end, const LateralCells& cells,
                                   const SlicePlace& place, SliceWindows& windows) const {
  const Layer& layer = layers_[number_of(first)];
  const std::int32_t column = (place.first_u - layer.first_u) / kColumn;
  const auto shift = static_cast<unsigned>(place.first_u - layer.first_u - column * kColumn);
  const std::int32_t from_row = place.first_v - layer.first_v;
  const std::uint32_t columns = ~std::uint32_t{0} << (cells.lo[0] - place.first_u) &
                                ~std::uint32_t{0} >> (SliceWindows::kWidth - 1 - (cells.hi[0] - place.first_u));
  const std::int32_t lo = cells.lo[1] - place.first_v;
  const std::int32_t hi = cells.hi[1] - place.first_v;
  std::array<std::uint32_t, SliceWindows::kMost> any{};
  compiled_for(set_, [&, from_row, shift, lo, hi] {
    for (std::int64_t slice = first; slice < end; ++slice) {
      const auto i = static_cast<std::size_t>(slice - first);
      const std::uint64_t* const from = rows_of(layer, column, beam_.along(slice) & 3) + from_row;
      std::uint32_t* const to = windows.rows[i].data();
      std::uint32_t met = 0;
      for (std::int32_t row = 0; row < SliceWindows::kHeight; ++row) {
        const auto cells_of_row = static_cast<std::uint32_t>(from[row] >> shift);
        to[row] = cells_of_row;
        met |= lo <= row && row <= hi ? cells_of_row : 0;
      }
      any[i] = met;
    }
  });
  Slices stopping{end, first - 1};
  for (std::int64_t slice = first; slice < end; ++slice) {
    if ((any[static_cast<std::size_t>(slice - first)] & columns) != 0) {
      stopping.first = std::min(stopping.first, slice);
      stopping.last = slice;
    }
  }
  windows.count = static_cast<std::size_t>(std::max<std::int64_t>(stopping.last - stopping.first + 1, 0));
  if (stopping.first > first) {
    std::copy_n(windows.rows.begin() + (stopping.first - first), windows.count, windows.rows.begin());
  }
  return stopping;
}

}  // namespace vantage
