// SPDX-License-Identifier: MIT
#include "evaluation/fuel_like.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

namespace vantage {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

// Legs between n views and from a start, number n, that differ by direction.
std::vector<std::vector<double>> random_legs(std::size_t n, std::mt19937& engine) {
  std::uniform_real_distribution<double> length(0.1, 10.0);
  std::vector<std::vector<double>> legs(n + 1, std::vector<double>(n));
  for (std::vector<double>& row : legs) {
    std::generate(row.begin(), row.end(), [&] { return length(engine); });
  }
  return legs;
}

double cost_of(const std::vector<std::size_t>& order, const std::vector<std::vector<double>>& legs,
               std::optional<std::size_t> end) {
  double cost = 0.0;
  std::size_t at = legs.size() - 1;
  for (const std::size_t view : order) {
    cost += legs[at][view];
    at = view;
  }
  return end ? cost + legs[at][*end] : cost;
}

TEST(FuelLike, TheOrderOfUpToEightPartsIsTheCheapest) {
  std::mt19937 engine(1);
  std::size_t cases = 0;
  for (std::size_t n = 1; n <= 8; ++n) {
    for (int seed = 0; seed < 20; ++seed) {
      const auto legs = random_legs(n + 1, engine);
      const detail::LegCost leg = [&](std::size_t from, std::size_t to) { return legs[from][to]; };
      std::vector<std::size_t> order(n);
      std::iota(order.begin(), order.end(), std::size_t{0});
      const auto end = seed % 2 == 0 ? std::optional(n) : std::nullopt;  // beyond those that are ordered
      const std::vector<std::size_t> found = detail::cheapest_order(order, n + 1, leg, end);
      ASSERT_TRUE(std::is_permutation(found.begin(), found.end(), order.begin(), order.end()));
      double least = kNever;
      do {
        least = std::min(least, cost_of(order, legs, end));
      } while (std::next_permutation(order.begin(), order.end()));
      EXPECT_NEAR(cost_of(found, legs, end), least, 1e-9);
      ++cases;
    }
  }
  EXPECT_EQ(cases, 160U);
}

// The least cost of all choices of one view of each layer from this one on.
double cost_of_all_choices(const std::vector<std::vector<std::size_t>>& layers, std::size_t layer, std::size_t at,
                           const std::vector<std::vector<double>>& legs, std::optional<std::size_t> end) {
  if (layer == layers.size()) {
    return end ? legs[at][*end] : 0.0;
  }
  double least = kNever;
  for (const std::size_t view : layers[layer]) {
    least = std::min(least, legs[at][view] + cost_of_all_choices(layers, layer + 1, view, legs, end));
  }
  return least;
}

TEST(FuelLike, TheViewsOfTheFirstPartsAreTheCheapest) {
  std::mt19937 engine(2);
  std::size_t cases = 0;
  for (std::size_t count = 1; count <= 5; ++count) {
    for (int seed = 0; seed < 40; ++seed) {
      std::vector<std::vector<std::size_t>> layers(count);
      std::size_t n = 0;
      for (std::vector<std::size_t>& layer : layers) {
        layer.resize(1 + engine() % 4);
        std::iota(layer.begin(), layer.end(), n);
        n += layer.size();
      }
      const auto legs = random_legs(n + 1, engine);
      const auto end = seed % 2 == 0 ? std::optional(n) : std::nullopt;
      const std::vector<std::size_t> found = detail::cheapest_through(
          layers, n + 1, [&](std::size_t from, std::size_t to) { return legs[from][to]; }, end);
      ASSERT_EQ(found.size(), count);
      for (std::size_t layer = 0; layer < count; ++layer) {
        ASSERT_NE(std::find(layers[layer].begin(), layers[layer].end(), found[layer]), layers[layer].end());
      }
      EXPECT_NEAR(cost_of(found, legs, end), cost_of_all_choices(layers, 0, n + 1, legs, end), 1e-9);
      ++cases;
    }
  }
  EXPECT_EQ(cases, 200U);
}

}  // namespace
}  // namespace vantage
