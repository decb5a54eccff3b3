// Conversions between Rigel's plain types and GLM, for callers that use GLM. Header-only; nothing else includes it.
#pragma once

#include <rigel/vec3.h>

#include <glm/vec3.hpp>

namespace rigel {

inline glm::vec3 toGlm(Vec3 v) noexcept { return {v.x, v.y, v.z}; }
inline glm::vec3 toGlm(Rgb c) noexcept { return {c.r, c.g, c.b}; }
inline Vec3 fromGlm(const glm::vec3& v) noexcept { return {v.x, v.y, v.z}; }
inline Rgb rgbFromGlm(const glm::vec3& c) noexcept { return {c.x, c.y, c.z}; }

}  // namespace rigel
