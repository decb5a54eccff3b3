// The one binary buffer of a glTF file being written, with its views and accessors.
#pragma once

#include "scene/scene.h"

#include <nlohmann/json.hpp>

#include <map>
#include <string>

namespace rigel::tools {

/// Whether an accessor states its minimum and maximum, as glTF demands of positions and key times.
enum class AccessorRange { omitted, written };

class GltfBuffer {
 public:
  /// Each returns the index of a new accessor (key times that were written before are shared).
  int addVectors(const std::vector<glm::vec3>& values, AccessorRange range = AccessorRange::omitted);
  int addMatrices(const std::vector<glm::mat4>& values);
  int addTriangles(const std::vector<glm::uvec3>& triangles);
  int addJoints(const std::vector<Influences>& influences, std::size_t set);
  int addWeights(const std::vector<Influences>& influences, std::size_t set);
  int addTimes(const std::vector<float>& times);
  int addFloats(const std::vector<float>& values, int width);

  /// Adds buffers, bufferViews and accessors to the document.
  void describe(nlohmann::json& document) const;
  const std::string& bytes() const noexcept { return bytes_; }

 private:
  int add(const void* data, std::size_t size, std::size_t count, int componentType, const char* type);
  void writeRange(int accessor, const float* values, std::size_t count, std::size_t width);

  std::string bytes_;
  nlohmann::json views_ = nlohmann::json::array();
  nlohmann::json accessors_ = nlohmann::json::array();
  std::map<std::vector<float>, int> times_;
};

std::string base64(const std::string& bytes);

}  // namespace rigel::tools
