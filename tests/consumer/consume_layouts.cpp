// SPDX-License-Identifier: MIT
// Checks that every public type has the same size and alignment with this file's compiler flags as without.
#include <iostream>

#include "layouts.hpp"

// No type is aligned more strictly than its numbers, so none depends on the vector width.
static_assert(alignof(vantage::Plan) <= alignof(double) && alignof(vantage::Scan) <= alignof(double));
static_assert(sizeof(vantage::Pose) == 16 * sizeof(double) && alignof(vantage::Pose) == alignof(double));

int main() {
  const std::vector<Layout> plain = plain_layouts();
  int faults = plain.size() == kLayouts.size() && plain.size() > 50 ? 0 : 1;
  for (std::size_t i = 0; i < plain.size() && i < kLayouts.size(); ++i) {
    const Layout& here = kLayouts[i];
    if (here.size != plain[i].size || here.alignment != plain[i].alignment || here.alignment > alignof(double)) {
      std::cout << here.name << ": " << here.size << " bytes, aligned to " << here.alignment << "; without flags "
                << plain[i].size << " and " << plain[i].alignment << '\n';
      ++faults;
    }
  }
  std::cout << kLayouts.size() << " types, " << faults << " faults\n";
  return faults == 0 ? 0 : 1;
}
