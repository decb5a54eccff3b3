// What a buffer's "uri" says: bytes in itself, a file beside the document, or something out of reach.
#pragma once

#include "scene/gltf_json.h"

#include <filesystem>

namespace rigel::tools {

/// Is it a data URI, whose bytes are in the document?
bool isDataUri(std::string_view uri);

/// The bytes of a data URI of any media type and parameters: base64 (padding may be missing), or percent-encoded where
/// ";base64" is absent. Throws LoadError at `place` for anything else.
std::string decodeDataUri(const JsonPlace& place);

/// The file that a relative reference names: as it stands where there is such a file (exporters forget to escape), else
/// with its %XX decoded. nullopt for another scheme, such as http; throws LoadError for what is no URI at all.
std::optional<std::filesystem::path> fileOfUri(const JsonPlace& place, const std::filesystem::path& folder);

}  // namespace rigel::tools
