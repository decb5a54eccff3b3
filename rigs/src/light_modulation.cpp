#include "light_modulation.h"

#include <algorithm>
#include <cmath>

#include "weights.h"

namespace rigel {
namespace {

// What float leaves of cosines.
constexpr float kCosineSlack = 2e-6f;

float sine(float cosine) noexcept { return std::sqrt(std::max(0.0f, (1 - cosine) * (1 + cosine))); }

float window(float distance, float range) noexcept {
  const float x = distance / range;
  const float u = 1 - x * x * x * x;
  return u > 0 ? u * u : 0;
}

/// Widens the cone to hold another's, an axis of length 1 and its spread.
void widen(LightModulation& cone, const LightModulation& other) noexcept {
  const float cosine = std::clamp(cone.x * other.x + cone.y * other.y + cone.z * other.z, -1.0f, 1.0f);
  const float reach = cosine < -other.cosSpread ? -1 : cosine * other.cosSpread - sine(cosine) * other.sinSpread;
  cone.cosSpread = std::max(-1.0f, std::min(cone.cosSpread, reach - kCosineSlack));
}

bool directed(const LightModulation& m) noexcept { return (m.kinds & ~LightModulation::kPlain) != 0; }

struct Cosines {
  float least = -1, most = 1;
};

/// Between any of the axes and any direction that is within the angle of sine `spread` from `between`.
Cosines cosines(const LightModulation& m, Vec3 between, float distance, float reach) noexcept {
  if (!(distance > reach)) return {};
  const float cosine = std::clamp((m.x * between.x + m.y * between.y + m.z * between.z) / distance, -1.0f, 1.0f);
  const float sin = sine(cosine);
  const float sinView = reach / distance;
  const float cosView = sine(sinView);
  if (m.cosSpread < -cosView) return {};
  const float cosOff = m.cosSpread * cosView - m.sinSpread * sinView;
  const float sinOff = std::max(0.0f, m.sinSpread * cosView + m.cosSpread * sinView);
  Cosines out;
  if (cosine < cosOff) out.most = std::min(1.0f, cosine * cosOff + sin * sinOff + kCosineSlack);
  if (cosine > -cosOff) out.least = std::max(-1.0f, cosine * cosOff - sin * sinOff - kCosineSlack);
  return out;
}

void include(DimmingRange& range, float least, float most) noexcept {
  range.least = std::min(range.least, least);
  range.most = std::max(range.most, most);
}

}  // namespace

LightModulation merged(const LightModulation& a, const LightModulation& b) noexcept {
  if (a.kinds == 0) return b;
  if (b.kinds == 0) return a;
  LightModulation out;
  out.kinds = a.kinds | b.kinds;
  out.leastOuter = std::min(a.leastOuter, b.leastOuter);
  out.mostOuter = std::max(a.mostOuter, b.mostOuter);
  out.leastInner = std::min(a.leastInner, b.leastInner);
  out.mostInner = std::max(a.mostInner, b.mostInner);
  out.leastRange = std::min(a.leastRange, b.leastRange);
  out.mostRange = std::max(a.mostRange, b.mostRange);
  // The axis of lights without one is 0.
  const Vec3 sum{a.x + b.x, a.y + b.y, a.z + b.z};
  const float norm = length(sum);
  if (norm > 1e-3f) {
    out.x = sum.x / norm;
    out.y = sum.y / norm;
    out.z = sum.z / norm;
    if (directed(a)) widen(out, a);
    if (directed(b)) widen(out, b);
  } else if (directed(out)) {
    out.x = 1;
    out.cosSpread = -1;
  }
  out.sinSpread = sine(out.cosSpread);
  return out;
}

DimmingRange dimming(const LightModulation& lights, Vec3 between, float distance, float reach) noexcept {
  DimmingRange range{1, 0};
  if (lights.kinds & LightModulation::kPlain) include(range, 1, 1);
  if (directed(lights)) {
    const Cosines c = cosines(lights, between, distance, reach);
    if (lights.kinds & LightModulation::kSpot) {
      include(range, smoothstep((c.least - lights.mostOuter) / (lights.mostInner - lights.mostOuter)),
              smoothstep((c.most - lights.leastOuter) / (lights.leastInner - lights.leastOuter)));
    }
    if (lights.kinds & LightModulation::kOneSided) include(range, std::max(0.0f, c.least), std::max(0.0f, c.most));
    if (lights.kinds & LightModulation::kTwoSided) {
      const bool crosses = c.least < 0 && c.most > 0;
      include(range, crosses ? 0 : std::min(std::abs(c.least), std::abs(c.most)),
              std::max(std::abs(c.least), std::abs(c.most)));
    }
  }
  if (lights.leastRange < kNoRange) range.least *= window(distance + reach, lights.leastRange);
  if (lights.mostRange < kNoRange) range.most *= window(std::max(0.0f, distance - reach), lights.mostRange);
  return range;
}

}  // namespace rigel
