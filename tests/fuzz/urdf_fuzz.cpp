// SPDX-License-Identifier: MIT
#include <cstdlib>
#include <stdexcept>
#include <vantage/arm/kinematic_chain.hpp>

#include "fuzz_target.hpp"

std::vector<std::string> vantage::fuzz::seeds() {
  return {
      "<?xml version='1.0'?><robot name='r'><!-- two joints --><link name='a'/>"
      "<link name='b'><collision><origin xyz='0 0 1' rpy='0 0.5 0'/><geometry><box size='0.2 0.6 0.2'/></geometry>"
      "</collision></link><link name='c'><collision><geometry><sphere radius='0.3'/></geometry></collision></link>"
      "<link name='d'><collision><geometry><cylinder radius='0.1' length='1'/></geometry></collision></link>"
      "<joint name='j' type='continuous'><parent link='a'/><child link='b'/><axis xyz='0 0 1'/></joint>"
      "<joint name='k' type='fixed'><parent link='b'/><child link='d'/><origin xyz='2 0 0'/></joint>"
      "<joint name='l' type='prismatic'><parent link='b'/><child link='c'/><axis xyz='1 0 0'/>"
      "<limit lower='-1' upper='1' effort='1' velocity='1'/></joint></robot>"};
}

// The parser loses links that are joined in a circle if it refuses the file for another reason.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:liburdfdom_model"; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    const auto chain = vantage::KinematicChain::from_urdf_text(text, "a", "c");
    const std::vector<double> joints(chain.joint_count(), 0.1);
    if (!chain.sensor_pose(joints).matrix().allFinite()) {
      std::abort();
    }
  } catch (const std::runtime_error&) {  // documented
  }
  return 0;
}
