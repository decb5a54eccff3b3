// Small glTF documents made for one test each, and scenes made in memory.
#pragma once

#include "scene/gltf_load.h"
#include "support/temporary_folder.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace rigel::tools::test {

using rigel::test::TemporaryFolder;
using rigel::test::writeFile;

/// A glTF document whose arrays are added to one embedded buffer. `json` may be changed freely before `write`.
class GltfMaker {
 public:
  nlohmann::json json = {{"asset", {{"version", "2.0"}}}};

  /// Index of a new accessor over `values`. Component types as glTF numbers them.
  template <class T>
  int add(const std::vector<T>& values, int componentType, const std::string& type, std::size_t count,
          bool normalized = false) {
    return addBytes(values.data(), values.size() * sizeof(T), componentType, type, count, normalized);
  }
  int addFloats(const std::vector<float>& values, const std::string& type);

  /// One node with a mesh of one triangle (0,0,0) (1,0,0) (0,1,0) in scene 0: the smallest valid document.
  static GltfMaker triangle();

  /// The same, skinned to two joints (nodes 1 and 2, in the scene).
  static GltfMaker skinned();

  /// The buffer's content as a data URI, in the document.
  void embed();
  std::filesystem::path write(const TemporaryFolder& folder, const std::string& name = "test.gltf");
  const std::string& bytes() const { return bytes_; }

 private:
  int addBytes(const void* data, std::size_t size, int componentType, const std::string& type, std::size_t count,
               bool normalized);
  std::string bytes_;
};

/// The only primitive of the documents that GltfMaker begins with.
inline nlohmann::json& primitive(GltfMaker& g) { return g.json["meshes"][0]["primitives"][0]; }

std::string encodeBase64(const std::string& bytes);

/// A scene that uses everything the model can say: skin of 5+ influences, morphs, all interpolations, all lights.
Scene everythingScene();

/// One mesh node of the given triangles (a position for each corner), no normals.
Scene triangleScene(const std::vector<glm::vec3>& corners);

}  // namespace rigel::tools::test
