// SPDX-License-Identifier: MIT
// A recording of any format: the first line names it, its files follow (input_folder.hpp).
#include <zlib.h>

#include <cstdlib>
#include <stdexcept>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/vision/recording.hpp>

#include "fuzz_target.hpp"
#include "input_folder.hpp"

namespace {

std::string big_endian(std::size_t number) {
  std::string bytes;
  for (unsigned shift = 32; shift > 0;) {
    shift -= 8;
    bytes.push_back(static_cast<char>(number >> shift & 0xFFU));
  }
  return bytes;
}

std::string chunk(const std::string& content) {
  return big_endian(content.size() - 4) + content +
         big_endian(::crc32(0, reinterpret_cast<const Bytef*>(content.data()), static_cast<uInt>(content.size())));
}

// A grey PNG of 16 x 12 pixels with stripes.
std::string png(char bits) {
  std::string rows;
  for (int v = 0; v < 12; ++v) {
    rows.push_back('\0');
    for (int u = 0; u < (bits == 16 ? 32 : 16); ++u) {
      rows.push_back(static_cast<char>(bits == 16 && u % 2 == 0 ? 9 : 40 * (u % 5) + v));
    }
  }
  std::string packed(::compressBound(rows.size()), '\0');
  uLongf size = packed.size();
  ::compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(rows.data()),
             rows.size());
  packed.resize(size);
  const std::string header = big_endian(16) + big_endian(12) + bits + std::string(4, '\0');
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR" + header) + chunk("IDAT" + packed) + chunk("IEND");
}

}  // namespace

std::vector<std::string> vantage::fuzz::seeds() {
  const std::string here = "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
  const std::string plate =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
      "property float z\nend_header\n0 0.1 0\n0.01 0.1 0\n";
  const std::string camera = "1 0 0 0 0 1 0 0 0 0 1 0\n";
  return {"7scenes\n@@ a.depth.png\n" + png(16) + "@@ a.pose.txt\n" + here + "@@ b.pose.txt\n" + here +
              "@@ camera-intrinsics.txt\n58 0 8\n0 58 6\n0 0 1\n",
          "tum\n@@ 1.png\n" + png(16) +
              "@@ depth.txt\n# maps\n1.000 1.png\n2.0 1.png\n@@ rgb.txt\n1.01 1.png\n@@ groundtruth.txt\n"
              "1.001 1 2 3 0 0 0 2\n2.0 0 0 nan 0 0 0 1\n",
          "apc\n@@ raw/f0.depth.png\n" + png(16) +
              "@@ cam.info.txt\n# Depth camera intrinsic matrix\n50 0 8\n0 50 6\n0 0 1\n"
              "# Depth-to-color camera extrinsic matrix\n" +
              here + "# Camera-to-world extrinsic matrix (camera pose) for f0\n" + here,
          "kitti-stereo\n@@ image_0/0.png\n" + png(8) + "@@ image_1/0.png\n" + png(8) +
              "@@ calib.txt\nP0: 20 0 8 0 0 20 6 0 0 0 1 0\nP1: 20 0 8 -2 0 20 6 0 0 0 1 0\n@@ poses.txt\n" + camera,
          "stanford\n@@ a.ply\n" + plate + "@@ a.conf\ncamera 0 0 -1 0 0 0 1\nbmesh a.ply 0 0 0 0 0 0 1\n"};
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const std::size_t line = std::min(input.find('\n'), input.size());
  const vantage::fuzz::InputFolder folder(input.substr(std::min(line + 1, input.size())));
  try {
    const auto recording = vantage::Recording::open(input.substr(0, line), folder.path());
    for (std::size_t frame = 0; frame < recording.frames().size(); ++frame) {
      try {
        const vantage::RecordedReading reading = recording.read(frame);
        if (!vantage::is_rigid(recording.pose(frame)) ||
            reading.depth.z_m.size() != reading.depth.width * reading.depth.height) {
          std::abort();
        }
        vantage::OccupancyMap map({.resolution_m = 0.1, .max_bytes = 1'000'000});
        map.insert(reading.scan.scan);
      } catch (const std::runtime_error&) {  // documented: this frame is damaged
      }
    }
  } catch (const std::runtime_error&) {     // documented
  } catch (const std::invalid_argument&) {  // documented: no such format
  }
  return 0;
}
