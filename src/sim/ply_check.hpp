// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace vantage::detail {

/// Whether these first bytes let Assimp take a file for PLY.
[[nodiscard]] bool begins_as_ply(std::string_view bytes);

/// Walks through a whole PLY file, ascii or binary: its header, every list and every vertex index of a face. What
/// passes holds exactly the elements that its header names, each face with corners that exist. Throws
/// std::runtime_error saying what is wrong, without the file's name. Takes no more memory than the header.
void check_ply(std::string_view bytes);

}  // namespace vantage::detail
