// Chebyshev coefficients of 1/(z-u)^2, the light's field along a line towards it, are 2 t^m (m/(z^2-1) + z/(z^2-1)^1.5)
// with t = z - sqrt(z^2-1) (S. Bernstein). What is left beyond degree m - 1 is at most their sum, relative to the
// largest value in [-1, 1]
//
//   R_m(t) = 2 t^m { (m (1-t) + t)/(1+t)^2 + (1+t^2)/(1+t)^3 }          R_0 = 1, R_m(1) = 1
//
// Along other lines the poles are complex and t follows from the ellipse through them, t = s - sqrt(s^2-1),
// s = (|z+1| + |z-1|)/2. In three variables the strength of a product of degrees is taken as the product of the R: not
// a theorem, and checked by test_light_bound.cpp.
#include "sample_bound.h"

#include <algorithm>
#include <cmath>

namespace rigel {
namespace {

using detail::BoundPlan;
using detail::SamplePlan;

constexpr int kDegrees = SamplePlan::kMaxDegree + 1;
using Strengths = std::array<float, kDegrees>;

/// t of the light's nearest singularity, seen along axis `a` with the other axes where they are nearest to it.
double convergence(double x, double half, double across2, double radius) noexcept {
  // The field is singular where the squared distance is 0 or radius^2.
  const double r2 = radius * radius;
  const double q = std::max(0.0, across2 - r2);
  const double real = std::max(0.0, x - std::sqrt(std::max(0.0, r2 - across2)));
  const double s =
      (std::sqrt((real + half) * (real + half) + q) + std::sqrt((real - half) * (real - half) + q)) / (2 * half);
  return s > 1 ? 1 / (s + std::sqrt(s * s - 1)) : 1.0;
}

Strengths strengths(double t, int degree) noexcept {
  Strengths out;
  const double onePlus = 1 / (1 + t);
  const double a = 2 * onePlus * onePlus;
  const double b = a * (1 + t * t) * onePlus;
  double power = 1;
  out[0] = 1;
  for (int m = 1; m <= degree; ++m) {
    power *= t;
    out[m] = static_cast<float>(power * (a * (m * (1 - t) + t) + b));
  }
  return out;
}

}  // namespace

SampleBound sampleBound(const BoundPlan& plan, const SamplePlan& samples, const WrapField& wrap,
                        const LightField& field, const std::array<double, 3>& light, double box,
                        double boxError) noexcept {
  const double radius = field.radius();
  const auto r2 = static_cast<float>(radius * radius);
  const std::array<float, 3> at{static_cast<float>(light[0]), static_cast<float>(light[1]),
                                static_cast<float>(light[2])};
  float sumValue = 0, mostValue = 0, sumShrink = 0, sumShare = 0, nearest = std::numeric_limits<float>::max();
  for (int i = 0; i < samples.samples; ++i) {
    const SamplePlan::Sample& s = samples.sample[i];
    const float x = at[0] - s.x, y = at[1] - s.y, z = at[2] - s.z;
    const float d2 = x * x + y * y + z * z;
    const float f2 = s.footprint * s.footprint;
    const float inverse = 1 / std::max({d2, f2, r2});
    sumValue += s.weight * inverse;
    mostValue = std::max(mostValue, inverse);
    nearest = std::min(nearest, d2);
    // A footprint that is larger than the light weakens bands 0 and 2: a convex function of (footprint / distance)^2.
    const float share = f2 > r2 ? std::min(1.0f, f2 * inverse) : 0.0f;
    sumShare += s.weight * inverse * share * (1 - std::min(1.0f, r2 / f2));
    sumShrink += s.weight * inverse * std::max(0.172f * share, 0.0858f + 0.8284f * (share - 0.5f));
  }
  for (int i = 0; i < samples.probes; ++i) {
    const auto& p = samples.probe[i];
    const float x = at[0] - p[0], y = at[1] - p[1], z = at[2] - p[2];
    nearest = std::min(nearest, x * x + y * y + z * z);
  }
  const double power = field.power();
  const double peak = std::max(wrap.inside, (wrap.s0 + wrap.s1 + wrap.s2) / 2);
  SampleBound out;
  out.near = samples.cover >= 0 ? std::max<double>(box, std::sqrt(nearest) - samples.cover) : box;
  out.cap = power * peak * std::min<double>(sumValue, plan.lebesgue * mostValue);
  out.error = power * 1.8 * (wrap.s0 + wrap.s2) * sumShrink;

  std::array<Strengths, 3> strength, single;
  for (int a = 0; a < 3; ++a) {
    double across2 = 0;
    for (int b = 0; b < 3; ++b) {
      const double beyond = b == a ? 0.0 : std::max(0.0, std::abs(light[b] - plan.centre[b]) - plan.axis[b].half);
      across2 += beyond * beyond;
    }
    const double half = plan.axis[a].half;
    const double t = half > 0 ? convergence(std::abs(light[a] - plan.centre[a]), half, across2, radius) : 0.0;
    strength[a] = strengths(t, samples.degree);
    single[a][0] = 1;
    for (int m = 1; m < samples.degree; ++m) single[a][m] = strength[a][m] - strength[a][m + 1];
    single[a][samples.degree] = strength[a][samples.degree];
  }
  float sum = 0;
  for (int i = 0; i < samples.terms; ++i) {
    const SamplePlan::Term& term = samples.term[i];
    const auto& table = term.single ? single : strength;
    sum += term.factor * table[0][term.degree[0]] * table[1][term.degree[1]] * table[2][term.degree[2]];
  }
  out.enlarged = power * sumShare;
  out.smooth = static_cast<double>(sum) * field.peak(box);
  out.error += out.smooth;
  if (!plan.polynomial) out.error += (1 + plan.lebesgue) * boxError;
  return out;
}

double seenError(const detail::SeenLight& seen, Range light, double variation) noexcept {
  Range near;  // the rig's values where the light is close
  for (const detail::SeenPoint& p : seen.points) {
    const float share = std::min(1.0f, 2 * p.close);
    near = {std::max<double>(near.down, share * p.down), std::max<double>(near.up, share * p.up)};
  }
  // What the points do not see of the light itself falls with the third power of spacing over distance: their own
  // values tell all that is flatter. Where the light comes as close as the points are to each other it is no less than
  // the cap, for what they see leaps as a disk's face passes them.
  const double unseen = (1 + seen.between) * light.up;
  const double leaping = seen.between * (near.down + near.up);
  double error = 0;
  for (const detail::SeenPoint& p : seen.points) {
    const double close = static_cast<double>(p.close) * static_cast<double>(p.close) * static_cast<double>(p.close);
    const double seenHere = seen.between * static_cast<double>(p.error) + static_cast<double>(p.crease) + variation +
                            close * (unseen + close * leaping);
    const Range rig{seen.between * std::max<double>(near.down, p.down), seen.between * std::max<double>(near.up, p.up)};
    error = std::max(error, std::min(seenHere, difference(light, rig)));
  }
  return error + seen.missing;
}

}  // namespace rigel
