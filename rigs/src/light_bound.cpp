#include <rigel/light_bound.h>

#include <rigel/wrap.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rigel {
namespace {

// Of the largest SH irradiance: a rig whose values are blends of the light's own is wrong by at most 1 + the negative
// lobe of a three-band light.
constexpr double kCap = 4;

double distanceToBox(const RigBox& box, Vec3 p) noexcept {
  double sum = 0;
  for (int a = 0; a < 3; ++a) {
    const double d = std::max({0.0, double{box.lo[a]} - p[a], double{p[a]} - box.hi[a]});
    sum += d * d;
  }
  return std::sqrt(sum);
}

LightBound held(double peak) noexcept {
  if (!(peak > 0)) return {};
  constexpr double kLargest = std::numeric_limits<float>::max();
  return {static_cast<float>(std::min(kCap * peak, kLargest)), static_cast<float>(std::min(peak, kLargest))};
}

}  // namespace

LightBounds::LightBounds(const Rig& rig, const RigFrame& worldFromRig, float wrap) noexcept
    : rig_(&rig), worldFromRig_(worldFromRig), wrap_(clampWrap(wrap)) {}

LightBound LightBounds::operator()(const DirectionalLight& light) const noexcept {
  const float squared = dot(light.direction, light.direction);
  return squared > 0 && std::isfinite(squared) ? LightBound{0, 1.0625f} : LightBound{};
}

LightBound LightBounds::operator()(const PointLight& light) const noexcept {
  if (!(light.range > 0) || !(light.radius == light.radius)) return {};
  const double radius = std::max(light.radius, kMinPointRadius);
  const double g = distanceToBox(rig_->box(), worldFromRig_.inversePoint(light.position));
  if (!(g < light.range)) return {};
  const double reach = std::max(g, radius);
  return held(1.34 / (reach * reach));
}

LightBound LightBounds::operator()(const SpotLight& light) const noexcept {
  return (*this)(PointLight{light.position, light.intensity, light.radius, light.range});
}

LightBound LightBounds::operator()(const SphereLight& light) const noexcept {
  if (!(light.radius > 0)) return {};
  const double g = distanceToBox(rig_->box(), worldFromRig_.inversePoint(light.position));
  const double s = light.radius / std::max<double>(g, light.radius);
  return std::isfinite(g) ? held(1.34 * kPi * s * s) : LightBound{};
}

}  // namespace rigel
