#include "scene/gltf_document.h"
#include "scene/gltf_layout.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <fstream>
#include <system_error>

namespace rigel::tools {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxFileBytes = (std::size_t{1} << 30) + (std::size_t{1} << 28);  // buffers of 1 GiB, and JSON
constexpr int kMaxJsonDepth = 64;  // real files stay below 12; nlohmann and tinygltf recurse when they copy and free
constexpr std::size_t kMaxJsonStructures = std::size_t{1} << 22;  // real files stay below a tenth
constexpr std::size_t kMaxJsonValues = std::size_t{1} << 25;
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

// The first of two readings of the text: its size before anything is built of it. A few bytes of text become a value of
// 16, an object or array of a hundred, and what we make of it several hundred. (A callback during the second would do
// the same, but nlohmann 3.11 then takes a time that grows with the square of an array's length.)
class SizeLimit {
 public:
  bool null() { return value(); }
  bool boolean(bool) { return value(); }
  bool number_integer(std::int64_t) { return value(); }
  bool number_unsigned(std::uint64_t) { return value(); }
  bool number_float(double, const std::string&) { return value(); }
  bool string(std::string&) { return value(); }
  bool binary(nlohmann::json::binary_t&) { return value(); }
  bool key(std::string&) { return true; }
  bool start_object(std::size_t) { return start(); }
  bool start_array(std::size_t) { return start(); }
  bool end_object() { return end(); }
  bool end_array() { return end(); }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception& error) {
    // "[json.exception.parse_error.101] parse error at line 1, column 1: ...": the part after the tag, on one line.
    std::string message = error.what();
    if (const auto tag = message.find("] "); tag != std::string::npos) message.erase(0, tag + 2);
    for (char& c : message) c = static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    if (message.size() > 160) message = message.substr(0, 160) + "...";
    throw LoadError{"", "is not glTF: neither a GLB header nor valid JSON (" + message + ")"};
  }

 private:
  bool value() {
    if (++values_ > kMaxJsonValues) throw LoadError{"", fmt::format("JSON has more than {} values", kMaxJsonValues)};
    return true;
  }
  bool start() {
    if (++depth_ > kMaxJsonDepth)
      throw LoadError{"", fmt::format("JSON is nested deeper than {} levels", kMaxJsonDepth)};
    if (++structures_ > kMaxJsonStructures)
      throw LoadError{"", fmt::format("JSON has more than {} objects and arrays", kMaxJsonStructures)};
    return true;
  }
  bool end() {
    --depth_;
    return true;
  }
  int depth_ = 0;
  std::size_t structures_ = 0, values_ = 0;
};

nlohmann::json parseJson(std::string_view text) {
  // Pictures, archives and other formats: a parser's view of their first byte helps nobody.
  const auto first = text.substr(0, 3) == "\xef\xbb\xbf" ? 3 : 0;  // byte order mark
  const auto start = text.find_first_not_of(" \t\r\n", first);
  if (start == std::string_view::npos || (text[start] != '{' && text[start] != '['))
    throw LoadError{"", "is not glTF: begins with neither a GLB header nor JSON"};
  SizeLimit limit;
  nlohmann::json::sax_parse(text, &limit);
  return nlohmann::json::parse(text);
}

// glTF 1.0 keeps things by name, in objects.
bool looksLikeGltf1(const JsonPlace& root) {
  constexpr const char* kLists[] = {"meshes", "nodes", "accessors", "buffers"};
  return std::ranges::any_of(kLists, [&](const char* list) {
    const auto found = root.find(list);
    return found && found->value().is_object();
  });
}

// asset.version: 2.x only, glTF 1.0 by name.
void checkVersion(const JsonPlace& root) {
  if (!root.value().is_object()) root.fail("is not glTF: the JSON is no object");
  if (!root.has("asset")) {
    if (looksLikeGltf1(root)) root.fail("is glTF 1.0, which Rigel does not read: convert it to glTF 2.0");
    root.fail("is not glTF: the JSON has no \"asset\"");
  }
  const JsonPlace version = root.member("asset").member("version");
  if (version.value().is_number() && looksLikeGltf1(root))
    root.fail("is glTF {:g}, which Rigel does not read: convert it to glTF 2.0", version.asNumber());
  const std::string text = version.asText();
  if (text.starts_with("1.") || text.starts_with("0."))
    root.fail("is glTF {}, which Rigel does not read: convert it to glTF 2.0", text);
  const bool wellFormed = text.size() >= 3 && text.find_first_not_of("0123456789.") == std::string::npos;
  if (!wellFormed || !text.starts_with("2.")) version.fail("glTF version \"{}\" is not known (2.0 is)", text);
  const std::string minVersion = root.member("asset").text("minVersion", "2.0");
  if (minVersion != "2.0") root.member("asset").member("minVersion").fail("needs glTF {}; Rigel reads 2.0", minVersion);
}

}  // namespace

std::string readWholeFile(const fs::path& file, const std::string& place, std::size_t limit) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) throw LoadError{place, "file does not exist"};
  if (fs::is_directory(status)) throw LoadError{place, "is a directory"};
  if (!fs::is_regular_file(status)) throw LoadError{place, "is no regular file"};  // pipes and devices may never end
  std::ifstream stream(file, std::ios::binary);
  const std::uintmax_t whole = fs::file_size(file, error);
  if (!stream || error) throw LoadError{place, "cannot be read"};
  const auto size = static_cast<std::size_t>(std::min<std::uintmax_t>(whole, limit));
  if (size > kMaxFileBytes) throw LoadError{place, fmt::format("has {} bytes, more than {}", size, kMaxFileBytes)};
  std::string content(size, '\0');
  stream.read(content.data(), static_cast<std::streamsize>(size));
  if (static_cast<std::size_t>(stream.gcount()) != size) throw LoadError{place, "cannot be read to its end"};
  return content;
}

GltfDocument readGltfDocument(std::string content, const GltfSource& source) {
  const Parts parts = content.starts_with("glTF") ? splitGlb(content) : Parts{content, std::nullopt};
  GltfDocument document;
  document.json = parseJson(parts.json);
  checkVersion(document.root());
  checkLayouts(document.root());
  if (!parts.chunk) content = {};  // embedded buffers are in the JSON now
  decodeBinary(document, source, parts.chunk);
  return document;
}

}  // namespace rigel::tools
