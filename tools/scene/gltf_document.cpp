#include "scene/gltf_document.h"

#include <tiny_gltf.h>

#include <bit>
#include <cstring>
#include <fstream>
#include <map>
#include <system_error>

namespace rigel::tools {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxJsonDepth = 64;  // real files stay below 12; nlohmann and tinygltf recurse when they copy and free
static_assert(std::endian::native == std::endian::little, "GLB and buffer data are read as they lie in memory");

std::string readFile(const fs::path& file, const std::string& place) {
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
  if (length != bytes.size()) fail(fmt::format("GLB header says {} bytes, the file has {}", length, bytes.size()));

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

// Percent-decodes a relative file reference.
std::string decodeUri(const JsonPlace& place) {
  const std::string uri = place.asText();
  const auto hex = [](char c) {
    return c >= '0' && c <= '9' ? c - '0' : (c | 32) >= 'a' && (c | 32) <= 'f' ? (c | 32) - 'a' + 10 : -1;
  };
  if (const auto colon = uri.find(':'); colon != std::string::npos && colon > 1 && uri.find('/') > colon) {
    place.fail("\"{}\" is not a file beside this one", uri.substr(0, 60));
  }
  std::string out;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      out += uri[i];
      continue;
    }
    const int high = i + 2 < uri.size() ? hex(uri[i + 1]) : -1;
    const int low = i + 2 < uri.size() ? hex(uri[i + 2]) : -1;
    if (high < 0 || low < 0 || high + low == 0) place.fail("\"{}\" holds a broken % escape", uri.substr(0, 60));
    out += static_cast<char>(high * 16 + low);
    i += 2;
  }
  if (out.empty()) place.fail("is empty");
  return out;
}

// What tinygltf may open: names we made up -> bytes we hold. It never sees the file system.
struct BufferFiles {
  std::map<std::string, std::string> content;

  static bool exists(const std::string& name, void* self) {
    return static_cast<BufferFiles*>(self)->content.contains(fs::path(name).filename().string());
  }
  static std::string expand(const std::string& name, void*) { return name; }
  static bool read(std::vector<unsigned char>* out, std::string*, const std::string& name, void* self) {
    const auto& content = static_cast<BufferFiles*>(self)->content;
    const auto it = content.find(fs::path(name).filename().string());
    if (it == content.end()) return false;
    out->assign(it->second.begin(), it->second.end());
    return true;
  }
  static bool write(std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; }
};

// A copy of `object` with the named members that it has.
nlohmann::json pick(const JsonPlace& object, std::initializer_list<const char*> keys) {
  nlohmann::json out = nlohmann::json::object();
  for (const char* key : keys) {
    if (const auto found = object.find(key)) out[key] = found->value();
  }
  return out;
}

// One buffer for tinygltf: bytes cut to byteLength (it insists on equality) under a name of ours, or the base64 URI.
nlohmann::json describeBuffer(const JsonPlace& buffer, std::size_t number, const fs::path& folder,
                              const std::optional<std::string_view>& chunk, BufferFiles& files) {
  const std::size_t byteLength = buffer.requiredSize("byteLength");
  if (byteLength == 0) buffer.member("byteLength").fail("must be at least 1");
  const auto uri = buffer.find("uri");
  if (uri && uri->asText().starts_with("data:")) {
    return {{"byteLength", byteLength}, {"uri", uri->asText()}};
  }
  std::string content;
  if (uri) {
    content = readFile(folder / decodeUri(*uri), uri->path());
  } else {
    if (number != 0 || !chunk) buffer.fail("has no \"uri\" and there is no GLB binary chunk for it");
    content = *chunk;
  }
  if (content.size() < byteLength) buffer.fail("has {} bytes, byteLength says {}", content.size(), byteLength);
  content.resize(byteLength);
  const std::string name = fmt::format("buffer{}", number);
  files.content[name] = std::move(content);
  return {{"byteLength", byteLength}, {"uri", name}};
}

nlohmann::json describeView(const JsonPlace& view, std::size_t bufferCount) {
  view.requiredIndex("buffer", bufferCount, "buffer");
  if (view.requiredSize("byteLength") == 0) view.member("byteLength").fail("must be at least 1");
  view.size("byteOffset", 0);
  if (const std::size_t stride = view.size("byteStride", 4); stride < 4 || stride > 252 || stride % 4 != 0) {
    view.member("byteStride").fail("must be a multiple of 4 from 4 to 252, is {}", stride);
  }
  return pick(view, {"buffer", "byteOffset", "byteLength", "byteStride"});
}

nlohmann::json describeAccessor(const JsonPlace& accessor, std::size_t viewCount) {
  accessor.index("bufferView", viewCount, "bufferView");
  accessor.size("byteOffset", 0);
  accessor.flag("normalized");
  if (accessor.requiredSize("count") == 0) accessor.member("count").fail("must be at least 1");
  const std::size_t component = accessor.requiredSize("componentType");
  if (component < 5120 || component > 5126 || component == 5124) {
    accessor.member("componentType").fail("{} is none of glTF's", component);
  }
  const std::string type = accessor.member("type").asText();
  bool known = false;
  for (const char* name : {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"}) known = known || type == name;
  if (!known) accessor.member("type").fail("\"{}\" is none of glTF's", type);
  nlohmann::json out = pick(accessor, {"bufferView", "byteOffset", "normalized", "count", "componentType", "type"});
  if (const auto sparse = accessor.find("sparse")) {
    sparse->requiredSize("count");
    const JsonPlace indices = sparse->member("indices"), values = sparse->member("values");
    indices.requiredIndex("bufferView", viewCount, "bufferView");
    indices.requiredSize("componentType");
    values.requiredIndex("bufferView", viewCount, "bufferView");
    // tinygltf keeps these two as int.
    for (const JsonPlace& part : {indices, values}) {
      if (part.size("byteOffset", 0) > 0x7fffffff) part.member("byteOffset").fail("is beyond 2 GiB");
    }
    if (sparse->requiredSize("count") > 0x7fffffff) sparse->member("count").fail("is absurd");
    out["sparse"] = {{"count", sparse->requiredSize("count")},
                     {"indices", pick(indices, {"bufferView", "byteOffset", "componentType"})},
                     {"values", pick(values, {"bufferView", "byteOffset"})}};
  }
  return out;
}

std::shared_ptr<const tinygltf::Model> decodeBinary(const JsonPlace& root, const fs::path& folder,
                                                    const std::optional<std::string_view>& chunk) {
  BufferFiles files;
  nlohmann::json reduced = {{"asset", {{"version", "2.0"}}}};
  const auto buffers = root.items("buffers"), views = root.items("bufferViews"), accessors = root.items("accessors");
  for (const JsonPlace& b : buffers) {
    reduced["buffers"].push_back(describeBuffer(b, reduced["buffers"].size(), folder, chunk, files));
  }
  for (const JsonPlace& v : views) reduced["bufferViews"].push_back(describeView(v, buffers.size()));
  for (const JsonPlace& a : accessors) reduced["accessors"].push_back(describeAccessor(a, views.size()));

  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks({&BufferFiles::exists, &BufferFiles::expand, &BufferFiles::read, &BufferFiles::write, &files});
  auto model = std::make_shared<tinygltf::Model>();
  std::string error, warning;
  const std::string text = reduced.dump();
  const bool loaded = loader.LoadASCIIFromString(model.get(), &error, &warning, text.data(),
                                                 static_cast<unsigned>(text.size()), ".", tinygltf::NO_REQUIRE);
  if (!loaded && model->buffers.size() < buffers.size()) {
    buffers[model->buffers.size()].fail("\"uri\" is not base64 data of exactly byteLength bytes");
  }
  if (!loaded || model->bufferViews.size() != views.size() || model->accessors.size() != accessors.size()) {
    root.fail("buffers cannot be decoded: {}", error.substr(0, error.find('\n')).substr(0, 160));
  }
  return model;
}

}  // namespace

GltfDocument readGltfDocument(const fs::path& file) {
  const std::string content = readFile(file, "");
  const Parts parts = content.starts_with("glTF") ? splitGlb(content) : Parts{content, std::nullopt};
  GltfDocument document;
  document.json = parseJson(parts.json);
  checkVersion(document.root());
  document.binary = decodeBinary(document.root(), file.parent_path(), parts.chunk);
  return document;
}

}  // namespace rigel::tools
