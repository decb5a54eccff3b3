#include "samples/walk.h"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace rigel::tools {
namespace {

using J = FigureJoint;

constexpr float kStance = 0.6f;      // share of a cycle that a foot is on the ground
constexpr float kSwingLift = 0.1f;   // m, of the ankle in mid swing
constexpr float kHeelRise = 0.055f;  // m, of the ankle as the foot leaves the ground

/// Rotation by angles [degrees] about x, then y, then z.
glm::quat turn(float x, float y, float z) {
  return glm::angleAxis(glm::radians(z), glm::vec3(0, 0, 1)) * glm::angleAxis(glm::radians(y), glm::vec3(0, 1, 0)) *
         glm::angleAxis(glm::radians(x), glm::vec3(1, 0, 0));
}

/// Where an ankle is in its cycle, relative to where it stands at rest below the moving hips, and the foot's pitch
/// [rad], toes down positive. `phase` in cycles; the foot is set down at 0.
struct Step {
  float ahead = 0, up = 0, pitch = 0;
};

Step stepAt(float phase, float stride) {
  phase -= std::floor(phase);
  if (phase < kStance) {
    const float s = phase / kStance;
    const float heel = s > 0.6f ? (s - 0.6f) / 0.4f : 0.0f;
    return {stride * (0.5f - s), kHeelRise * heel * heel, 0.5f * heel * heel};
  }
  const float s = (phase - kStance) / (1 - kStance);
  // Cubic from -stride/2 to stride/2 that leaves and meets the ground at the ground's own speed.
  const float slope = -stride * (1 - kStance) / kStance;
  const float ahead = stride * (-0.5f + s * s * (3 - 2 * s)) + slope * s * (1 - s) * (1 - 2 * s);
  const float arc = std::sin(glm::pi<float>() * s);
  return {ahead, kHeelRise * (1 - s) * (1 - s) + kSwingLift * arc * arc, 0.5f * (1 - s) * (1 - s) - 0.25f * arc * s};
}

/// A limb of two segments in the plane of y and z: lengths, and angles from -y towards +z at rest.
struct Leg {
  float upper = 0, lower = 0, upperRest = 0, lowerRest = 0;
  glm::vec2 ankle;  // at rest, from the hip: (ahead, down)

  Leg(glm::vec3 knee, glm::vec3 foot)
      : upper(std::hypot(knee.y, knee.z)),
        lower(std::hypot(foot.y, foot.z)),
        upperRest(std::atan2(knee.z, -knee.y)),
        lowerRest(std::atan2(foot.z, -foot.y)),
        ankle(knee.z + foot.z, -knee.y - foot.y) {}

  /// Angles of both segments that put the ankle at (ahead, down) of the hip, the knee in front.
  glm::vec2 solve(glm::vec2 to) const {
    constexpr float kMostReach = 0.9995f;  // of the leg: a knee that stretches fully snaps
    const float reach = std::min(glm::length(to), kMostReach * (upper + lower));
    const float direction = std::atan2(to.x, to.y);
    const float knee =
        std::acos(std::clamp((upper * upper + reach * reach - lower * lower) / (2 * upper * reach), -1.0f, 1.0f));
    const float foot =
        std::acos(std::clamp((lower * lower + reach * reach - upper * upper) / (2 * lower * reach), -1.0f, 1.0f));
    return {direction + knee, direction - foot};
  }
};

}  // namespace

void addWalk(AnimationBuilder& animation, const Scene& scene, const Figure& figure, const Walk& walk) {
  const int count = static_cast<int>(std::lround(walk.duration * 30));
  const auto joint = [&](int index) { return figure.skeleton.joints[index]; };
  const auto rotation = [&](int index, const std::function<glm::quat(float)>& at) {
    animation.sampledRotation(joint(index), walk.duration, count, at);
  };
  const auto wave = [&](float time, float shift) {  // 1 when the left foot is farthest ahead
    return std::cos(glm::two_pi<float>() * (time / walk.cycle + shift));
  };
  // Lowest with both feet on the ground, twice a cycle.
  const auto drop = [&](float time) {
    return walk.crouch + 0.014f * std::cos(2 * glm::two_pi<float>() * time / walk.cycle);
  };
  const glm::vec3 hips = scene.nodes[joint(J::hips)].translation;
  animation.sampledTranslation(joint(J::hips), walk.duration, count, [&](float t) {
    return walk.start + hips + glm::vec3(0.018f * wave(t, -0.3f), -drop(t), walk.speed * t);
  });

  const float stride = walk.speed * walk.cycle * kStance;
  for (const int side : {J::left, J::right}) {
    const float shift = side == J::left ? 0.0f : 0.5f;
    const Leg leg(scene.nodes[joint(side + J::shin)].translation, scene.nodes[joint(side + J::foot)].translation);
    const auto stepOf = [=](float t) { return stepAt(t / walk.cycle + shift, stride); };
    const auto anglesOf = [=](float t) {
      const Step step = stepOf(t);
      return leg.solve(leg.ankle + glm::vec2(step.ahead, -drop(t) - step.up));
    };
    // A turn about +x swings what hangs down backwards.
    const auto about = [](float angle) { return glm::angleAxis(angle, glm::vec3(1, 0, 0)); };
    rotation(side + J::thigh, [=](float t) { return about(leg.upperRest - anglesOf(t).x); });
    rotation(side + J::shin, [=](float t) {
      const glm::vec2 angles = anglesOf(t);
      return about((leg.lowerRest - angles.y) - (leg.upperRest - angles.x));
    });
    rotation(side + J::foot, [=](float t) { return about(stepOf(t).pitch - (leg.lowerRest - anglesOf(t).y)); });

    const float outwards = side == J::left ? 1.0f : -1.0f;
    const auto swing = [=](float t) { return -wave(t, shift); };  // arms go against the legs
    rotation(side + J::upperArm, [=](float t) { return turn(4 - 20 * swing(t), 0, outwards * -32.0f); });
    rotation(side + J::forearm, [=](float t) { return turn(-18 - 12 * swing(t), outwards * -8.0f, 0); });
    rotation(side + J::fingers, [=](float) { return turn(0, 0, outwards * -20.0f); });
  }
  rotation(J::spine, [&](float t) { return turn(2, -4 * wave(t, 0), 0); });
  rotation(J::chest, [&](float t) { return turn(1, 9 * wave(t, 0), 0); });
  rotation(J::neck, [&](float t) { return turn(-1, -3 * wave(t, 0), 0); });
  rotation(J::head, [&](float t) { return turn(-2, -2 * wave(t, 0), 0); });
}

}  // namespace rigel::tools
