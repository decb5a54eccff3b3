#include "scene/gltf_buffer.h"

#include "scene/accessor_type.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>

namespace rigel::tools {
namespace {

constexpr int kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat32 = 5126;

static_assert(sizeof(glm::vec3) == 12 && sizeof(glm::uvec3) == 12 && sizeof(glm::mat4) == 64);

}  // namespace

int GltfBuffer::add(const void* data, std::size_t size, std::size_t count, int componentType, const char* type) {
  bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
  views_.push_back({{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", size}});
  bytes_.append(static_cast<const char*>(data), size);
  accessors_.push_back(
      {{"bufferView", views_.size() - 1}, {"componentType", componentType}, {"count", count}, {"type", type}});
  return static_cast<int>(accessors_.size()) - 1;
}

void GltfBuffer::writeRange(int accessor, const float* values, std::size_t count, std::size_t width) {
  nlohmann::json low = nlohmann::json::array(), high = nlohmann::json::array();
  for (std::size_t c = 0; c < width; ++c) {
    float least = values[c], most = values[c];
    for (std::size_t i = 1; i < count; ++i) {
      least = std::min(least, values[i * width + c]);
      most = std::max(most, values[i * width + c]);
    }
    low.push_back(double{least});
    high.push_back(double{most});
  }
  accessors_[accessor]["min"] = std::move(low);
  accessors_[accessor]["max"] = std::move(high);
}

int GltfBuffer::addVectors(const std::vector<glm::vec3>& values, AccessorRange range) {
  const int accessor = add(values.data(), values.size() * sizeof(glm::vec3), values.size(), kFloat32, "VEC3");
  if (range == AccessorRange::written) writeRange(accessor, glm::value_ptr(values.front()), values.size(), 3);
  return accessor;
}

int GltfBuffer::addMatrices(const std::vector<glm::mat4>& values) {
  return add(values.data(), values.size() * sizeof(glm::mat4), values.size(), kFloat32, "MAT4");
}

int GltfBuffer::addTriangles(const std::vector<glm::uvec3>& triangles) {
  return add(triangles.data(), triangles.size() * sizeof(glm::uvec3), 3 * triangles.size(), kUnsignedInt, "SCALAR");
}

int GltfBuffer::addJoints(const std::vector<Influences>& influences, std::size_t set) {
  std::vector<std::uint16_t> flat;
  flat.reserve(4 * influences.size());
  for (const Influences& in : influences) {
    for (std::size_t k = 4 * set; k < 4 * set + 4; ++k)
      flat.push_back(in.weight[k] != 0 ? in.joint[k] : std::uint16_t{0});
  }
  return add(flat.data(), flat.size() * sizeof(flat[0]), influences.size(), kUnsignedShort, "VEC4");
}

int GltfBuffer::addWeights(const std::vector<Influences>& influences, std::size_t set) {
  std::vector<float> flat;
  flat.reserve(4 * influences.size());
  for (const Influences& in : influences) flat.insert(flat.end(), &in.weight[4 * set], &in.weight[4 * set] + 4);
  return addFloats(flat, 4);
}

int GltfBuffer::addTimes(const std::vector<float>& times) {
  const auto [known, isNew] = times_.try_emplace(times, 0);
  if (isNew) {
    known->second = addFloats(times, 1);
    writeRange(known->second, times.data(), times.size(), 1);
  }
  return known->second;
}

int GltfBuffer::addFloats(const std::vector<float>& values, int width) {
  return add(values.data(), values.size() * sizeof(float), values.size() / static_cast<std::size_t>(width), kFloat32,
             accessorType(width));
}

void GltfBuffer::describe(nlohmann::json& document) const {
  if (bytes_.empty()) return;
  document["buffers"] = nlohmann::json::array({{{"byteLength", bytes_.size()}}});
  document["bufferViews"] = views_;
  document["accessors"] = accessors_;
}

std::string base64(const std::string& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      out += i + k <= bytes.size() ? kDigits[group >> (18 - 6 * k) & 63] : '=';
    }
  }
  return out;
}

}  // namespace rigel::tools
