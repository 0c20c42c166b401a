// SPDX-License-Identifier: MIT
// Range scans of the Stanford 3D Scanning Repository: points of a stationary laser scanner, and a list with the pose
// of each scan in the frame of the object.
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

#include "vision/pose_text.hpp"
#include "vision/recording_reader.hpp"

namespace vantage {
namespace {

// The rays of the scanner are nearly parallel. They are approximated by a camera at a typical distance, in front of
// the centre of the turntable. It looks along -z of the scan, whose y axis points up.
const Eigen::Vector3d kEye(0.0, 0.1, 0.7);
constexpr std::size_t kPixels = 200;
constexpr double kAngleRad = 0.35;

Pose scan_from_sensor() {
  Pose pose = Pose::Identity();
  pose.linear() << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  pose.translation() = kEye;
  return pose;
}

// Reads a file that may be compressed.
std::string unpacked_text(const std::filesystem::path& file) {
  gzFile_s* const in = gzopen(file.c_str(), "rb");
  if (in == nullptr) {
    throw std::runtime_error(file.string() + ": cannot be opened");
  }
  std::string text;
  std::array<char, 1U << 16U> buffer{};
  int count = 0;
  while ((count = gzread(in, buffer.data(), static_cast<unsigned>(buffer.size()))) > 0) {
    text.append(buffer.data(), static_cast<std::size_t>(count));
    if (text.size() > detail::kMostTextBytes) {
      gzclose(in);
      throw std::runtime_error(file.string() + ": holds more than " + std::to_string(detail::kMostTextBytes) +
                               " bytes, which no range scan does");
    }
  }
  const bool whole = gzclose(in) == Z_OK && count == 0;
  if (!whole) {
    throw std::runtime_error(file.string() + ": is cut off or damaged");
  }
  return text;
}

struct ScanHeader {
  std::size_t vertices = 0;
  std::size_t properties = 0;  // per vertex; x y z come first
};

// Throws unless the file is an ASCII PLY whose vertices start with x, y and z.
ScanHeader header_in(std::istream& in, const std::filesystem::path& file) {
  ScanHeader header;
  std::string axes;
  std::string element;
  bool text = false;
  for (std::string line; std::getline(in, line) && line.rfind("end_header", 0) != 0;) {
    std::istringstream words(line);
    std::string kind;
    std::string name;
    std::string last;
    words >> kind >> name >> last;
    text = text || (kind == "format" && name == "ascii");
    if (kind == "element") {
      element = name;
      if (name == "vertex" && !(std::istringstream(last) >> header.vertices)) {
        break;
      }
    } else if (kind == "property" && element == "vertex") {
      axes += header.properties++ < 3 ? last : "";
    }
  }
  if (!in || !text || axes != "xyz" || header.vertices == 0) {
    throw std::runtime_error(file.string() + ": is no range scan: PLY in words, its vertices by x, y and z");
  }
  return header;
}

std::vector<Eigen::Vector3f> points_in(const std::filesystem::path& file) {
  std::istringstream in(unpacked_text(file));
  const ScanHeader header = header_in(in, file);
  const Pose sensor_from_scan = scan_from_sensor().inverse();
  std::vector<Eigen::Vector3f> points;
  points.reserve(std::min<std::size_t>(header.vertices, 1U << 22U));
  std::string line;
  while (points.size() < header.vertices && std::getline(in, line)) {
    const auto numbers = detail::numbers_in(line);
    if (!numbers || numbers->size() != header.properties) {
      throw std::runtime_error(file.string() + ": vertex " + std::to_string(points.size() + 1) + " is not " +
                               std::to_string(header.properties) + " numbers");
    }
    points.emplace_back((sensor_from_scan * Eigen::Vector3d(numbers->data())).cast<float>());
  }
  if (points.size() < header.vertices) {
    throw std::runtime_error(file.string() + ": ends after " + std::to_string(points.size()) + " of " +
                             std::to_string(header.vertices) + " vertices");
  }
  return points;
}

// What the approximating camera would see; for display.
DepthImage depth_image_of(const std::vector<Eigen::Vector3f>& points, const DepthCamera& camera) {
  DepthImage image{camera.width, camera.height,
                   std::vector<float>(camera.width * camera.height, std::numeric_limits<float>::quiet_NaN())};
  for (const Eigen::Vector3f& point : points) {
    const double column = std::round(camera.cx + camera.fx * static_cast<double>(point.x() / point.z()));
    const double row = std::round(camera.cy + camera.fy * static_cast<double>(point.y() / point.z()));
    if (point.z() > 0.0F && column >= 0.0 && row >= 0.0 && column < static_cast<double>(camera.width) &&
        row < static_cast<double>(camera.height)) {
      float& pixel = image.z_m[static_cast<std::size_t>(row) * camera.width + static_cast<std::size_t>(column)];
      pixel = std::isnan(pixel) ? point.z() : std::min(pixel, point.z());
    }
  }
  return image;
}

RecordedReading reading_of(const RecordedFrame& frame, const DepthCamera& camera) {
  RecordedReading reading;
  reading.scan.scan.points = points_in(frame.depth);
  reading.scan.scan.world_from_sensor = frame.world_from_posed;
  reading.scan.scan.max_range_m = camera.max_range_m;
  reading.scan.report.used = reading.scan.scan.points.size();
  reading.depth = depth_image_of(reading.scan.scan.points, camera);
  return reading;
}

}  // namespace

Recording open_stanford(RecordingReader reader) {
  const std::vector<std::filesystem::path> lists = files_ending(reader.folder(), ".conf");
  if (lists.empty()) {
    throw std::runtime_error(reader.folder().string() + ": there is no list *.conf of its scans");
  }
  for (const detail::TextLine& line : detail::lines_of(lists.front())) {
    std::istringstream words(line.text);
    std::string kind;
    RecordedFrame frame;
    words >> kind >> frame.name;
    if (kind != "bmesh" && kind != "mesh") {
      continue;  // "camera" lines describe a viewer
    }
    const auto numbers = detail::numbers_in(line.text.substr(line.text.find(frame.name) + frame.name.size()));
    bool was_off = false;
    const auto listed = numbers && numbers->size() == 7
                            ? detail::pose_of_quaternion(Eigen::Matrix<double, 7, 1>(numbers->data()), was_off)
                            : std::nullopt;
    frame.depth = reader.folder() / frame.name;
    if (!std::filesystem::exists(frame.depth)) {
      frame.depth += ".gz";
    }
    if (!listed || !std::filesystem::exists(frame.depth)) {
      reader.skip(frame.name, !listed ? "line " + std::to_string(line.number) + " of " +
                                            lists.front().filename().string() + " has no pose"
                                      : "there is no " + frame.name + " or " + frame.name + ".gz");
      continue;
    }
    if (was_off) {
      reader.count_normalised();
    }
    // The quaternions of the list rotate from the object frame to the scan frame, but its translations lead from scan
    // to object.
    Pose object_from_scan = *listed;
    object_from_scan.linear() = listed->linear().transpose();
    frame.world_from_posed = object_from_scan * scan_from_sensor();
    reader.add(std::move(frame));
  }
  reader.set_up("y");
  reader.read_by(reading_of);
  const double focal = 0.5 * static_cast<double>(kPixels) / std::tan(0.5 * kAngleRad);
  const double middle = 0.5 * static_cast<double>(kPixels - 1);
  return reader.finish({.width = kPixels,
                        .height = kPixels,
                        .fx = focal,
                        .fy = focal,
                        .cx = middle,
                        .cy = middle,
                        .min_range_m = 0.1,
                        .max_range_m = 0.9},
                       lists.front(), true);
}

}  // namespace vantage
