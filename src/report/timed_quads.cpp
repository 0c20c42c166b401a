// SPDX-License-Identifier: MIT
#include "report/timed_quads.hpp"

#include <algorithm>
#include <tuple>

namespace vantage::detail {
namespace {

// A rectangle in the axes of its plane: `u` along its width, `v` along its height, `w` along its normal.
struct Flat {
  std::int32_t u;
  std::int32_t v;
  std::int32_t w;
  TimedQuad quad;
};

// Joins neighbours in a sorted list if `next_to(a, b)`: b continues a.
template <class NextTo>
std::vector<Flat> joined(const std::vector<Flat>& flats, std::uint16_t TimedQuad::*extent, const NextTo& next_to) {
  std::vector<Flat> longer;
  for (const Flat& flat : flats) {
    if (!longer.empty() && longer.back().quad.*extent < 0x7FFF && next_to(longer.back(), flat)) {
      ++(longer.back().quad.*extent);
    } else {
      longer.push_back(flat);
    }
  }
  return longer;
}

}  // namespace

std::vector<TimedQuad> merged(const std::vector<TimedCell>& faces, std::size_t direction) {
  const std::size_t axis = direction / 2;
  std::vector<Flat> flats;
  flats.reserve(faces.size());
  for (const TimedCell& face : faces) {
    const VoxelIndex& c = face.cell;
    const TimedQuad quad{.cell = c, .birth = face.birth, .death = face.death};
    flats.push_back(axis == 0   ? Flat{c.y, c.z, c.x, quad}
                    : axis == 1 ? Flat{c.x, c.z, c.y, quad}
                                : Flat{c.x, c.y, c.z, quad});
  }
  const auto times = [](const Flat& f) { return std::tie(f.quad.birth, f.quad.death); };
  std::sort(flats.begin(), flats.end(), [&](const Flat& a, const Flat& b) {
    return std::tuple(a.w, times(a), a.v, a.u) < std::tuple(b.w, times(b), b.v, b.u);
  });
  flats = joined(flats, &TimedQuad::width, [&](const Flat& a, const Flat& b) {
    return a.w == b.w && times(a) == times(b) && a.v == b.v && a.u + a.quad.width == b.u;
  });
  std::sort(flats.begin(), flats.end(), [&](const Flat& a, const Flat& b) {
    return std::tuple(a.w, times(a), a.u, a.quad.width, a.v) < std::tuple(b.w, times(b), b.u, b.quad.width, b.v);
  });
  flats = joined(flats, &TimedQuad::height, [&](const Flat& a, const Flat& b) {
    return a.w == b.w && times(a) == times(b) && a.u == b.u && a.quad.width == b.quad.width &&
           a.v + a.quad.height == b.v;
  });
  std::vector<TimedQuad> quads;
  quads.reserve(flats.size());
  for (const Flat& flat : flats) {
    quads.push_back(flat.quad);
  }
  return quads;
}

void FaceHistory::set(const VoxelIndex& brick, const std::array<BrickPlane, 6>& faces, std::uint16_t now) {
  for (std::size_t direction = 0; direction < faces.size(); ++direction) {
    directions_[direction].set(brick, faces[direction], now);
  }
}

std::array<std::vector<TimedQuad>, 6> FaceHistory::quads() const {
  std::array<std::vector<TimedQuad>, 6> quads;
  for (std::size_t direction = 0; direction < quads.size(); ++direction) {
    quads[direction] = merged(directions_[direction].stays(), direction);
  }
  return quads;
}

}  // namespace vantage::detail
