// glTF/GLB -> Scene, through tinygltf. Everything indexed is checked; nothing is silently dropped (Scene::notes).
#pragma once

#include "scene/scene.h"

#include <filesystem>

namespace rigel::tools {

/// Loads .gltf or .glb (by content). The Error's place is "file: JSON path" and its message one line.
Result<Scene> loadGltf(const std::filesystem::path& file);

/// A file, or a built-in scene where `source` is "sample:NAME".
Result<Scene> loadScene(const std::string& source);

}  // namespace rigel::tools
