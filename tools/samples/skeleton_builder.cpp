#include "samples/skeleton_builder.h"

#include "samples/implicit_surface.h"
#include "samples/scene_builder.h"

#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <limits>

namespace rigel::tools {

Skeleton addSkeleton(Scene& scene, std::string name, int parent, std::span<const Bone> bones) {
  Skeleton skeleton;
  Skin skin;
  skin.name = std::move(name);
  for (const Bone& bone : bones) {
    const bool isRoot = bone.parent < 0;
    const glm::vec3 offset = isRoot ? bone.head : bone.head - bones[bone.parent].head;
    const int node = addNode(scene, bone.name, isRoot ? parent : skeleton.joints[bone.parent], offset);
    skeleton.joints.push_back(node);
    skin.inverseBind.push_back(glm::translate(glm::mat4(1), -bone.head));
  }
  skin.joints = skeleton.joints;
  skin.skeletonRoot = skeleton.joints.front();
  skeleton.skin = static_cast<int>(scene.skins.size());
  scene.skins.push_back(std::move(skin));
  return skeleton;
}

void bindToBones(Primitive& mesh, std::span<const Bone> bones, float blend) {
  constexpr int kKept = 4;  // one JOINTS_0 / WEIGHTS_0 pair
  mesh.influences.clear();
  std::vector<std::pair<float, std::uint16_t>> ranked(bones.size());
  for (const glm::vec3 p : mesh.positions) {
    float nearest = std::numeric_limits<float>::infinity();
    for (std::size_t b = 0; b < bones.size(); ++b) {
      const Bone& bone = bones[b];
      const float d = roundConeDistance(p, bone.head, bone.tail, bone.headRadius, bone.tailRadius);
      ranked[b] = {d, static_cast<std::uint16_t>(b)};
      nearest = std::min(nearest, d);
    }
    for (auto& [d, b] : ranked) {
      const float t = std::max(0.0f, 1 - (d - nearest) / blend);
      d = t * t;
    }
    std::sort(ranked.begin(), ranked.end(), std::greater<>());
    // Less the first weight left out: an influence then enters and leaves the list at weight 0.
    const float cut = ranked.size() > kKept ? ranked[kKept].first : 0.0f;
    Influences influences;
    float sum = 0;
    for (int i = 0; i < std::min<int>(kKept, static_cast<int>(ranked.size())); ++i) {
      influences.weight[i] = ranked[i].first - cut;
      influences.joint[i] = influences.weight[i] > 0 ? ranked[i].second : std::uint16_t{0};
      sum += influences.weight[i];
    }
    if (sum <= 0) influences.weight[0] = sum = 1;  // five bones at the very same distance
    for (float& w : influences.weight) w /= sum;
    mesh.influences.push_back(influences);
  }
}

void bindToBone(Primitive& mesh, int bone) {
  Influences influences;
  influences.joint[0] = static_cast<std::uint16_t>(bone);
  influences.weight[0] = 1;
  mesh.influences.assign(mesh.positions.size(), influences);
}

}  // namespace rigel::tools
