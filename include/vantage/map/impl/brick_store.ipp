// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <new>
#include <stdexcept>
#include <utility>
#include <vantage/map/brick_store.hpp>

#include <vantage/map/impl/brick_file.hpp>

namespace vantage {

VANTAGE_INLINE BrickStore::BrickStore(const std::filesystem::path& folder, std::size_t resident_bytes)
    : file_(std::make_unique<detail::BrickFile>(folder, resident_bytes)) {}

VANTAGE_INLINE BrickStore::BrickStore(const BrickStore& other) {
  BrickStore copy;  // so that its destructor frees what was copied before an exception
  if (other.file_ != nullptr) {
    copy.file_ = std::make_unique<detail::BrickFile>(other.file_->folder(), other.file_->most_hot_bytes());
  }
  copy.bricks_.reserve(other.size());
  for (const Brick* brick : other.bricks_) {
    if (!copy.add()) {
      throw std::runtime_error(copy.file_->folder().string() +
                               ": OccupancyMapOptions::resident_folder: no room for a copy of the map");
    }
    *copy.bricks_.back() = *brick;
  }
  swap(copy);
}

VANTAGE_INLINE BrickStore::~BrickStore() {
  if (file_ == nullptr) {
    for (Brick* brick : bricks_) {
      delete brick;
    }
  }
}

VANTAGE_INLINE void BrickStore::swap(BrickStore& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(bricks_, other.bricks_);
}

VANTAGE_INLINE bool BrickStore::add() {
  bricks_.push_back(nullptr);
  if (file_ == nullptr) {
    bricks_.back() = new Brick;
  } else if (void* place = file_->place(bricks_.size() - 1)) {
    bricks_.back() = new (place) Brick;
  } else {
    bricks_.pop_back();
    return false;
  }
  return true;
}

VANTAGE_INLINE void BrickStore::note_use(std::size_t number) { file_->note_use(number); }

VANTAGE_INLINE void BrickStore::release_read() {
  if (file_ != nullptr) {
    file_->release_cold();
  }
}

VANTAGE_INLINE std::size_t BrickStore::resident_bytes() const {
  return file_ != nullptr ? file_->hot_bytes() : bricks_.size() * sizeof(Brick);
}

}  // namespace vantage
