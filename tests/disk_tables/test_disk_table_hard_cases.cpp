// Any input gives finite SH: on the axis, in the plane, on the rim, behind, touching, zero radius, huge and tiny scale,
// any bit pattern. RIGEL_FULL=1: ten million of them.
#include <gtest/gtest.h>
#include <rigel/disk_table.h>
#include <rigel/project.h>

#include <bit>
#include <cmath>
#include <limits>

#include "lights/describe.h"
#include "lights/random.h"

namespace rigel {
namespace {

using test::describe;
using test::Random;

float anyBits(Random& random) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(random.index(1 << 16)) << 16 |
                              static_cast<std::uint32_t>(random.index(1 << 16)));
}

float hardValue(Random& random) {
  constexpr float kValues[] = {0,
                               1,
                               -1,
                               std::numeric_limits<float>::denorm_min(),
                               std::numeric_limits<float>::min(),
                               std::numeric_limits<float>::max(),
                               -std::numeric_limits<float>::max(),
                               std::numeric_limits<float>::infinity(),
                               std::numeric_limits<float>::quiet_NaN()};
  switch (random.index(4)) {
    case 0:
      return kValues[random.index(9)];
    case 1:
      return anyBits(random);
    default:
      return random.uniformf(-2, 2);
  }
}

Vec3 hardVector(Random& random) { return {hardValue(random), hardValue(random), hardValue(random)}; }

/// A step of the last bit, or none.
float nudged(Random& random, float x) {
  const int way = random.index(3);
  return way == 0 ? x : std::nextafter(x, way == 1 ? -HUGE_VALF : HUGE_VALF);
}

/// Exactly, and within the last bits of: the centre, the axis, the plane, the rim, the face, behind.
Vec3 hardPlace(Random& random, Vec3 axis, float radius) {
  const Vec3 helper = std::abs(axis.x) < 0.5f ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  Vec3 side = {axis.y * helper.z - axis.z * helper.y, axis.z * helper.x - axis.x * helper.z,
               axis.x * helper.y - axis.y * helper.x};
  side = side * (1 / std::hypot(side.x, side.y, side.z));
  constexpr float kAcross[] = {0, 1e-20f, 0.5f, 1, 1, 1, 2, 1e5f, 1e20f};
  constexpr float kAlong[] = {0, 0, 1e-30f, 1e-7f, -1e-7f, 1, -1, 1e5f, 1e20f};
  const float across = nudged(random, kAcross[random.index(9)]), along = nudged(random, kAlong[random.index(9)]);
  return (side * across + axis * along) * radius;
}

template <int B>
bool finite(const DiskLight& light, Vec3 p, float footprint) {
  const RadianceSH<B> q = DiskTable::project<B>(light, p, footprint);
  for (int i = 0; i < 3 * shCount(B); ++i) {
    if (!(std::abs(q.data()[i]) <= 20 * kMaxProjectionScale)) return false;
  }
  return true;
}

TEST(DiskTableHardCases, StayFinite) {
  const int cases = test::fullRun() ? 10'000'000 : 200'000;
  Random random(61);
  int failures = 0;
  for (int k = 0; k < cases && failures < 5; ++k) {
    DiskLight light;
    Vec3 p;
    if (k % 3 == 0) {
      light = {hardVector(random), hardVector(random), hardValue(random), {hardValue(random), 1, 2}, k % 2 == 0};
      p = random.index(3) == 0 ? light.position : hardVector(random);
    } else {
      light.direction = random.index(3) == 0 ? Vec3{0, k % 2 == 0 ? -1.0f : 1.0f, 0} : random.direction();
      light.radius = static_cast<float>(random.logUniform(1e-38, 1e38));
      light.radiance = random.colour();
      light.twoSided = random.index(2) == 0;
      p = hardPlace(random, light.direction, light.radius);
    }
    const float footprint = random.index(3) == 0 ? hardValue(random) : 0;
    if (finite<3>(light, p, footprint) && finite<5>(light, p, footprint)) continue;
    ++failures;
    ADD_FAILURE() << "position " << describe(light.position) << ", direction " << describe(light.direction)
                  << ", radius " << describe(light.radius) << ", radiance " << describe(light.radiance) << ", p "
                  << describe(p) << ", footprint " << describe(footprint);
  }
}

}  // namespace
}  // namespace rigel
