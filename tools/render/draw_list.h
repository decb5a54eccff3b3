// Posed objects as vertex buffers, grouped by what a draw call may share.
#pragma once

#include "scene/pose.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace rigel::tools {

/// As object.vert reads it. Triangles do not share vertices: each has its own number, colour and, where flat shaded,
/// normal.
struct DrawVertex {
  glm::vec3 position{0};  // world
  glm::vec3 normal{0};    // world, unit
  glm::vec3 colour{0};    // base colour
  std::uint32_t triangle = 0;
};
static_assert(sizeof(DrawVertex) == 40);

/// Consecutive vertices of one wrap.
struct DrawRange {
  float wrap = 0;
  std::uint32_t first = 0, count = 0;
};

/// The draws of one object: fixed at load, so that a frame only fills vertices in.
class DrawList {
 public:
  /// `wrap` overrides the materials'.
  DrawList(const SceneObject& object, std::optional<float> wrap);

  const std::vector<DrawRange>& ranges() const { return ranges_; }
  std::uint32_t vertexCount() const { return static_cast<std::uint32_t>(3 * order_.size()); }

  /// `out` has vertexCount() entries.
  void fill(const PosedObject& posed, DrawVertex* out) const;

 private:
  const SceneObject* object_;
  std::vector<std::uint32_t> order_;  // triangles, those of a wrap together
  std::vector<DrawRange> ranges_;
};

}  // namespace rigel::tools
