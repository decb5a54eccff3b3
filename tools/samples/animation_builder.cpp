#include "samples/animation_builder.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>

namespace rigel::tools {
namespace {

template <class T, class Flatten>
void flatten(std::span<const Key<T>> keys, std::vector<float>& times, std::vector<float>& values, Flatten&& flat) {
  for (const Key<T>& key : keys) {
    times.push_back(key.time);
    flat(key.value, values);
  }
}

void flattenVec3(glm::vec3 v, std::vector<float>& out) { out.insert(out.end(), {v.x, v.y, v.z}); }

}  // namespace

void AnimationBuilder::add(int node, AnimationPath path, Interpolation interpolation, int width,
                           std::vector<float> times, const std::vector<float>& values) {
  Channel channel{node, path, interpolation, width, std::move(times), values};
  const int count = static_cast<int>(channel.times.size());
  if (interpolation == Interpolation::cubicSpline) {
    channel.values.clear();
    for (int key = 0; key < count; ++key) {
      std::vector<float> tangent(static_cast<std::size_t>(width), 0.0f);
      if (key > 0 && key + 1 < count) {
        const float span = channel.times[key + 1] - channel.times[key - 1];
        for (int i = 0; i < width; ++i) {
          tangent[i] = (values[(key + 1) * width + i] - values[(key - 1) * width + i]) / span;
        }
      }
      const auto value = values.begin() + key * width;
      channel.values.insert(channel.values.end(), tangent.begin(), tangent.end());
      channel.values.insert(channel.values.end(), value, value + width);
      channel.values.insert(channel.values.end(), tangent.begin(), tangent.end());
    }
  }
  animation_.duration = std::max(animation_.duration, static_cast<double>(channel.times.back()));
  animation_.channels.push_back(std::move(channel));
}

void AnimationBuilder::translation(int node, Interpolation interpolation, std::span<const Key<glm::vec3>> keys) {
  std::vector<float> times, values;
  flatten(keys, times, values, flattenVec3);
  add(node, AnimationPath::translation, interpolation, 3, std::move(times), values);
}

void AnimationBuilder::scale(int node, Interpolation interpolation, std::span<const Key<glm::vec3>> keys) {
  std::vector<float> times, values;
  flatten(keys, times, values, flattenVec3);
  add(node, AnimationPath::scale, interpolation, 3, std::move(times), values);
}

void AnimationBuilder::rotation(int node, Interpolation interpolation, std::span<const Key<glm::quat>> keys) {
  std::vector<float> times, values;
  glm::quat last{1, 0, 0, 0};
  flatten(keys, times, values, [&](glm::quat q, std::vector<float>& out) {
    // Neighbours in the same hemisphere, so that splines of the components take the short way.
    last = glm::dot(q, last) < 0 ? -q : q;
    out.insert(out.end(), {last.x, last.y, last.z, last.w});
  });
  add(node, AnimationPath::rotation, interpolation, 4, std::move(times), values);
}

void AnimationBuilder::weights(int node, Interpolation interpolation, std::span<const Key<std::vector<float>>> keys) {
  std::vector<float> times, values;
  flatten(keys, times, values,
          [](const std::vector<float>& w, std::vector<float>& out) { out.insert(out.end(), w.begin(), w.end()); });
  add(node, AnimationPath::weights, interpolation, static_cast<int>(keys.front().value.size()), std::move(times),
      values);
}

void AnimationBuilder::sampledTranslation(int node, float duration, int count,
                                          const std::function<glm::vec3(float)>& at) {
  std::vector<Key<glm::vec3>> keys;
  for (int i = 0; i <= count; ++i) {
    const float time = duration * static_cast<float>(i) / static_cast<float>(count);
    keys.push_back({time, at(time)});
  }
  translation(node, Interpolation::linear, keys);
}

void AnimationBuilder::sampledRotation(int node, float duration, int count, const std::function<glm::quat(float)>& at) {
  std::vector<Key<glm::quat>> keys;
  for (int i = 0; i <= count; ++i) {
    const float time = duration * static_cast<float>(i) / static_cast<float>(count);
    keys.push_back({time, at(time)});
  }
  rotation(node, Interpolation::linear, keys);
}

Animation AnimationBuilder::finish() { return std::move(animation_); }

}  // namespace rigel::tools
