#include "disk_aspect.h"

#include <algorithm>
#include <cmath>

namespace rigel {
namespace {

double dotOf(const Triple& a, const Triple& b) noexcept { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

}  // namespace

DiskAspect diskAspect(const Region& region, const Triple& axis, double radius, bool twoSided, double margin) noexcept {
  // Directions of length 1 in float.
  constexpr double kDirectionRounding = 2e-7;
  DiskAspect view;
  const double rounding = region.rounding + kDirectionRounding * region.far;
  const double middle = dotOf(region.towards, axis);
  double reach = 0, square = 0, support = 0;
  Triple across{};
  for (int a = 0; a < 3; ++a) {
    reach += region.half[a] * std::abs(axis[a]);
    across[a] = region.towards[a] - middle * axis[a];
    square += across[a] * across[a];
    support += region.half[a] * std::abs(across[a]);
  }
  reach = std::min(reach, region.radius) + rounding;
  view.low = middle - reach;
  view.high = middle + reach;
  const double apart = std::max({0.0, view.low, -view.high});
  if (view.high < 0) {
    const double x = margin > 0 ? std::max(0.0, 1 + view.high / margin) : 0;
    view.share = x * x * (3 - 2 * x);
    view.low -= view.high;
    view.high = 0;
  }
  view.near = region.near;

  const double off = std::sqrt(square);
  support = std::min(off > 0 ? support / off : 0.0, region.radius) + rounding;
  const double beyondHeight = region.near - view.high;
  const double byDistance = beyondHeight > 0 ? std::sqrt(beyondHeight * (region.near + view.high)) : 0;
  view.off = std::max({0.0, off - support, byDistance});
  const double beside = std::max(0.0, off - support - radius);
  view.gap = std::sqrt(apart * apart + beside * beside);
  view.offMost = off + std::min(region.radius, std::sqrt(dotOf(region.half, region.half))) + rounding;

  const Interval centre = cosines(region, axis, 0);
  const double share = region.near > radius ? radius / region.near : 1;
  const double most = twoSided ? std::max(centre.hi, -centre.lo) : centre.hi;
  view.cosine.hi = share < 1 ? std::clamp(most / (1 - share), 0.0, 1.0) : 1.0;
  view.cosine.lo = std::clamp(centre.lo / (1 + share), 0.0, view.cosine.hi);
  view.front = {frontOf(region, axis), frontOfBall(region, axis)};
  if (twoSided)
    for (Front& front : view.front) front.cosAxis = std::abs(front.cosAxis);
  return view;
}

}  // namespace rigel
