// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace vantage::detail {

/// The bytes of a file of src/report/page or of the 3D library ("three.js", "OrbitControls.js"), embedded when
/// this library was built. Throws std::logic_error for any other name.
[[nodiscard]] std::string page_file(std::string_view name);

}  // namespace vantage::detail
