// Short names for what every sample scene does: add nodes, materials, meshes and lights.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <string>

namespace rigel::tools {

inline constexpr int kNoParent = -1;

/// All return the index of what they added; nodes are linked to their parent, or to the roots without one.
int addNode(Scene& scene, std::string name, int parent, glm::vec3 translation = glm::vec3(0));
int addMaterial(Scene& scene, std::string name, glm::vec3 baseColour, float wrap = 0);
int addMesh(Scene& scene, std::string name, std::vector<Primitive> primitives);

/// A mesh of one primitive on a node of its own.
int addMeshNode(Scene& scene, std::string name, int parent, Primitive primitive, int material);

/// As addMeshNode, marked as scenery.
int addScenery(Scene& scene, std::string name, Primitive primitive, int material);

/// A node that carries a light, shining along `direction` of the parent's frame (-z of its own).
int addLight(Scene& scene, std::string name, LightShape shape, int parent, glm::vec3 position,
             glm::vec3 direction = glm::vec3(0, -1, 0));

/// The rotation that takes -z to `direction`.
glm::quat aim(glm::vec3 direction);

/// Sphere light of intensity `colour` [W/sr] far away: radiance colour/(pi radius^2).
SphereLight sphereOfIntensity(float radius, Rgb colour);

/// Deterministic numbers for scattering things (PCG by M. O'Neill, 32-bit output of a 64-bit state).
class Scatter {
 public:
  explicit Scatter(std::uint64_t seed) : state_(seed * 2 + 1) { next(); }
  /// Uniform in [low, high).
  float uniform(float low, float high);

 private:
  std::uint32_t next();
  std::uint64_t state_;
};

}  // namespace rigel::tools
