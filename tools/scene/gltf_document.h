// The file as such: container, JSON, buffers. Nothing of glTF's meaning yet.
#pragma once

#include "scene/gltf_json.h"

#include <filesystem>
#include <memory>
#include <vector>

namespace tinygltf {
class Model;
}

namespace rigel::tools {

struct GltfDocument {
  nlohmann::json json;
  std::shared_ptr<const tinygltf::Model> binary;  // buffers, bufferViews, accessors and nothing else
  std::vector<bool> bufferHasData;                // glTF allows buffers without; who reads one is refused

  JsonPlace root() const { return JsonPlace(json); }
};

/// Reads the file and everything its buffers refer to; throws LoadError.
GltfDocument readGltfDocument(const std::filesystem::path& file);

/// The second step of readGltfDocument: fills `binary` and `bufferHasData`. `chunk` is a GLB's binary chunk; other
/// buffers are base64 or files relative to `folder`.
///
/// tinygltf 2.7 decodes the binary half: buffers (external, base64, GLB chunk), views, accessors. It is handed a
/// document of these three alone, rebuilt from fields that were checked before, because it drops what it cannot read
/// (shifting later indices), recurses without bound through extras and throws out of its URI decoder. The graph (nodes,
/// meshes, skins, animations, lights) is read from the JSON by JsonPlace.
void decodeBinary(GltfDocument& document, const std::filesystem::path& folder,
                  const std::optional<std::string_view>& chunk);

/// The bytes of a file; `place` stands in the LoadError.
std::string readWholeFile(const std::filesystem::path& file, const std::string& place);

}  // namespace rigel::tools
