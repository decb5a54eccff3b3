#include "scene/gltf_accessor.h"

#include <tiny_gltf.h>
#include "scene/accessor_type.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

namespace rigel::tools {
namespace {

// Files may name one accessor many times and count elements that no byte stands for; the sum is what costs memory. A
// file that reads each byte once stays below one component a byte, whatever its size; primitives that share their
// vertices read them a few dozen times.
constexpr std::size_t kFreeComponents = std::size_t{1} << 24;
constexpr std::size_t kComponentsPerByte = 64;
constexpr std::size_t kMaxUnbacked = std::size_t{1} << 26;  // 256 MiB of floats, twice that while they are read

int gltfType(int width) {
  switch (width) {
    case 1:
      return TINYGLTF_TYPE_SCALAR;
    case 3:
      return TINYGLTF_TYPE_VEC3;
    case 4:
      return TINYGLTF_TYPE_VEC4;
    default:
      return TINYGLTF_TYPE_MAT4;
  }
}

unsigned formatBits(int componentType, bool normalized) {
  switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return normalized ? kNormalizedInt8 : kPlainInt8;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return normalized ? kNormalizedInt8 : kPlainInt8 | kUnsigned8;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return normalized ? kNormalizedInt16 : kPlainInt16;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return normalized ? kNormalizedInt16 : kPlainInt16 | kUnsigned16;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return normalized ? 0u : unsigned{kUnsigned32};
    default:
      return normalized ? 0u : unsigned{kFloat};
  }
}

std::string formatName(int componentType, bool normalized) {
  const char* name = "FLOAT";
  switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      name = "BYTE";
      break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      name = "UNSIGNED_BYTE";
      break;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      name = "SHORT";
      break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      name = "UNSIGNED_SHORT";
      break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      name = "UNSIGNED_INT";
      break;
    default:
      break;
  }
  return normalized ? fmt::format("normalized {}", name) : name;
}

[[noreturn]] void failAbsurd(const JsonPlace& place, std::size_t count) {
  place.fail("count {} is absurd: the file's data would grow beyond all proportion to its size", count);
}

template <class T>
double decode(const unsigned char* bytes, double scale) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<double>(value) * scale;
}

// One component; normalised signed integers have two codes for -1 (glTF 2.0, section 3.11).
double component(const unsigned char* bytes, int type, bool normalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return std::max(decode<std::int8_t>(bytes, normalized ? 1 / 127. : 1), normalized ? -1. : -128.);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return decode<std::uint8_t>(bytes, normalized ? 1 / 255. : 1);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return std::max(decode<std::int16_t>(bytes, normalized ? 1 / 32767. : 1), normalized ? -1. : -32768.);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return decode<std::uint16_t>(bytes, normalized ? 1 / 65535. : 1);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return decode<std::uint32_t>(bytes, 1);
    default:
      return decode<float>(bytes, 1);
  }
}

}  // namespace

struct AccessorReader::Layout {
  int accessor = -1;
  std::size_t count = 0;
  std::size_t width = 0;
  std::size_t componentBytes = 0;
  std::size_t stride = 0;
  const unsigned char* data = nullptr;  // null: zeros, until sparse values replace some
};

AccessorReader::AccessorReader(const GltfDocument& document)
    : document_(document), places_(document.root().items("accessors")), views_(document.root().items("bufferViews")) {
  std::size_t bytes = 0;
  for (const tinygltf::Buffer& buffer : document.binary->buffers) bytes += buffer.data.size();
  componentsLeft_ = bytes + std::min(kFreeComponents + kComponentsPerByte * bytes, kMaxUnbacked);
}

int AccessorReader::count() const noexcept { return static_cast<int>(places_.size()); }

std::size_t AccessorReader::elements(int accessor) const { return document_.binary->accessors[accessor].count; }

bool AccessorReader::isMaxIndex(int accessor, std::uint32_t value) const {
  const int bytes = tinygltf::GetComponentSizeInBytes(document_.binary->accessors[accessor].componentType);
  return value == 0xffffffffu >> (32 - 8 * bytes);
}

void AccessorReader::reserve(const JsonPlace& place, std::size_t components) {
  if (components > componentsLeft_) failAbsurd(place, components);
  componentsLeft_ -= components;
}

bool AccessorReader::hasData(int accessor) const {
  const tinygltf::Accessor& a = document_.binary->accessors[accessor];
  return a.bufferView >= 0 || a.sparse.isSparse;
}

// Address of `bytes` bytes at `offset` in a buffer view. checkLayouts made sure that view and buffer hold them.
const unsigned char* AccessorReader::viewData(const JsonPlace& place, int view, std::size_t offset,
                                              [[maybe_unused]] std::size_t bytes) const {
  const tinygltf::BufferView& v = document_.binary->bufferViews[view];
  if (const auto& lack = document_.bufferLacks[v.buffer]) {
    for (const char* codec : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
      const auto extensions = views_[view].find("extensions");
      if (extensions && extensions->has(codec))
        views_[view].fail("is compressed by {}, which Rigel does not read", codec);
    }
    if (!lack->place.empty()) throw *lack;
    place.fail("is in buffer {}, {}", v.buffer, lack->message);
  }
  const std::vector<unsigned char>& buffer = document_.binary->buffers[v.buffer].data;
  assert(v.byteOffset <= buffer.size() && offset + bytes <= v.byteLength &&
         v.byteLength <= buffer.size() - v.byteOffset);
  return buffer.data() + v.byteOffset + offset;
}

AccessorReader::Layout AccessorReader::layout(const JsonPlace& user, int accessor, int width, unsigned allowed) {
  const tinygltf::Accessor& a = document_.binary->accessors[accessor];
  const JsonPlace& place = places_[accessor];
  if (a.type != gltfType(width)) {
    user.fail("accessor {} must be {}, is {}", accessor, accessorType(width), place.text("type"));
  }
  if ((formatBits(a.componentType, a.normalized) & allowed) == 0) {
    user.fail("accessor {} has component type {}, which is not allowed here", accessor,
              formatName(a.componentType, a.normalized));
  }
  Layout out;
  out.accessor = accessor;
  out.count = a.count;
  out.width = static_cast<std::size_t>(width);
  out.componentBytes = static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(a.componentType));
  if (a.count > componentsLeft_ / out.width) failAbsurd(place, a.count);
  reserve(place, a.count * out.width);
  if (a.bufferView < 0) return out;

  const tinygltf::BufferView& view = document_.binary->bufferViews[a.bufferView];
  const std::size_t elementBytes = out.componentBytes * out.width;
  out.stride = view.byteStride != 0 ? view.byteStride : elementBytes;
  out.data = viewData(place, a.bufferView, a.byteOffset, out.stride * (a.count - 1) + elementBytes);
  return out;
}

// Calls store(component number, value) for all components, then again for those that sparse data replace.
template <class Store>
void AccessorReader::forEachComponent(const Layout& in, Store&& store) const {
  const tinygltf::Accessor& a = document_.binary->accessors[in.accessor];
  const JsonPlace& place = places_[in.accessor];
  const auto storeElement = [&](std::size_t element, const unsigned char* bytes) {
    for (std::size_t c = 0; c < in.width; ++c) {
      store(element * in.width + c, component(bytes + c * in.componentBytes, a.componentType, a.normalized));
    }
  };
  if (in.data != nullptr) {
    for (std::size_t i = 0; i < in.count; ++i) storeElement(i, in.data + i * in.stride);
  }
  if (!a.sparse.isSparse) return;

  const JsonPlace sparse = place.member("sparse");
  const auto count = static_cast<std::size_t>(a.sparse.count);
  const int indexType = a.sparse.indices.componentType;
  const auto indexBytes = static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(indexType));
  const std::size_t elementBytes = in.componentBytes * in.width;
  const unsigned char* indices = viewData(sparse.member("indices"), a.sparse.indices.bufferView,
                                          static_cast<std::size_t>(a.sparse.indices.byteOffset), count * indexBytes);
  const unsigned char* values = viewData(sparse.member("values"), a.sparse.values.bufferView,
                                         static_cast<std::size_t>(a.sparse.values.byteOffset), count * elementBytes);
  double previous = -1;
  for (std::size_t i = 0; i < count; ++i) {
    const double index = component(indices + i * indexBytes, indexType, false);
    if (index >= static_cast<double>(in.count)) {
      sparse.member("indices").fail("index {} (number {}) is beyond the accessor's {} elements", index, i, in.count);
    }
    if (index <= previous) sparse.member("indices").fail("index {} (number {}) does not increase", index, i);
    previous = index;
    storeElement(static_cast<std::size_t>(index), values + i * elementBytes);
  }
}

std::vector<float> AccessorReader::floats(const JsonPlace& user, int accessor, int width, unsigned allowed) {
  const Layout from = layout(user, accessor, width, allowed);
  std::vector<float> out(from.count * from.width, 0.f);
  forEachComponent(from, [&](std::size_t i, double value) { out[i] = static_cast<float>(value); });
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (!std::isfinite(out[i])) {
      user.fail("accessor {} holds {} in element {}", accessor, std::isnan(out[i]) ? "NaN" : "infinity",
                i / from.width);
    }
  }
  return out;
}

std::vector<std::uint32_t> AccessorReader::integers(const JsonPlace& user, int accessor, int width, unsigned allowed) {
  const Layout from = layout(user, accessor, width, allowed);
  std::vector<std::uint32_t> out(from.count * from.width, 0u);
  forEachComponent(from, [&](std::size_t i, double value) { out[i] = static_cast<std::uint32_t>(value); });
  return out;
}

}  // namespace rigel::tools
