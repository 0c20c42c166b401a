// SPDX-License-Identifier: MIT
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vantage/sim/mesh_file.hpp>

#include "map/option_rule.hpp"

namespace vantage {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what) {
  throw std::runtime_error(path.string() + ": " + what);
}

void add_mesh(const aiMesh& part, const aiMatrix4x4& file_from_part, TriangleMesh& mesh) {
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

void add_node(const aiScene& scene, const aiNode& node, const aiMatrix4x4& file_from_parent, TriangleMesh& mesh) {
  const aiMatrix4x4 file_from_node = file_from_parent * node.mTransformation;
  for (unsigned int i = 0; i < node.mNumMeshes; ++i) {
    add_mesh(*scene.mMeshes[node.mMeshes[i]], file_from_node, mesh);
  }
  for (unsigned int i = 0; i < node.mNumChildren; ++i) {
    add_node(scene, *node.mChildren[i], file_from_node, mesh);
  }
}

void check_vertices(const std::filesystem::path& path, const TriangleMesh& mesh) {
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (!mesh.vertices[i].allFinite()) {
      refuse(path, "vertex " + std::to_string(i) + " is not finite");
    }
  }
}

bool is_read_with_y_up(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".dae" || extension == ".zae" || extension == ".gltf" || extension == ".glb";
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
  // What a COLLADA file says of its axis, Assimp obeys: the scene's y is up.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, options.up.has_value());
  const aiScene* scene = importer.ReadFile(path.string(), aiProcess_Triangulate);
  if (scene == nullptr) {
    refuse(path, std::string("cannot be read as a mesh: ") + importer.GetErrorString());
  }
  TriangleMesh mesh;
  if (scene->mRootNode != nullptr) {
    add_node(*scene, *scene->mRootNode, aiMatrix4x4(), mesh);
  }
  if (mesh.triangles.empty()) {
    refuse(path, "holds no triangles");
  }
  check_vertices(path, mesh);
  Pose z_up = Pose::Identity();
  if (options.up ? *options.up == MeshFileOptions::Up::Y : is_read_with_y_up(path)) {
    z_up.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  }
  TriangleMesh placed;
  placed.append(mesh, z_up, options.scale);
  return placed;
}

}  // namespace vantage
