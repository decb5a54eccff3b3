#include <rigel/prepared_lights.h>
#include <rigel/project.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "prepared_term.h"
#include "vec3d.h"

namespace rigel {
namespace {

using detail::PreparedKind;
using detail::PreparedLight;

constexpr double kLargest = std::numeric_limits<float>::max();

float rounded(double value) noexcept { return static_cast<float>(std::clamp(value, -kLargest, kLargest)); }

Rgb scaled(Rgb colour, double scale) noexcept {
  return {rounded(colour.r * scale), rounded(colour.g * scale), rounded(colour.b * scale)};
}

/// e and e/d are to stay within what their product with the colour allows.
void setNearest(PreparedLight& light) noexcept {
  const double r2 = static_cast<double>(light.radius) * light.radius;
  const double held = 1 / detail::largestFlux(light.colour);
  double nearest = std::max({detail::kCloseSquare * r2, held, detail::kMinPreparedSquare});
  // The cube root is asked for where it counts, at lights as bright as none that is meant.
  if (held * held > nearest * nearest * nearest) nearest = std::cbrt(held * held);
  light.extreme = nearest > r2 / detail::kSmallSquare;
  light.nearestSquare = nearest < kLargest ? static_cast<float>(nearest) : std::numeric_limits<float>::infinity();
}

// What contributes nothing stays as it is by default.

void prepare(const DirectionalLight& light, PreparedLight& out) noexcept {
  const detail::Vec3d direction = detail::directionOf(light.direction);
  if (detail::anyNan(light.irradiance) || detail::dot(direction, direction) == 0) return;
  out.kind = PreparedKind::directional;
  out.position = detail::narrow(direction * -1.0);
  for (int c = 0; c < 3; ++c)
    out.colour[c] = std::clamp(light.irradiance[c], -kMaxProjectionScale, kMaxProjectionScale);
}

void prepare(const PointLight& light, PreparedLight& out) noexcept {
  const bool nan = detail::anyNan(light.position) || detail::anyNan(light.radius) || detail::anyNan(light.intensity);
  if (nan || !(light.range > 0)) return;
  out.kind = PreparedKind::point;
  out.position = light.position;
  out.radius = std::clamp(light.radius, kMinPointRadius, std::numeric_limits<float>::max());
  out.colour = scaled(light.intensity, 1);
  out.radiusSquare = out.radius * out.radius;
  out.inverseRangeSquare = rounded(1 / (static_cast<double>(light.range) * light.range));
  setNearest(out);
}

void prepare(const SpotLight& light, PreparedLight& out) noexcept {
  const detail::Vec3d axis = detail::directionOf(light.direction);
  if (detail::anyNan(light.innerAngle, light.outerAngle) || detail::dot(axis, axis) == 0) return;
  const double cosOuter = std::cos(static_cast<double>(light.outerAngle));
  const double width = std::max<double>(std::cos(static_cast<double>(light.innerAngle)) - cosOuter, kMinConeWidth);
  // An angle that is infinite has no cosine.
  if (!(width < 3)) return;
  prepare(PointLight{light.position, light.intensity, light.radius, light.range}, out);
  if (out.kind == PreparedKind::none) return;
  out.kind = PreparedKind::spot;
  out.axis = detail::narrow(axis * (-1 / width));
  out.coneOffset = static_cast<float>(-cosOuter / width);
}

void prepare(const SphereLight& light, PreparedLight& out) noexcept {
  if (detail::anyNan(light.position) || !(light.radius > 0) || detail::anyNan(light.radiance)) return;
  const double peak = detail::peakOf(light.radiance);
  if (peak == 0) return;
  out.kind = PreparedKind::sphere;
  out.position = light.position;
  out.radius = std::min(light.radius, std::numeric_limits<float>::max());
  const double r2 = static_cast<double>(out.radius) * out.radius;
  out.arealess = !detail::hasRoom(r2, peak);
  out.colour = scaled(light.radiance, out.arealess ? kPi : kPi * r2);
  out.radiusSquare = static_cast<float>(r2);
  setNearest(out);
  if (!out.arealess) return;
  out.extreme = true;
  out.nearestSquare = std::numeric_limits<float>::infinity();
}

void prepare(const DiskLight& light, PreparedLight& out) noexcept {
  const detail::Vec3d axis = detail::directionOf(light.direction);
  // Of a radius that float has no inverse of nothing is seen but from where the disk is.
  if (!(light.radius >= std::numeric_limits<float>::min()) || detail::dot(axis, axis) == 0) return;
  if (detail::anyNan(light.position) || detail::anyNan(light.radiance)) return;
  out.kind = PreparedKind::disk;
  out.position = light.position;
  out.radius = light.radius;
  for (int c = 0; c < 3; ++c) out.colour[c] = std::clamp(light.radiance[c], -kMaxProjectionScale, kMaxProjectionScale);
  out.axis = light.direction;
  out.twoSided = light.twoSided;
}

}  // namespace

void PreparedLights::reserve(int count) {
  lights_.reserve(static_cast<std::size_t>(count));
  uses_.reserve(static_cast<std::size_t>(count));
}

PreparedLight& PreparedLights::push() {
  if (uses_.size() == lights_.size()) uses_.push_back({static_cast<std::uint32_t>(uses_.size()), 1});
  return lights_.emplace_back();
}

void PreparedLights::set(const LightSet& lights) {
  anyDirectional_ = lights.directionalCount() > 0;
  anyDisk_ = lights.diskCount() > 0;
  lights_.clear();
  reserve(lights.size());
  lights.visitAll([this](const auto& light) { prepare(light, push()); });
}

std::uint32_t PreparedLights::add(const SphereLight& light) {
  prepare(light, push());
  return static_cast<std::uint32_t>(lights_.size() - 1);
}

}  // namespace rigel
