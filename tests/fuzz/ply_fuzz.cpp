// SPDX-License-Identifier: MIT
#include <cstdlib>
#include <stdexcept>
#include <vantage/sim/mesh_file.hpp>

#include "fuzz_target.hpp"
#include "input_file.hpp"

namespace {

std::string binary_ply() {
  std::string text =
      "ply\nformat binary_little_endian 1.0\ncomment a triangle\nelement vertex 3\nproperty float x\n"
      "property float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  for (const float value : {0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F}) {
    text.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  text.push_back('\3');
  for (const std::int32_t corner : {0, 1, 2}) {
    text.append(reinterpret_cast<const char*>(&corner), sizeof corner);
  }
  return text;
}

}  // namespace

std::vector<std::string> vantage::fuzz::seeds() {
  return {binary_ply(),
          "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
          "property uchar red\nelement face 2\nproperty list uchar int vertex_index\nend_header\n"
          "0 0 0 1\n1 0 0 2\n1 1 0 3\n0 1 0.5 4\n3 0 1 2\n4 0 1 2 3\n",
          "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
          "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
          "0 0 0\n1 0 0\n0 1 0\n1 1 0\n5 0 1 2 3 -1\n"};
}

// Assimp loses a few vectors of some files that it refuses.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libassimp"; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const vantage::fuzz::InputFile file(data, size, ".ply");
  try {
    const vantage::TriangleMesh mesh = vantage::read_mesh_file(file.path());
    for (const auto& triangle : mesh.triangles) {
      for (const std::uint32_t corner : triangle) {
        if (corner >= mesh.vertices.size() || !mesh.vertices[corner].allFinite()) {
          std::abort();
        }
      }
    }
  } catch (const std::runtime_error&) {  // documented
  }
  return 0;
}
