// Lights of any kind as sums of emitters: spheres and points as one at their centre, disks as one on each bit of their
// face.
#include "light_tree_state.h"
#include "weights.h"

#include <algorithm>
#include <cmath>

namespace rigel {
namespace {

constexpr float kPiF = 3.14159265f;

// A sphere's SH differ from those of a point of equal power by less than 0.3 N P r^2/d^4 for d >= 2r (0.282 at wrap
// -0.25, test_light_tree.cpp), as lights spread over this second moment, times r^2, would at least: S G is 3 S or more.
constexpr float kSphereMoment = 0.3f / 3;

constexpr float kFarthest = 1e15f;  // m; squares of distances stay finite
constexpr float kBrightest = 1e20f;

template <class... Floats>
bool anyNan(Floats... values) noexcept {
  return ((values != values) || ...);
}

bool anyNan(Vec3 v) noexcept { return anyNan(v.x, v.y, v.z); }

/// In double: squares of large directions overflow.
bool setAxis(LightModulation& m, Vec3 direction) noexcept {
  const double x = direction.x, y = direction.y, z = direction.z;
  const double norm = std::sqrt(x * x + y * y + z * z);
  if (!(norm > 0) || !std::isfinite(norm)) return false;
  m.x = static_cast<float>(x / norm);
  m.y = static_cast<float>(y / norm);
  m.z = static_cast<float>(z / norm);
  return true;
}

void place(LightSource& source, Vec3 p, float reach, Rgb colour) noexcept {
  if (anyNan(p) || anyNan(colour.r, colour.g, colour.b) || anyNan(reach)) return;
  const float far = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z), reach});
  const bool infinite = std::isinf(p.x) || std::isinf(p.y) || std::isinf(p.z);
  if (colour == Rgb{} || infinite) return;
  const float power = magnitude(colour);
  if (!(far < kFarthest && power < kBrightest && power > 1 / kBrightest)) {
    source.lone = source.shines = true;
    return;
  }
  source.light.x = p.x;
  source.light.y = p.y;
  source.light.z = p.z;
  source.light.reach = reach;
  source.light.power = power;
  source.light.mean = (colour.r + colour.g + colour.b) / 3;
  source.colour = colour;
}

void describe(const DirectionalLight& light, LightSource& source) noexcept {
  LightModulation axis;
  source.lone = source.directional = true;
  const Rgb c = light.irradiance;
  source.shines = !anyNan(c.r, c.g, c.b) && c != Rgb{} && setAxis(axis, light.direction);
  source.light.mean = (c.r + c.g + c.b) / 3;
}

void describe(const PointLight& light, LightSource& source) noexcept {
  if (light.range != kNoRange) source.dimming = Dimming::range;
  if (anyNan(light.radius) || !(light.range > 0)) return;
  const float radius = std::max(light.radius, kMinPointRadius);
  place(source, light.position, 2 * radius, light.intensity);
  source.light.radius = radius;
  source.second = kSphereMoment * radius * radius;
  source.modulation.kinds = LightModulation::kPlain;
  source.modulation.leastRange = source.modulation.mostRange = light.range;
}

void describe(const SpotLight& light, LightSource& source) noexcept {
  describe(PointLight{light.position, light.intensity, light.radius, light.range}, source);
  source.dimming = source.dimming == Dimming::range ? Dimming::coneAndRange : Dimming::cone;
  LightModulation& m = source.modulation;
  const bool valid = !anyNan(light.innerAngle, light.outerAngle) && setAxis(m, light.direction);
  const double outer = std::cos(static_cast<double>(light.outerAngle));
  const double inner = std::max(std::cos(static_cast<double>(light.innerAngle)), outer + kMinConeWidth);
  if (!valid || anyNan(outer, inner)) {
    source.light.power = 0;
    source.lone = source.shines = false;
    return;
  }
  m.kinds = LightModulation::kSpot;
  m.leastOuter = m.mostOuter = static_cast<float>(outer);
  m.leastInner = m.mostInner = static_cast<float>(inner);
}

void describe(const SphereLight& light, LightSource& source) noexcept {
  if (!(light.radius > 0)) return;
  place(source, light.position, 2 * light.radius, light.radiance * (kPiF * light.radius * light.radius));
  source.light.radius = light.radius;
  source.second = kSphereMoment * light.radius * light.radius;
  source.modulation.kinds = LightModulation::kPlain;
}

void describe(const DiskLight& light, LightSource& source) noexcept {
  source.dimming = light.twoSided ? Dimming::twoFaces : Dimming::face;
  if (!(light.radius > 0) || !setAxis(source.modulation, light.direction)) return;
  place(source, light.position, light.radius, light.radiance * (kPiF * light.radius * light.radius));
  source.second = light.radius * light.radius / 2;
  source.modulation.kinds = light.twoSided ? LightModulation::kTwoSided : LightModulation::kOneSided;
  source.modulation.leastRange = source.modulation.mostRange = kNoRange;
}

}  // namespace

LightSource lightSource(const LightSet& lights, std::uint32_t index) noexcept {
  LightSource source;
  lights.visit(static_cast<int>(index), [&](const auto& light) { describe(light, source); });
  source.light.light = index;
  if (!(source.light.power > 0)) source.modulation = {};
  return source;
}

}  // namespace rigel
