// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vantage/map/impl/slice_beam.hpp>
#include <vantage/raytrace/impl/slice_lanes.hpp>
#include <vantage/raytrace/impl/slice_windows.hpp>

namespace vantage::detail {

/// The passages of a beam (glossary in slices.hpp): the windows along its way in which a cell may stop a ray, in
/// the order of the walk. They are recorded once for a group of tiles, and then asked for the beam of one tile after
/// the other.
class BeamPassages {
 public:
  static constexpr std::size_t kMost = 16;  ///< maximum number of passages

  /// The windows of a few consecutive slices.
  struct Passage {
    SliceWindows windows;
    alignas(64) WindowCells wanted{};  ///< cells to find: rays may meet them, and no ray has met them yet
  };

  /// The number of passages.
  [[nodiscard]] std::size_t size() const { return size_; }
  /// The passage with this index.
  [[nodiscard]] Passage& operator[](std::size_t i) { return passages_[i]; }
  /// Removes all passages.
  void clear() { size_ = 0; }
  /// The next passage, to be filled; size() must be less than kMost. `keep` adds it.
  [[nodiscard]] Passage& next() { return passages_[size_]; }
  /// Adds the passage filled through `next`, which was recorded for this beam.
  void keep(const SliceBeam& beam);

  /// The slices that must be walked for a beam that is a part of the recorded beam, a bit each, four bits per
  /// passage: those in which a cell may stop a ray of the beam, up to the last slice with a wanted cell. 0 if the
  /// beam can meet no wanted cell.
  [[nodiscard]] std::uint64_t to_pass(const SliceBeam& beam, InstructionSet set) const;

 private:
  template <class T>
  using PerPassage = std::array<T, kMost>;

  std::size_t size_ = 0;
  PerPassage<Passage> passages_;
  // distance from the origin, in cells along the major axis, at which rays enter and leave
  alignas(64) PerPassage<double> enters_{};
  alignas(64) PerPassage<double> leaves_{};
  alignas(64) PerPassage<double> from_u_{};  // position of the origin in the coordinates of the window
  alignas(64) PerPassage<double> from_v_{};
};

inline void BeamPassages::keep(const SliceBeam& beam) {
  const Passage& passage = passages_[size_];
  enters_[size_] = beam.entered_at(passage.windows.first);
  leaves_[size_] = beam.entered_at(passage.windows.first + static_cast<std::int64_t>(passage.windows.count));
  from_u_[size_] = beam.within[0] + (beam.first[0] - passage.windows.place.first_u);
  from_v_[size_] = beam.within[1] + (beam.first[1] - passage.windows.place.first_v);
  ++size_;
}

inline std::uint64_t BeamPassages::to_pass(const SliceBeam& beam, InstructionSet set) const {
  // bit mask of the columns and rows of the windows that the beam may pass
  alignas(64) PerPassage<std::uint32_t> columns;
  alignas(64) PerPassage<std::uint32_t> rows;
  compiled_for(set, [this, of_columns = columns.data(), of_rows = rows.data(), least_u = beam.least[0],
                     most_u = beam.most[0], least_v = beam.least[1], most_v = beam.most[1]] {
    VANTAGE_INDEPENDENT
#pragma GCC unroll 1
    for (std::size_t i = 0; i < kMost; ++i) {
      const double enters = enters_[i];
      const double leaves = leaves_[i];
      // An edge that runs outwards is furthest out where rays leave the windows, otherwise where they enter.
      const double left = least_u * (least_u < 0.0 ? leaves : enters);
      const double right = most_u * (most_u > 0.0 ? leaves : enters);
      const double top = least_v * (least_v < 0.0 ? leaves : enters);
      const double bottom = most_v * (most_v > 0.0 ? leaves : enters);
      of_columns[i] = bits_between(column_at(from_u_[i] + left - SliceBeam::kRounding),
                                   column_at(from_u_[i] + right + SliceBeam::kRounding));
      of_rows[i] = bits_between(row_at(from_v_[i] + top - SliceBeam::kRounding),
                                row_at(from_v_[i] + bottom + SliceBeam::kRounding));
    }
  });
  std::uint64_t blocking = 0;
  std::uint64_t wanted = 0;
  for (std::size_t i = 0; i < size_; ++i) {
    const WindowPatch patch{columns[i], rows[i]};
    const std::uint32_t there = (1U << passages_[i].windows.count) - 1;
    blocking |= std::uint64_t{slices_with(patch, passages_[i].windows.rows, set) & there} << 4 * i;
    wanted |= std::uint64_t{slices_with(patch, passages_[i].wanted, set)} << 4 * i;
  }
  // Slices behind the last wanted cell are left out.
  return wanted == 0 ? 0 : blocking & ~std::uint64_t{0} >> std::countl_zero(wanted);
}

}  // namespace vantage::detail
