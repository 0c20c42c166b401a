// SPDX-License-Identifier: MIT
// TUM RGB-D benchmark folders (Sturm et al. 2012): lists of time-stamped files and poses.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "vision/pose_text.hpp"
#include "vision/recording_reader.hpp"

namespace vantage {
namespace {

struct StampedFile {
  double stamp_s = 0.0;
  std::string stamp;  // as written in the file
  std::filesystem::path file;
};

struct StampedPose {
  double stamp_s = 0.0;
  Pose pose = Pose::Identity();
};

[[noreturn]] void refuse(const std::filesystem::path& file, const detail::TextLine& line, const char* rule) {
  throw std::runtime_error(file.string() + ": line " + std::to_string(line.number) + " '" + line.text + "' must be " +
                           rule);
}

std::vector<StampedFile> files_in(const std::filesystem::path& list) {
  std::vector<StampedFile> files;
  for (const detail::TextLine& line : detail::lines_of(list)) {
    const std::size_t start = line.text.find_first_not_of(" \t");
    const std::size_t blank = line.text.find_first_of(" \t", start);
    const std::size_t name = blank == std::string::npos ? blank : line.text.find_first_not_of(" \t\r", blank);
    const auto stamp = detail::numbers_in(std::string_view(line.text).substr(0, blank));
    if (name == std::string::npos || !stamp || stamp->size() != 1 || !std::isfinite(stamp->front())) {
      refuse(list, line, "a time stamp and a file");
    }
    const std::size_t end = line.text.find_last_not_of(" \t\r");
    files.push_back({stamp->front(), line.text.substr(start, blank - start),
                     list.parent_path() / line.text.substr(name, end + 1 - name)});
  }
  std::stable_sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.stamp_s < b.stamp_s; });
  return files;
}

std::vector<StampedPose> poses_in(const std::filesystem::path& list, RecordingReader& reader) {
  std::vector<StampedPose> poses;
  for (const detail::TextLine& line : detail::lines_of(list)) {
    const auto numbers = detail::numbers_in(line.text);
    const bool is_row = numbers && numbers->size() == 8 && std::isfinite(numbers->front());
    bool was_off = false;
    const auto pose =
        is_row ? detail::pose_of_quaternion(Eigen::Matrix<double, 7, 1>(numbers->data() + 1), was_off) : std::nullopt;
    if (!pose) {
      reader.skip("line " + std::to_string(line.number) + " of " + list.filename().string(),
                  is_row ? "its numbers are not a pose" : "it is not a time stamp and tx ty tz qx qy qz qw");
      continue;
    }
    if (was_off) {
      reader.count_normalised();
    }
    poses.push_back({numbers->front(), *pose});
  }
  std::stable_sort(poses.begin(), poses.end(), [](const auto& a, const auto& b) { return a.stamp_s < b.stamp_s; });
  return poses;
}

// The entry of `stamped`, which is sorted by time, nearest to a time; null if it is more than `most_s` away.
template <class Stamped>
const Stamped* nearest(const std::vector<Stamped>& stamped, double stamp_s, double most_s) {
  const auto after = std::lower_bound(stamped.begin(), stamped.end(), stamp_s,
                                      [](const Stamped& entry, double stamp) { return entry.stamp_s < stamp; });
  const Stamped* best = nullptr;
  for (auto at = after == stamped.begin() ? after : after - 1; at != stamped.end() && at <= after; ++at) {
    const double gap_s = std::abs(at->stamp_s - stamp_s);
    if (gap_s <= most_s && (best == nullptr || gap_s < std::abs(best->stamp_s - stamp_s))) {
      best = &*at;
    }
  }
  return best;
}

}  // namespace

Recording open_tum(RecordingReader reader) {
  const std::filesystem::path& folder = reader.folder();
  const double most_s = reader.options().max_stamp_gap_s;
  const std::vector<StampedPose> poses = poses_in(folder / "groundtruth.txt", reader);
  const std::vector<StampedFile> pictures =
      std::filesystem::exists(folder / "rgb.txt") ? files_in(folder / "rgb.txt") : std::vector<StampedFile>{};
  for (const StampedFile& depth : files_in(folder / "depth.txt")) {
    const StampedPose* pose = nearest(poses, depth.stamp_s, most_s);
    if (pose == nullptr) {
      reader.skip(depth.stamp, "groundtruth.txt has no pose within " + std::to_string(most_s) + " s");
    } else if (!std::filesystem::exists(depth.file)) {
      reader.skip(depth.stamp, "there is no file " + depth.file.string());
    } else {
      const StampedFile* picture = nearest(pictures, depth.stamp_s, most_s);
      reader.add({.name = depth.stamp,
                  .world_from_posed = pose->pose,
                  .depth = depth.file,
                  .colour = picture == nullptr ? std::filesystem::path() : picture->file});
    }
  }
  reader.read_depth_png_as({.units_per_m = 5000.0});
  // The intrinsics that the benchmark recommends for its registered depth images.
  return reader.finish({.fx = 525.0, .fy = 525.0, .cx = 319.5, .cy = 239.5, .min_range_m = 0.4, .max_range_m = 4.0},
                       folder);
}

}  // namespace vantage
