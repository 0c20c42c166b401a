// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vantage/map/impl/slice_beam.hpp>
#include <vantage/raytrace/impl/slice_lanes.hpp>

namespace vantage {

/// The passages of a beam (glossary in view_walk.hpp): the windows along its way in which a cell may stop a ray, in
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

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/raytrace/impl/beam_passages.ipp>
#endif
