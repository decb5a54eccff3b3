#include "probed_error.h"

#include <rigel/disk_batch.h>
#include <rigel/project.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rigel {
namespace {

using detail::BoundPlan;
using detail::SamplePlan;

constexpr int kBands = 3, kCoefficients = kBands * kBands;
constexpr int kPoints = SamplePlan::kMaxProbed;

/// SH of a light at samples or probes.
struct Rows {
  alignas(64) std::array<std::array<float, kPoints>, kCoefficients> row;
};

/// Of a sphere light, as large as each point's footprint at least.
void projectSphere(const SamplePlan::Points& points, int count, const LightField& field,
                   const std::array<double, 3>& position, Rows& out) noexcept {
  constexpr auto kY0 = 0.28209479f, kY1 = 0.48860251f, kY2 = 1.0925484f, kY20 = 0.31539157f, kY22 = 0.54627422f;
  const auto x0 = static_cast<float>(position[0]), y0 = static_cast<float>(position[1]),
             z0 = static_cast<float>(position[2]);
  const auto r2 = static_cast<float>(field.radius() * field.radius());
  const auto twice = static_cast<float>(2 * field.power());
  auto& row = out.row;
  for (int i = 0; i < count; ++i) {
    const float dx = x0 - points.x[i], dy = y0 - points.y[i], dz = z0 - points.z[i];
    const float d2 = dx * dx + dy * dy + dz * dz;
    const float size2 = std::max(r2, points.footprint[i] * points.footprint[i]);
    const float scale = twice / size2;  // 2 pi L
    const float ratio = std::min(d2, size2) / std::max(d2, size2);
    const float root = std::sqrt(std::max(0.0f, 1 - ratio));
    const bool inside = d2 < size2;
    const float c = inside ? -root : root;
    const float inverse = 1 / std::sqrt(std::max(d2, 1e-30f));
    const float x = dx * inverse, y = dy * inverse, z = dz * inverse;
    const float g0 = inside ? 1 + root : ratio / (1 + root);
    const float g1 = scale * ratio / 2;
    const float g2 = g1 * c;
    row[0][i] = scale * g0 * kY0;
    row[1][i] = g1 * kY1 * y;
    row[2][i] = g1 * kY1 * z;
    row[3][i] = g1 * kY1 * x;
    row[4][i] = g2 * kY2 * x * y;
    row[5][i] = g2 * kY2 * y * z;
    row[6][i] = g2 * kY20 * (3 * z * z - 1);
    row[7][i] = g2 * kY2 * x * z;
    row[8][i] = g2 * kY22 * (x * x - y * y);
  }
}

void projectDisk(const SamplePlan::Points& points, int count, const DiskLight& light, Rows& out) noexcept {
  const auto size = static_cast<std::size_t>(count);
  std::array<float, kCoefficients * kPoints> sh;
  const auto front = [&](const std::array<float, kPoints>& all) { return std::span(all).first(size); };
  projectDiskBatch<kBands>(light, {front(points.x), front(points.y), front(points.z)}, DiskNodes::six,
                           std::span(sh).first(kCoefficients * size));
  for (int i = 0; i < kCoefficients; ++i) std::copy_n(&sh[i * size], size, out.row[i].begin());
  for (int k = 0; k < count; ++k) {
    if (!(points.footprint[k] > light.radius)) continue;
    const RadianceSH<kBands> one = project<kBands>(light, {points.x[k], points.y[k], points.z[k]}, points.footprint[k]);
    for (int i = 0; i < kCoefficients; ++i) out.row[i][k] = one[i].g;
  }
}

/// The rig's values at the probes.
void evaluate(const SamplePlan& plan, const Rows& samples, Rows& values) noexcept {
  const int vectors = plan.vectors;
  for (int i = 0; i < kCoefficients; ++i) {
    std::array<float, SamplePlan::kMaxVectors> fitted{};
    for (int s = 0; s < plan.samples; ++s) {
      const float value = samples.row[i][s];
      const float* weight = plan.fit[s].data();
      for (int k = 0; k < vectors; ++k) fitted[k] += weight[k] * value;
    }
    float* value = values.row[i].data();
    std::fill_n(value, plan.probed, 0.0f);
    for (int k = 0; k < vectors; ++k) {
      const float* basis = plan.basis[k].data();
      for (int j = 0; j < plan.probed; ++j) value[j] += basis[j] * fitted[k];
    }
  }
}

double largest(const SamplePlan& plan, const WrapField& wrap, const Rows& rest) noexcept {
  const auto s0 = static_cast<float>(wrap.s0 * std::sqrt(kPi));
  const auto s1 = static_cast<float>(wrap.s1 * std::sqrt(kPi / 3));
  const auto s2 = static_cast<float>(wrap.s2 * std::sqrt(kPi / 5));
  std::array<float, kPoints> size;
  const auto& e = rest.row;
  for (int j = 0; j < plan.probed; ++j) {
    const float first = e[1][j] * e[1][j] + e[2][j] * e[2][j] + e[3][j] * e[3][j];
    const float second =
        e[4][j] * e[4][j] + e[5][j] * e[5][j] + e[6][j] * e[6][j] + e[7][j] * e[7][j] + e[8][j] * e[8][j];
    size[j] = plan.doubt[j] * (s0 * std::abs(e[0][j]) + s1 * std::sqrt(first) + s2 * std::sqrt(second));
  }
  float most = 0, sum = 0;
  for (int j = 0; j < plan.probed; ++j) {
    most = std::max(most, size[j]);
    sum += size[j];
  }
  // Of numbers that are too large nothing is known.
  return std::isfinite(sum) ? static_cast<double>(most) : std::numeric_limits<double>::infinity();
}

template <class Project>
Probed probe(const SamplePlan& plan, const WrapField& wrap, Project project) noexcept {
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  if (plan.probed == 0) return {kUnknown, kUnknown};
  Rows light, rig;
  project(plan.fitted, plan.samples, light);
  evaluate(plan, light, rig);
  Probed out;
  out.value = largest(plan, wrap, rig);
  project(plan.looked, plan.probed, light);
  for (int i = 0; i < kCoefficients; ++i)
    for (int j = 0; j < plan.probed; ++j) rig.row[i][j] -= light.row[i][j];
  out.error = largest(plan, wrap, rig);
  return out;
}

}  // namespace

Probed probed(const SamplePlan& plan, const WrapField& wrap, const LightField& field,
              const std::array<double, 3>& position) noexcept {
  return probe(plan, wrap, [&](const SamplePlan::Points& points, int count, Rows& out) {
    projectSphere(points, count, field, position, out);
  });
}

Probed probed(const SamplePlan& plan, const WrapField& wrap, const DiskLight& light) noexcept {
  return probe(plan, wrap,
               [&](const SamplePlan::Points& points, int count, Rows& out) { projectDisk(points, count, light, out); });
}

double probedBound(const BoundPlan& plan, const SamplePlan& samples, double tail, const Probed& probed,
                   const LightNearby& light, double error) noexcept {
  // Measured over random lights (rigs/README.md): of what the probes can tell apart, errors between them are up to 1.6
  // times as large as at them, 2.2 times where they are few; of the rest half the sum of its sizes is enough; what a
  // close light does between the probes falls with the square of their spacing over its distance.
  constexpr int kFew = 36;
  constexpr double kTail = 0.5, kClose = 3, kValues = 1.5;
  const bool surface = samples.cover >= 0;
  const double between = surface && samples.probed < kFew ? 2.3 : 1.8;
  const double share = plan.falloff ? 0.02 : 0.05;
  const double close = surface ? samples.cover / (light.distance + samples.cover) : 1.0;
  const double unseen = std::min(kTail * tail, kClose * close * close * light.peak + share * error);
  const double seen = std::min(between * probed.error + unseen, light.peak + kValues * probed.value);
  return std::min(error, seen + light.leap * error);
}

}  // namespace rigel
