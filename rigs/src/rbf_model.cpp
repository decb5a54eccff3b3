#include "rbf_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rigel {
namespace {

constexpr float kWidth = 2.5f;  // of a Gaussian, in spacings of the centres

float squaredDistance(Vec3 a, Vec3 b) noexcept { return dot(a - b, a - b); }

}  // namespace

Rig::RbfModel::RbfModel(RigSpec s, const RigShape& rest, const Anchors& chosen)
    : Model(std::move(s)), centres_(spec.terms), surfaceFit_(*this, chosen, std::vector<double>(spec.terms, 1)) {
  std::vector<Vec3> points;
  for (int i : chosen.index) points.push_back(rest.surface[i]);
  // Fewer where points coincide: some centres are then there twice, and share what one would have.
  const std::vector<int> medoids = chooseAnchors(points, spec.terms).index;
  distinct_ = medoids.size();
  for (std::size_t k = 0; k < centres_.size(); ++k) centreAnchors_.push_back(medoids[k % medoids.size()]);
}

/// Box coordinates, but in the proportions of the box.
Vec3 Rig::RbfModel::place(Vec3 p) const noexcept {
  Vec3 u = box_(p);
  for (int a = 0; a < 3; ++a) u[a] = std::clamp(u[a], -1.0f, 1.0f) * aspect_[a];
  return u;
}

/// Mean square of the distance from a centre to the next.
float Rig::RbfModel::squaredSpacing() const noexcept {
  if (distinct_ < 2) return 0;
  float sum = 0;
  for (std::size_t k = 0; k < distinct_; ++k) {
    float nearest = std::numeric_limits<float>::max();
    for (std::size_t j = 0; j < distinct_; ++j)
      if (j != k) nearest = std::min(nearest, squaredDistance(centres_[k], centres_[j]));
    sum += nearest;
  }
  return sum / static_cast<float>(distinct_);
}

void Rig::RbfModel::setPose(const RigPose& pose) noexcept {
  box_ = BoxCoordinates(pose.box);
  const float largest = std::max({box_.half.x, box_.half.y, box_.half.z});
  for (int a = 0; a < 3; ++a) aspect_[a] = largest > 0 ? box_.half[a] / largest : 0;
  for (std::size_t k = 0; k < centres_.size(); ++k) centres_[k] = place(pose.anchors[centreAnchors_[k]]);
  const float square = kWidth * kWidth * squaredSpacing();
  constexpr float kLeast = 1e-12f;  // of the box
  inverseSquaredWidth_ = square > kLeast ? 1 / square : 0;
  surfaceFit_.setPose(*this, pose);
}

void Rig::RbfModel::basis(Vec3 p, RigBasis& out) const noexcept {
  const Vec3 at = place(p);
  out.count = spec.terms;
  float nearest = std::numeric_limits<float>::max();
  for (int k = 0; k < out.count; ++k) {
    out.index[k] = k;
    out.value[k] = inverseSquaredWidth_ * squaredDistance(at, centres_[k]);
    nearest = std::min(nearest, out.value[k]);
  }
  // Relative to the largest, so that not all are 0 far from every centre.
  float sum = 0;
  for (int k = 0; k < out.count; ++k) sum += out.value[k] = std::exp(nearest - out.value[k]);
  for (int k = 0; k < out.count; ++k) out.value[k] /= sum;
}

}  // namespace rigel
