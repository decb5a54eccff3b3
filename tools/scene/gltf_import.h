// The steps of loadGltf, in the order in which it takes them. Each reads one part of the document, checks it, adds it
// to the scene and throws LoadError.
#pragma once

#include "scene/gltf_accessor.h"
#include "scene/scene.h"

namespace rigel::tools {

struct GltfImport {
  const GltfDocument& document;
  AccessorReader accessors;
  Scene scene;
  std::vector<int> punctualLight;  // per KHR_lights_punctual light: its index in scene.lights
  std::vector<int> areaLight;      // per EXT_lights_area light likewise, -1 where ignored

  explicit GltfImport(const GltfDocument& from) : document(from), accessors(from) {}

  template <class... Args>
  void note(fmt::format_string<Args...> text, Args&&... args) {
    scene.notes.push_back(fmt::format(text, std::forward<Args>(args)...));
  }
};

void importExtensions(GltfImport& import);  // refuses required ones that are not known, notes unused ones
void importMaterials(GltfImport& import);
void importLights(GltfImport& import);
void importMeshes(GltfImport& import);
void importNodes(GltfImport& import);  // hierarchy, the scene's roots, references to meshes, skins, lights
void importSkins(GltfImport& import);
void importAnimations(GltfImport& import);

/// Removes what no triangle refers to from every array of every primitive; the others keep their order. After the
/// checks above, whose messages number vertices as the file does.
void dropStrayVertices(Scene& scene);

/// A name made printable (files may hold line breaks in them), or `otherwise`.
std::string readName(const JsonPlace& thing, std::string otherwise = "");

}  // namespace rigel::tools
