// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

namespace vantage::detail {

/// The first bytes of a record.
inline constexpr std::string_view kRecordMagic = "vantage run record 3\n";

/// Kind of a chunk.
enum class ChunkKind : std::uint8_t { Head = 'H', Cycle = 'C', End = 'E' };

/// A part of a record that is either complete or missing. On disk: kind (1 byte), length of the packed and of the
/// unpacked payload (4 bytes each, little endian), CRC-32 of these nine bytes and the packed payload (4 bytes),
/// payload packed by deflate.
struct Chunk {
  ChunkKind kind;
  std::string payload;
};

/// Packs bytes by deflate (RFC 1950). A higher `level` in [1, 9] packs better and takes longer.
[[nodiscard]] std::string deflated(std::string_view bytes, int level);

/// A chunk as it is stored on disk.
[[nodiscard]] std::string packed(ChunkKind kind, std::string_view payload);

/// Reads the next chunk. None at the end of the file, and none where no complete chunk follows; `problem` then
/// says why.
[[nodiscard]] std::optional<Chunk> read_chunk(std::istream& in, std::string& problem);

}  // namespace vantage::detail
