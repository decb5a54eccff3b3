#include "render/draw_list.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <numeric>

namespace rigel::tools {
namespace {

/// Below this an interpolated normal says nothing; as the ray caster has it.
constexpr float kLeastNormal = 1e-12f;

glm::vec3 flatNormal(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
  const glm::vec3 n = glm::cross(b - a, c - a);
  const float square = glm::dot(n, n);
  return square > 0 ? n / std::sqrt(square) : glm::vec3(0, 1, 0);
}

}  // namespace

DrawList::DrawList(const SceneObject& object, std::optional<float> wrap) : object_(&object) {
  const auto wrapOf = [&](std::uint32_t t) { return wrap.value_or(object.triangleWrap[t]); };
  order_.resize(object.triangles.size());
  std::iota(order_.begin(), order_.end(), 0u);
  std::ranges::stable_sort(order_, {}, wrapOf);
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const float own = wrapOf(order_[i]);
    if (ranges_.empty() || ranges_.back().wrap != own) ranges_.push_back({own, static_cast<std::uint32_t>(3 * i), 0});
    ranges_.back().count += 3;
  }
}

void DrawList::fill(const PosedObject& posed, DrawVertex* out) const {
  for (const std::uint32_t t : order_) {
    const glm::uvec3 corners = object_->triangles[t];
    const glm::vec3 flat =
        flatNormal(posed.positions[corners.x], posed.positions[corners.y], posed.positions[corners.z]);
    for (const glm::uint v : {corners.x, corners.y, corners.z}) {
      const glm::vec3 n = posed.normals[v];
      *out++ = {posed.positions[v], glm::dot(n, n) > kLeastNormal ? n : flat, object_->triangleColour[t], t};
    }
  }
}

}  // namespace rigel::tools
