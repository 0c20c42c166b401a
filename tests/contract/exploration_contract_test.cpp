// SPDX-License-Identifier: MIT
// Properties that every planner must have with its default settings, over buildings with moving objects, floors with
// pits and windows of real buildings, imperfect hosts, ideal and usual sensors, cell sizes, 3D, 2D and bands of
// heights. VANTAGE_CONTRACT_SEEDS: number of worlds per planner and host. VANTAGE_CONTRACT_FIRST_SEED: the first one.
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <tuple>
#include <vantage/sim/world.hpp>
#include <vector>

#include "contract/expect_contract.hpp"
#include "support/every_planner.hpp"
#include "support/real_data.hpp"

namespace vantage {
namespace {

using testing::Building;
using testing::expect_contract;
using testing::Host;
using testing::kHosts;
using testing::Scene;

using Pair = std::tuple<std::string, Host>;

// Runs the scenes numbered `first`, `first + step`, ..., as many as the environment asks for.
template <class SceneOf>
void expect_contract_in_each(const Pair& pair, std::uint32_t step, SceneOf&& scene_of) {
  const auto& [planner, host] = pair;
  const std::uint32_t seeds = testing::number_from("VANTAGE_CONTRACT_SEEDS", 1);
  const std::uint32_t first =
      testing::number_from("VANTAGE_CONTRACT_FIRST_SEED", 1) + static_cast<std::uint32_t>(host);
  std::size_t ended = 0;
  for (std::uint32_t i = 0; i < seeds; ++i) {
    ended += expect_contract(planner, host, scene_of(first + i * step).met_by(host)) ? 1U : 0U;
  }
  EXPECT_EQ(ended, seeds);
}

// It has no factor in common with the kinds of scenes, so that every host meets all of them.
constexpr std::uint32_t kStep = 13;

class ExplorationContract : public ::testing::TestWithParam<Pair> {};

TEST_P(ExplorationContract, Holds) { expect_contract_in_each(GetParam(), kStep, Scene::numbered); }

class ExplorationContractOfUsualSensors : public ExplorationContract {};

TEST_P(ExplorationContractOfUsualSensors, Holds) {
  expect_contract_in_each(GetParam(), kStep, Scene::with_a_usual_sensor);
}

class ExplorationContractInRealBuildings : public ExplorationContract {};

TEST_P(ExplorationContractInRealBuildings, Holds) {
  VANTAGE_REAL_DATA(data, "floorplans");
  expect_contract_in_each(GetParam(), testing::kSeedsOfABuilding, [](std::uint32_t number) {
    return Scene::in_real_building(testing::real_building(number), number);
  });
}
class ExplorationContractOverPits : public ExplorationContract {};

TEST_P(ExplorationContractOverPits, Holds) { expect_contract_in_each(GetParam(), kStep, Scene::over_pits); }

std::vector<Host> hosts() {
  std::vector<Host> all;
  for (std::uint32_t i = 0; i < kHosts; ++i) {
    all.push_back(static_cast<Host>(i));
  }
  return all;
}

// A window of a real building has no corner that is known to be free.
std::vector<Host> hosts_in_real_buildings() {
  std::vector<Host> all = hosts();
  std::erase(all, Host::InACorner);
  return all;
}

std::string name_of_pair(const ::testing::TestParamInfo<Pair>& pair) {
  return test::test_name(std::get<0>(pair.param) + "_" + name_of(std::get<1>(pair.param)));
}

INSTANTIATE_TEST_SUITE_P(Every, ExplorationContract,
                         ::testing::Combine(::testing::ValuesIn(test::every_planner()), ::testing::ValuesIn(hosts())),
                         name_of_pair);
INSTANTIATE_TEST_SUITE_P(Every, ExplorationContractOfUsualSensors,
                         ::testing::Combine(::testing::ValuesIn(test::every_planner()), ::testing::ValuesIn(hosts())),
                         name_of_pair);
INSTANTIATE_TEST_SUITE_P(Every, ExplorationContractOverPits,
                         ::testing::Combine(::testing::ValuesIn(test::every_planner()), ::testing::ValuesIn(hosts())),
                         name_of_pair);
INSTANTIATE_TEST_SUITE_P(Every, ExplorationContractInRealBuildings,
                         ::testing::Combine(::testing::ValuesIn(test::every_planner()),
                                            ::testing::ValuesIn(hosts_in_real_buildings())),
                         name_of_pair);

TEST(ExplorationContractSuite, HoldsEveryPlannerToEveryHostInEveryKindOfWorld) {
  EXPECT_EQ(test::every_planner().size(), 6U);
  EXPECT_EQ(hosts().size(), kHosts);
  std::set<std::tuple<Building, std::size_t, double, bool>> kinds;
  for (std::uint32_t number = 0; number < 90; ++number) {
    const Scene scene = Scene::numbered(number);
    kinds.insert({scene.building, scene.sensor_kind, scene.cell_m, scene.flat});
  }
  EXPECT_EQ(kinds.size(), testing::kBuildings * 3 * 3 * 2);
}

}  // namespace
}  // namespace vantage
