#include "scene/animation.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rigel::tools {
namespace {

// Where `time` falls: between keys `key` and `key + 1`, a fraction `u` in [0, 1) of the way, or exactly on `key`.
struct KeyPosition {
  std::size_t key = 0;
  double u = 0;
  double span = 0;
};

KeyPosition locate(const std::vector<float>& times, double time) noexcept {
  if (!(time > times.front())) return {};
  if (time >= times.back()) return {times.size() - 1, 0, 0};
  const auto next = std::upper_bound(times.begin(), times.end(), time, [](double t, float key) { return t < key; });
  const auto key = static_cast<std::size_t>(next - times.begin()) - 1;
  const double span = static_cast<double>(times[key + 1]) - times[key];
  return {key, (time - times[key]) / span, span};
}

glm::dquat readQuat(const float* q) noexcept { return {q[3], q[0], q[1], q[2]}; }

glm::dquat normalized(const glm::dquat& q) noexcept {
  const double norm = glm::length(q);
  return norm > 0 ? q / norm : glm::dquat(1, 0, 0, 0);
}

void writeQuat(const glm::dquat& q, float* out) noexcept {
  const glm::dquat unit = normalized(q);
  out[0] = static_cast<float>(unit.x);
  out[1] = static_cast<float>(unit.y);
  out[2] = static_cast<float>(unit.z);
  out[3] = static_cast<float>(unit.w);
}

// The angle comes from chords, which stays exact where the dot product is near 1.
glm::dquat slerpShortest(const glm::dquat& a, glm::dquat b, double u) noexcept {
  if (glm::dot(a, b) < 0) b = -b;
  const double angle = 2 * std::atan2(glm::length(a - b), glm::length(a + b));
  const double s = std::sin(angle);
  if (s < 1e-9) return a * (1 - u) + b * u;
  return a * (std::sin((1 - u) * angle) / s) + b * (std::sin(u * angle) / s);
}

// Hermite weights of value, out-tangent, next value, next in-tangent.
struct Hermite {
  double p0, m0, p1, m1;
  Hermite(double u, double span) noexcept
      : p0((1 + 2 * u) * (1 - u) * (1 - u)),
        m0(span * u * (1 - u) * (1 - u)),
        p1(u * u * (3 - 2 * u)),
        m1(span * u * u * (u - 1)) {}
};

}  // namespace

void sampleChannel(const Channel& channel, double time, float* out) noexcept {
  const auto width = static_cast<std::size_t>(channel.width);
  const bool cubic = channel.interpolation == Interpolation::cubicSpline;
  const std::size_t stride = cubic ? 3 * width : width;
  assert(!channel.times.empty() && channel.values.size() == channel.times.size() * stride);

  const KeyPosition at = locate(channel.times, time);
  const float* value = channel.values.data() + at.key * stride + (cubic ? width : 0);
  const bool rotation = channel.path == AnimationPath::rotation;
  const bool onKey = at.u == 0 || channel.interpolation == Interpolation::step;
  if (onKey) {
    std::copy_n(value, width, out);
  } else if (cubic) {
    const Hermite h(at.u, at.span);
    const float* outTangent = value + width;
    const float* nextIn = value + 2 * width;
    const float* next = value + 3 * width;
    for (std::size_t i = 0; i < width; ++i) {
      out[i] = static_cast<float>(h.p0 * value[i] + h.m0 * outTangent[i] + h.p1 * next[i] + h.m1 * nextIn[i]);
    }
  } else if (rotation) {
    writeQuat(slerpShortest(normalized(readQuat(value)), normalized(readQuat(value + width)), at.u), out);
    return;
  } else {
    const float* next = value + width;
    for (std::size_t i = 0; i < width; ++i) out[i] = static_cast<float>(value[i] + at.u * (double(next[i]) - value[i]));
  }
  if (rotation) writeQuat(readQuat(out), out);
}

}  // namespace rigel::tools
