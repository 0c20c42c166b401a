// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/field/laplace_domain.hpp>

#include <vantage/field/impl/fine_level.hpp>

namespace vantage::detail {

/// Fills the data of brick `b` + 1 of `level`, the faces of its cells and its blocks, from brick `b` of a domain and
/// its neighbours `links`. The data must be 0 before.
void fill_brick(FineLevel& level, const std::vector<LaplaceDomain::Brick>& bricks, std::size_t b,
                const std::array<std::uint32_t, 6>& links);

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/field/impl/fill_brick.ipp>
#endif
