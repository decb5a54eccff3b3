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
  /// Per buffer why it has no bytes, which glTF allows: who reads it is refused. Without a place: the end of a sentence
  /// that names the buffer.
  std::vector<std::optional<LoadError>> bufferLacks;

  JsonPlace root() const { return JsonPlace(json); }
};

/// Where a document comes from, and with it the files that its buffers may name.
struct GltfSource {
  std::filesystem::path folder;
  bool readsFiles = true;
};

/// Reads the document and everything its buffers refer to; throws LoadError. `content` is a whole .gltf or .glb.
GltfDocument readGltfDocument(std::string content, const GltfSource& source);

/// The last step of readGltfDocument: fills `binary` and `bufferLacks`. `chunk` is a GLB's binary chunk; other buffers
/// are data URIs or files relative to the source's folder. After checkLayouts.
///
/// tinygltf 2.7 decodes the binary half: buffers, views, accessors. It is handed a document of these three alone,
/// rebuilt from fields that were checked before, because it drops what it cannot read (shifting later indices),
/// recurses without bound through extras, knows few media types and throws out of its URI decoder. The graph (nodes,
/// meshes, skins, animations, lights) is read from the JSON by JsonPlace.
void decodeBinary(GltfDocument& document, const GltfSource& source, const std::optional<std::string_view>& chunk);

inline constexpr std::size_t kWholeFile = static_cast<std::size_t>(-1);

/// The bytes of a regular file, at most the first `limit`; `place` stands in the LoadError.
std::string readWholeFile(const std::filesystem::path& file, const std::string& place, std::size_t limit = kWholeFile);

}  // namespace rigel::tools
