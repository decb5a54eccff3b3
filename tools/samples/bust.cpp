// The figure's head with hair and a face, on shoulders cut off round, as a distance field.
#include "samples/bust.h"

#include "samples/figure_mesh.h"
#include "samples/implicit_surface.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace rigel::tools {
namespace {

constexpr float kCell = 0.0105f;  // m; the finest that keeps the bust well below 20k triangles
constexpr float kBase = 1.085f;   // m, of the socle's foot in the figure's own frame

float smoothIntersection(float a, float b, float blend) { return -smoothUnion(-a, -b, blend); }

float faceDistance(glm::vec3 p) {
  const glm::vec3 q{std::abs(p.x), p.y, p.z};
  float d = figureHeadDistance(p);
  d = smoothUnion(d, roundConeDistance(q, {0.014f, 1.697f, 0.086f}, {0.05f, 1.7f, 0.064f}, 0.006f, 0.004f), 0.016f);
  d = smoothUnion(d, ellipsoidDistance(q, {0.031f, 1.677f, 0.073f}, {0.016f, 0.0105f, 0.013f}), 0.008f);  // eyes
  d = smoothUnion(d, ellipsoidDistance(p, {0, 1.612f, 0.083f}, {0.024f, 0.007f, 0.011f}), 0.01f);         // lips
  d = smoothUnion(d, ellipsoidDistance(p, {0, 1.58f, 0.066f}, {0.026f, 0.02f, 0.022f}), 0.025f);          // chin
  d = smoothUnion(d, ellipsoidDistance(q, {0.045f, 1.64f, 0.045f}, {0.025f, 0.025f, 0.02f}), 0.035f);     // cheeks
  // Hair drawn back into a knot.
  d = smoothUnion(d, ellipsoidDistance(p, {0, 1.715f, -0.025f}, {0.088f, 0.098f, 0.102f}), 0.012f);
  return smoothUnion(d, ellipsoidDistance(p, {0, 1.7f, -0.135f}, {0.045f, 0.042f, 0.036f}), 0.02f);
}

float shoulderDistance(glm::vec3 p) {
  const glm::vec3 q{std::abs(p.x), p.y, p.z};
  float d = ellipsoidDistance(p, {0, 1.31f, -0.005f}, {0.165f, 0.185f, 0.112f});
  d = smoothUnion(d, roundConeDistance(q, {0.03f, 1.46f, -0.02f}, {0.175f, 1.435f, -0.018f}, 0.055f, 0.058f), 0.05f);
  d = smoothUnion(d, roundConeDistance(q, {0.175f, 1.435f, -0.018f}, {0.225f, 1.3f, -0.01f}, 0.058f, 0.05f), 0.03f);
  d = smoothUnion(d, ellipsoidDistance(q, {0.075f, 1.35f, 0.06f}, {0.075f, 0.06f, 0.042f}), 0.06f);
  // Cut off along a sphere about the throat.
  return smoothIntersection(d, glm::distance(p, {0, 1.5f, 0.02f}) - 0.27f, 0.012f);
}

/// Upright cylinder of radius and half height, its rims rounded.
float drumDistance(glm::vec3 p, float radius, float half, float round) {
  const glm::vec2 q{std::hypot(p.x, p.z) - radius + round, std::abs(p.y) - half + round};
  return std::min(std::max(q.x, q.y), 0.0f) + glm::length(glm::max(q, glm::vec2(0))) - round;
}

float socleDistance(glm::vec3 p) {
  float d = roundConeDistance(p, {0, kBase + 0.08f, 0}, {0, 1.27f, 0}, 0.042f, 0.06f);
  d = smoothUnion(d, drumDistance(p - glm::vec3(0, kBase + 0.054f, 0), 0.09f, 0.018f, 0.017f), 0.03f);
  return smoothUnion(d, drumDistance(p - glm::vec3(0, kBase + 0.02f, 0), 0.12f, 0.02f, 0.012f), 0.006f);
}

float bustDistance(glm::vec3 local) {
  const glm::vec3 p = local + glm::vec3(0, kBase, 0);
  float d = smoothUnion(shoulderDistance(p), faceDistance(p), 0.03f);
  return smoothUnion(d, socleDistance(p), 0.03f);
}

}  // namespace

Primitive makeBust() {
  return meshImplicit(bustDistance, {-0.3f, -0.02f, -0.22f}, {0.3f, kBustHeight + 0.04f, 0.2f}, kCell);
}

}  // namespace rigel::tools
