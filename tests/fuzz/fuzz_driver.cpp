// SPDX-License-Identifier: MIT
// Runs a fuzz target without libFuzzer.
//
//     ply_fuzz                 runs the seeds and a fixed set of mutations
//     ply_fuzz --write DIR     writes the seeds as a corpus for libFuzzer
//     ply_fuzz FILE...         runs these files, e.g. findings
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "fuzz_target.hpp"

namespace {

void take(const std::string& input) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
}

// Changes, deletes, duplicates or truncates a few bytes.
std::string damaged(std::string input, std::mt19937_64& engine) {
  const auto below = [&](std::size_t count) { return static_cast<std::size_t>(engine() % count); };
  for (std::size_t change = 0; change <= below(3) && !input.empty(); ++change) {
    const std::size_t at = below(input.size());
    switch (below(5)) {
      case 0:
        input[at] = static_cast<char>(engine() & 0xFFU);
        break;
      case 1:
        input[at] = static_cast<char>('0' + below(10));
        break;
      case 2:
        input.erase(at, 1 + below(16));
        break;
      case 3:
        input.insert(at, input.substr(below(input.size()), 1 + below(32)));
        break;
      default:
        input.resize(at);
    }
  }
  return input;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  const std::vector<std::string> seeds = vantage::fuzz::seeds();
  if (words.size() == 2 && words[0] == "--write") {
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      std::ofstream(std::filesystem::path(words[1]) / ("seed" + std::to_string(i)), std::ios::binary) << seeds[i];
    }
    return 0;
  }
  for (const std::string& name : words) {
    std::ifstream file(name, std::ios::binary);
    take(std::string(std::istreambuf_iterator<char>(file), {}));
  }
  if (words.empty()) {
    constexpr std::size_t kRuns = 2000;
    std::mt19937_64 engine(1);
    std::for_each(seeds.begin(), seeds.end(), take);
    for (std::size_t run = 0; run < kRuns; ++run) {
      take(damaged(seeds[run % seeds.size()], engine));
    }
    std::cout << seeds.size() << " seeds and " << kRuns << " inputs made from them\n";
  }
  return seeds.empty() ? 1 : 0;
}
