// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "apps/map_command.hpp"
#include "support/real_data.hpp"
#include "support/temporary_folder.hpp"

namespace vantage::apps {
namespace {

TEST(MapCommand, CountsTheCellsOfARealBuilding) {
  VANTAGE_REAL_DATA(path, "octomaps/geb079.bt");
  std::ostringstream out;
  EXPECT_EQ(run_map_command(path, "-", out), 0);
  const nlohmann::json summary = nlohmann::json::parse(out.str());
  EXPECT_EQ(summary.at("file"), path.string());
  EXPECT_DOUBLE_EQ(summary.at("resolution_m"), 0.08);
  EXPECT_EQ(summary.at("cells").at("free"), 950'759);
  EXPECT_EQ(summary.at("cells").at("frontier"), 188'596);
  EXPECT_GT(summary.at("cells").at("occupied"), 0);
  EXPECT_GT(summary.at("cells").at("void"), 0);
  EXPECT_GT(summary.at("memory_mb"), 0.0);
  const nlohmann::json& bounds = summary.at("bounds_m");
  ASSERT_EQ(bounds.size(), 6U);
  const auto extent = [&](std::size_t axis) {
    return bounds.at(axis + 3).get<double>() - bounds.at(axis).get<double>();
  };
  EXPECT_NEAR(extent(0), 39.0, 0.5);
  EXPECT_NEAR(extent(1), 15.0, 0.5);
  EXPECT_NEAR(extent(2), 3.1, 0.1);

  const test::TemporaryFolder folder;
  std::ostringstream text;
  EXPECT_EQ(run_map_command(path, (folder / "map.json").string(), text), 0);
  EXPECT_EQ(nlohmann::json::parse(std::ifstream(folder / "map.json")), summary);
  EXPECT_NE(text.str().find("188596 of them frontier"), std::string::npos) << text.str();
}

TEST(MapCommand, NamesABadFileAndWritesNothing) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "cut.bt") << "# Octomap OcTree binary file\nid OcTree\nsize 9\nres 0.1\ndata\n";
  std::ostringstream out;
  EXPECT_THROW(run_map_command(folder / "cut.bt", (folder / "map.json").string(), out), std::runtime_error);
  EXPECT_TRUE(out.str().empty());
  EXPECT_FALSE(std::filesystem::exists(folder / "map.json"));
}

}  // namespace
}  // namespace vantage::apps
