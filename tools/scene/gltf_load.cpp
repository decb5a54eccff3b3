#include "scene/gltf_load.h"

#include "scene/gltf_import.h"
#include "scene/transform.h"

#include <algorithm>

namespace rigel::tools {
namespace {

// Nodes may show one mesh many times: what counts is what findObjects will lay out.
constexpr std::size_t kMaxSceneVertices = 100'000'000;

void refuseEmptyOrAbsurd(const GltfImport& import) {
  const Scene& scene = import.scene;
  const std::vector<bool> inScene = nodesInScene(scene);
  std::size_t triangles = 0, vertices = 0;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    if (!inScene[i] || scene.nodes[i].mesh < 0) continue;
    for (const Primitive& primitive : scene.meshes[scene.nodes[i].mesh].primitives) {
      triangles += primitive.triangles.size();
      vertices += std::max(primitive.positions.size(), primitive.triangles.size());
    }
  }
  if (triangles == 0) import.document.root().fail("no mesh: nothing to light");
  if (vertices > kMaxSceneVertices) {
    import.document.root().fail("its nodes show {} vertices, more than {}", vertices, kMaxSceneVertices);
  }
}

// A skinned mesh whose joints are outside the scene would stand still wherever its bones happen to be.
void refuseStrayJoints(const GltfImport& import) {
  const Scene& scene = import.scene;
  const std::vector<bool> inScene = nodesInScene(scene);
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    if (!inScene[i] || node.skin < 0) continue;
    for (const int joint : scene.skins[node.skin].joints) {
      if (!inScene[joint]) {
        import.document.root().items("nodes")[i].fail("joint node {} of skin {} is not in the scene", joint, node.skin);
      }
    }
  }
}

}  // namespace

Result<Scene> loadGltf(const std::filesystem::path& file) {
  try {
    const GltfDocument document = readGltfDocument(file);
    GltfImport import(document);
    importExtensions(import);
    importMaterials(import);
    importLights(import);
    importMeshes(import);
    importNodes(import);
    importSkins(import);
    importAnimations(import);
    refuseStrayJoints(import);
    dropStrayVertices(import.scene);
    refuseEmptyOrAbsurd(import);
    import.scene.name = file.filename().string();
    return std::move(import.scene);
  } catch (const LoadError& error) {
    return Error{error.message, error.place.empty() ? file.string() : file.string() + ": " + error.place};
  } catch (const std::exception& error) {
    std::string message = error.what();
    std::ranges::replace(message, '\n', ' ');
    return Error{"cannot be read (" + message + ")", file.string()};
  }
}

}  // namespace rigel::tools
