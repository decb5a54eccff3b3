// Fitting a rig to a frame's lights, and evaluating the fitted rig.
#pragma once

#include <rigel/project.h>
#include <rigel/project_batch.h>
#include <rigel/rig.h>
#include <rigel/sh_batch.h>
#include <rigel/wrap.h>

#include <algorithm>
#include <cassert>

namespace rigel {

/// Orthonormal placement of the rig frame in the world: columns x, y, z and origin. world = x*p.x + y*p.y + z*p.z +
/// origin.
struct RigFrame {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  Vec3 origin;

  Vec3 vector(Vec3 v) const noexcept { return x * v.x + y * v.y + z * v.z; }
  Vec3 point(Vec3 p) const noexcept { return vector(p) + origin; }
  /// The inverse of `point`; the columns must be orthonormal.
  Vec3 inversePoint(Vec3 w) const noexcept {
    const Vec3 d = w - origin;
    return {dot(x, d), dot(y, d), dot(z, d)};
  }
};

/// F_s: projects `lights` into every sample of the rig's current pose. `functionals` has rig.projections() entries.
/// Cost: lights x samples projections. Allocates nothing.
template <int B>
void projectSamples(const Rig& rig, const RigFrame& worldFromRig, const LightSet& lights,
                    std::span<RadianceSH<B>> functionals) noexcept {
  assert(functionals.size() == static_cast<std::size_t>(rig.projections()));
  auto out = functionals.begin();
  for (const RigSample& sample : rig.samples()) {
    const Vec3 p = worldFromRig.point(sample.position);
    if (sample.derivatives == 0) {
      *out++ = project<B>(lights, p, sample.footprint);
      continue;
    }
    const ProjectionWithGradient<B> projected = projectWithGradient<B>(lights, p);
    *out++ = projected.value;
    for (int i = 0; i < sample.derivatives; ++i) {
      const Vec3 direction = worldFromRig.vector(sample.directions[i]);
      RadianceSH<B> along = projected.gradient.d[0] * direction.x;
      along += projected.gradient.d[1] * direction.y;
      along += projected.gradient.d[2] * direction.z;
      *out++ = along;
    }
  }
}

namespace detail {

/// Samples of one sort, all with derivatives or all without, from `first` on, in the world; as many as fit.
struct SampleBatch {
  static constexpr std::size_t kMost = 32;
  float x[kMost], y[kMost], z[kMost], footprint[kMost];
  std::size_t count = 0;
  bool derivatives = false, footprints = false;

  SampleBatch(std::span<const RigSample> samples, std::size_t first, const RigFrame& worldFromRig) noexcept
      : derivatives(samples[first].derivatives > 0) {
    for (; count < kMost && first + count < samples.size(); ++count) {
      const RigSample& sample = samples[first + count];
      if ((sample.derivatives > 0) != derivatives) break;
      const Vec3 p = worldFromRig.point(sample.position);
      x[count] = p.x;
      y[count] = p.y;
      z[count] = p.z;
      footprint[count] = sample.footprint;
      footprints = footprints || sample.footprint > 0;
    }
  }
  Vec3Rows rows() const noexcept { return {{x, count}, {y, count}, {z, count}}; }
};

/// Sums of one point: 3 B^2 numbers that are `stride` apart.
template <int B>
RadianceSH<B> shFromRows(const float* sums, std::size_t stride) noexcept {
  RadianceSH<B> sh;
  for (int i = 0; i < 3 * shCount(B); ++i) sh.data()[i] = sums[static_cast<std::size_t>(i) * stride];
  return sh;
}

}  // namespace detail

/// The same in vectors (project_batch.h), of the lights in `uses`: some thirty times as fast.
template <int B>
void projectSamples(const Rig& rig, const RigFrame& worldFromRig, const PreparedLights& lights,
                    std::span<const LightUse> uses, std::span<RadianceSH<B>> functionals) noexcept {
  assert(functionals.size() == static_cast<std::size_t>(rig.projections()));
  constexpr std::size_t kRows = 3 * shCount(B);
  const std::span<const RigSample> samples = rig.samples();
  float sums[4 * kRows * detail::SampleBatch::kMost];
  auto out = functionals.begin();
  for (std::size_t first = 0; first < samples.size();) {
    const detail::SampleBatch batch(samples, first, worldFromRig);
    const std::size_t n = batch.count;
    if (batch.derivatives) {
      projectBatchWithGradient<B>(lights, uses, batch.rows(), {sums, 4 * kRows * n});
    } else {
      const auto footprints = batch.footprints ? std::span(batch.footprint, n) : std::span<const float>();
      projectBatch<B>(lights, uses, batch.rows(), footprints, {sums, kRows * n});
    }
    for (std::size_t k = 0; k < n; ++k, ++first) {
      *out++ = detail::shFromRows<B>(sums + k, n);
      for (int i = 0; i < samples[first].derivatives; ++i) {
        const Vec3 direction = worldFromRig.vector(samples[first].directions[i]);
        RadianceSH<B> along = detail::shFromRows<B>(sums + kRows * n + k, n) * direction.x;
        along += detail::shFromRows<B>(sums + 2 * kRows * n + k, n) * direction.y;
        along += detail::shFromRows<B>(sums + 3 * kRows * n + k, n) * direction.z;
        *out++ = along;
      }
    }
  }
}

/// Rig::adapt on typed vectors: for `invquad` rigs, between projectSamples and fitRig.
template <int B>
void adaptRig(Rig& rig, std::span<const RadianceSH<B>> functionals) noexcept {
  constexpr int kWidth = 3 * shCount(B);
  static_assert(sizeof(RadianceSH<B>) == kWidth * sizeof(float));
  assert(!functionals.empty());
  rig.adapt({functionals.front().data(), functionals.size() * kWidth}, kWidth);
}

/// c = P F on typed vectors: rig.projections() functionals, rig.shVectors() coefficients, not overlapping.
template <int B>
void fitRig(const Rig& rig, std::span<const RadianceSH<B>> functionals,
            std::span<RadianceSH<B>> coefficients) noexcept {
  constexpr int kWidth = 3 * shCount(B);
  static_assert(sizeof(RadianceSH<B>) == kWidth * sizeof(float));
  assert(!functionals.empty() && !coefficients.empty());
  rig.fit({functionals.front().data(), functionals.size() * kWidth}, kWidth,
          {coefficients.front().data(), coefficients.size() * kWidth});
}

/// Radiance SH at `p` (rig frame): sum_k phi_k(p) c_k.
template <int B>
RadianceSH<B> evaluateRig(const Rig& rig, std::span<const RadianceSH<B>> coefficients, Vec3 p) noexcept {
  RigBasis basis;
  rig.basis(p, basis);
  RadianceSH<B> sum;
  float* out = sum.data();
  for (int j = 0; j < basis.count; ++j) {
    const float* c = coefficients[basis.index[j]].data();
    for (int i = 0; i < 3 * shCount(B); ++i) out[i] += basis.value[j] * c[i];
  }
  return sum;
}

/// E(n) = pi sum_l f_l sum_m L_lm Y_lm(n) [W/m2], not clamped. `wrapCoefficients` are f_l(a); n is unit, world.
template <int B>
Rgb irradiance(const RadianceSH<B>& radiance, const std::array<float, B>& wrapCoefficients, Vec3 n) noexcept {
  float y[shCount(B)];
  shBasis<B>(n, y);
  Rgb sum;
  for (int l = 0; l < B; ++l) {
    Rgb band;
    for (int i = l * l; i < (l + 1) * (l + 1); ++i) band += radiance[i] * y[i];
    sum += band * wrapCoefficients[l];
  }
  return sum * static_cast<float>(kPi);
}

/// Irradiance of a rig that is fitted, at points and unit normals of the world, in vectors (sh_batch.h): row c of
/// `irradiance` (points.size() numbers) is its colour c, not clamped. `coefficients`: c_k, or the first of them where
/// the others are 0. To rounding what `irradiance(evaluateRig(...))` gives, point after point where a rig has more than
/// kMaxShBatch coefficients. Allocates nothing.
template <int B>
void irradianceBatch(const Rig& rig, const RigFrame& worldFromRig, std::span<const RadianceSH<B>> coefficients,
                     const std::array<float, B>& wrapCoefficients, const Vec3Rows& points, const Vec3Rows& normals,
                     std::span<float> irradiance) noexcept;

}  // namespace rigel
