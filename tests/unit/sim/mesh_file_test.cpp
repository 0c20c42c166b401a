// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <random>
#include <stdexcept>
#include <string>
#include <vantage/sim/mesh_file.hpp>
#include <vector>

#include "sim/ply_check.hpp"
#include "support/temporary_folder.hpp"

namespace vantage {
namespace {

enum class PlyKind : std::uint8_t { Ascii, Little, Big };

std::string name_of(PlyKind kind) {
  return kind == PlyKind::Ascii ? "ascii" : kind == PlyKind::Little ? "binary_little_endian" : "binary_big_endian";
}

// Writes the body of a small PLY file in any of the three formats.
class PlyText {
 public:
  explicit PlyText(PlyKind kind) : kind_(kind) {}

  template <class Number>
  PlyText& put(Number value) {
    if (kind_ == PlyKind::Ascii) {
      bytes_ += (at_start_ ? "" : " ") + std::to_string(value);
    } else {
      std::string raw(sizeof value, '\0');
      std::memcpy(raw.data(), &value, sizeof value);
      if ((std::endian::native == std::endian::little) != (kind_ == PlyKind::Little)) {
        std::reverse(raw.begin(), raw.end());
      }
      bytes_ += raw;
    }
    at_start_ = false;
    return *this;
  }
  PlyText& end() {
    bytes_ += kind_ == PlyKind::Ascii ? "\n" : "";
    at_start_ = true;
    return *this;
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  PlyKind kind_;
  bool at_start_ = true;
  std::string bytes_;
};

std::string ply_header(PlyKind kind, const std::string& vertices, const std::string& faces) {
  return "ply\nformat " + name_of(kind) + " 1.0\ncomment two triangles and a quadrilateral\nelement vertex " +
         vertices + "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nelement face " +
         faces + "\nproperty list uchar int vertex_indices\nend_header\n";
}

std::string small_ply(PlyKind kind, std::int32_t last_corner = 4, const std::string& vertices = "5",
                      const std::string& faces = "3") {
  PlyText body(kind);
  const float corners[5][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5F, 0.5F, 2}};
  for (const auto& corner : corners) {
    body.put(corner[0]).put(corner[1]).put(corner[2]).put(std::uint8_t{7}).end();
  }
  const auto byte = [](int value) { return static_cast<std::uint8_t>(value); };
  body.put(byte(4)).put(std::int32_t{0}).put(std::int32_t{1}).put(std::int32_t{2}).put(std::int32_t{3}).end();
  body.put(byte(3)).put(std::int32_t{0}).put(std::int32_t{1}).put(std::int32_t{4}).end();
  body.put(byte(3)).put(std::int32_t{1}).put(std::int32_t{2}).put(last_corner).end();
  return ply_header(kind, vertices, faces) + body.bytes();
}

class PlyFile : public ::testing::TestWithParam<PlyKind> {
 protected:
  [[nodiscard]] std::filesystem::path file(const std::string& bytes, const char* name = "mesh.ply") const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  // The error message for a file, without its name; "" if it is read and its triangles are valid.
  [[nodiscard]] std::string complaint(const std::string& bytes, const char* name = "mesh.ply") const {
    const std::filesystem::path path = file(bytes, name);
    try {
      const TriangleMesh mesh = read_mesh_file(path);
      EXPECT_FALSE(mesh.triangles.empty());
      for (const auto& triangle : mesh.triangles) {
        for (const std::uint32_t corner : triangle) {
          EXPECT_LT(corner, mesh.vertices.size());
          EXPECT_TRUE(mesh.vertices.at(corner).allFinite());
        }
      }
      return "";
    } catch (const std::runtime_error& error) {
      const std::string said = error.what();
      EXPECT_EQ(said.rfind(path.string() + ": ", 0), 0U) << said;
      return said.substr(path.string().size() + 2);
    }
  }

  test::TemporaryFolder folder_;
};

TEST_P(PlyFile, IsReadWhole) {
  const TriangleMesh mesh = read_mesh_file(file(small_ply(GetParam())));
  EXPECT_EQ(mesh.vertices.size(), 5U);
  EXPECT_EQ(mesh.triangles.size(), 4U);
  EXPECT_TRUE(mesh.bounds().max.isApprox(Eigen::Vector3d(1, 1, 2)));
  EXPECT_EQ(complaint(small_ply(GetParam()), "mesh.unknown"), "") << "the content says what it is";
  EXPECT_EQ(complaint(small_ply(GetParam()) + "\n"), "") << "some writers end with a line break";
}

TEST_P(PlyFile, NamesWhatIsWrongWithCountsAndIndices) {
  const PlyKind kind = GetParam();
  const auto says = [&](const std::string& bytes, const std::string& what) {
    const std::string said = complaint(bytes);
    EXPECT_NE(said.find(what), std::string::npos) << said;
  };
  says(small_ply(kind, 5), "a face has a corner at vertex 5 of 5");
  says(small_ply(kind, -1), "a face has a corner at vertex -1 of 5");
  says(small_ply(kind, 1'000'000), "a face has a corner at vertex 1000000 of 5");
  says(small_ply(kind, 4, "4"), "PLY");
  says(small_ply(kind, 4, "4000000000"), "4000000000 of the element 'vertex', more than the file holds");
  says(small_ply(kind, 4, "18446744073709551615"), "more than the file holds");
  says(small_ply(kind, 4, "5", "4"), "PLY");
  says(small_ply(kind, 4, "5", "2"), "it holds more than its header names");
  says(small_ply(kind, 4, "-5"), "the count of its element 'vertex' is '-5'");
  says(small_ply(kind, 4, "5", "3\nproperty list float int more"), "the length of a list is no whole number");
  says(small_ply(kind, 4, "5", "3\nproperty quaternion q"), "its header names a type 'quaternion'");
  says(small_ply(kind, 4, "5\nproperty float x"), "no property 'x', or two");
}

TEST_P(PlyFile, AFaceWithoutACornerIsAnError) {
  PlyText body(GetParam());
  for (int corner = 0; corner < 3; ++corner) {
    body.put(1.0F * static_cast<float>(corner)).put(0.0F).put(0.0F).put(std::uint8_t{7}).end();
  }
  EXPECT_EQ(complaint(ply_header(GetParam(), "3", "1") + body.put(std::uint8_t{0}).end().bytes()),
            "a face has no corner");
}

// A file truncated anywhere in header or body is rejected.
TEST_P(PlyFile, CutAnywhereIsAnError) {
  const std::string whole = small_ply(GetParam());
  // The last line break may be missing, and a shortened last number may still be valid.
  const std::size_t end = whole.size() - (GetParam() == PlyKind::Ascii ? 1 : 0);
  for (std::size_t length = 0; length < end; ++length) {
    EXPECT_NE(complaint(whole.substr(0, length)), "") << length << " bytes of " << whole.size();
  }
}

// A file with any changed bytes is rejected or gives valid triangles.
TEST_P(PlyFile, DamagedIsRefusedOrSound) {
  std::mt19937_64 engine(7);
  const auto below = [&](std::size_t count) { return static_cast<std::size_t>(engine() % count); };
  const std::string whole = small_ply(GetParam());
  std::size_t refused = 0;
  constexpr std::size_t kRuns = 500;
  for (std::size_t run = 0; run < kRuns; ++run) {
    std::string bytes = whole;
    for (std::size_t change = 0; change <= below(3); ++change) {
      const std::size_t at = below(bytes.size());
      switch (below(4)) {
        case 0:
          bytes[at] = static_cast<char>(engine() & 0xFFU);
          break;
        case 1:
          bytes[at] = static_cast<char>('0' + below(10));
          break;
        case 2:
          bytes.erase(at, 1 + below(8));
          break;
        default:
          bytes.insert(at, bytes.substr(below(bytes.size()), 1 + below(20)));
      }
    }
    refused += complaint(bytes).empty() ? 0U : 1U;
  }
  EXPECT_GT(refused, kRuns / 4);
  EXPECT_LT(refused, kRuns);
}

INSTANTIATE_TEST_SUITE_P(Formats, PlyFile, ::testing::Values(PlyKind::Ascii, PlyKind::Little, PlyKind::Big),
                         [](const auto& tested) { return name_of(tested.param); });

TEST(PlyCheck, TakesTriangleStripsWithTheirEnds) {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n";
  EXPECT_NO_THROW(detail::check_ply(header + "5 0 1 2 3 -1\n"));
  EXPECT_THROW(detail::check_ply(header + "5 0 1 2 3 -2\n"), std::runtime_error);
  EXPECT_THROW(detail::check_ply(header + "5 0 1 2 4 -1\n"), std::runtime_error);
}

TEST(MeshFileFaces, OfTooManyCornersAreRefusedInAnyFormat) {
  const test::TemporaryFolder folder;
  std::string obj;
  std::string face = "f";
  for (int i = 1; i <= 1001; ++i) {
    obj.append("v ").append(std::to_string(i)).append(" ").append(std::to_string(i * i % 17)).append(" 0\n");
    face.append(" ").append(std::to_string(i));
  }
  std::ofstream(folder / "round.obj") << obj << face << '\n';
  try {
    (void)read_mesh_file(folder / "round.obj");
    ADD_FAILURE() << "it was read";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("round.obj: a face has 1001 corners, must be at most 1000"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace vantage
