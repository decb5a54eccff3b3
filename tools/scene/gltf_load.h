// glTF/GLB -> Scene, through tinygltf. Everything indexed is checked; nothing is silently dropped (Scene::notes).
#pragma once

#include "scene/scene.h"

#include <filesystem>

namespace rigel::tools {

/// Loads .gltf or .glb (by content). The Error's place is "file: JSON path" and its message one line. A file without
/// triangles loads, with a note: what asks for something to light refuses it.
Result<Scene> loadGltf(const std::filesystem::path& file);

/// The same from a whole .gltf or .glb in memory, which may refer to no files.
Result<Scene> loadGltfFromMemory(std::string bytes, const std::string& name);

/// A file, or a built-in scene where `source` is "sample:NAME".
Result<Scene> loadScene(const std::string& source);

}  // namespace rigel::tools
