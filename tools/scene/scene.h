// The scene model of the tools: what Rigel understands of a glTF file, checked, in memory. Immutable once loaded.
#pragma once

#include <rigel/light.h>
#include <rigel/result.h>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace rigel::tools {

/// Up to eight skin influences of a vertex (JOINTS_0 and JOINTS_1); unused weights are 0, used ones sum to 1.
struct Influences {
  std::array<std::uint16_t, 8> joint{};
  std::array<float, 8> weight{};
};

/// Offsets from the base mesh; `normals` may be empty.
struct MorphTarget {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
};

/// A triangle list; every vertex belongs to a triangle. `normals` is empty where the file has none: triangles are then
/// flat shaded, as glTF asks. `influences` is empty for unskinned primitives.
struct Primitive {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::uvec3> triangles;
  std::vector<Influences> influences;
  std::vector<MorphTarget> targets;
  int material = -1;
};

struct Mesh {
  std::string name;
  std::vector<Primitive> primitives;
  std::vector<float> morphWeights;  // default weights, one per target
};

/// `wrap` is the material's extras.wrap (0: Lambert).
struct Material {
  std::string name;
  glm::vec3 baseColour{1};
  float wrap = 0;
};

struct Skin {
  std::string name;
  std::vector<int> joints;  // node indices
  std::vector<glm::mat4> inverseBind;
  int skeletonRoot = -1;  // `skeleton`, or the joints' closest common ancestor (a joint itself may be it)
};

/// A light in its node's frame: local position is the origin, local direction -z (glTF).
/// LightShape holds position {0,0,0} and direction {0,0,-1}.
using LightShape = std::variant<DirectionalLight, PointLight, SpotLight, SphereLight, DiskLight>;
struct SceneLight {
  std::string name;
  LightShape shape;
  bool scalesWithNode = false;  // a disk whose radius its node's largest scale multiplies (EXT_lights_area)
};

struct Node {
  std::string name;
  int parent = -1;
  std::vector<int> children;
  glm::vec3 translation{0};
  glm::quat rotation{1, 0, 0, 0};
  glm::vec3 scale{1};
  bool hasMatrix = false;  // `matrix` replaces translation, rotation, scale; such nodes are never animated
  glm::mat4 matrix{1};
  int mesh = -1;
  int skin = -1;
  int light = -1;
  std::vector<float> morphWeights;  // overrides the mesh's when not empty
  bool isStatic = false;            // extras.rigel.static: scenery, drawn in pictures but given no rig
  bool isObject = false;  // extras.rigel.object: this node and all meshes below it are one object with one rig
};

enum class AnimationPath { translation, rotation, scale, weights };
enum class Interpolation { step, linear, cubicSpline };

/// Keys of one channel. `values` holds `width` floats a key (weights: one per morph target), for cubicSpline three
/// such groups a key: in-tangent, value, out-tangent. Times increase strictly.
struct Channel {
  int node = -1;
  AnimationPath path = AnimationPath::translation;
  Interpolation interpolation = Interpolation::linear;
  int width = 3;
  std::vector<float> times;
  std::vector<float> values;
};

struct Animation {
  std::string name;
  std::vector<Channel> channels;
  double duration = 0;  // s, the last key
};

struct Scene {
  std::string name;  // file name or sample name
  std::vector<Node> nodes;
  std::vector<int> roots;
  std::vector<Mesh> meshes;
  std::vector<Material> materials;
  std::vector<Skin> skins;
  std::vector<SceneLight> lights;
  std::vector<Animation> animations;
  std::string settings;  // extras.rigel.settings as JSON text: how a captured run was asked for (tools/report)
  std::vector<std::string> notes;  // what the file holds that Rigel does not use, by name; shown in reports and `info`
};

}  // namespace rigel::tools
