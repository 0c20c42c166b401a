// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/compiler.hpp>
#include <vantage/field/laplace_problem.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// A cheap first guess at the solution, from coarse to fine: cells are paired along x, y, z in turn, the smallest
/// problem is solved outright, and each finer one starts from the coarser and is smoothed by a few sweeps.
///
/// A relaxation that starts from it has only short waves left to remove, where from zero it must carry the level of
/// every room through its doors cell by cell. By position in the problem; sinks hold 0, the source 1.
/// `uniform_source` as in RelaxationOptions. Pairs join cells that share an open face only, so nothing leaks through
/// a thin wall.
[[nodiscard]] std::vector<double> coarse_to_fine_guess(const LaplaceProblem& problem, double uniform_source = 0.0);

}  // namespace vantage
