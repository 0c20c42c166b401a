// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vantage/compiler.hpp>
#include <vantage/map/brick.hpp>
#include <vantage/map/brick_directory.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

namespace detail {
class BrickFile;
}

/// The bricks of an OccupancyMap by number, in order of creation. No brick moves while the store lives, except one
/// that is shared: it moves when it is written to.
///
/// Bricks are on the heap, or in a file that is mapped into memory (impl/brick_file.hpp). In a file, those that were
/// not written to for longest are taken out of memory. They come back by themselves when they are read or written, so
/// readers need not know, and any number of threads may read.
class BrickStore {
 public:
  /// Index of a brick.
  using Number = BrickDirectory::Number;

  /// Bricks on the heap.
  BrickStore() = default;
  /// Bricks in a new file without a name in `folder`, of which about `resident_bytes` stay in memory. Throws
  /// std::runtime_error with the folder if no file can be made there.
  BrickStore(const std::string& folder, std::size_t resident_bytes);
  /// Copies the bricks; a store with a file makes its own in the same folder. Throws std::runtime_error with the
  /// folder if there is no room on its disk.
  BrickStore(const BrickStore& other);
  BrickStore(BrickStore&&) = delete;
  BrickStore& operator=(const BrickStore&) = delete;
  BrickStore& operator=(BrickStore&&) = delete;
  ~BrickStore();
  /// Exchanges two stores.
  void swap(BrickStore& other) noexcept;

  /// The number of bricks.
  [[nodiscard]] std::size_t size() const { return bricks_.size(); }
  /// A brick. `number` must be less than `size()`.
  [[nodiscard]] const Brick& operator[](std::size_t number) const { return *bricks_[number]; }
  /// A brick, to write to. `number` must be less than `size()`.
  [[nodiscard]] Brick& to_write(std::size_t number) {
    if (file_ != nullptr) {
      note_use(number);
    } else if (is_shared(number)) {
      unshare(number);
    }
    return *bricks_[number];
  }
  /// Keeps one brick for all that are shared, because free space has many equal ones. `number` must be less than
  /// `size()`, and the brick equal to those shared before. No effect with a file.
  void share(std::size_t number);
  /// Whether a brick is shared.
  [[nodiscard]] bool is_shared(std::size_t number) const { return bricks_[number] == shared_.get(); }
  /// Appends a brick without known cells. Returns whether there was room for it: false if the disk is full.
  [[nodiscard]] bool add();
  /// Takes a part of what was only read out of memory again, each call the next 16 MiB of the file. No effect without
  /// a file.
  void release_read();

  /// Bytes of the bricks that are kept in memory. What was only read since its turn in `release_read` comes on top.
  [[nodiscard]] std::size_t resident_bytes() const;

 private:
  void note_use(std::size_t number);
  void unshare(std::size_t number);

  std::unique_ptr<detail::BrickFile> file_;  // null: bricks are on the heap
  std::vector<Brick*> bricks_;
  std::unique_ptr<Brick> shared_;  // null: none was shared
  std::size_t shared_count_ = 0;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/map/impl/brick_store.ipp>
#endif
