// Scene -> .glb (or .gltf with embedded buffers, by extension), light data and extras included; loadGltf reads it back.
#pragma once

#include "scene/scene.h"

#include <filesystem>

namespace rigel::tools {

/// Written aside and renamed, so that a failure leaves nothing behind. On success returns the bytes written.
Result<std::size_t> saveGltf(const Scene& scene, const std::filesystem::path& file);

}  // namespace rigel::tools
