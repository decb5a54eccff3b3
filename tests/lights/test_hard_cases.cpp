// Finite input of any kind gives finite output: projection, gradient, exact irradiance and near lights over random hard
// cases, inside, touching, coincident, zero radius, huge and tiny scales, any bit pattern. RIGEL_FULL=1: ten million of
// them.
#include <gtest/gtest.h>
#include <rigel/exact.h>
#include <rigel/near_light.h>
#include <rigel/project.h>
#include <rigel/wrap.h>

#include <bit>
#include <limits>

#include "lights/describe.h"
#include "lights/random.h"

namespace rigel {
namespace {

using test::describe;
using test::Random;

constexpr float kLargest = std::numeric_limits<float>::max();

int caseCount() { return test::fullRun() ? 10'000'000 : 300'000; }

float anyFinite(Random& random) {
  for (;;) {
    const auto bits =
        static_cast<std::uint32_t>(random.index(1 << 16)) << 16 | static_cast<std::uint32_t>(random.index(1 << 16));
    const auto value = std::bit_cast<float>(bits);
    if (std::isfinite(value)) return value;
  }
}

/// Values that break formulas: zero, ends of the float range, denormals, ordinary ones, any bit pattern.
float hardValue(Random& random) {
  switch (random.index(8)) {
    case 0:
      return 0;
    case 1:
      return random.index(2) == 0 ? kLargest : -kLargest;
    case 2:
      return std::numeric_limits<float>::denorm_min() * static_cast<float>(random.index(100));
    case 3:
      return anyFinite(random);
    case 4:
      return static_cast<float>(random.logUniform(1e-37, 1e37)) * (random.index(2) == 0 ? 1.0f : -1.0f);
    default:
      return random.uniformf(-10, 10);
  }
}

Vec3 hardVector(Random& random) { return {hardValue(random), hardValue(random), hardValue(random)}; }

struct HardPlace {
  Vec3 receiver;
  Vec3 centre;
  float radius = 0;
};

/// Receiver and sphere: unrelated, coincident, a few float steps apart, touching to the last bit, one within the other.
HardPlace hardPlace(Random& random) {
  HardPlace out;
  out.receiver = hardVector(random);
  const auto scale = static_cast<float>(random.logUniform(1e-30, 1e30));
  switch (random.index(5)) {
    case 0:
      out.centre = hardVector(random);
      break;
    case 1:
      out.centre = out.receiver;
      break;
    case 2:
      out.centre = out.receiver;
      for (int axis = 0; axis < 3; ++axis) out.centre[axis] = std::nextafter(out.receiver[axis], hardValue(random));
      break;
    default:
      out.receiver = random.pointInCube(1) * scale;
      out.centre = out.receiver + random.direction() * scale;
      break;
  }
  const Vec3 apart = out.centre - out.receiver;
  const float distance = std::hypot(apart.x, apart.y, apart.z);
  switch (random.index(6)) {
    case 0:
      out.radius = 0;
      break;
    case 1:
      out.radius = distance;
      break;
    case 2:
      out.radius = std::nextafter(distance, random.index(2) == 0 ? 0.0f : kLargest);
      break;
    case 3:
      out.radius = std::min(kLargest, distance * random.uniformf(1, 3));
      break;
    case 4:
      out.radius = distance * random.uniformf(0, 1);
      break;
    default:
      out.radius = hardValue(random);
      break;
  }
  if (!std::isfinite(out.radius)) out.radius = kLargest;
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(out.centre[axis])) out.centre[axis] = kLargest;
  }
  return out;
}

float hardAngle(Random& random) {
  switch (random.index(4)) {
    case 0:
      return 0;
    case 1:
      return 3.14159265f;
    case 2:
      return hardValue(random);
    default:
      return random.uniformf(0, 3.2);
  }
}

bool allFinite(const float* values, int count) {
  for (int i = 0; i < count; ++i) {
    if (!std::isfinite(values[i])) return false;
  }
  return true;
}

template <class Light>
bool expectFinite(const Light& light, Vec3 p, Vec3 n, float wrap) {
  const ProjectionWithGradient<5> both = projectWithGradient<5>(light, p);
  const RadianceSH<3> value = project<3>(light, p);
  const RgbD exact = exactIrradiance(light, p, n, wrap);
  bool finite = allFinite(both.value.data(), 75) && allFinite(value.data(), 27);
  for (const RadianceSH<5>& slope : both.gradient.d) finite = finite && allFinite(slope.data(), 75);
  finite = finite && std::isfinite(exact.r) && std::isfinite(exact.g) && std::isfinite(exact.b);
  const NearLight near = nearLight(light);
  const Rgb runtime[] = {nearIrradiance(near, p, n, wrap), cheapIrradiance(near, p, n),
                         correctorIrradiance(near, p, n, nearWrap(wrap))};
  finite = finite && allFinite(&runtime[0].r, 9);
  EXPECT_TRUE(finite) << describe(light) << ", p " << describe(p) << ", n " << describe(n) << ", wrap "
                      << describe(wrap) << "\n  q0 " << describe(both.value[0]) << ", gradient of it "
                      << describe(both.gradient.d[0][0]) << describe(both.gradient.d[1][0])
                      << describe(both.gradient.d[2][0]) << "\n  exact " << describe(exact.r) << " "
                      << describe(exact.g) << " " << describe(exact.b);
  return finite;
}

float hardWrap(Random& random) {
  constexpr float kWraps[] = {0, 1, -0.25f, 0.5f};
  const int i = random.index(6);
  return i < 4 ? kWraps[i] : random.uniformf(-0.25, 1);
}

TEST(HardCases, EveryKindStaysFinite) {
  Random random(71);
  const int cases = caseCount();
  int failures = 0;
  for (int k = 0; k < cases && failures < 5; ++k) {
    const HardPlace at = hardPlace(random);
    const Rgb colour = {hardValue(random), hardValue(random), random.uniformf(0, 1)};
    const Vec3 n = random.index(10) == 0 ? hardVector(random) : random.direction();
    const Vec3 axis = random.index(3) == 0 ? hardVector(random) : random.direction();
    const float wrap = hardWrap(random);
    const float range = random.index(3) == 0 ? kNoRange : hardValue(random);
    bool finite = true;
    switch (k % 8) {
      case 0:
        finite = expectFinite(DirectionalLight{axis, colour}, at.receiver, n, wrap);
        break;
      case 1:
      case 2:
        finite = expectFinite(PointLight{at.centre, colour, at.radius, range}, at.receiver, n, wrap);
        break;
      case 3:
      case 4: {
        const SpotLight spot{at.centre, axis, colour, hardAngle(random), hardAngle(random), at.radius, range};
        finite = expectFinite(spot, at.receiver, n, wrap);
        break;
      }
      default:
        finite = expectFinite(SphereLight{at.centre, at.radius, colour}, at.receiver, n, wrap);
        break;
    }
    failures += finite ? 0 : 1;
  }
  EXPECT_EQ(failures, 0);
}

// Energy: radiance 1 gives at most 4 pi Y00 in band 0 and irradiance between 0 and pi f_0.
TEST(HardCases, SpheresStayWithinTheWhiteFurnace) {
  Random random(72);
  const int cases = caseCount() / 3;
  int failures = 0;
  for (int k = 0; k < cases && failures < 5; ++k) {
    const HardPlace at = hardPlace(random);
    const SphereLight light{at.centre, at.radius, {1, 1, 1}};
    const Vec3 n = random.direction();
    const float wrap = hardWrap(random);
    const double band0 = project<5>(light, at.receiver)[0].r;
    const double exact = exactIrradiance(light, at.receiver, n, wrap).r;
    const double a = wrap;
    const bool holds = band0 >= 0 && band0 <= 4 * kPi * 0.2820948 * (1 + 1e-6) && exact >= 0 &&
                       exact <= kPi * 2 * (1 + a) / (2 + a) * (1 + 1e-9);
    EXPECT_TRUE(holds) << describe(light) << ", p " << describe(at.receiver) << ", n " << describe(n) << ", wrap "
                       << describe(wrap) << "\n  band 0 " << describe(band0) << ", exact " << describe(exact);
    failures += holds ? 0 : 1;
  }
  EXPECT_EQ(failures, 0);
}

TEST(HardCases, SetsOfExtremeLightsSumToFiniteValues) {
  LightSet lights;
  for (int i = 0; i < 1000; ++i) lights.add(PointLight{{}, {kLargest, kLargest, kLargest}, 0});
  const ProjectionWithGradient<5> both = projectWithGradient<5>(lights, {1e-9f, 0, 0});
  EXPECT_TRUE(allFinite(both.value.data(), 75));
  for (const RadianceSH<5>& slope : both.gradient.d) EXPECT_TRUE(allFinite(slope.data(), 75));
  EXPECT_GE(both.value[0].r, kMaxProjectionScale);
}

}  // namespace
}  // namespace rigel
