#include "scene/gltf_document.h"

#include <bit>
#include <cstring>
#include <fstream>
#include <system_error>

namespace rigel::tools {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxJsonDepth = 64;  // real files stay below 12; nlohmann and tinygltf recurse when they copy and free
static_assert(std::endian::native == std::endian::little, "GLB and buffer data are read as they lie in memory");

// Container: JSON text and the optional binary chunk.
struct Parts {
  std::string_view json;
  std::optional<std::string_view> chunk;
};

std::uint32_t word(std::string_view bytes, std::size_t offset) {
  std::uint32_t value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

Parts splitGlb(std::string_view bytes) {
  constexpr std::uint32_t kJson = 0x4e4f534a, kBin = 0x004e4942;
  const auto fail = [](std::string message) { throw LoadError{"", std::move(message)}; };
  if (bytes.size() < 20) fail("GLB is cut short: no room for header and JSON chunk");
  if (word(bytes, 4) == 1) fail("is glTF 1.0, which Rigel does not read: convert it to glTF 2.0");
  if (word(bytes, 4) != 2) fail(fmt::format("GLB version {} is not known (2 is)", word(bytes, 4)));
  const std::uint32_t length = word(bytes, 8);
  if (length > bytes.size()) fail(fmt::format("GLB header says {} bytes, the file has {}", length, bytes.size()));
  if (length < 20) fail(fmt::format("GLB header says {} bytes, which holds no JSON chunk", length));
  bytes = bytes.substr(0, length);  // what follows is not the GLB's

  Parts parts;
  for (std::size_t at = 12, number = 0; at < bytes.size(); ++number) {
    if (bytes.size() - at < 8) fail(fmt::format("GLB chunk {} is cut short", number));
    const std::uint32_t size = word(bytes, at), type = word(bytes, at + 4);
    at += 8;
    if (size % 4 != 0) fail(fmt::format("GLB chunk {} has {} bytes, not a multiple of 4", number, size));
    if (size > bytes.size() - at)
      fail(fmt::format("GLB chunk {} has {} bytes, {} are left", number, size, bytes.size() - at));
    const std::string_view content = bytes.substr(at, size);
    at += size;
    if ((number == 0) != (type == kJson)) fail("GLB must have exactly one JSON chunk, the first");
    if (type == kJson) parts.json = content;
    if (type == kBin) {
      if (number != 1) fail("GLB binary chunk must be the second, and the only one");
      parts.chunk = content;
    }
  }
  if (parts.json.empty()) fail("GLB JSON chunk is empty");
  return parts;
}

nlohmann::json parseJson(std::string_view text) {
  const auto limitDepth = [](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
    if (depth > kMaxJsonDepth) throw LoadError{"", fmt::format("JSON is nested deeper than {} levels", kMaxJsonDepth)};
    return true;
  };
  try {
    return nlohmann::json::parse(text, limitDepth);
  } catch (const nlohmann::json::exception& e) {
    // "[json.exception.parse_error.101] parse error at line 1, column 1: ...": the part after the tag, on one line.
    std::string message = e.what();
    if (const auto tag = message.find("] "); tag != std::string::npos) message.erase(0, tag + 2);
    for (char& c : message) c = static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    if (message.size() > 160) message = message.substr(0, 160) + "...";
    throw LoadError{"", "is not glTF: neither a GLB header nor valid JSON (" + message + ")"};
  }
}

// asset.version: 2.x only, glTF 1.0 by name.
void checkVersion(const JsonPlace& root) {
  if (!root.value().is_object()) root.fail("is not glTF: the JSON is no object");
  if (!root.has("asset")) root.fail("is not glTF: the JSON has no \"asset\"");
  const JsonPlace version = root.member("asset").member("version");
  const std::string text = version.asText();
  if (text.starts_with("1.")) root.fail("is glTF {}, which Rigel does not read: convert it to glTF 2.0", text);
  const bool wellFormed = text.size() >= 3 && text.find_first_not_of("0123456789.") == std::string::npos;
  if (!wellFormed || !text.starts_with("2.")) version.fail("glTF version \"{}\" is not known (2.0 is)", text);
  const std::string minVersion = root.member("asset").text("minVersion", "2.0");
  if (minVersion != "2.0") root.member("asset").member("minVersion").fail("needs glTF {}; Rigel reads 2.0", minVersion);
}

}  // namespace

std::string readWholeFile(const fs::path& file, const std::string& place) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) throw LoadError{place, "file does not exist"};
  if (fs::is_directory(status)) throw LoadError{place, "is a directory"};
  std::ifstream stream(file, std::ios::binary);
  const std::uintmax_t size = fs::file_size(file, error);
  if (!stream || error) throw LoadError{place, "cannot be read"};
  std::string content(size, '\0');
  stream.read(content.data(), static_cast<std::streamsize>(size));
  if (static_cast<std::uintmax_t>(stream.gcount()) != size) throw LoadError{place, "cannot be read to its end"};
  return content;
}

GltfDocument readGltfDocument(const fs::path& file) {
  const std::string content = readWholeFile(file, "");
  const Parts parts = content.starts_with("glTF") ? splitGlb(content) : Parts{content, std::nullopt};
  GltfDocument document;
  document.json = parseJson(parts.json);
  checkVersion(document.root());
  decodeBinary(document, file.parent_path(), parts.chunk);
  return document;
}

}  // namespace rigel::tools
