// decodeBinary: the checked, reduced document that tinygltf gets to see.
#include "scene/gltf_document.h"
#include "scene/gltf_uri.h"

#include <tiny_gltf.h>

#include <map>

namespace rigel::tools {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// In memory twice while they are decoded.
constexpr std::size_t kMaxBufferBytes = std::size_t{1} << 30;

// What tinygltf may open: names we made up -> bytes we hold. It never sees the file system. Bytes are handed over once
// and then let go: files of hundreds of megabytes would lie in memory three times otherwise.
struct BufferFiles {
  std::map<std::string, std::string> owned;
  std::map<std::string, std::string_view> content;

  static bool exists(const std::string& name, void* self) {
    return static_cast<BufferFiles*>(self)->content.contains(fs::path(name).filename().string());
  }
  static std::string expand(const std::string& name, void*) { return name; }
  static bool read(std::vector<unsigned char>* out, std::string*, const std::string& name, void* self) {
    auto& files = *static_cast<BufferFiles*>(self);
    const std::string key = fs::path(name).filename().string();
    const auto it = files.content.find(key);
    if (it == files.content.end()) return false;
    out->assign(it->second.begin(), it->second.end());
    files.content.erase(it);
    files.owned.erase(key);
    return true;
  }
  static bool write(std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; }
};

// A copy of `object` with the named members that it has.
json pick(const JsonPlace& object, std::initializer_list<const char*> keys) {
  json out = json::object();
  for (const char* key : keys) {
    if (const auto found = object.find(key)) out[key] = found->value();
  }
  return out;
}

// Reads the bytes of one buffer; returns why there are none, where nobody may need them: a buffer without "uri", a file
// that is not there or elsewhere.
class BufferReader {
 public:
  BufferReader(const GltfSource& source, const std::optional<std::string_view>& chunk, BufferFiles& files)
      : source_(source), chunk_(chunk), files_(files) {}

  std::optional<LoadError> read(const JsonPlace& buffer, std::size_t number) {
    const std::size_t bytes = buffer.requiredSize("byteLength");
    if (bytes > bytesLeft_) buffer.fail("the buffers have more than {} bytes", kMaxBufferBytes);
    const auto uri = buffer.find("uri");
    std::string_view content;
    if (!uri) {
      if (number != 0 || !chunk_) return LoadError{"", "which has neither \"uri\" nor a GLB binary chunk"};
      content = *chunk_;
    } else if (isDataUri(uri->asText())) {
      content = own(number, decodeDataUri(*uri));
    } else {
      const auto file = source_.readsFiles ? fileOfUri(*uri, source_.folder) : std::nullopt;
      if (!file) return LoadError{uri->path(), fmt::format("\"{}\" is not a file beside this one", shortText(*uri))};
      try {
        content = own(number, readWholeFile(*file, uri->path(), bytes));
      } catch (LoadError& error) {
        return std::move(error);
      }
    }
    if (content.size() < bytes) buffer.fail("has {} bytes, byteLength says {}", content.size(), bytes);
    bytesLeft_ -= bytes;
    files_.content[nameOf(number)] = content.substr(0, bytes);  // tinygltf insists on equality
    return std::nullopt;
  }

  static std::string nameOf(std::size_t number) { return fmt::format("buffer{}", number); }

 private:
  static std::string shortText(const JsonPlace& uri) { return uri.asText().substr(0, 60); }
  std::string_view own(std::size_t number, std::string content) {
    return files_.owned[nameOf(number)] = std::move(content);
  }

  const GltfSource& source_;
  const std::optional<std::string_view>& chunk_;
  BufferFiles& files_;
  std::size_t bytesLeft_ = kMaxBufferBytes;
};

json describeSparse(const JsonPlace& sparse) {
  return {{"count", sparse.requiredSize("count")},
          {"indices", pick(sparse.member("indices"), {"bufferView", "byteOffset", "componentType"})},
          {"values", pick(sparse.member("values"), {"bufferView", "byteOffset"})}};
}

}  // namespace

void decodeBinary(GltfDocument& document, const GltfSource& source, const std::optional<std::string_view>& chunk) {
  const JsonPlace root = document.root();
  const auto buffers = root.items("buffers"), views = root.items("bufferViews"), accessors = root.items("accessors");
  json reduced = {{"asset", {{"version", "2.0"}}}};
  BufferFiles files;
  BufferReader reader(source, chunk, files);
  for (const JsonPlace& b : buffers) {
    const std::size_t number = document.bufferLacks.size();
    document.bufferLacks.push_back(reader.read(b, number));
    const bool lacks = document.bufferLacks.back().has_value();
    reduced["buffers"].push_back(
        lacks ? json{{"byteLength", 1}, {"uri", "data:application/octet-stream;base64,AA=="}}
              : json{{"byteLength", b.requiredSize("byteLength")}, {"uri", BufferReader::nameOf(number)}});
  }
  for (const JsonPlace& v : views)
    reduced["bufferViews"].push_back(pick(v, {"buffer", "byteOffset", "byteLength", "byteStride"}));
  for (const JsonPlace& a : accessors) {
    json accessor = pick(a, {"bufferView", "byteOffset", "normalized", "count", "componentType", "type"});
    if (const auto sparse = a.find("sparse")) accessor["sparse"] = describeSparse(*sparse);
    reduced["accessors"].push_back(std::move(accessor));
  }

  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks({&BufferFiles::exists, &BufferFiles::expand, &BufferFiles::read, &BufferFiles::write, &files});
  auto model = std::make_shared<tinygltf::Model>();
  std::string error, warning;
  const std::string text = reduced.dump();
  reduced = nullptr;
  const bool loaded = loader.LoadASCIIFromString(model.get(), &error, &warning, text.data(),
                                                 static_cast<unsigned>(text.size()), ".", tinygltf::NO_REQUIRE);
  if (!loaded || model->buffers.size() != buffers.size() || model->bufferViews.size() != views.size() ||
      model->accessors.size() != accessors.size()) {
    root.fail("buffers cannot be decoded: {}", error.substr(0, error.find('\n')).substr(0, 160));
  }
  document.binary = std::move(model);
}

}  // namespace rigel::tools
