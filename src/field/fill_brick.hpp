// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/field/laplace_domain.hpp>

#include "field/fine_level.hpp"

namespace vantage::detail {

/// Writes what `level` says of brick `b` + 1, the faces of its cells and its blocks, from brick `b` of a domain and
/// its neighbours `links`. The places must be 0.
void fill_brick(FineLevel& level, const std::vector<LaplaceDomain::Brick>& bricks, std::size_t b,
                const std::array<std::uint32_t, 6>& links);

}  // namespace vantage::detail
