// Many points under many lights in vectors, on every instruction set of this machine: against 50 digits light by light,
// and against the scalar functions.
#include <gtest/gtest.h>
#include <rigel/project_batch.h>

#include "lights/batch_points.h"
#include "lights/compare_sh.h"
#include "lights/every_target.h"
#include "lights/lights_for_reference.h"
#include "reference/worst.h"

namespace rigel {
namespace {

using reference::Coefficients50;
using reference::Worst;
using test::BatchPoints;
using test::describe;
using test::onEveryTarget;
using test::Placement;
using test::Random;

// Relative to the norm of the vector of 5 bands, without window and cone. Vectors to the light are rounded to float,
// which band l has l times; c is found in double near contact. Worst measured 8.3e-7 in 10^6 cases.
constexpr double kTolerance = 1e-6;
// The same of 3 bands: worst measured 6.8e-7 in 10^7 cases, 6.0e-7 with AVX-512.
constexpr double kTolerance3 = 7e-7;
// Of a spot's cone, over the width of its cosine.
constexpr double kConeTolerance = 3e-7;

struct Case {
  LightSet light;
  Vec3 p;
  Coefficients50 expected;
  double norm3 = 0, norm5 = 0;
  double coneTolerance = 0;
  std::string text;
};

template <int B>
double normOf(const Coefficients50& c) {
  reference::Real50 sum = 0;
  for (std::size_t i = 0; i < B * B; ++i) sum += c[i] * c[i];
  return static_cast<double>(sqrt(sum));
}

template <class Light>
Case caseOf(const Light& light, const Light& unmodulated, Vec3 p) {
  Case c;
  c.light.add(light);
  c.p = p;
  c.expected = projectReference(light, reference::exactly(p), 5);
  const Coefficients50 whole = projectReference(unmodulated, reference::exactly(p), 5);
  c.norm3 = normOf<3>(whole);
  c.norm5 = normOf<5>(whole);
  c.text = describe(light) + ", p " + describe(p);
  return c;
}

/// ||difference|| / norm, over what the cone adds to the tolerance.
template <int B>
double errorOf(const Case& c, const BatchPoints& points, std::size_t lane, double norm, double tolerance) {
  const RadianceSH<B> q = test::shAt<B>(test::sumsOf<B>(c.light, points), points.size(), lane);
  reference::Real50 squared = 0;
  for (int i = 0; i < B * B; ++i) {
    const reference::Real50 difference = reference::Real50(q[i].r) - c.expected[static_cast<std::size_t>(i)];
    squared += difference * difference;
  }
  return static_cast<double>(sqrt(squared)) / norm * tolerance / (tolerance + c.coneTolerance);
}

/// Each case in some lane, its neighbours all over the place.
void compareAll(const std::string& what, const std::vector<Case>& cases) {
  onEveryTarget([&] {
    Worst worst5(what + ", 5 bands"), worst3(what + ", 3 bands");
    Random random(301);
    for (const Case& c : cases) {
      const auto lane = static_cast<std::size_t>(random.index(20));
      BatchPoints points;
      const float scale = std::abs(c.p.x) + std::abs(c.p.y) + std::abs(c.p.z);
      for (std::size_t k = 0; k < 20; ++k) points.add(k == lane ? c.p : random.pointInCube(1) * (2 * scale));
      worst5.add(errorOf<5>(c, points, lane, c.norm5, kTolerance), [&] { return c.text; });
      worst3.add(errorOf<3>(c, points, lane, c.norm3, kTolerance3), [&] { return c.text; });
    }
    worst5.expectWithin(kTolerance);
    worst3.expectWithin(kTolerance3);
  });
}

int count(int usual) { return test::fullRun() ? 20 * usual : usual; }

TEST(ProjectBatch, SphereOfEveryScaleAndSize) {
  Random random(31);
  std::vector<Case> cases;
  for (int k = 0; k < count(300); ++k) {
    const Placement at = test::place(random, random.logUniform(1e-15, 1e15));
    const SphereLight light = test::sphereAt(at, k % 2 == 0 ? random.logUniform(1e-8, 0.9) : random.uniform(0.1, 0.9));
    cases.push_back(caseOf(light, light, at.receiver));
  }
  compareAll("sphere in vectors, r/d 1e-8 to 0.9, d 1e-15 to 1e15", cases);
}

TEST(ProjectBatch, SphereTouchingAndInside) {
  Random random(32);
  std::vector<Case> cases;
  for (int k = 0; k < count(200); ++k) {
    const Placement at = test::place(random, random.logUniform(1e-14, 1e14));
    const double gap = random.logUniform(1e-7, 0.1);
    const double ratio = k % 3 == 0 ? 1 - gap : k % 3 == 1 ? 1 + gap : 1 / random.logUniform(1e-8, 0.9);
    const SphereLight light = test::sphereAt(at, ratio);
    cases.push_back(caseOf(light, light, at.receiver));
  }
  compareAll("sphere in vectors, touching and inside", cases);
}

TEST(ProjectBatch, PointWithWindow) {
  Random random(34);
  std::vector<Case> cases;
  for (int k = 0; k < count(300); ++k) {
    const Placement at = test::place(random, random.logUniform(1e-3, 1e6));
    const double ratio = k % 5 == 0 ? random.uniform(1.2, 20) : random.logUniform(1e-8, 0.9);
    const PointLight light = test::pointAt(random, at, ratio);
    PointLight whole = light;
    whole.range = kNoRange;
    cases.push_back(caseOf(light, whole, at.receiver));
  }
  compareAll("point in vectors, radius raised, outside and inside, range window", cases);
}

TEST(ProjectBatch, SpotWithConeAndWindow) {
  Random random(35);
  std::vector<Case> cases;
  for (int k = 0; k < count(300); ++k) {
    const Placement at = test::place(random, random.logUniform(1e-3, 1e6));
    const double ratio = k % 5 == 0 ? random.uniform(1.2, 20) : random.logUniform(1e-8, 0.9);
    const SpotLight light = test::spotAt(random, at, ratio);
    SpotLight whole = light;
    whole.range = kNoRange;
    whole.innerAngle = whole.outerAngle = 3.14159274f;
    cases.push_back(caseOf(light, whole, at.receiver));
    const double width =
        std::cos(static_cast<double>(light.innerAngle)) - std::cos(static_cast<double>(light.outerAngle));
    cases.back().coneTolerance = kConeTolerance / std::max<double>(width, kMinConeWidth);
  }
  compareAll("spot in vectors, outside and inside, cone and window", cases);
}

TEST(ProjectBatch, Directional) {
  Random random(36);
  std::vector<Case> cases;
  for (int k = 0; k < 50; ++k) {
    const DirectionalLight light{random.direction() * static_cast<float>(random.logUniform(1e-15, 1e15)), {1, 1, 1}};
    cases.push_back(caseOf(light, light, random.pointInCube(10)));
  }
  compareAll("directional in vectors", cases);
}

/// Lights of every kind around a box of 2 m, some of them in it.
LightSet someOfEveryKind(Random& random, int perKind) {
  LightSet lights;
  for (int k = 0; k < perKind; ++k) {
    const auto place = [&] { return random.pointInCube(k % 4 == 0 ? 1 : 8); };
    lights.add(DirectionalLight{random.direction(), random.colour()});
    lights.add(PointLight{place(), random.colour(), 0.02f, k % 2 == 0 ? kNoRange : random.uniformf(1, 12)});
    const Vec3 p = place();
    lights.add(SpotLight{p, random.pointInCube(1) - p, random.colour(), random.uniformf(0, 0.4), 0.8f, 0.01f, 20});
    lights.add(SphereLight{place(), random.uniformf(0.01, 0.5), random.colour()});
    lights.add(DiskLight{place(), random.direction(), random.uniformf(0.05, 0.5), random.colour(), k % 2 == 0});
  }
  return lights;
}

double normOf(const auto& sh) {
  double sum = 0;
  for (const Rgb& c : sh.c) sum += static_cast<double>(c.g) * c.g;
  return std::sqrt(sum);
}

// Errors are relative to a light without its window and cone.
const auto& whole(const auto& light) { return light; }
PointLight whole(const PointLight& light) { return {light.position, light.intensity, light.radius}; }
PointLight whole(const SpotLight& light) { return {light.position, light.intensity, light.radius}; }

// Sums of a few lights each, so that what one misses does not drown; the peaks of disks and of what is inside a light
// included.
template <int B>
void compareWithScalar(Worst& worst, Random& random, bool withFootprints) {
  const LightSet lights = someOfEveryKind(random, 1 + random.index(3));
  BatchPoints points;
  std::vector<float> footprints;
  const int n = 1 + random.index(90);
  for (int k = 0; k < n; ++k) {
    points.add(random.pointInCube(1));
    footprints.push_back(random.index(3) == 0 ? 0 : random.uniformf(0, 0.5));
  }
  PreparedLights prepared;
  prepared.set(lights);
  std::vector<LightUse> uses(prepared.all().begin(), prepared.all().end());
  for (LightUse& use : uses) use.share = random.index(3) == 0 ? random.uniformf(0, 1) : 1;
  std::shuffle(uses.begin(), uses.end(), std::mt19937(5));
  std::vector<float> sums(3 * B * B * points.size());
  projectBatch<B>(prepared, uses, points.rows(), withFootprints ? footprints : std::vector<float>(), sums);
  for (std::size_t k = 0; k < points.size(); ++k) {
    RadianceSH<B> expected;
    double scale = 0;
    for (const LightUse& use : uses)
      lights.visit(static_cast<int>(use.light), [&](const auto& light) {
        const float footprint = withFootprints ? footprints[k] : 0;
        expected += project<B>(light, points[k], footprint) * use.share;
        scale += normOf(project<B>(whole(light), points[k], footprint) * use.share);
      });
    const RadianceSH<B> q = test::shAt<B>(sums, points.size(), k);
    double squared = 0;
    for (int i = 0; i < B * B; ++i) {
      const double difference = static_cast<double>(q[i].g) - expected[i].g;
      squared += difference * difference;
    }
    worst.add(std::sqrt(squared) / scale, [&] { return std::to_string(k) + " of " + describe(points[k]); });
  }
}

template <int B>
void compareManyWithScalar() {
  onEveryTarget([] {
    Random random(38);
    Worst worst("every kind in vectors against scalars, " + std::to_string(B) + " bands");
    for (int k = 0; k < count(60); ++k) compareWithScalar<B>(worst, random, k % 2 == 0);
    // Disks near their plane and rim differ by up to 2e-6 (disk_batch.h); a cone 0.3 wide by 1e-6.
    worst.expectWithin(2e-6);
  });
}

TEST(ProjectBatch, EveryKind2Bands) { compareManyWithScalar<2>(); }
TEST(ProjectBatch, EveryKind3Bands) { compareManyWithScalar<3>(); }
TEST(ProjectBatch, EveryKind4Bands) { compareManyWithScalar<4>(); }
TEST(ProjectBatch, EveryKind5Bands) { compareManyWithScalar<5>(); }

// What a point receives depends on no other point, nor on where it is stored.
TEST(ProjectBatch, AnyCountAndAlignmentGivesTheSame) {
  onEveryTarget([] {
    constexpr float kUntouched = -12345;
    Random random(39);
    const LightSet lights = someOfEveryKind(random, 12);
    PreparedLights prepared;
    prepared.set(lights);
    const std::span<const LightUse> uses = prepared.all();
    BatchPoints all;
    std::vector<float> footprints;
    for (int k = 0; k < 150; ++k) {
      all.add(random.pointInCube(1));
      footprints.push_back(random.uniformf(0, 0.2));
    }
    for (const bool withFootprints : {false, true}) {
      const auto of = [&](std::size_t n) {
        return withFootprints ? std::span<const float>(footprints).first(n) : std::span<const float>();
      };
      std::vector<float> whole(27 * all.size());
      projectBatch<3>(prepared, uses, all.rows(), of(all.size()), whole);
      for (std::size_t n = 0; n <= 150; n += n < 70 ? 1 : 16) {
        BatchPoints some(static_cast<int>(1 + n % 5));
        for (std::size_t k = 0; k < n; ++k) some.add(all[k]);
        std::vector<float> sums(27 * n + 2, kUntouched);
        projectBatch<3>(prepared, uses, some.rows(), of(n), std::span(sums).subspan(1, 27 * n));
        for (std::size_t row = 0; row < 27; ++row)
          for (std::size_t k = 0; k < n; ++k)
            ASSERT_EQ(sums[1 + row * n + k], whole[row * all.size() + k]) << k << " of " << n << ", row " << row;
        ASSERT_EQ(sums.front(), kUntouched);
        ASSERT_EQ(sums.back(), kUntouched);
      }
    }
  });
}

// Any number of lines to fetch beside any number of lights, at addresses that need not exist.
TEST(ProjectBatch, LinesAheadChangeNothing) {
  onEveryTarget([] {
    Random random(40);
    const LightSet lights = someOfEveryKind(random, 3);
    PreparedLights prepared;
    prepared.set(lights);
    BatchPoints points;
    for (int k = 0; k < 40; ++k) points.add(random.pointInCube(1));
    std::vector<const void*> lines(2000);
    for (std::size_t i = 0; i < lines.size(); ++i) lines[i] = i % 2 == 0 ? &lines[i] : nullptr;
    std::vector<float> plain(27 * points.size()), sums(plain.size());
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, prepared.all().size()}) {
      const auto uses = prepared.all().first(count);
      projectBatch<3>(prepared, uses, points.rows(), {}, plain);
      for (const std::size_t n : {0, 1, 7, 300, 2000}) {
        projectBatch<3>(prepared, uses, points.rows(), {}, sums, {}, std::span(lines).first(n));
        EXPECT_EQ(sums, plain) << count << " lights, " << n << " lines";
      }
    }
  });
}

TEST(ProjectBatch, LightsBeyondTheSetAndNoLights) {
  PreparedLights prepared;
  LightSet set;
  set.add(DirectionalLight{{0, -1, 0}, {1, 2, 3}});
  prepared.set(set);
  const SphereLight cluster{{1, 2, 3}, 0.2f, {5, 6, 7}};
  const std::uint32_t index = prepared.add(cluster);
  EXPECT_EQ(index, 1u);
  BatchPoints points;
  points.add({0.1f, 0.2f, 0.3f});
  std::vector<float> sums(27);
  const LightUse use[] = {{index, 0.5f}};
  projectBatch<3>(prepared, use, points.rows(), {}, sums);
  const RadianceSH<3> expected = project<3>(cluster, points[0]) * 0.5f;
  for (int i = 0; i < 27; ++i) EXPECT_NEAR(sums[static_cast<std::size_t>(i)], expected.data()[i], 1e-6f);
  projectBatch<3>(prepared, {}, points.rows(), {}, sums);
  for (const float sum : sums) EXPECT_EQ(sum, 0);
  prepared.set(set);
  EXPECT_EQ(prepared.size(), 1);
}

}  // namespace
}  // namespace rigel
