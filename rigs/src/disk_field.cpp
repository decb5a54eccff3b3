#include "disk_field.h"

#include <rigel/project.h>

#include <algorithm>
#include <cmath>

namespace rigel {
namespace {

double sineOf(double cosine) noexcept { return std::sqrt(std::max(0.0, (1 - cosine) * (1 + cosine))); }

/// Largest a c + b sqrt(1-c^2), c in `cosine` (within [0, 1]); a, b >= 0.
double largestSum(double a, double b, Interval cosine) noexcept {
  const double best = a / std::sqrt(a * a + b * b);
  const double c = std::clamp(best, cosine.lo, cosine.hi);
  return a * c + b * sineOf(c);
}

/// Largest cos t / rho^2 of a lobe over a half space at distance 1, whose normal has this cosine with the lobe's axis:
/// at the point whose direction is off the normal by an angle of tangent T in 2 tan A T^2 + 3 T = tan A.
double lobeOverHalfSpace(double cosine) noexcept {
  const double sine = sineOf(cosine);
  const double sum = std::sqrt(8 + cosine * cosine) + 3 * cosine;
  if (!(sum > 0)) return 0;
  const double tangent = 2 * sine / sum;
  const double scale = 1 / std::sqrt(1 + tangent * tangent);
  return std::max(0.0, (cosine + sine * tangent) * scale) * scale * scale;
}

}  // namespace

DiskField::DiskField(const WrapField& wrap, double radius, bool twoSided) noexcept
    : radius_(radius), twoSided_(twoSided) {
  const LightField emitter(wrap, 1, 0);
  peak_ = emitter.peak(1);
  point_ = emitter.slopes(1);
  perVector_ = std::max(peak_, wrap.s0 + wrap.s1 / 2);
  // The kernel is at most (x + a)/(1 + a) for a > 0 and x for a < 0, and the solid angle at most 2 V.
  const double a = 2 * (wrap.fullSphere - 1) / (2 - wrap.fullSphere);
  exactPerVector_ = std::max(perVector_, (1 + 2 * a) / (1 + a));
  // Of wide cones relative to V: 1.14 at a = -0.25, 1.07 at a = 0.
  lobe_ = 1.15 * wrap.lobe * peak_;
}

double DiskField::vector(double off, double height) const noexcept {
  const double rho = off / radius_, z = height / radius_;
  if (!(z > 0)) return rho < 1 ? kPi : 0;
  const double m = (rho - 1) * (rho + 1) + z * z;
  const double d = std::sqrt(m * m + 4 * z * z);
  const double along = m > 0 ? 2 * z * (z / d) / (d + m) : (d - m) / (2 * d);
  const double across = 2 * z / d * (rho / (rho * rho + z * z + 1 + d));
  return kPi * std::sqrt(along * along + across * across);
}

double DiskField::vector(const DiskAspect& view) const noexcept {
  if (!(view.share > 0)) return 0;
  const double low = std::max(0.0, view.low);
  // At the height of the maximum z^2 = k (rho^2 - 1): k from 1/3 at the rim to 1/2 far away. Between the fit and the
  // maximum V differs by less than 1e-3.
  constexpr double kOffMaximum = 1.001;
  const double rho = view.off / radius_;
  double best = low;
  if (rho > 1) {
    const double w = std::sqrt((rho - 1) * (rho + 1));
    const double k = 0.5 - 1 / (6 * (1 + w * (1.6 + 2.4 * w)));
    best = std::clamp(radius_ * w * std::sqrt(k), low, view.high);
  }
  double most = std::min(kPi, kOffMaximum * vector(view.off, best));
  // On the face V is pi up to the rim, and just beyond the rim 0.71 pi at most: a jump of its own, taken slowly.
  constexpr double kRim = 0.1;
  const double atFace = std::clamp(1 - (rho - 1) / kRim, 0.0, 1.0) * std::max(0.0, 1 - low / (kRim * radius_));
  most += atFace * (kPi - most);
  // The disk lies within the sphere of its radius.
  if (view.near > radius_) most = std::min(most, kPi * (radius_ / view.near) * (radius_ / view.near));
  for (const Front& front : view.front) {
    if (!(front.distance > 0)) continue;
    const Means mean = means(front.distance, sineOf(front.cosAxis));
    if (!(mean.cube < std::numeric_limits<double>::infinity())) continue;
    most = std::min({most, area() * lobeOverHalfSpace(front.cosAxis) * mean.square, area() * view.high * mean.cube});
  }
  return view.share * most;
}

DiskField::Means DiskField::means(double distance, double sine) const noexcept {
  const double share = radius_ * sine / distance;
  if (!(distance > 0 && share < 1)) return {};
  const double q2 = (1 - share) * (1 + share);
  const double q = std::sqrt(q2);
  const double inverse = 1 / distance;
  const double square = inverse * inverse;
  return {square * 2 / (q * (1 + q)), square * inverse / (q * q2), square * square / (q * q2 * q2)};
}

double DiskField::slopeAlong(Interval cosine, double least, double along) const noexcept {
  const double w2 = along * along;
  const double p = point_.first, t = point_.firstAcross;
  return largestSum(std::sqrt(p * p * w2 + t * t * (1 - w2)), peak_ * sineOf(least), cosine);
}

double DiskField::slope(Interval cosine) const noexcept {
  // c sqrt(P^2 w^2 + T^2 (1-w^2)) + E s sqrt(1-w^2), by Cauchy's inequality.
  const double p = point_.first, t = point_.firstAcross;
  const double s2 = 1 - cosine.hi * cosine.hi;
  return std::sqrt(p * p * cosine.hi * cosine.hi + peak_ * peak_ * p * p / (p * p - t * t) * s2);
}

double DiskField::curvatureAlong(Interval cosine, double along) const noexcept {
  return curvature(cosine, along * along, 1);
}

double DiskField::curvature(Interval cosine, double along, double square) const noexcept {
  const double across = point_.secondAcross + peak_;
  return largestSum(across * square + (point_.second - across) * along, 2 * kLobeCurvature * peak_ * square, cosine);
}

double DiskField::lobeStrength(Interval cosine) const noexcept { return largestSum(1, 0.8, cosine); }

double DiskField::rimSlope(const DiskAspect& view) const noexcept {
  const double gap = std::max({0.0, view.off - radius_, radius_ - view.offMost});
  const double low = std::max(0.0, view.low);
  const double nearest = std::max(std::sqrt(gap * gap + low * low), double{kMinGradientRim} * radius_);
  const double reach = view.off + radius_;
  const double farthest = std::sqrt(reach * reach + low * low);
  return peak_ * 2 * kPi * radius_ / (nearest * farthest);
}

}  // namespace rigel
