// decodeBinary: the checked, reduced document that tinygltf gets to see.
#include "scene/gltf_document.h"

#include <tiny_gltf.h>

#include <map>

namespace rigel::tools {
namespace {

namespace fs = std::filesystem;

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
// nullopt for a buffer without data.
std::optional<nlohmann::json> describeBuffer(const JsonPlace& buffer, std::size_t number, const fs::path& folder,
                                             const std::optional<std::string_view>& chunk, BufferFiles& files) {
  const std::size_t byteLength = buffer.requiredSize("byteLength");
  if (byteLength == 0) buffer.member("byteLength").fail("must be at least 1");
  const auto uri = buffer.find("uri");
  if (uri && uri->asText().starts_with("data:")) {
    return nlohmann::json{{"byteLength", byteLength}, {"uri", uri->asText()}};
  }
  std::string content;
  if (uri) {
    content = readWholeFile(folder / decodeUri(*uri), uri->path());
  } else {
    if (number != 0 || !chunk) return std::nullopt;
    content = *chunk;
  }
  if (content.size() < byteLength) buffer.fail("has {} bytes, byteLength says {}", content.size(), byteLength);
  content.resize(byteLength);
  const std::string name = fmt::format("buffer{}", number);
  files.content[name] = std::move(content);
  return nlohmann::json{{"byteLength", byteLength}, {"uri", name}};
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

}  // namespace

void decodeBinary(GltfDocument& document, const fs::path& folder, const std::optional<std::string_view>& chunk) {
  const JsonPlace root = document.root();
  BufferFiles files;
  nlohmann::json reduced = {{"asset", {{"version", "2.0"}}}};
  const auto buffers = root.items("buffers"), views = root.items("bufferViews"), accessors = root.items("accessors");
  const nlohmann::json noData = {{"byteLength", 1}, {"uri", "data:application/octet-stream;base64,AA=="}};
  for (const JsonPlace& b : buffers) {
    const auto described = describeBuffer(b, document.bufferHasData.size(), folder, chunk, files);
    document.bufferHasData.push_back(described.has_value());
    reduced["buffers"].push_back(described.value_or(noData));
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
  document.binary = std::move(model);
}

}  // namespace rigel::tools
