#include "surface_check.h"

#include <algorithm>
#include <cmath>

#include "anchors.h"
#include "weights.h"

namespace rigel {
namespace {

constexpr std::size_t kPoints = 24;
constexpr std::size_t kTruncationEvery = 3;  // the high bands vary less over an object, and cost more to project
// Square of the height over the patch radius that a light of no size is taken to pass a patch at, when it is close.
constexpr float kLeastHeight = 0.0025f;

/// Lambert has nothing in band 3; on materials that wrap, band 3 is the larger.
int highBandOf(float wrap) noexcept { return wrap > 0 ? 3 : 4; }

/// How much of a patch of radius rho, d away, a cone may light: the area of its circle, 0 where it misses the patch.
float coneOnPatch(const SpotLight& light, Vec3 patch, float d, float rho) noexcept {
  const float axis = length(light.direction);
  if (!(axis > 0)) return 0;
  const float cosine = d > 0 ? dot(light.direction, patch - light.position) / (axis * d) : 1.0f;
  const float angle = std::acos(std::clamp(cosine, -1.0f, 1.0f));
  const float seen = d > rho ? std::asin(rho / d) : static_cast<float>(kPi / 2);
  const float t = light.outerAngle < static_cast<float>(kPi / 4) ? std::tan(light.outerAngle) : 1.0f;
  return smoothstep((light.outerAngle + seen - angle) / std::max(seen, 1e-6f)) * t * t;
}

/// How much of a patch of radius rho lies before a disk: 0 where it is all behind.
float patchBefore(const DiskLight& light, Vec3 patch, float rho) noexcept {
  const float axis = length(light.direction);
  if (!(axis > 0)) return 0;
  const float height = dot(light.direction, patch - light.position) / axis;
  return smoothstep(((light.twoSided ? std::abs(height) : height) / rho + 1) / 2);
}

/// The same disk, turned to the point, or as it is where it is there.
DiskLight turnedTo(DiskLight light, Vec3 point) noexcept {
  const Vec3 towards = point - light.position;
  const float distance = length(towards);
  if (distance > 0) light.direction = towards * (1 / distance);
  return light;
}

}  // namespace

template <int B>
SurfaceCheck<B>::SurfaceCheck(const Rig& rig, const RigShape& rest, float wrap, bool truncation)
    : functionals_(rig.projections()), coefficients_(rig.shVectors()) {
  own_ = rig.spec().adaptive || rig.anchors().size() >= kPoints;
  if (own_) {
    for (const RigSample& sample : rig.samples()) points_.push_back({{}, sample.share, sample.footprint});
  } else {
    Anchors chosen = chooseAnchors(rest.surface, kPoints);
    for (std::size_t i = 0; i < chosen.index.size(); ++i) points_.push_back({{}, chosen.share[i], chosen.radius[i]});
    extraAnchors_ = std::move(chosen.index);
  }
  for (const Point& point : points_) shares_.push_back(point.share);
  if (rig.spec().adaptive) nested_.emplace(static_cast<int>(points_.size()), rig.shVectors());
  values_.resize(points_.size() * kStride);

  rows.nested = nested_ ? nested_->functions() : 0;
  rows.residuals = static_cast<int>(points_.size());
  rows.width = kStride;
  if (own_ && !nested_)
    rows.inflation = inflation(static_cast<float>(points_.size()), static_cast<float>(rig.shVectors()));
  setUpScales(wrap, truncation);
  setUpRows();
}

template <int B>
void SurfaceCheck<B>::setUpRows() {
  whole_ = static_cast<std::size_t>(rows.truncatedRows);
  const std::size_t count = points_.size();
  for (auto* row : {&x_, &y_, &z_, &footprints_}) row->resize(count);
  rowOf_.resize(count);
  std::size_t others = whole_;
  for (std::size_t i = 0; i < count; ++i) {
    const bool isWhole = whole_ > 0 && i % kTruncationEvery == 0;
    rowOf_[i] = isWhole ? i / kTruncationEvery : others++;
    footprints_[rowOf_[i]] = points_[i].footprint;
  }
  sums_.resize(kWidth * count);
  wholeSums_.resize(3 * shCount(kMaxBands) * whole_);
}

/// Factors from SH coefficients to RMS irradiance: E(n) = pi sum f_l L_lm Y_lm(n) has the mean square
/// sum (pi f_l L_lm)^2 / 4pi over normals.
template <int B>
void SurfaceCheck<B>::setUpScales(float wrap, bool truncation) {
  const std::array<float, kMaxBands> f = wrapCoefficients<kMaxBands>(wrap);
  const auto squared = [&](int l) { return kPi * static_cast<double>(f[l]) * static_cast<double>(f[l]) / 4 / 3; };
  constexpr double kY00 = 0.28209479177387814;
  meanPerL00_ = static_cast<float>(kPi * kY00 / 3) * f[0];
  rows.weight.assign(kStride, 0.0f);
  for (int l = 0; l < B; ++l)
    for (int i = 3 * shCount(l); i < 3 * shCount(l + 1); ++i) rows.weight[i] = static_cast<float>(squared(l));

  if (!truncation) return;
  rows.truncatedRows = static_cast<int>((points_.size() + kTruncationEvery - 1) / kTruncationEvery);
  rows.truncated = rows.truncatedRows * kTruncatedWidth;
  truncationScale_.resize(kTruncatedWidth);
  // Energy of a distant light's kernel, int f^2 dx = (1+a)/(3+2a) = sum (2l+1) f_l^2 / 8: what of it is in the bands
  // that are projected, and all that the rig's bands leave out.
  const auto energy = [&](int l) { return (2 * l + 1) * static_cast<double>(f[l]) * static_cast<double>(f[l]) / 8; };
  double projected = 0;
  for (int l = kFirstTruncated; l < kMaxBands; ++l) {
    projected += energy(l);
    for (int i = 3 * shCount(l); i < 3 * shCount(l + 1); ++i)
      truncationScale_[i - 3 * shCount(kFirstTruncated)] =
          static_cast<float>(std::sqrt(squared(l) / rows.truncatedRows));
  }
  const int band = highBandOf(wrap);
  if (band >= B) {
    rows.highFirst = 3 * (shCount(band) - shCount(kFirstTruncated));
    rows.highCount = 3 * (2 * band + 1);
  }
  const double a = static_cast<double>(clampWrap(wrap));
  double lost = (1 + a) / (3 + 2 * a);
  for (int l = 0; l < B; ++l) lost -= energy(l);
  rows.tail = projected > 1e-9 ? static_cast<float>(std::max(0.0, lost) / projected) : 0;
}

template <int B>
void SurfaceCheck<B>::place(std::span<const Vec3> anchors, const RigFrame& worldFromRig) noexcept {
  frame_ = worldFromRig;
  const auto posed = anchors.last(points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Vec3 p = points_[i].position = frame_.point(posed[i]);
    x_[rowOf_[i]] = p.x;
    y_[rowOf_[i]] = p.y;
    z_[rowOf_[i]] = p.z;
  }
}

template <int B>
void SurfaceCheck<B>::setPose(const Rig& rig, std::span<const Vec3> anchors) noexcept {
  if (!nested_) return;
  const auto posed = anchors.last(points_.size());
  RigBasis phi;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const auto row = nested_->row(static_cast<int>(i));
    rig.basis(posed[i], phi);
    std::ranges::fill(row, 0.0);
    for (int j = 0; j < phi.count; ++j) row[phi.index[j]] = static_cast<double>(phi.value[j]);
  }
  nested_->factor(shares_);
}

template <int B>
void SurfaceCheck<B>::reserve(int lights) {
  prepared_.reserve(lights);
}

/// Fills the sums: B bands at all points, and all bands at those where they are wanted.
template <int B>
void SurfaceCheck<B>::projectAtPoints(const LightSet& lights) {
  prepared_.set(lights);
  projectBatch<B>(prepared_, prepared_.all(), {x_, y_, z_}, footprints_, sums_);
  if (whole_ == 0) return;
  const auto first = [&](const std::vector<float>& row) { return std::span<const float>(row).first(whole_); };
  projectBatch<kMaxBands>(prepared_, prepared_.all(), {first(x_), first(y_), first(z_)}, first(footprints_),
                          wholeSums_);
}

template <int B>
float SurfaceCheck<B>::describe(const LightSet& lights, Rig& rig, int index) {
  float* block = rows.fields.data() + static_cast<std::size_t>(index) * rows.block();
  float* residuals = block + static_cast<std::size_t>(rows.nested) * kStride;
  float* truncated = rows.truncation.data() + static_cast<std::size_t>(index) * rows.truncated;
  projectAtPoints(lights);
  for (std::size_t s = 0; s < whole_; ++s) {
    const float* from = wholeSums_.data() + 3 * shCount(kFirstTruncated) * whole_ + s;
    for (int i = 0; i < kTruncatedWidth; ++i)
      *truncated++ = truncationScale_[i] * from[static_cast<std::size_t>(i) * whole_];
  }
  float mean = 0;
  for (std::size_t s = 0; s < points_.size(); ++s) {
    const float* from = sums_.data() + rowOf_[s];
    mean += points_[s].share * (from[0] + from[points_.size()] + from[2 * points_.size()]);
    const float root = std::sqrt(points_[s].share);
    for (std::size_t i = 0; i < kWidth; ++i) values_[s * kStride + i] = root * from[i * points_.size()];
  }
  if (nested_) {
    nested_->analyse(values_.data(), kStride, block, residuals);
  } else {
    subtractRig(rig, residuals);
  }
  rows.excess[index] = 0;
  for (int i = 0; i < lights.size(); ++i)
    rows.excess[index] += lights.visit(i, [&](const auto& light) { return excessOf(light); });
  return mean * meanPerL00_;
}

template <int B>
void SurfaceCheck<B>::subtractRig(Rig& rig, float* residuals) {
  projectSamples<B>(rig, frame_, prepared_, prepared_.all(), functionals_);
  fitRig<B>(rig, functionals_, coefficients_);
  for (std::size_t s = 0; s < points_.size(); ++s) {
    const RadianceSH<B> sh = evaluateRig<B>(rig, coefficients_, frame_.inversePoint(points_[s].position));
    const float root = std::sqrt(points_[s].share);
    for (int i = 0; i < kWidth; ++i) residuals[s * kStride + i] = values_[s * kStride + i] - root * sh.data()[i];
  }
}

/// What a light so close that the points are too coarse for it adds to the mean-square error. A patch of radius rho
/// that a light of radius r passes at height h receives a mean square of 1/(h^2 (h^2 + rho^2)) on the light's own
/// scale; its point, d away, knows 1/max(d, rho)^4. How close the surface comes within the patch is not known: h^2 = r
/// d, between touching and as far as the point.
template <int B>
template <class Light>
float SurfaceCheck<B>::excessOf(const Light& light) const noexcept {
  if constexpr (std::is_same_v<Light, DirectionalLight>) {
    return 0;
  } else {
    float sum = 0;
    for (const Point& point : points_) {
      const float rho = point.footprint;
      const float d = length(light.position - point.position);
      if (!(d < 3 * rho)) continue;
      const float r = std::max(light.radius, kMinPointRadius);
      const float apart = smoothstep((d / rho - 1) / 2);
      const float h2 = std::max(std::lerp(std::max(r * d, kLeastHeight * rho * rho), d * d, apart), r * r);
      const float reach = std::max({d, rho, r});
      const auto square = [&](const auto& of) {
        const RadianceSH<B> sh = project<B>(of, point.position, rho);
        float energy = 0;
        for (int i = 0; i < kWidth; ++i) energy += rows.weight[i] * sh.data()[i] * sh.data()[i];
        return energy;
      };
      const float ratio = reach * reach / h2 * (reach * reach / (h2 + rho * rho)) - 1;
      if constexpr (std::is_same_v<Light, SpotLight>) {
        // The circle that it lights may lie between points.
        const PointLight whole{light.position, light.intensity, light.radius, light.range};
        const float met = (1 - apart) * coneOnPatch(light, point.position, d, rho) * (ratio + 1);
        sum += point.share * std::max(0.0f, met * square(whole) - square(light));
      } else if constexpr (std::is_same_v<Light, DiskLight>) {
        // The point may lie behind a disk that lights a part of the patch. One that is larger than the patch lights all
        // of what is before it alike.
        if (!(ratio > 0)) continue;
        const float met = (1 - apart) * patchBefore(light, point.position, rho) * (ratio + 1);
        const float lost = met * square(turnedTo(light, point.position)) - square(light);
        sum += point.share * std::min(ratio, 1.0f) * std::max(0.0f, lost);
      } else if (ratio > 0) {
        sum += point.share * square(light) * ratio;
      }
    }
    return sum;
  }
}

template <int B>
void SurfaceCheck<B>::highBand(std::span<const float> truncated, float weight, HighBand& out) const noexcept {
  out = {};
  if (!(weight > 0) || rows.highCount == 0) return;
  out.band = rows.highCount / 6;
  const int first = rows.highFirst;
  for (int s = 0; s < rows.truncatedRows; ++s) {
    const float* t = truncated.data() + static_cast<std::size_t>(s) * kTruncatedWidth + first;
    for (int i = 0; i < 2 * out.band + 1; ++i)
      for (int c = 0; c < 3; ++c) {
        const float scale = truncationScale_[first + 3 * i + c] * static_cast<float>(rows.truncatedRows);
        if (scale > 0) out.c[i][c] += weight * t[3 * i + c] / scale;
      }
  }
}

template class SurfaceCheck<2>;
template class SurfaceCheck<3>;
template class SurfaceCheck<4>;
template class SurfaceCheck<5>;

}  // namespace rigel
