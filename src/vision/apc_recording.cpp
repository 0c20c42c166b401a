// SPDX-License-Identifier: MIT
// Data of the Amazon Picking Challenge (Zeng et al. 2017): a RealSense on an arm; all numbers are in one text file.
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>

#include <vantage/map/impl/file_bytes.hpp>
#include "vision/pose_text.hpp"
#include "vision/recording_reader.hpp"

namespace vantage {
namespace {

constexpr const char* kDecoded = ".depth_dmm.png";
constexpr const char* kRaw = ".depth.png";
constexpr const char* kPoseTitle = "Camera-to-world extrinsic matrix (camera pose) for ";

using Blocks = std::map<std::string, std::vector<double>, std::less<>>;

// Reads blocks of "# title" and the numbers below it.
Blocks blocks_in(const std::filesystem::path& file) {
  std::istringstream in(detail::file_bytes(file, detail::kMostTextBytes));
  Blocks blocks;
  std::string title;
  std::string text;
  for (std::size_t number = 1; std::getline(in, text); ++number) {
    const std::size_t end = text.find_last_not_of(" \t\r");
    text.resize(end == std::string::npos ? 0 : end + 1);
    if (text.rfind("# ", 0) == 0) {
      title = text.substr(2);
    } else if (!text.empty()) {
      const auto numbers = detail::numbers_in(text);
      if (!numbers) {
        throw std::runtime_error(file.string() + ": line " + std::to_string(number) + " is not a row of numbers");
      }
      std::vector<double>& block = blocks[title];
      block.insert(block.end(), numbers->begin(), numbers->end());
    }
  }
  return blocks;
}

// Decoded images are registered to the colour camera; raw images are in the pixels of the depth camera. This was
// measured: with these assumptions, neighbouring frames agree to 3 mm and 4 mm, otherwise only to 6 mm.
DepthCamera camera_of(const std::filesystem::path& file, const Blocks& blocks, bool registered) {
  const auto block = [&](const char* title, std::size_t size) -> const std::vector<double>& {
    const auto found = blocks.find(title);
    if (found == blocks.end() || found->second.size() != size) {
      throw std::runtime_error(file.string() + ": there is no '" + title + "' of " + std::to_string(size) +
                               " numbers");
    }
    return found->second;
  };
  const std::vector<double>& k =
      block(registered ? "Color camera intrinsic matrix" : "Depth camera intrinsic matrix", 9);
  DepthCamera camera{.fx = k[0], .fy = k[4], .cx = k[2], .cy = k[5]};
  if (!registered) {
    const auto colour_from_depth = detail::pose_of_rows(block("Depth-to-color camera extrinsic matrix", 16));
    if (!colour_from_depth) {
      throw std::runtime_error(file.string() + ": the 'Depth-to-color camera extrinsic matrix' is not rigid");
    }
    camera.posed_from_depth = *colour_from_depth;
  }
  camera.min_range_m = 0.2;  // reliable range of a RealSense F200
  camera.max_range_m = 1.2;
  return camera;
}

}  // namespace

Recording open_apc(RecordingReader reader) {
  const std::filesystem::path info = reader.folder() / "cam.info.txt";
  const Blocks blocks = blocks_in(info);
  std::vector<std::filesystem::path> files = files_ending(reader.folder() / "decoded", kDecoded);
  const bool decoded = !files.empty();
  for (const char* sub : {"raw", "."}) {
    files = files.empty() ? files_ending(reader.folder() / sub, kRaw) : files;
  }
  for (const std::filesystem::path& depth : files) {
    const std::string name = name_without(depth, decoded ? kDecoded : kRaw);
    const auto rows = blocks.find(kPoseTitle + name);
    const std::optional<Pose> pose = rows == blocks.end() ? std::nullopt : detail::pose_of_rows(rows->second);
    if (!pose) {
      reader.skip(name, rows == blocks.end() ? "cam.info.txt has no pose for it" : "its pose is not rigid");
      continue;
    }
    const std::filesystem::path colour = reader.folder() / (name + ".color.png");
    reader.add({.name = name,
                .world_from_posed = *pose,
                .depth = depth,
                .colour = std::filesystem::exists(colour) ? colour : std::filesystem::path()});
  }
  // The unit is 0.1 mm. The driver writes raw values rotated by three bits.
  reader.read_depth_png_as({.units_per_m = 10000.0, .rotated_bits = decoded ? 0 : 3});
  return reader.finish(camera_of(info, blocks, decoded), info);
}

}  // namespace vantage
