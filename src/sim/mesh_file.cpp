// SPDX-License-Identifier: MIT
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vantage/sim/mesh_file.hpp>
#include <vector>

#include <vantage/settings/impl/option_rule.hpp>
#include "sim/ply_check.hpp"

namespace vantage {
namespace {

constexpr std::size_t kMostVertices = std::size_t{1} << 27;  // 1.6 GB; a small file can place one part many times
constexpr unsigned kMostCorners = 1000;                      // triangulating a polygon takes quadratic time and more

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what) {
  throw std::runtime_error(path.string() + ": " + what);
}

// Checks a part of the imported scene before anything follows its indices.
void check_part(const std::filesystem::path& path, const aiMesh* part) {
  if (part == nullptr || (part->mNumVertices > 0 && part->mVertices == nullptr) ||
      (part->mNumFaces > 0 && part->mFaces == nullptr)) {
    refuse(path, "is read in part only: a part of it is missing");
  }
  for (unsigned int i = 0; i < part->mNumVertices; ++i) {
    const aiVector3D& vertex = part->mVertices[i];
    if (!std::isfinite(vertex.x) || !std::isfinite(vertex.y) || !std::isfinite(vertex.z)) {
      refuse(path, "vertex " + std::to_string(i) + " is not finite");
    }
  }
  for (unsigned int i = 0; i < part->mNumFaces; ++i) {
    const aiFace& face = part->mFaces[i];
    if (face.mNumIndices == 0) {  // Assimp ends the process if it triangulates a part with such faces alone
      refuse(path, "a face has no corner");
    }
    if (face.mNumIndices > kMostCorners) {
      refuse(path, "a face has " + std::to_string(face.mNumIndices) + " corners, must be at most " +
                       std::to_string(kMostCorners));
    }
    for (unsigned int corner = 0; corner < face.mNumIndices; ++corner) {
      if (face.mIndices[corner] >= part->mNumVertices) {
        refuse(path, "a face has a corner at vertex " + std::to_string(face.mIndices[corner]) + " of " +
                         std::to_string(part->mNumVertices));
      }
    }
  }
}

void check_scene(const std::filesystem::path& path, const aiScene& scene) {
  for (unsigned int i = 0; i < scene.mNumMeshes; ++i) {
    check_part(path, scene.mMeshes[i]);
  }
}

void add_part(const aiMesh& part, const aiMatrix4x4& file_from_part, TriangleMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (unsigned int i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D vertex = file_from_part * part.mVertices[i];
    mesh.vertices.emplace_back(vertex.x, vertex.y, vertex.z);
  }
  for (unsigned int i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    if (face.mNumIndices == 3) {
      mesh.triangles.push_back({face.mIndices[0] + first, face.mIndices[1] + first, face.mIndices[2] + first});
    }
  }
}

// Places the parts of every node by the transforms of the node and its parents, in the order of the file. Nodes
// may be nested arbitrarily deep, so they wait in a list, not on the stack.
TriangleMesh placed_parts(const std::filesystem::path& path, const aiScene& scene) {
  struct Waiting {
    const aiNode* node;
    aiMatrix4x4 file_from_parent;
  };
  TriangleMesh mesh;
  std::vector<Waiting> waiting;
  if (scene.mRootNode != nullptr) {
    waiting.push_back({scene.mRootNode, aiMatrix4x4()});
  }
  while (!waiting.empty()) {
    const Waiting at = waiting.back();
    waiting.pop_back();
    const aiMatrix4x4 file_from_node = at.file_from_parent * at.node->mTransformation;
    for (unsigned int i = 0; i < at.node->mNumMeshes; ++i) {
      if (at.node->mMeshes[i] >= scene.mNumMeshes) {
        refuse(path, "is read in part only: a part of it is missing");
      }
      const aiMesh& part = *scene.mMeshes[at.node->mMeshes[i]];
      if (mesh.vertices.size() + part.mNumVertices > kMostVertices) {
        refuse(path, "has more than " + std::to_string(kMostVertices) + " vertices");
      }
      add_part(part, file_from_node, mesh);
    }
    for (unsigned int i = at.node->mNumChildren; i-- > 0;) {
      waiting.push_back({at.node->mChildren[i], file_from_node});
    }
  }
  return mesh;
}

// The transforms of the file and the scale may make a vertex infinite.
void check_vertices(const std::filesystem::path& path, const TriangleMesh& mesh) {
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (!mesh.vertices[i].allFinite()) {
      refuse(path, "vertex " + std::to_string(i) + " is not finite");
    }
  }
}

std::string ending_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

bool is_read_with_y_up(const std::filesystem::path& path) {
  const std::string ending = ending_of(path);
  return ending == ".dae" || ending == ".zae" || ending == ".gltf" || ending == ".glb";
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::string bytes(std::istreambuf_iterator<char>(in), {});
  if (!in) {
    refuse(path, "cannot be read");
  }
  return bytes;
}

constexpr std::string_view kBlank = " \t\r\n";

// The text of an attribute of an XML tag, without quotes.
std::optional<std::string_view> attribute_in(std::string_view tag, std::string_view name) {
  for (std::size_t at = tag.find(name); at != std::string_view::npos; at = tag.find(name, at + 1)) {
    const std::size_t equals = tag.find_first_not_of(kBlank, at + name.size());
    if (equals == std::string_view::npos || tag[equals] != '=' ||
        kBlank.find(tag[at - 1]) == std::string_view::npos) {
      continue;
    }
    const std::size_t quote = tag.find_first_of("\"'", equals);
    const std::size_t end = quote == std::string_view::npos ? quote : tag.find(tag[quote], quote + 1);
    return end == std::string_view::npos ? std::nullopt : std::optional(tag.substr(quote + 1, end - quote - 1));
  }
  return std::nullopt;
}

// Removes the blanks at both ends of a part of `text`.
void trim(std::string& text, std::string_view part) {
  const std::size_t first = part.find_first_not_of(kBlank);
  if (first != std::string_view::npos) {
    const auto begin = static_cast<std::size_t>(part.data() - text.data());
    const std::size_t behind = part.find_last_not_of(kBlank) + 1;
    text.erase(begin + behind, part.size() - behind).erase(begin, first);
  }
}

// A COLLADA file without the blanks around its unit and its axis, which XML allows and Assimp does not expect.
// Assimp reads any text as some number, so the unit is checked.
std::string collada_text(const std::filesystem::path& path) {
  constexpr std::string_view kAxis = "<up_axis>";
  std::string text = bytes_of(path);
  if (text.empty()) {
    refuse(path, "is empty");
  }
  if (const std::size_t axis = text.find(kAxis); axis != std::string::npos) {
    const std::size_t begin = axis + kAxis.size();
    trim(text, std::string_view(text).substr(begin, text.find('<', begin) - begin));
  }
  const auto unit_in = [](std::string_view whole) {
    const std::size_t unit = std::min(whole.find("<unit"), whole.size());
    return attribute_in(whole.substr(unit, whole.find('>', unit) - unit), "meter");
  };
  if (const auto value = unit_in(text)) {
    trim(text, *value);
  }
  if (const auto value = unit_in(text)) {
    double metres = 0.0;
    const char* const last = value->data() + value->size();
    const auto [end, error] = std::from_chars(value->data(), last, metres);
    if (error != std::errc{} || end != last || !std::isfinite(metres) || metres <= 0.0) {
      refuse(path, "its unit is meter=\"" + std::string(*value) + "\", must be a number > 0");
    }
  }
  return text;
}

// Assimp trusts the counts and indices of a PLY file, so PLY files are checked first.
const aiScene* parsed(const std::filesystem::path& path, Assimp::Importer& importer) {
  std::array<char, 3> start{};
  std::ifstream(path, std::ios::binary).read(start.data(), start.size());
  if (ending_of(path) != ".ply" && !detail::begins_as_ply(std::string_view(start.data(), start.size()))) {
    if (ending_of(path) != ".dae") {
      return importer.ReadFile(path.string(), 0);
    }
    const std::string text = collada_text(path);
    return importer.ReadFileFromMemory(text.data(), text.size(), 0, "dae");
  }
  const std::string bytes = bytes_of(path);
  try {
    detail::check_ply(bytes);
  } catch (const std::runtime_error& error) {
    refuse(path, std::string("cannot be read as a mesh: ") + error.what());
  }
  return importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, "ply");
}

// Triangulates. Face indices are checked before, because Assimp does not check them.
const aiScene* triangulated(const std::filesystem::path& path, Assimp::Importer& importer) {
  const aiScene* scene = nullptr;
  try {
    scene = parsed(path, importer);
    if (scene != nullptr) {
      check_scene(path, *scene);
      scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
    }
  } catch (const std::bad_alloc&) {
    refuse(path, "cannot be read as a mesh: there is no memory for it");
  }
  if (scene == nullptr) {
    refuse(path, std::string("cannot be read as a mesh: ") + importer.GetErrorString());
  }
  return scene;
}

}  // namespace

TriangleMesh read_mesh_file(const std::filesystem::path& path, const MeshFileOptions& options) {
  detail::require_option(std::isfinite(options.scale) && options.scale > 0.0, "MeshFileOptions::scale", options.scale,
                         "> 0");
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    refuse(path, "there is no such file");
  }
  if (!std::filesystem::is_regular_file(path, error)) {
    refuse(path, "is not a file");
  }
  Assimp::Importer importer;
  // Assimp obeys the axis of a COLLADA file: the y axis of its scene is up.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, options.up.has_value());
  const TriangleMesh mesh = placed_parts(path, *triangulated(path, importer));
  if (mesh.triangles.empty()) {
    refuse(path, "holds no triangles");
  }
  const auto has_area = [&mesh](const auto& corners) {
    const Eigen::Vector3f& a = mesh.vertices[corners[0]];
    return (mesh.vertices[corners[1]] - a).cross(mesh.vertices[corners[2]] - a).norm() > 0.0F;
  };
  if (std::none_of(mesh.triangles.begin(), mesh.triangles.end(), has_area)) {
    refuse(path, "holds no triangle with an area");
  }
  Pose z_up = Pose::Identity();
  if (options.up ? *options.up == MeshFileOptions::Up::Y : is_read_with_y_up(path)) {
    z_up.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  }
  TriangleMesh placed;
  placed.append(mesh, z_up, options.scale);
  check_vertices(path, placed);
  return placed;
}

}  // namespace vantage
