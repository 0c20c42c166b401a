// SPDX-License-Identifier: MIT
#include <vantage/map/impl/whole_file.hpp>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>

#include "support/read_all.hpp"
#include "support/temporary_folder.hpp"

namespace vantage {
namespace {

std::string write_error(const std::function<void()>& act) {
  try {
    act();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

// Limits the file size during its lifetime, to simulate a full disk.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    (void)std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit less{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &less);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk(FullDisk&&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;
  FullDisk& operator=(FullDisk&&) = delete;
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    (void)std::signal(SIGXFSZ, SIG_DFL);
  }

 private:
  rlimit before_{};
};

TEST(WholeFile, HoldsAllOfTheNewOrAllOfTheOld) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "map.ot";
  detail::write_whole_file(file, "old");
  EXPECT_EQ(test::read_all(file), "old");
  for (const rlim_t bytes : {rlim_t{0}, rlim_t{1}, rlim_t{4096}, rlim_t{99'999}}) {
    const FullDisk full(bytes);
    EXPECT_EQ(write_error([&] { detail::write_whole_file(file, std::string(100'000, 'x')); }),
              file.string() + ": cannot be written: File too large");
    EXPECT_EQ(test::read_all(file), "old");
    EXPECT_FALSE(std::filesystem::exists(folder / "map.ot.part"));
  }
  detail::write_whole_file(file, std::string(100'000, 'x'));
  EXPECT_EQ(test::read_all(file), std::string(100'000, 'x'));
  EXPECT_FALSE(std::filesystem::exists(folder / "map.ot.part"));
}

TEST(WholeFile, NamesWhatCannotBeWrittenAndWhy) {
  const test::TemporaryFolder folder;
  const auto said = [](const std::filesystem::path& file) {
    return write_error([&] { detail::write_whole_file(file, "x"); });
  };
  EXPECT_EQ(said(folder / "no/map.ot"),
            (folder / "no/map.ot").string() + ": cannot be written: " + "No such file or directory");
  EXPECT_EQ(said("/dev/full"), "/dev/full: cannot be written: No space left on device");
  EXPECT_EQ(said("/dev/null"), "");
  EXPECT_NE(said(folder / "."), "") << "a folder";
}

TEST(WholeFile, TryingLeavesThingsAsTheyAre) {
  const test::TemporaryFolder folder;
  EXPECT_NO_THROW(detail::try_whole_file(folder / "new"));
  EXPECT_TRUE(std::filesystem::is_empty(folder / "."));
  detail::write_whole_file(folder / "old", "old");
  EXPECT_NO_THROW(detail::try_whole_file(folder / "old"));
  EXPECT_EQ(test::read_all(folder / "old"), "old");
  EXPECT_FALSE(std::filesystem::exists(folder / "old.part"));
  EXPECT_NE(write_error([&] { detail::try_whole_file(folder / "no/file"); }), "");
}

TEST(WholeFile, ALinkStaysOne) {
  const test::TemporaryFolder folder;
  detail::write_whole_file(folder / "target", "old");
  std::filesystem::create_symlink(folder / "target", folder / "link");
  detail::write_whole_file(folder / "link", "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(test::read_all(folder / "target"), "new");
  std::filesystem::create_symlink("later", folder / "next");
  std::filesystem::create_symlink("next", folder / "first");
  detail::write_whole_file(folder / "first", "whole");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "first"));
  EXPECT_EQ(test::read_all(folder / "later"), "whole") << "a link to a file that is not there yet";
  std::filesystem::create_symlink("nowhere/file", folder / "dangling");
  EXPECT_NE(write_error([&] { detail::write_whole_file(folder / "dangling", "x"); }), "");
  std::filesystem::create_symlink("circle", folder / "circle");
  EXPECT_NE(write_error([&] { detail::write_whole_file(folder / "circle", "x"); }), "");
}

}  // namespace
}  // namespace vantage
