#include "scene/gltf_load.h"

#include "scene/gltf_import.h"
#include "scene/transform.h"

#include <algorithm>

namespace rigel::tools {
namespace {

// Nodes may show one mesh many times: what counts is what findObjects will lay out.
constexpr std::size_t kMaxSceneVertices = 25'000'000;
constexpr std::size_t kMaxNotes = 200;

void refuseAbsurdAndNoteEmpty(GltfImport& import) {
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
  if (triangles == 0) import.note("no mesh of triangles: there is nothing to light");
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

// Some files give one reason thousands of times.
void shorten(std::vector<std::string>& notes) {
  if (notes.size() <= kMaxNotes) return;
  const std::size_t more = notes.size() - kMaxNotes;
  notes.resize(kMaxNotes);
  notes.push_back(fmt::format("and {} more notes", more));
}

// extras.rigel.settings, whatever it says: its reader is who runs the scene.
void importSettings(GltfImport& import) {
  JsonPlace place = import.document.root();
  for (const char* key : {"extras", "rigel", "settings"}) {
    const auto found = place.find(key);
    if (!found) return;
    if (!found->value().is_object()) {
      if (std::string_view(key) == "extras") return;  // free-form in glTF
      found->fail("must be an object, is {}", found->value().type_name());
    }
    place = *found;
  }
  import.scene.settings = place.value().dump();
}

Scene importScene(const GltfDocument& document) {
  GltfImport import(document);
  importExtensions(import);
  importMaterials(import);
  importLights(import);
  importMeshes(import);
  importNodes(import);
  importSkins(import);
  importAnimations(import);
  importSettings(import);
  refuseStrayJoints(import);
  dropStrayVertices(import.scene);
  refuseAbsurdAndNoteEmpty(import);
  shorten(import.scene.notes);
  return std::move(import.scene);
}

// `read` gives the document; whatever goes wrong becomes an Error of one line that begins with `source`.
template <class Read>
Result<Scene> load(const std::string& source, const std::string& name, Read&& read) {
  try {
    Scene scene = importScene(read());
    scene.name = name;
    return scene;
  } catch (const LoadError& error) {
    return Error{error.message, error.place.empty() ? source : source + ": " + error.place};
  } catch (const std::exception& error) {
    std::string message = error.what();
    std::ranges::replace(message, '\n', ' ');
    return Error{"cannot be read (" + message + ")", source};
  }
}

}  // namespace

Result<Scene> loadGltf(const std::filesystem::path& file) {
  return load(file.string(), file.filename().string(), [&] {
    return readGltfDocument(readWholeFile(file, ""), {file.parent_path(), true});
  });
}

Result<Scene> loadGltfFromMemory(std::string bytes, const std::string& name) {
  return load(name, name, [&] { return readGltfDocument(std::move(bytes), {{}, false}); });
}

}  // namespace rigel::tools
