// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vantage/compiler.hpp>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/planner/planner_setup.hpp>

namespace VANTAGE_EXPORT vantage {

/// Makes a planner to compare with, by NAME. Each is our own implementation of a published method. It chooses by the
/// rule of the paper among the targets of FrontierSurvey and ends as FrontierPlanner does, so planners differ only in
/// their choice. Paths are the shortest through reachable cells. The host decides how the robot follows them in time,
/// so trajectories of the papers are left out. Parts are clusters of the frontier of limited extent. None has
/// settings.
///
/// - `distance-advantage` (Ericson, Pedro & Jensfelt 2025): goes to the part for which the mean path length from all
///   reachable cells, minus the path length from here, is largest: parts far from everything else are visited while
///   they are near. Left out: predicted maps.
/// - `fuel-like` (Zhou, Zhang, Chen & Shen 2021, FUEL): several views of each part, by how much they show; an open
///   tour over the best view of each part, in seconds; then, for the first parts, those of their views that make the
///   tour shortest. Left out: the minimum-time B-spline. Views are sampled anew for each plan, for the nearest parts.
///   FUEL as published looks at no cluster of fewer than 100 frontier cells and ends when none is larger; this one
///   goes on until nothing is left.
/// - `rh-nbv` (Bircher, Kamel, Alexis, Oleynikova & Siegwart 2016): a random tree of views around the current
///   pose; takes the first edge of the branch with the largest sum of gain * exp(-lambda * path length). The rest of
///   the branch starts the next tree. The gain is the volume of unknown space in view. Left out: the end of the run
///   when the gain is small. Where the tree has no gain, or the robot does not move, it goes to the nearest frontier.
/// - `aep-like` (Selin, Tiger, Duberg, Heintz & Jensfelt 2019, AEP): such a tree with the best of all yaws at each
///   node, gains kept while nothing around them changes, and the nearest frontier if the gain is small. Left out:
///   the interpolation of gains between nodes, pitch.
/// - `tare-like` (Cao, Zhu, Choset & Zhang 2021, TARE): near here, views that cover the frontier together on a short
///   tour; beyond, a coarse tour over cubes that hold frontier, which gives the end of the tour near here. Left out:
///   random choice of the cover, surfaces that were seen at grazing angles, the path home.
/// - `falcon-like` (Zhang, Chen, Feng, Zhou & Shen 2024, FALCON): divides free and unknown space into zones:
///   connected cells of a block. A path visits the unknown zones that border known space; lengths through unknown
///   space count twice. The parts are visited in the order of their zones, the first ones with views as in
///   `fuel-like`. Left out: unknown zones behind these (they would change the start of the path with each plan),
///   zones kept from plan to plan, minimum-time trajectories.
///
/// Throws std::invalid_argument if there is no such peer, with the list of names, or as PlannerSetup::validate.
[[nodiscard]] std::unique_ptr<ExplorationPlanner> make_exploration_peer(std::string_view name,
                                                                        const PlannerSetup& setup);
/// The names `make_exploration_peer` knows.
[[nodiscard]] std::span<const std::string_view> exploration_peer_names();

}  // namespace vantage
