// SPDX-License-Identifier: MIT
#pragma once

#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/util/Console.h>

#include <cstdint>
#include <mutex>

namespace vantage {

/// Suppresses the output of OMPL during its lifetime.
class OmplQuiet {
 public:
  OmplQuiet() : lock_(one_at_a_time()), before_(ompl::msg::getOutputHandler()) { ompl::msg::noOutputHandler(); }
  ~OmplQuiet() { ompl::msg::useOutputHandler(before_); }
  OmplQuiet(const OmplQuiet&) = delete;
  OmplQuiet& operator=(const OmplQuiet&) = delete;
  OmplQuiet(OmplQuiet&&) = delete;
  OmplQuiet& operator=(OmplQuiet&&) = delete;

 private:
  static std::mutex& one_at_a_time() {
    static std::mutex mutex;
    return mutex;
  }
  std::lock_guard<std::mutex> lock_;
  ompl::msg::OutputHandler* before_;
};

/// A sampler with a fixed seed. OMPL's own generators are seeded by the clock.
class SeededSampler final : public ompl::base::RealVectorStateSampler {
 public:
  SeededSampler(const ompl::base::StateSpace* space, std::uint64_t seed) : RealVectorStateSampler(space) {
    rng_.setLocalSeed(static_cast<std::uint_fast32_t>((seed ^ seed >> 32U) & 0xFFFFFFFFU));
  }
};

}  // namespace vantage
