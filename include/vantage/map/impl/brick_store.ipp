// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <new>
#include <stdexcept>
#include <utility>
#include <vantage/map/brick_store.hpp>

#include <vantage/map/impl/brick_file.hpp>

namespace vantage {

VANTAGE_INLINE BrickStore::BrickStore(const std::string& folder, std::size_t resident_bytes)
    : file_(std::make_unique<detail::BrickFile>(folder, resident_bytes)) {}

VANTAGE_INLINE BrickStore::BrickStore(const BrickStore& other) {
  BrickStore copy;  // so that its destructor frees what was copied before an exception
  if (other.file_ != nullptr) {
    copy.file_ = std::make_unique<detail::BrickFile>(other.file_->folder(), other.file_->most_hot_bytes());
  }
  copy.bricks_.reserve(other.size());
  for (std::size_t number = 0; number < other.size(); ++number) {
    if (!copy.add()) {
      throw std::runtime_error(copy.file_->folder() + ": no room for a copy of the map");
    }
    *copy.bricks_.back() = other[number];
    if (other.is_shared(number)) {
      copy.share(number);
    }
  }
  swap(copy);
}

VANTAGE_INLINE BrickStore::~BrickStore() {
  if (file_ == nullptr) {
    for (std::size_t number = 0; number < bricks_.size(); ++number) {
      if (!is_shared(number)) {
        delete bricks_[number];
      }
    }
  }
}

VANTAGE_INLINE void BrickStore::swap(BrickStore& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(bricks_, other.bricks_);
  std::swap(shared_, other.shared_);
  std::swap(shared_count_, other.shared_count_);
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

VANTAGE_INLINE void BrickStore::share(std::size_t number) {
  if (file_ != nullptr || is_shared(number)) {
    return;
  }
  if (shared_ == nullptr) {
    shared_ = std::make_unique<Brick>(*bricks_[number]);
  }
  delete std::exchange(bricks_[number], shared_.get());
  ++shared_count_;
}

VANTAGE_INLINE void BrickStore::unshare(std::size_t number) {
  bricks_[number] = new Brick(*shared_);
  --shared_count_;
}

VANTAGE_INLINE void BrickStore::note_use(std::size_t number) { file_->note_use(number); }

VANTAGE_INLINE void BrickStore::release_read() {
  if (file_ != nullptr) {
    file_->release_cold();
  }
}

VANTAGE_INLINE std::size_t BrickStore::resident_bytes() const {
  return file_ != nullptr ? file_->hot_bytes() : (bricks_.size() - shared_count_) * sizeof(Brick);
}

}  // namespace vantage
