#include <rigel/near_light.h>
#include <rigel/project.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "vec3d.h"

namespace rigel {
namespace {

using detail::Vec3d;

static_assert(static_cast<int>(NearLight::Kind::directional) == shader_types::kGpuDirectional);
static_assert(static_cast<int>(NearLight::Kind::point) == shader_types::kGpuPoint);
static_assert(static_cast<int>(NearLight::Kind::spot) == shader_types::kGpuSpot);
static_assert(static_cast<int>(NearLight::Kind::sphere) == shader_types::kGpuSphere);
static_assert(static_cast<int>(NearLight::Kind::disk) == shader_types::kGpuDisk);

NearLight black(NearLight::Kind kind) noexcept {
  NearLight out;
  out.kind = kind;
  out.share = 0;
  return out;
}

float held(float value) noexcept { return std::clamp(value, -kMaxProjectionScale, kMaxProjectionScale); }

void lightUp(NearLight& light, Rgb colour, float share) noexcept {
  light.share = share > 0 ? std::min(share, 1.0f) : 0.0f;
  light.colour = {held(colour.r), held(colour.g), held(colour.b)};
}

}  // namespace

// All returns are of one variable, which is built where the caller wants it.

NearLight nearLight(const DirectionalLight& light, float share) noexcept {
  NearLight out = black(NearLight::Kind::directional);
  const Vec3d direction = detail::directionOf(light.direction);
  if (detail::anyNan(light.irradiance) || detail::dot(direction, direction) == 0) return out;
  lightUp(out, light.irradiance, share);
  out.position = detail::narrow(direction * -1.0);
  return out;
}

NearLight nearLight(const PointLight& light, float share) noexcept {
  NearLight out = black(NearLight::Kind::point);
  const bool nan = detail::anyNan(light.position) || detail::anyNan(light.radius) || detail::anyNan(light.intensity);
  if (nan || !(light.range > 0)) return out;
  lightUp(out, light.intensity, share);
  out.position = light.position;
  out.radius = std::max(light.radius, kMinPointRadius);
  out.range = light.range;
  return out;
}

NearLight nearLight(const SpotLight& light, float share) noexcept {
  const Vec3d axis = detail::directionOf(light.direction);
  const bool dark = detail::anyNan(light.innerAngle, light.outerAngle) || detail::dot(axis, axis) == 0;
  NearLight out = dark ? black(NearLight::Kind::spot)
                       : nearLight(PointLight{light.position, light.intensity, light.radius, light.range}, share);
  out.kind = NearLight::Kind::spot;
  if (dark) return out;
  out.axis = detail::narrow(axis);
  out.cosOuter = static_cast<float>(std::cos(static_cast<double>(light.outerAngle)));
  out.cosInner = static_cast<float>(std::cos(static_cast<double>(light.innerAngle)));
  return out;
}

NearLight nearLight(const SphereLight& light, float share) noexcept {
  NearLight out = black(NearLight::Kind::sphere);
  if (detail::anyNan(light.position) || !(light.radius > 0) || detail::anyNan(light.radiance)) return out;
  lightUp(out, light.radiance, share);
  out.position = light.position;
  out.radius = light.radius;
  return out;
}

NearLight nearLight(const DiskLight& light, float share) noexcept {
  NearLight out = black(NearLight::Kind::disk);
  const Vec3d axis = detail::directionOf(light.direction);
  if (!(light.radius > 0) || detail::dot(axis, axis) == 0) return out;
  if (detail::anyNan(light.position) || detail::anyNan(light.radiance)) return out;
  lightUp(out, light.radiance, share);
  out.position = light.position;
  out.radius = std::min(light.radius, std::numeric_limits<float>::max());
  // A unit vector stays as it is: rounding it again would move the rim.
  const bool unit = std::abs(dot(light.direction, light.direction) - 1) < 1e-6f;
  out.axis = unit ? light.direction : detail::narrow(axis);
  out.cosOuter = light.twoSided ? -1.0f : 0.0f;
  return out;
}

GpuNearLight gpuNearLight(const NearLight& light) noexcept {
  const bool disk = light.kind == NearLight::Kind::disk;
  const bool area = disk || light.kind == NearLight::Kind::sphere;
  const bool spot = light.kind == NearLight::Kind::spot;
  const float scale = light.share * (area ? static_cast<float>(kPi) : 1.0f);
  // A window that ends closer than floats can invert leaves no light at any distance that counts, as it should.
  constexpr float kMaxInverse = std::numeric_limits<float>::max();
  GpuNearLight out{};
  out.position = {light.position.x, light.position.y, light.position.z};
  out.radius = light.radius;
  out.colour = {light.colour.r * scale, light.colour.g * scale, light.colour.b * scale};
  out.kind = static_cast<int>(light.kind);
  if (spot || disk) out.axis = {light.axis.x, light.axis.y, light.axis.z};
  if (light.kind == NearLight::Kind::point || spot) out.inverseRange = std::min(1 / light.range, kMaxInverse);
  out.cosOuter = spot || disk ? light.cosOuter : -1.0f;
  out.inverseConeWidth = spot ? 1 / std::max(light.cosInner - light.cosOuter, kMinConeWidth) : 1.0f;
  out.extent = area ? light.radius : 1.0f;
  return out;
}

}  // namespace rigel
