// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace vantage::detail {

/// Whether Assimp would take a file that begins with these bytes for PLY.
[[nodiscard]] bool begins_as_ply(std::string_view bytes);

/// Checks a whole PLY file, ascii or binary: header, every list, every vertex index of a face. A file that passes
/// holds exactly the elements that its header announces, and every corner of a face exists. Throws
/// std::runtime_error with the error but without the file name. Needs no more memory than the header.
void check_ply(std::string_view bytes);

}  // namespace vantage::detail
