// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

namespace vantage::detail {

/// The first bytes of a record.
inline constexpr std::string_view kRecordMagic = "vantage run record 2\n";

/// What a chunk of a record is.
enum class ChunkKind : std::uint8_t { Head = 'H', Cycle = 'C', End = 'E' };

/// A part of a record that is either whole or not there. On disk: the kind (1 byte), the length of the packed payload
/// and of the plain one (4 bytes each, the lowest first), the CRC-32 of these nine bytes and the packed payload (4),
/// the payload, packed by deflate.
struct Chunk {
  ChunkKind kind;
  std::string payload;
};

/// `bytes` packed by deflate (RFC 1950), the more tightly the higher `level` in [1, 9].
[[nodiscard]] std::string deflated(std::string_view bytes, int level);

/// A chunk as it lies on disk.
[[nodiscard]] std::string packed(ChunkKind kind, std::string_view payload);

/// The next chunk; none at the end of the file or where what follows is no whole chunk, which `problem` then tells.
[[nodiscard]] std::optional<Chunk> read_chunk(std::istream& in, std::string& problem);

}  // namespace vantage::detail
