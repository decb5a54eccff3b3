#include "bench/people.h"

#include <algorithm>
#include <array>

namespace rigel::tools {
namespace {

constexpr int kJoints = 60;

/// A skeleton as games have them: 24 joints in trunk, head and limbs, 18 in each hand.
std::vector<Vec3> joints() {
  std::vector<Vec3> places;
  for (int i = 0; i < 24; ++i) {
    const float t = static_cast<float>(i / 3) / 7, side = static_cast<float>(i % 3 - 1);
    places.push_back({0.2f * side, 1.6f * t - 0.8f, 0});
  }
  for (int i = 0; i < 36; ++i) {
    const float side = i < 18 ? -1.0f : 1.0f, finger = static_cast<float>(i % 18);
    places.push_back({side * (0.28f + 0.005f * finger), -0.05f, 0.01f * finger});
  }
  return places;
}

/// The four nearest joints of each point, by the inverse square of the distance.
std::vector<SkinWeights> skinOf(const std::vector<Vec3>& surface) {
  const std::vector<Vec3> places = joints();
  std::vector<SkinWeights> skin;
  for (const Vec3 p : surface) {
    std::array<std::uint16_t, kJoints> order;
    for (int j = 0; j < kJoints; ++j) order[j] = static_cast<std::uint16_t>(j);
    const auto distance = [&](std::uint16_t j) { return length(places[j] - p); };
    std::ranges::partial_sort(order, order.begin() + 4, {}, distance);
    SkinWeights weights;
    float sum = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      weights.joint[i] = order[i];
      weights.weight[i] = 1 / (0.001f + distance(order[i]) * distance(order[i]));
      sum += weights.weight[i];
    }
    for (float& w : weights.weight) w /= sum;
    skin.push_back(weights);
  }
  return skin;
}

/// About the vertical.
RigFrame turned(float angle, Vec3 origin) {
  const float c = std::cos(angle), s = std::sin(angle);
  return {{c, 0, -s}, {0, 1, 0}, {s, 0, c}, origin};
}

}  // namespace

/// In a square, two metres apart on average, each in a pose of its own, and lamps over it.
People::People(int people, int lamps, int tasks, bool largePages)
    : crowd_(tasks),
      palettes_(static_cast<std::size_t>(people * kJoints), LargePages<JointMatrix>(largePages)),
      rigs_(LargePages<GpuRig>(largePages)),
      coefficients_(LargePages<GpuVec4>(largePages)),
      near_(LargePages<GpuNearLight>(largePages)) {
  const std::vector<Vec3> surface = bodySurface();
  const std::vector<SkinWeights> skin = skinOf(surface);
  const RigBox box{{-0.3f, -0.9f, -0.2f}, {0.3f, 0.9f, 0.2f}};
  const auto shape = *CrowdKind::create(*parseRigSpec("poly:6"), {{box, surface}, skin});
  const int kind = crowd_.addKind(shape);
  empty_.input(empty_.add(empty_.addKind(shape))).visible = false;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(0, 1);
  const float side = 2 * std::sqrt(static_cast<float>(people));
  for (int i = 0; i < people; ++i) {
    ids_.push_back(crowd_.add(kind));
    CrowdInput& input = crowd_.input(ids_.back());
    input.worldFromRig = turned(6 * unit(random), {side * unit(random), 0.9f, side * unit(random)});
    input.palette = std::span(palettes_).subspan(static_cast<std::size_t>(i * kJoints), kJoints);
  }
  for (JointMatrix& joint : palettes_) {
    const RigFrame turn = turned(0.3f * unit(random), {});
    for (int a = 0; a < 3; ++a) {
      joint.m[a][0] = turn.x[a];
      joint.m[a][2] = turn.z[a];
      joint.m[a][3] = 0.05f * unit(random);
    }
  }
  for (int i = 0; i < lamps; ++i)
    lights_.add(SphereLight{{side * unit(random), 2.5f + 2 * unit(random), side * unit(random)}, 0.1f, {30, 20, 10}});
  const CrowdOutputBound bound = crowd_.outputBound();
  rigs_.resize(bound.rigs);
  coefficients_.resize(bound.coefficients);
  near_.resize(bound.nearLights);
}

void People::frameOfLights() {
  prepared_.set(lights_);
  empty_.frame({&lights_, &prepared_, {}}, 1.0f / 60, {rigs_, coefficients_, {}, near_});
}

void People::projectOnly() {
  constexpr std::size_t kPack = 16, kSamples = 12;
  prepared_.set(lights_);
  for (std::size_t first = 0; first < ids_.size(); first += kPack) {
    const std::size_t people = std::min(kPack, ids_.size() - first), points = people * kSamples;
    for (std::size_t i = 0; i < points; ++i) {
      const Vec3 p = crowd_.input(ids_[first + i % people]).worldFromRig.origin;
      const float step = static_cast<float>(i / people) / kSamples;
      x_[i] = p.x + 0.3f * step;
      y_[i] = p.y + 1.8f * step - 0.9f;
      z_[i] = p.z;
      footprint_[i] = 0.15f;
    }
    const auto rows = [&](const float* row) { return std::span(row, points); };
    projectBatch<3>(prepared_, prepared_.all(), {rows(x_), rows(y_), rows(z_)}, rows(footprint_), {sums_, 27 * points});
  }
}

}  // namespace rigel::tools
