// SPDX-License-Identifier: MIT
// Makes the peer planners for object views by name.
#include <iostream>
#include <stdexcept>
#include <vantage/evaluation/object_peers.hpp>

int main() {
  const auto names = vantage::object_peer_names();
  std::cout << names.size() << " peers\n";
  try {
    (void)vantage::make_object_peer("nobody", {});
  } catch (const std::invalid_argument&) {
    return names.empty() ? 1 : 0;
  }
  return 1;
}
