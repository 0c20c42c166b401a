// SPDX-License-Identifier: MIT
#include "report/record_chunk.hpp"

#include <zlib.h>

#include <istream>
#include <stdexcept>

#include "report/bytes.hpp"

namespace vantage::detail {
namespace {

constexpr int kChunkLevel = 1;  // the fastest; cells that change lie together and compress well anyway
constexpr std::size_t kSizes = 9;
constexpr std::size_t kFrame = kSizes + 4;
constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 30;
constexpr std::uint64_t kMostPacked = 1100;  // most unpacked bytes per packed byte; deflate reaches at most 1032

const Bytef* data_of(std::string_view bytes) { return reinterpret_cast<const Bytef*>(bytes.data()); }

std::uint32_t checksum(std::string_view sizes, std::string_view payload) {
  uLong sum = crc32(0, data_of(sizes), static_cast<uInt>(sizes.size()));
  sum = crc32(sum, data_of(payload), static_cast<uInt>(payload.size()));
  return static_cast<std::uint32_t>(sum);
}

}  // namespace

std::string deflated(std::string_view bytes, int level) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string out(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(out.data()), &size, data_of(bytes), static_cast<uLong>(bytes.size()),
                level) != Z_OK) {
    throw std::runtime_error("there is no memory to pack a part of a record");
  }
  out.resize(size);
  return out;
}

std::string packed(ChunkKind kind, std::string_view payload) {
  const std::string body = deflated(payload, kChunkLevel);
  if (payload.size() > kMostBytes || body.size() > kMostBytes) {
    throw std::runtime_error("one cycle of a record is longer than 1 GiB");
  }
  ByteWriter frame;
  frame.byte(static_cast<std::uint8_t>(kind));
  frame.word(body.size(), 4);
  frame.word(payload.size(), 4);
  frame.word(checksum(frame.bytes(), body), 4);
  return frame.bytes() + body;
}

std::optional<Chunk> read_chunk(std::istream& in, std::string& problem) {
  std::string frame(kFrame, '\0');
  in.read(frame.data(), kFrame);
  if (in.gcount() == 0) {
    return std::nullopt;
  }
  ByteReader reader(frame);
  const auto kind = static_cast<ChunkKind>(reader.byte());
  const std::uint64_t size = reader.word(4);
  uLongf plain = static_cast<uLongf>(reader.word(4));
  const std::uint64_t sum = reader.word(4);
  if (in.gcount() < static_cast<std::streamsize>(kFrame) || size > kMostBytes || plain > kMostBytes) {
    problem = "a chunk is cut off or damaged";
    return std::nullopt;
  }
  // A damaged length must not allocate more than the file can fill.
  const std::istream::pos_type here = in.tellg();
  in.seekg(0, std::ios::end);
  const std::streamoff left = in.tellg() - here;
  in.seekg(here);
  if (left < static_cast<std::streamoff>(size) || plain > kMostPacked * (size + 1)) {
    problem = "a chunk is cut off or damaged";
    return std::nullopt;
  }
  std::string body(size, '\0');
  in.read(body.data(), static_cast<std::streamsize>(size));
  Chunk chunk{kind, std::string()};
  if (checksum(std::string_view(frame).substr(0, kSizes), body) == sum) {
    const uLongf expected = plain;
    chunk.payload.resize(plain);
    if (uncompress(reinterpret_cast<Bytef*>(chunk.payload.data()), &plain, data_of(body),
                   static_cast<uLong>(body.size())) == Z_OK &&
        plain == expected) {
      return chunk;
    }
  }
  problem = "a chunk does not fit its checksum";
  return std::nullopt;
}

}  // namespace vantage::detail
