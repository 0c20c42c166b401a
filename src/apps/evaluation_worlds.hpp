// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "apps/explore_request.hpp"
#include "apps/simulated_run.hpp"

// The worlds of `vantage evaluate exploration`.
namespace vantage::apps {

/// Worlds that share a table, and what they share.
struct EvaluationClass {
  std::string_view name;
  std::string_view about;
  std::string_view options;  ///< of `vantage explore`, for all its worlds
};

/// A world with its sensor and its robot.
struct EvaluationWorld {
  std::string_view name;
  std::string_view in_class;                      ///< name of its EvaluationClass
  std::string_view options;                       ///< of `vantage explore`, besides those of its class
  std::optional<BoundWith> bound = std::nullopt;  ///< how the table bounds the path from below, if it does
  bool quick = false;                             ///< whether --quick takes it

  [[nodiscard]] bool needs_data() const { return options.find("$VANTAGE_DATA") != std::string_view::npos; }
};

[[nodiscard]] std::span<const EvaluationClass> evaluation_classes();
[[nodiscard]] std::span<const EvaluationWorld> evaluation_worlds();
/// The class of this name. Throws std::logic_error if there is none.
[[nodiscard]] const EvaluationClass& evaluation_class(std::string_view name);

/// Options of `vantage explore` for a run in a world: those of its class and its own. In the folder of the results
/// a shell runs them as they are: sensors lie in its folder sensors, and worlds in $VANTAGE_DATA.
[[nodiscard]] std::string options_of(const EvaluationWorld& world);

/// What such options ask for when the results lie in `folder`. Throws as `explore_request`.
[[nodiscard]] ExploreRequest request_in(const std::filesystem::path& folder, const std::string& options);

/// Writes the sensors that the options name into FOLDER/sensors. Throws std::runtime_error with the path.
void write_evaluation_sensors(const std::filesystem::path& folder);

}  // namespace vantage::apps
