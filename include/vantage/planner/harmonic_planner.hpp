// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <vantage/compiler.hpp>
#include <vantage/field/laplace_problem.hpp>
#include <vantage/field/laplace_relaxation.hpp>
#include <vantage/planner/frontier_planner.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// How the harmonic field is found.
enum class FieldSolver : std::uint8_t {
  Multigrid,    ///< to a small residual, with a certificate that the way down from every cell ends at a sink
  GaussSeidel,  ///< the method of the paper: relaxation from zero until the largest relative change is small (eq. 10)
};

/// What HarmonicPlanner does that the paper leaves open or does otherwise; docs/harmonic.md has what each part earns.
struct HarmonicStrategy {
  /// Sinks whose way is longer than the way to the nearest by more than this wait for a later plan, metres, >= 0:
  /// what is near is cleared first. Infinity: every frontier draws.
  double detour_m = 0.2;
  /// Looks from the first place on the way from which the boundary it came for is in sight, not from beside it.
  bool look_early = true;
  /// With look_early: once it has gone so far, metres, >= 0, any other boundary that comes into sight is looked at,
  /// too.
  double look_spacing_m = 0.5;
  /// Of a sensor that does not see all around: before it moves on it looks from where it is, in the direction that is
  /// expected to teach most, as long as that is at least so much unknown space, m^3, >= 0; and at its goal it takes
  /// such a direction, too. Infinity: it looks once, at most of the boundary. Not in a plane.
  double look_again_m3 = 0.1;
  /// Takes the shortest way to the place it looks from, not the streamline.
  bool shortest_way = true;
  /// The paper's plain method.
  [[nodiscard]] static HarmonicStrategy faithful() {
    return {.detour_m = std::numeric_limits<double>::infinity(),
            .look_early = false,
            .look_again_m3 = std::numeric_limits<double>::infinity(),
            .shortest_way = false};
  }
};

/// Options of HarmonicPlanner.
struct HarmonicOptions {
  FieldSolver solver = FieldSolver::Multigrid;          ///< how the field is solved
  NeumannScheme neumann = NeumannScheme::FiniteVolume;  ///< what a closed face contributes
  double tolerance = 1e-4;            ///< GaussSeidel: largest relative change of the last sweep (eq. 10), > 0
  std::size_t max_sweeps = 50000;     ///< of the relaxation; no field takes more, > 0
  double uniform_source = 1e-4;       ///< see RelaxationOptions; 0 is the field of the paper
  HarmonicStrategy strategy = {};     ///< what to make of the field
  FrontierSurveyOptions survey = {};  ///< what counts as observable
};

/// The field behind a plan, for pictures and for those who want to look.
struct HarmonicField {
  LaplaceProblem problem;                   ///< what was solved
  std::vector<double> phi;                  ///< by position in the problem
  std::vector<Eigen::Vector3d> streamline;  ///< from the sensor to the sink that was chosen
  LaplaceReport report;                     ///< how the solver ended
  std::size_t stuck_cells =
      0;  ///< cells without a strictly lower neighbour; 0: descent from every cell ends in a sink
  /// False: the field is not certified (Multigrid), or descent from the source gets stuck (the others), and the plan
  /// takes the shortest way instead.
  bool followed = true;
};

/// Harmonic exploration, Shade & Newman 2011: solve Laplace's equation over the space the platform can reach, 1 at
/// the sensor, 0 at the boundaries to explore, no flow through the rest, and follow the steepest streamline down.
///
/// The paper's sensor is a point; here the domain is the platform's reachable space, and a frontier cell that lies
/// outside it is represented by the reachable cell from which its unknown neighbour is seen (FrontierSurvey). Only a
/// way that is known to end at a sink is ever followed. docs/harmonic.md names the place of every equation.
class HarmonicPlanner final : public FrontierPlanner {
 public:
  /// Throws std::invalid_argument naming the option or the part of the setup at fault.
  explicit HarmonicPlanner(const PlannerSetup& setup, const HarmonicOptions& options = {});

  [[nodiscard]] std::string_view name() const override { return "harmonic"; }

  /// The options it was made with.
  [[nodiscard]] const HarmonicOptions& options() const { return options_; }
  /// The field of the last plan; none where it needed none: nothing is left, the sensor looks from where it is, or
  /// there is one place to go and the shortest way is taken.
  [[nodiscard]] const std::optional<HarmonicField>& field() const { return field_; }

 private:
  void prepare(Plan& plan) override;
  [[nodiscard]] std::optional<ChosenView> choose(Plan& plan) override;
  void solve(const std::vector<VoxelIndex>& sinks, PlanStatistics& statistics);
  void solve_by_multigrid();
  void relax();
  [[nodiscard]] std::vector<VoxelIndex> way_down();
  [[nodiscard]] std::vector<VoxelIndex> sinks() const;
  [[nodiscard]] bool can_look(const FrontierTarget& target, const VoxelIndex& from, std::uint64_t& operations) const;
  [[nodiscard]] FrontierTarget first_look(const std::vector<VoxelIndex>& way, std::uint64_t& operations) const;
  [[nodiscard]] std::optional<TargetView> look_again(std::uint64_t& operations) const;
  [[nodiscard]] TargetView look_at(const FrontierTarget& wanted, std::uint64_t& operations) const;
  [[nodiscard]] bool chooses_directions() const;

  HarmonicOptions options_;
  std::optional<HarmonicField> field_;
};

}  // namespace vantage
