// SPDX-License-Identifier: MIT
// KITTI odometry sequences (Geiger et al. 2012): rectified stereo pairs from a car, with poses from laser and GPS.
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vantage/vision/stereo_matcher.hpp>

#include "vision/pose_text.hpp"
#include "vision/recording_reader.hpp"

namespace vantage {
namespace {

struct ImageFolders {
  std::filesystem::path left;
  std::filesystem::path right;
  std::size_t left_camera = 0;  // its number in the calibration
};

ImageFolders image_folders(const std::filesystem::path& folder) {
  for (const auto& [left, right, camera] :
       {std::tuple("image_l", "image_r", 0U), std::tuple("image_0", "image_1", 0U),
        std::tuple("image_2", "image_3", 2U)}) {
    if (std::filesystem::is_directory(folder / left) && std::filesystem::is_directory(folder / right)) {
      return {folder / left, folder / right, camera};
    }
  }
  throw std::runtime_error(folder.string() +
                           ": there are no folders image_l and image_r, image_0 and image_1, or "
                           "image_2 and image_3");
}

std::vector<std::optional<Pose>> poses_in(const std::filesystem::path& file) {
  std::vector<std::optional<Pose>> poses;
  for (const detail::TextLine& line : detail::lines_of(file)) {
    const auto numbers = detail::numbers_in(line.text);
    poses.push_back(numbers && numbers->size() == 12 ? detail::pose_of_rows(*numbers) : std::nullopt);
  }
  return poses;
}

// The images of a folder by name without ending: the order of the poses. A name with both endings counts once.
std::map<std::string, std::filesystem::path> images_in(const std::filesystem::path& folder, RecordingReader& reader) {
  std::map<std::string, std::filesystem::path> images;
  for (const char* ending : {".png", ".jpg"}) {
    for (const std::filesystem::path& file : files_ending(folder, ending)) {
      const std::string name = name_without(file, ending);
      const auto [known, is_new] = images.try_emplace(name, file);
      if (!is_new) {
        reader.skip(file.filename().string(),
                    "there is also " + known->second.filename().string() + ", which is read");
      }
    }
  }
  return images;
}

}  // namespace

Recording open_kitti_stereo(RecordingReader reader) {
  const auto [left, right, left_camera] = image_folders(reader.folder());
  const auto poses = poses_in(reader.folder() / "poses.txt");
  const auto matcher =
      std::make_shared<const StereoMatcher>(read_kitti_calibration(reader.folder() / "calib.txt", left_camera),
                                            reader.options().stereo.value_or(StereoOptions{}));
  std::size_t row = 0;
  for (const auto& [name, file] : images_in(left, reader)) {
    const std::size_t number = row++;
    if (number >= poses.size()) {
      reader.skip(name, "poses.txt ends after " + std::to_string(poses.size()) + " poses");
    } else if (!poses[number]) {
      reader.skip(name, "row " + std::to_string(number + 1) + " of poses.txt is not a rigid transform of 12 numbers");
    } else if (!std::filesystem::exists(right / file.filename())) {
      reader.skip(name, "there is no " + (right / file.filename()).string());
    } else {
      reader.add({.name = name,
                  .world_from_posed = *poses[number],
                  .depth = file,
                  .right = right / file.filename(),
                  .colour = file});
    }
  }
  reader.read_depth_by(
      [matcher](const RecordedFrame& frame) { return matcher->match(frame.depth, frame.right).depth; });
  reader.set_up("-y");
  return reader.finish(matcher->camera(reader.options().cell_m), reader.folder() / "calib.txt");
}

}  // namespace vantage
