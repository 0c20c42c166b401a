// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <raytrace/slice_beam.hpp>
#include <raytrace/slice_lanes.hpp>
#include <raytrace/tile_hits.hpp>

namespace vantage {

/// The windows on the way of a beam in which something may stop a ray, in the order of the walk.
class BeamPassages {
 public:
  static constexpr std::size_t kMost = 16;  ///< passages

  /// Some slices one after the other.
  struct Passage {
    SliceWindows windows;
    alignas(64) WindowCells wanted{};  ///< cells that rays may meet, and are to be found
    SlicePlace place;
    std::int64_t first = 0;  ///< slice
  };

  /// How many there are.
  [[nodiscard]] std::size_t size() const { return size_; }
  /// One of them.
  [[nodiscard]] Passage& operator[](std::size_t i) { return passages_[i]; }
  /// None from now on.
  void clear() { size_ = 0; }
  /// One to be filled; there must be less than kMost.
  [[nodiscard]] Passage& next() { return passages_[size_]; }
  /// Takes that one over, of slices that the beams enter and leave so many cells from the origin.
  void keep(const SliceBeam& beam);

  /// Turns to a beam that is a part of that of which they are.
  void turn_to(const SliceBeam& beam, InstructionSet set);
  /// Which slices of them it has to pass, a bit for each: those in which something may stop a ray and what is between
  /// them, up to the last in which it may meet what is wanted. Four bits for each passage, so all in one word.
  [[nodiscard]] std::uint64_t to_pass(InstructionSet set) const;

 private:
  template <class T>
  using PerPassage = std::array<T, kMost>;

  std::size_t size_ = 0;
  PerPassage<Passage> passages_;
  alignas(64) PerPassage<double> enters_{};  // how far from the origin beams do, in cells
  alignas(64) PerPassage<double> leaves_{};
  alignas(64) PerPassage<double> from_u_{};  // where the origin is in the windows
  alignas(64) PerPassage<double> from_v_{};
  alignas(64) PerPassage<std::uint32_t> columns_{};  // that the beam passes
  alignas(64) PerPassage<std::uint32_t> rows_{};
};

}  // namespace vantage
