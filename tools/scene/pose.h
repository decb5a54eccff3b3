// The scene at a moment: node transforms, posed objects, lights in world space.
#pragma once

#include "scene/scene.h"

#include <span>

namespace rigel::tools {

/// Node transforms and morph weights at a time of a clip.
struct ScenePose {
  std::vector<glm::mat4> worldFromNode;
  std::vector<std::vector<float>> morphWeights;  // per node, empty without a mesh

  /// Working memory of poseScene, kept so that a frame allocates nothing.
  struct Local {
    glm::vec3 translation;
    glm::quat rotation;
    glm::vec3 scale;
  };
  std::vector<Local> local;
  std::vector<int> pending;
};

inline constexpr int kRestPose = -1;

/// Pose at `time` [s] of animation `clip` (kRestPose: as authored). Times outside the clip are clamped to its ends.
/// All interpolation kinds; rotations by shortest-arc slerp. Reuses the vectors of `out`.
void poseScene(const Scene& scene, int clip, double time, ScenePose& out);

/// Something that gets a rig: one mesh node, one skin with all meshes bound to it, or the subtree of a node marked
/// `isObject`. Topology is constant: vertex i and triangle j of every PosedObject are the same. Triangles are wound
/// counter-clockwise seen from outside in the rest pose, also where a node mirrors its mesh.
struct SceneObject {
  std::string name;
  bool isStatic = false;       // its node (all of its mesh nodes) or one above is marked static
  int frameNode = -1;          // rig frame: the mesh's node, the skeleton root, or the marked node
  std::vector<int> meshNodes;  // in the order in which their vertices are laid out
  std::vector<glm::uvec3> triangles;
  std::vector<float> triangleWrap;        // per triangle
  std::vector<glm::vec3> triangleColour;  // per triangle, base colour of its material
  int vertexCount = 0;
};

/// All objects of the scene, static ones included, in node order; names are unique (suffix " 2", " 3", ...). Nodes
/// outside the scene's roots hold none. Of nested marked nodes the outermost makes the object.
std::vector<SceneObject> findObjects(const Scene& scene);

/// World-space vertices of an object. `normals` are unit; where a primitive has none (flat shading) its entries are
/// zero and the triangle's own normal counts.
struct PosedObject {
  glm::mat4 worldFromRig{1};
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;

  std::vector<glm::mat4> skinMatrices;  // working memory of poseObject
};

/// Morphs, then skins (the mesh node's own transform is then ignored, as glTF asks) or transforms `object`. Reuses the
/// vectors of `out`: no allocation once they have grown. Finite for every finite pose; collapsed scales included.
void poseObject(const Scene& scene, const SceneObject& object, const ScenePose& pose, PosedObject& out);

/// Lights of the scene in world space, in the order directional, point, spot, sphere, disk that LightSet keeps.
struct PosedLights {
  LightSet set;
  std::vector<std::string> names;  // of set's lights, in that order
};

/// Lights of nodes outside the scene's roots are left out. Scale has no effect on a light but where `scalesWithNode`
/// says so: that disk's radius is multiplied by the length of the longest axis.
void poseLights(const Scene& scene, const ScenePose& pose, PosedLights& out);

}  // namespace rigel::tools
