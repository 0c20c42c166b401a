// SPDX-License-Identifier: MIT
#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <deque>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vantage/map/brick.hpp>
#include <vector>

namespace vantage::detail {

// Room for bricks in a file that is mapped into memory, so that a part of it can be on disk only:
//
//     addresses   | segment of 16 MiB                          | segment of 16 MiB ...
//     file        | block | block | block | ...        | block | block | ...        end of what is reserved
//     in memory   |  hot  |   .   |  hot  | read       |   .   |  hot  |
//
// A block is hot from the first write to it. If too many are hot, the one that was not written to since it was last
// considered goes (second chance): its pages leave the memory of the process, and the kernel writes them to the file.
// A page that is touched without being there is read by the kernel. So addresses stay valid, and reading is safe in
// any number of threads. What readers bring back is not known here; `release_cold` takes it out, one segment per
// call.
//
// The file has no name, so nobody else reads it, and it ends with the process, however that ends. Its blocks are
// reserved on disk before they are used: a full disk shows there, and not later as a failed write.
class BrickFile {
 public:
  // A multiple of every usual size of a page.
  static constexpr std::size_t kBlockBytes = std::size_t{1} << 16U;
  static constexpr std::size_t kBricksOfBlock = kBlockBytes / sizeof(Brick);

  BrickFile(std::string folder, std::size_t hot_bytes)
      : folder_(std::move(folder)), most_hot_(std::max<std::size_t>(1, hot_bytes / kBlockBytes)) {
    file_ = open_unnamed(folder_);
    if (file_ < 0) {
      throw std::runtime_error(
          folder_ + ": no file can be made here for the bricks of a map: " + std::generic_category().message(errno));
    }
  }
  BrickFile(const BrickFile&) = delete;
  BrickFile(BrickFile&&) = delete;
  BrickFile& operator=(const BrickFile&) = delete;
  BrickFile& operator=(BrickFile&&) = delete;
  ~BrickFile() {
    for (std::byte* segment : segments_) {
      ::munmap(segment, kSegmentBytes);
    }
    ::close(file_);
  }

  [[nodiscard]] const std::string& folder() const { return folder_; }
  [[nodiscard]] std::size_t most_hot_bytes() const { return most_hot_ * kBlockBytes; }
  [[nodiscard]] std::size_t hot_bytes() const { return hot_.size() * kBlockBytes; }

  // Room for brick number `number`, the number of those placed before. Null if the disk or the address space is full.
  [[nodiscard]] void* place(std::size_t number) {
    const std::size_t block = number / kBricksOfBlock;
    if (block == blocks_.size() && !reserve(block)) {
      return nullptr;
    }
    note_use(number);
    return address_of(block) + number % kBricksOfBlock * sizeof(Brick);
  }

  void note_use(std::size_t number) {
    const std::size_t block = number / kBricksOfBlock;
    blocks_[block].used = true;
    if (blocks_[block].hot) {
      return;
    }
    blocks_[block].hot = true;
    hot_.push_back(static_cast<std::uint32_t>(block));
    while (hot_.size() > most_hot_) {
      const std::uint32_t oldest = hot_.front();
      hot_.pop_front();
      if (oldest == block || blocks_[oldest].used) {
        blocks_[oldest].used = false;
        hot_.push_back(oldest);
      } else {
        blocks_[oldest].hot = false;
        release(oldest, oldest + 1);
      }
    }
  }

  void release_cold() {
    if (segments_.empty()) {
      return;
    }
    next_ = (next_ + 1) % segments_.size();
    const std::size_t end = std::min((next_ + 1) * kBlocksOfSegment, blocks_.size());
    for (std::size_t from = next_ * kBlocksOfSegment; from < end; ++from) {
      std::size_t to = from;
      while (to < end && !blocks_[to].hot) {
        ++to;
      }
      if (to > from) {
        release(from, to);
        from = to;
      }
    }
  }

 private:
  static constexpr std::size_t kSegmentBytes = std::size_t{1} << 24U;
  static constexpr std::size_t kBlocksOfSegment = kSegmentBytes / kBlockBytes;
  struct Block {
    bool hot = false;
    bool used = false;  // written to since it became hot or was last considered
  };

  static int open_unnamed(const std::string& folder) {
#ifdef O_TMPFILE
    const int unnamed = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    if (unnamed >= 0 || (errno != EOPNOTSUPP && errno != EISDIR)) {
      return unnamed;
    }
#endif
    std::string name = folder + "/vantage-map-XXXXXX";
    const int file = ::mkstemp(name.data());
    if (file >= 0) {
      ::unlink(name.c_str());
      ::fcntl(file, F_SETFD, FD_CLOEXEC);
    }
    return file;
  }

  [[nodiscard]] bool reserve(std::size_t block) {
    int error = EINTR;
    while (error == EINTR) {
      error = ::posix_fallocate(file_, static_cast<off_t>(block * kBlockBytes), static_cast<off_t>(kBlockBytes));
    }
    if (error != 0) {
      return false;
    }
    if (block == segments_.size() * kBlocksOfSegment) {
      void* segment = ::mmap(nullptr, kSegmentBytes, PROT_READ | PROT_WRITE, MAP_SHARED, file_,
                             static_cast<off_t>(block * kBlockBytes));
      if (segment == MAP_FAILED) {
        return false;
      }
      segments_.push_back(static_cast<std::byte*>(segment));
    }
    blocks_.emplace_back();
    return true;
  }
  [[nodiscard]] std::byte* address_of(std::size_t block) const {
    return segments_[block / kBlocksOfSegment] + block % kBlocksOfSegment * kBlockBytes;
  }
  // The blocks must be of one segment.
  void release(std::size_t from, std::size_t to) const {
    ::madvise(address_of(from), (to - from) * kBlockBytes, MADV_DONTNEED);
  }

  std::string folder_;
  std::size_t most_hot_;
  int file_ = -1;
  std::vector<std::byte*> segments_;
  std::vector<Block> blocks_;
  std::deque<std::uint32_t> hot_;
  std::size_t next_ = 0;
};

}  // namespace vantage::detail
