// A crowd of bending bodies, and what the rig of one of them gives by the classes that it is made of.
#pragma once

#include <rigel/crowd.h>
#include <rigel/light_tree.h>
#include <rigel/near_far.h>

#include <cmath>
#include <random>
#include <thread>
#include <vector>

#include "rig_fixture.h"

namespace rigel::test {

/// Every task on a thread of its own.
inline ParallelFor threadPerTask() {
  ParallelFor threads;
  threads.run = [](void*, int count, ParallelFor::Task task, void* work) {
    std::vector<std::thread> others;
    for (int i = 1; i < count; ++i) others.emplace_back([=] { task(work, i); });
    task(work, 0);
    for (std::thread& other : others) other.join();
  };
  return threads;
}

/// The joint's turn about the z axis at a place, after the body has bent along its height.
inline JointMatrix bent(float angle, Vec3 pivot, Vec3 shift) {
  const float c = std::cos(angle), s = std::sin(angle);
  JointMatrix j;
  const float rows[3][3] = {{c, -s, 0}, {s, c, 0}, {0, 0, 1}};
  for (int r = 0; r < 3; ++r) {
    for (int k = 0; k < 3; ++k) j.m[r][k] = rows[r][k];
    j.m[r][3] = pivot[r] + shift[r] - (rows[r][0] * pivot.x + rows[r][1] * pivot.y + rows[r][2] * pivot.z);
  }
  return j;
}

/// About as large as a person, with a joint each 0.3 m of its height.
struct BendingBody {
  static constexpr int kJoints = 7;
  std::vector<Vec3> surface = ellipsoid({}, {0.3f, 0.9f, 0.2f}, 400);
  std::vector<SkinWeights> skin;
  RigBox box = boxOf(surface);

  BendingBody() {
    for (Vec3 p : surface) {
      const float at = (p.y + 0.9f) / 1.8f * (kJoints - 1);
      const int below = std::min(static_cast<int>(at), kJoints - 2);
      const float above = at - static_cast<float>(below);
      skin.push_back(
          {{static_cast<std::uint16_t>(below), static_cast<std::uint16_t>(below + 1), 0, 0}, {1 - above, above, 0, 0}});
    }
  }
  CrowdShape shape() const { return {{box, surface}, skin}; }
  CrowdShape rigidShape() const { return {{box, surface}, {}}; }

  static std::vector<JointMatrix> palette(float bend) {
    std::vector<JointMatrix> joints;
    for (int j = 0; j < kJoints; ++j) {
      const float t = static_cast<float>(j) / (kJoints - 1);
      joints.push_back(bent(bend * t, {0, -0.9f, 0}, {0.1f * bend * t * t, 0, 0.05f * bend * t}));
    }
    return joints;
  }
  Vec3 posed(int point, std::span<const JointMatrix> palette) const {
    const Vec3 p = surface[point];
    Vec3 sum;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& m = palette[skin[point].joint[i]].m;
      for (int r = 0; r < 3; ++r)
        sum[r] += skin[point].weight[i] * (m[r][0] * p.x + m[r][1] * p.y + m[r][2] * p.z + m[r][3]);
    }
    return sum;
  }
};

inline RigFrame turned(float angle, Vec3 origin) {
  const float c = std::cos(angle), s = std::sin(angle);
  return {{c, 0, -s}, {0, 1, 0}, {s, 0, c}, origin};
}

inline std::shared_ptr<const CrowdKind> kindOf(const std::string& spec, const CrowdShape& shape,
                                               const CrowdKindOptions& options = {}) {
  auto kind = CrowdKind::create(specOf(spec), shape, options);
  EXPECT_TRUE(kind) << (kind ? "" : kind.error().line());
  return kind ? *kind : nullptr;
}

/// A crowd with all that a frame needs.
template <int B>
struct Stage {
  Crowd<B> crowd;
  LightSet lights;
  PreparedLights prepared;
  std::vector<std::uint32_t> ids;
  std::vector<GpuRig> rigs;
  std::vector<GpuVec4> coefficients;
  std::vector<GpuHalf4> halves;
  std::vector<GpuNearLight> near;
  ParallelFor parallel;
  LightTree tree;
  CrowdTree asked{nullptr, 0};  // with a target, of `tree`

  explicit Stage(int tasks = 1) : crowd(tasks) {}

  void makeRoom() {
    const CrowdOutputBound bound = crowd.outputBound();
    rigs.assign(bound.rigs, {});
    coefficients.assign(bound.coefficients, {});
    halves.assign(bound.coefficients, {});
    near.assign(bound.nearLights, {});
  }
  CrowdStats frame(float seconds) {
    prepared.set(lights);
    if (asked.target > 0) {
      tree.update(lights);
      for (const SphereLight& cluster : tree.clusters()) prepared.add(cluster);
      asked.tree = &tree;
    }
    return crowd.frame({&lights, &prepared, ids, asked}, seconds, {rigs, coefficients, halves, near}, parallel);
  }

  const GpuRig& rig(CrowdId id) const { return rigs[static_cast<std::size_t>(crowd.result(id).rig)]; }

  /// Radiance SH at a world point, as shaders sum them up.
  RadianceSH<B> evaluate(CrowdId id, Vec3 p) const {
    const GpuRig& r = rig(id);
    RadianceSH<B> sum;
    const Vec3 d = p - Vec3{r.centre.x, r.centre.y, r.centre.z};
    const auto coordinate = [&](const GpuVec4& a) { return a.x * d.x + a.y * d.y + a.z * d.z + a.w; };
    const Vec3 u{coordinate(r.axisX), coordinate(r.axisY), coordinate(r.axisZ)};
    std::vector<float> phi(static_cast<std::size_t>(r.vectors), 1.0f);
    for (int k = 0; k < r.vectors; ++k) {
      const auto& four = r.terms[k / 16];
      const int term = (k / 4 % 4 == 0   ? four.x
                        : k / 4 % 4 == 1 ? four.y
                        : k / 4 % 4 == 2 ? four.z
                                         : four.w) >>
                       (8 * (k % 4));
      if (k > 0) phi[k] = phi[(term & 0xff) / 4] * u[(term & 0xff) % 4];
      const float* c = &coefficients[static_cast<std::size_t>(r.offset + k * gpuVectorSize(B))].x;
      for (int i = 0; i < 3 * B * B; ++i) sum.data()[i] += phi[k] * c[i] * static_cast<float>(1 / kPi);
    }
    return sum;
  }
};

/// Weights of a character's near lights, per light, from what was packed for shaders.
template <int B>
std::vector<float> weightsOf(const Stage<B>& stage, CrowdId id) {
  std::vector<float> weights(static_cast<std::size_t>(stage.lights.size()));
  const CrowdResult result = stage.crowd.result(id);
  for (int n = 0; n < result.nearCount; ++n) {
    const GpuNearLight& near = stage.near[static_cast<std::size_t>(result.nearOffset + n)];
    bool found = false;
    for (int i = 0; i < stage.lights.size(); ++i) {
      const GpuNearLight whole = stage.lights.visit(i, [](const auto& l) { return gpuNearLight(nearLight(l)); });
      if (whole.position.x != near.position.x || whole.position.y != near.position.y || whole.kind != near.kind)
        continue;
      weights[static_cast<std::size_t>(i)] = near.colour.x / whole.colour.x;
      found = true;
    }
    EXPECT_TRUE(found) << "near light " << n;
  }
  return weights;
}

template <int B>
double distance(const RadianceSH<B>& a, const RadianceSH<B>& b) {
  double square = 0;
  for (int i = 0; i < 3 * B * B; ++i) square += std::pow(static_cast<double>(a.data()[i] - b.data()[i]), 2);
  return std::sqrt(square);
}
template <int B>
double norm(const RadianceSH<B>& a) {
  return distance<B>(a, {});
}

/// Rig, projectSamples and fitRig for one body, with near weights as given.
template <int B>
class SingleBody {
 public:
  SingleBody(const std::string& spec, const BendingBody& body) : body_(body), rig_(rigOf(spec, body.surface)) {}

  void fit(const RigFrame& frame, std::span<const JointMatrix> palette, const LightSet& lights,
           std::span<const float> nearWeights) {
    frame_ = frame;
    std::vector<Vec3> anchors;
    for (const int i : rig_.anchors()) anchors.push_back(palette.empty() ? body_.surface[i] : body_.posed(i, palette));
    RigBox box = boxOf(anchors);
    for (std::size_t i = 0; i < anchors.size(); ++i)
      for (int a = 0; a < 3; ++a) {
        box.lo[a] = std::min(box.lo[a], anchors[i][a] - rig_.samples()[i].footprint);
        box.hi[a] = std::max(box.hi[a], anchors[i][a] + rig_.samples()[i].footprint);
      }
    if (palette.empty()) box = body_.box;
    rig_.setPose({box, anchors});
    LightSet far;
    std::vector<NearLight> near;
    splitLights(lights, nearWeights, far, near);
    std::vector<RadianceSH<B>> functionals(static_cast<std::size_t>(rig_.projections()));
    coefficients_.resize(static_cast<std::size_t>(rig_.shVectors()));
    projectSamples<B>(rig_, frame, far, functionals);
    fitRig<B>(rig_, functionals, coefficients_);
    std::vector<RadianceSH<B>> all(functionals.size());
    projectSamples<B>(rig_, frame, lights, all);
    size_ = 0;
    for (const RadianceSH<B>& f : all) size_ = std::max(size_, norm<B>(f));
  }
  RadianceSH<B> evaluate(Vec3 p) const { return evaluateRig<B>(rig_, coefficients_, frame_.inversePoint(p)); }
  /// Largest norm of what all lights give at a sample.
  double size() const { return size_; }
  double condition() const { return rig_.condition(); }

 private:
  const BendingBody& body_;
  Rig rig_;
  RigFrame frame_;
  std::vector<RadianceSH<B>> coefficients_;
  double size_ = 0;
};

}  // namespace rigel::test
