// Builds glTF animation channels from keys or from functions of time.
#pragma once

#include "scene/scene.h"

#include <functional>
#include <span>

namespace rigel::tools {

template <class T>
struct Key {
  float time = 0;
  T value{};
};

/// Cubic splines get Catmull-Rom tangents for the keys' own spacing and rest at both ends.
class AnimationBuilder {
 public:
  explicit AnimationBuilder(std::string name) { animation_.name = std::move(name); }

  void translation(int node, Interpolation interpolation, std::span<const Key<glm::vec3>> keys);
  void rotation(int node, Interpolation interpolation, std::span<const Key<glm::quat>> keys);
  void scale(int node, Interpolation interpolation, std::span<const Key<glm::vec3>> keys);
  /// `keys` all hold the same number of weights.
  void weights(int node, Interpolation interpolation, std::span<const Key<std::vector<float>>> keys);

  /// `count` + 1 linear keys of a function of time over [0, duration].
  void sampledTranslation(int node, float duration, int count, const std::function<glm::vec3(float)>& at);
  void sampledRotation(int node, float duration, int count, const std::function<glm::quat(float)>& at);

  /// The animation; its duration is the latest key.
  Animation finish();

 private:
  void add(int node, AnimationPath path, Interpolation interpolation, int width, std::vector<float> times,
           const std::vector<float>& values);

  Animation animation_;
};

}  // namespace rigel::tools
