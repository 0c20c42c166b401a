// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/field/impl/fine_level.hpp>

#include <algorithm>

#include <vantage/field/impl/fill_brick.hpp>

namespace vantage::detail {

// With fewer bricks, a thread would mostly wait for the others.
inline constexpr std::size_t kFewestBricks = 96;

// Divides the bricks equally among the threads. Requires the links.
inline void share_bricks(FineLevel& level) {
  level.shares.resize(level.team->size());
  level.passes.assign(level.brick_count, 3);
  for (std::size_t i = 0; i < level.shares.size(); ++i) {
    BrickShare& share = level.shares[i];
    share.begin = 1 + (level.brick_count - 1) * i / level.shares.size();
    share.end = 1 + (level.brick_count - 1) * (i + 1) / level.shares.size();
    for (std::size_t b = share.begin; b < share.end; ++b) {
      for (const std::uint32_t link : level.links[b]) {
        if (link != 0 && (link < share.begin || link >= share.end)) {
          level.passes[b] = 1;
        }
      }
      if (level.passes[b] == 1) {
        share.late_second.push_back(static_cast<std::uint32_t>(b));
      }
    }
  }
  for (BrickShare& share : level.shares) {
    for (std::size_t b = share.begin; b < share.end; ++b) {
      const auto is_late = [&](std::uint32_t link) { return link != 0 && level.passes[link] == 1; };
      if (level.passes[b] == 3 && std::any_of(level.links[b].begin(), level.links[b].end(), is_late)) {
        level.passes[b] = 2;
      }
      if (level.passes[b] < 3) {
        share.late_third.push_back(static_cast<std::uint32_t>(b));
      }
    }
  }
}

VANTAGE_INLINE FineLevel make_fine_level(const LaplaceDomain& domain, std::size_t threads) {
  const std::vector<LaplaceDomain::Brick>& bricks = domain.bricks();
  FineLevel level;
  level.brick_count = bricks.size() + 1;
  level.team = std::make_unique<ThreadTeam>(std::clamp<std::size_t>(bricks.size() / kFewestBricks, 1, threads));
  level.links.assign(level.brick_count, {});
  level.address.assign(level.brick_count, {});
  level.ready.assign(level.brick_count, 0);
  const std::vector<std::array<std::uint32_t, 6>> links = domain.neighbours();
  for (std::size_t b = 0; b < bricks.size(); ++b) {
    level.address[b + 1] = bricks[b].address;
    level.ready[b + 1] = static_cast<std::uint32_t>(b + 1);
    for (std::size_t face = 0; face < 6; ++face) {
      level.links[b + 1][face] = links[b][face] == LaplaceDomain::kNone ? 0 : links[b][face] + 1;
      level.ready[b + 1] = std::max(level.ready[b + 1], level.links[b + 1][face]);
    }
  }
  share_bricks(level);
  clear(level, level.faces[kRed], kBrickRows);
  clear(level, level.faces[kBlack], kBrickRows);
  clear(level, level.blocks, kBrickBlocks);
  for_bricks(level, [&](std::size_t b) { fill_brick(level, bricks, b - 1, links[b - 1]); });
  return level;
}

VANTAGE_INLINE std::size_t FineLevel::memory_bytes() const {
  return bytes_of(address) + bytes_of(links) + bytes_of(ready) + bytes_of(passes) + bytes_of(faces[0]) +
         bytes_of(faces[1]) + bytes_of(blocks);
}

}  // namespace vantage::detail
