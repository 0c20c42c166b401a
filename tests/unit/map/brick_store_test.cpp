// SPDX-License-Identifier: MIT
// Maps whose bricks are mostly on disk beside the same maps in memory.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vantage/map/occupancy_map.hpp>
#include <vector>

#include "support/equal_maps.hpp"
#include "support/random_maps.hpp"
#include "support/sanitized.hpp"
#include "support/temporary_folder.hpp"

namespace vantage {
namespace {

constexpr std::size_t kBlockBytes = 65536;

/// The bytes of the files of a folder that are in the memory of this process, named or not.
std::size_t bytes_in_memory(const std::filesystem::path& folder) {
  std::ifstream mappings("/proc/self/smaps");
  std::size_t bytes = 0;
  bool of_folder = false;
  for (std::string line; std::getline(mappings, line);) {
    std::istringstream words(line);
    std::string name;
    std::size_t value = 0;
    words >> name;
    if (name.back() != ':') {
      of_folder = line.find(folder.string()) != std::string::npos;
    } else if (of_folder && name == "Rss:" && words >> value) {
      bytes += 1024 * value;
    }
  }
  return bytes;
}

OccupancyMap on_disk(const std::filesystem::path& folder, std::size_t blocks) {
  return {{}, folder, blocks * kBlockBytes};
}

/// Writes in one of the ways of a host around a place that moves; both maps get the same.
class Host {
 public:
  explicit Host(std::uint32_t seed) : engine_(seed) {}

  void write(OccupancyMap& a, OccupancyMap& b) {
    if (engine_() % 8 == 0) {
      place_ = {coordinate(300), coordinate(300), coordinate(20)};
    }
    const VoxelIndex cell = place_ + VoxelIndex{coordinate(20), coordinate(20), coordinate(20)};
    const VoxelBox box{cell, cell + VoxelIndex{1 + coordinate(4) + 4, 5, 9}};
    const int kind = static_cast<int>(engine_() % 8);
    Scan scan = test::random_scan(engine_, 40);
    scan.world_from_sensor.translation() += a.frame().corner_of(place_);
    Brick cells;
    for (std::size_t word = 0; word < Brick::kWords; ++word) {
      cells.known[word] = std::uint64_t{engine_()} << 32U | engine_();
      cells.occupied[word] = cells.known[word] & (std::uint64_t{engine_()} << 32U | engine_());
    }
    const double log_odds = 0.1 * coordinate(30);
    for (OccupancyMap* map : {&a, &b}) {
      switch (kind) {
        case 0:
          map->set(cell, static_cast<Occupancy>(cells.known[0] % 3));
          break;
        case 1:
          map->set_log_odds(box, log_odds);
          break;
        case 2:
          map->assume_free(map->frame().box_of(box));
          break;
        case 3:
          map->assign(Brick::of_cell(cell), cells.known, cells.occupied);
          break;
        default:
          map->insert(scan);
      }
    }
  }
  std::int32_t coordinate(std::int32_t furthest) {
    return static_cast<std::int32_t>(engine_() % static_cast<std::uint32_t>(2 * furthest)) - furthest;
  }

 private:
  std::mt19937 engine_;
  VoxelIndex place_;
};

TEST(ResidentBricks, EqualAMapInMemory) {
  const test::TemporaryFolder folder;
  std::size_t writes = 0;
  std::size_t compared = 0;
  constexpr std::uint32_t kSeeds = test::kSanitized ? 2 : 3;
  for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
    const std::size_t blocks = seed == 1 ? 1 : 4;
    OccupancyMap paged = on_disk(folder.path(), blocks);
    OccupancyMap whole;
    Host host(seed);
    OccupancyMap::Revision seen = 0;
    for (int step = 1; step <= 1000; ++step) {
      host.write(paged, whole);
      ++writes;
      const VoxelIndex cell{host.coordinate(300), host.coordinate(300), host.coordinate(40)};
      ASSERT_EQ(paged.log_odds(cell), whole.log_odds(cell));
      if (step % 10 == 0) {
        ASSERT_EQ(paged.changed_since(seen), whole.changed_since(seen));
        seen = paged.revision();
      }
      if (step % 250 == 0) {
        test::expect_equal_maps(paged, whole);
        ++compared;
        OccupancyMap copy = paged;
        paged = std::move(copy);
        seen = 0;
      }
      ASSERT_LE(paged.resident_bytes() + paged.brick_count() * sizeof(Brick),
                paged.memory_bytes() + blocks * kBlockBytes);
    }
    EXPECT_EQ(whole.resident_bytes(), whole.memory_bytes());
    EXPECT_GT(whole.memory_bytes(), 5 * 4 * kBlockBytes);
  }
  EXPECT_EQ(writes, kSeeds * 1000U);
  EXPECT_EQ(compared, kSeeds * 4U);
}

// Not what the map says of itself, but what the kernel says of the process.
TEST(ResidentBricks, LeaveTheMemoryOfTheProcess) {
  const test::TemporaryFolder folder;
  constexpr std::size_t kBlocks = 16;
  OccupancyMap map = on_disk(folder.path(), kBlocks);
  ASSERT_LE(bytes_in_memory(folder.path()), kBlocks * kBlockBytes);
  std::size_t most = 0;
  for (std::int32_t x = 0; x < 400; ++x) {
    map.set_log_odds(VoxelBox{{8 * x, 0, 0}, {8 * x + 8, 160, 16}}, x % 7 - 3.0);
    most = std::max(most, bytes_in_memory(folder.path()));
  }
  EXPECT_GT(map.memory_bytes(), 5 * kBlocks * kBlockBytes);
  EXPECT_GT(most, kBlocks * kBlockBytes / 2);
  EXPECT_LE(most, kBlocks * kBlockBytes);
  EXPECT_LE(map.resident_bytes(), kBlocks * kBlockBytes + map.memory_bytes() / 5);

  // A reader brings all of it back; the next writes take it out again.
  EXPECT_EQ(map.counts().free + map.counts().occupied, 400U * 8 * 160 * 16);
  EXPECT_GT(bytes_in_memory(folder.path()), 5 * kBlocks * kBlockBytes);
  for (int scan = 0; scan < 3; ++scan) {
    map.set_log_odds(VoxelBox{{0, 0, 0}, {8, 8, 8}}, -2.0);
  }
  EXPECT_LE(bytes_in_memory(folder.path()), kBlocks * kBlockBytes);
}

TEST(ResidentBricks, AreReadByManyThreads) {
  const test::TemporaryFolder folder;
  OccupancyMap paged = on_disk(folder.path(), 2);
  OccupancyMap whole;
  Host host(7);
  for (int step = 0; step < 400; ++step) {
    host.write(paged, whole);
  }
  ASSERT_GT(whole.memory_bytes(), 10 * kBlockBytes);
  std::vector<std::size_t> equal(4);
  std::vector<std::thread> threads;
  for (std::size_t& count : equal) {
    threads.emplace_back([&count, &paged, &whole] {
      whole.for_each_known([&](const VoxelIndex& cell, Occupancy) {
        count += paged.log_odds(cell) == whole.log_odds(cell) ? 1U : 0U;
      });
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  const OccupancyMap::Counts counts = whole.counts();
  EXPECT_GT(counts.free, 10'000U);
  for (const std::size_t count : equal) {
    EXPECT_EQ(count, counts.free + counts.occupied);
  }
}

// What a kill could leave: nothing, because the file never has a name.
TEST(ResidentBricks, LeaveNoFile) {
  const test::TemporaryFolder folder;
  const auto open_files = [] {
    std::size_t count = 0;
    for ([[maybe_unused]] const auto& file : std::filesystem::directory_iterator("/proc/self/fd")) {
      ++count;
    }
    return count;
  };
  const std::size_t before = open_files();
  {
    OccupancyMap map = on_disk(folder.path(), 1);
    map.set_log_odds(VoxelBox{{0, 0, 0}, {100, 100, 100}}, 1.0);
    const OccupancyMap copy = map;
    EXPECT_EQ(open_files(), before + 2);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  }
  EXPECT_EQ(open_files(), before);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(ResidentBricks, NeedAFolder) {
  const test::TemporaryFolder folder;
  const auto message_of = [](const std::filesystem::path& in, std::size_t resident_bytes) -> std::string {
    try {
      const OccupancyMap map({}, in, resident_bytes);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  };
  const std::filesystem::path missing = folder.path() / "missing";
  EXPECT_EQ(message_of(missing, 65536),
            missing.string() + ": no file can be made here for the bricks of a map: No such file or directory");
  EXPECT_EQ(message_of("", 65536), "OccupancyMap: folder must not be empty");
  EXPECT_EQ(message_of(folder.path(), 1000), "OccupancyMap: resident_bytes is 1000, must be at least 65536");
  EXPECT_THROW(on_disk(missing, 1), std::runtime_error);
  EXPECT_THROW(OccupancyMap({}, folder.path(), 1000), std::invalid_argument);
}

/// No file may be larger than `bytes` while this lives: to a map, a full disk.
class FileLimit {
 public:
  explicit FileLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  FileLimit(const FileLimit&) = delete;
  FileLimit(FileLimit&&) = delete;
  FileLimit& operator=(const FileLimit&) = delete;
  FileLimit& operator=(FileLimit&&) = delete;
  ~FileLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  void (*handler_)(int);
  rlimit before_{};
};

TEST(ResidentBricks, AFullDiskIsAFullMap) {
  const test::TemporaryFolder folder;
  OccupancyMap map = on_disk(folder.path(), 1);
  const VoxelBox first{{0, 0, 0}, {80, 80, 8}};    // 100 bricks, one block
  const VoxelBox later{{0, 80, 0}, {80, 240, 8}};  // 200 more
  {
    const FileLimit full(kBlockBytes);
    map.set_log_odds(first, -2.0);
    EXPECT_EQ(map.cells_refused(), 0U);
    map.set_log_odds(later, 1.0);
    EXPECT_EQ(map.counts().occupied, 2U * Brick::kCells);  // 102 bricks fit into a block
    EXPECT_EQ(map.cells_refused(), 198U * Brick::kCells);
    map.set_log_odds(first, 1.0);  // what is known goes on being updated
    EXPECT_EQ(map.counts().occupied, 102U * Brick::kCells);

    const OccupancyMap copy = map;  // has a block of its own
    const FileLimit fuller(0);
    OccupancyMap target;
    target.set({1, 2, 3}, Occupancy::Occupied);
    EXPECT_THROW(target = map, std::runtime_error);
    EXPECT_EQ(target.at({1, 2, 3}), Occupancy::Occupied);
    EXPECT_EQ(target.counts().occupied, 1U);
  }
  const std::size_t refused = map.cells_refused();
  map.set_log_odds(later, 1.0);  // there is room again
  EXPECT_EQ(map.counts().occupied, 300U * Brick::kCells);
  EXPECT_EQ(map.cells_refused(), refused);
}

}  // namespace
}  // namespace vantage
