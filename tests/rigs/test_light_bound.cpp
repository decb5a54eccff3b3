// Bounds against the truth found by search: never below it, and how far above. RIGEL_FULL=1: 10^5 lights per rig and
// light kind. Each rig prints its table: bound / true over the lights that reach the object.
#include "bound_truth.h"
#include "largest_jump.h"
#include "lights/describe.h"
#include "lights/random.h"
#include "random_lights.h"
#include "rig_fixture.h"

#include <rigel/exact.h>
#include <rigel/light_bound.h>
#include <rigel/probed_bounds.h>

#include <algorithm>
#include <cstdio>
#include <limits>

namespace rigel::test {
namespace {

constexpr Vec3 kCentre{0.3f, -0.2f, 0.1f};

/// Cube, car, human, dragon, flat [m].
const std::vector<Vec3> kBoxes = {
    {0.5f, 0.5f, 0.5f}, {2.25f, 0.75f, 0.9f}, {0.3f, 0.9f, 0.2f}, {4, 0.5f, 0.5f}, {1, 0.01f, 0.7f}};
const std::vector<Vec3> kBalls = {{0.5f, 0.5f, 0.5f}, {2, 2, 2}};

struct Case {
  std::string spec;
  Domain::Kind domain;
  double medianSphere, medianPoint, medianSpot, medianDisk;  // largest allowed
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.spec; }

// Measured medians with RIGEL_FULL=1 are in rigs/README.md.
const std::vector<Case> kCases = {
    {"constant", Domain::Kind::ball, 1.2, 1.2, 1.2, 1.5},
    {"gradient", Domain::Kind::ball, 1.2, 1.2, 1.2, 2},
    {"gradient@numeric", Domain::Kind::ball, 3, 3, 3, 3},
    {"constant", Domain::Kind::box, 1.2, 1.2, 1.7, 1.5},
    {"gradient", Domain::Kind::box, 1.5, 1.5, 2.5, 2},
    {"gradient@numeric", Domain::Kind::box, 3, 3, 5, 3},
    {"lattice:2x2x2", Domain::Kind::box, 3, 3, 3, 3},
    {"lattice:3x2x2", Domain::Kind::box, 3, 3, 3, 3},
    {"lattice:8x4x2", Domain::Kind::box, 3, 3, 3, 3},
    {"lattice:3x2x2:smooth", Domain::Kind::box, 3, 3, 3, 3},
    {"lattice:4x3x2:cubic", Domain::Kind::box, 3, 3, 3, 3},
    {"mixed:l3,g,c", Domain::Kind::box, 8, 8, 8, 3},
    {"mixed:g,g,c", Domain::Kind::box, 8, 8, 8, 3},
    {"mixed:xyz:c,l4,g", Domain::Kind::box, 8, 8, 8, 3},
    {"mixed:l3,g,c@numeric", Domain::Kind::box, 8, 8, 8, 3},
    {"poly:1", Domain::Kind::ellipsoid, 5, 5, 8, 5},
    {"poly:4", Domain::Kind::ellipsoid, 10, 10, 15, 10},
    {"poly:6", Domain::Kind::ellipsoid, 10, 10, 15, 10},
    {"poly:12", Domain::Kind::ellipsoid, 20, 20, 30, 20},
    {"poly:20", Domain::Kind::ellipsoid, 30, 35, 50, 30},
    {"invquad:1", Domain::Kind::ellipsoid, 30, 30, 50, 30},
    {"invquad:6", Domain::Kind::ellipsoid, 70, 70, 120, 90},
    {"invquad:12", Domain::Kind::ellipsoid, 200, 200, 400, 250},
    {"constant@lsq", Domain::Kind::ellipsoid, 5, 5, 8, 5},
    {"gradient@lsq", Domain::Kind::ellipsoid, 10, 10, 15, 10},
    {"lattice:3x2x2@lsq", Domain::Kind::ellipsoid, 25, 25, 35, 25},
    {"mixed:l3,g,c@lsq", Domain::Kind::ellipsoid, 10, 10, 15, 10},
    {"lattice:3x2x2@gauss", Domain::Kind::box, 30, 30, 50, 10},
    {"mixed:l3,g,c@gauss", Domain::Kind::box, 30, 30, 50, 6},
    {"latticegrad:1x1x1", Domain::Kind::box, 1.5, 1.5, 2.5, 2},
    {"latticegrad:3x2x2", Domain::Kind::box, 3, 3, 15, 15},
    {"latticegrad:2x2x1:smooth", Domain::Kind::box, 3, 3, 10, 6},
    {"hermite:3x2x2", Domain::Kind::box, 10, 10, 35, 20},
    {"hermite:3x1x1", Domain::Kind::box, 3, 3, 10, 5},
    {"rbf:1", Domain::Kind::ellipsoid, 5, 5, 8, 5},
    {"rbf:6", Domain::Kind::ellipsoid, 10, 10, 15, 10},
    {"rbf:12", Domain::Kind::ellipsoid, 15, 15, 20, 15},
    {"rbf:24", Domain::Kind::ellipsoid, 20, 20, 35, 20},
};

struct Ratios {
  std::vector<double> ratio, probed;
  int dark = 0;  // lights of which neither the rig nor the truth holds anything
  static double at(double quantile, std::vector<double>& of) {
    std::ranges::sort(of);
    return of.empty() ? 0 : of[static_cast<std::size_t>(quantile * static_cast<double>(of.size() - 1))];
  }
};

void adaptTo(const LightSet& frame, Rig& rig) {
  std::vector<RadianceSH<3>> functionals(static_cast<std::size_t>(rig.projections()));
  projectSamples<3>(rig, {}, frame, functionals);
  adaptRig<3>(rig, functionals);
}

class LightBound : public testing::TestWithParam<Case> {
 protected:
  static constexpr int kPromised = 4;  // every fourth light: they take twenty times as long

  /// Bound / true of `count` lights made by `next`, over all shapes.
  template <class Next>
  Ratios measure(int count, Next next) {
    const Case& c = GetParam();
    const std::vector<Vec3>& shapes = c.domain == Domain::Kind::ball ? kBalls : kBoxes;
    Ratios out;
    unsigned seed = 0;
    for (const Vec3 half : shapes) {
      const RigBox box{kCentre - half, kCentre + half};
      const std::vector<Vec3> surface = ellipsoid(kCentre, half, 600), fine = ellipsoid(kCentre, half, 2400);
      Rig rig = *Rig::create(specOf(c.spec), {box, surface});
      // What promises are made of is a surface that is known as well as in reports.
      Rig known = *Rig::create(specOf(c.spec), {box, fine, true});
      const float radius = c.domain == Domain::Kind::ball ? half.x : kNoRange;
      const auto boundsOf = [&](const Rig& of, float wrap) { return LightBounds(of, {}, wrap, radius); };
      const auto probedOf = [&](const Rig& of, float wrap) { return ProbedBounds(of, {}, wrap, radius); };
      const std::array wraps{0.0f, 0.5f, -0.25f};
      const std::array bounds{boundsOf(rig, wraps[0]), boundsOf(rig, wraps[1]), boundsOf(rig, wraps[2])};
      std::array probed{probedOf(known, wraps[0]), probedOf(known, wraps[1]), probedOf(known, wraps[2])};
      RandomLights lights(box, 11 + ++seed, c.domain == Domain::Kind::ellipsoid);
      for (int i = 0; i < count / static_cast<int>(shapes.size()); ++i) {
        const int w = i % 8 == 1 ? 1 : i % 8 == 2 ? 2 : 0;
        const auto light = next(lights);
        rigel::LightBound bound = bounds[w](light);
        const bool asked = probed[w].tight() && i % kPromised == 0;
        if (rig.spec().falloff) {
          // Bounds are those of the falloff that the rig has: of this light and another.
          LightSet frame;
          frame.add(light);
          frame.add(lights.sphere());
          adaptTo(frame, rig);
          bound = boundsOf(rig, wraps[w])(light);
          if (asked) {
            adaptTo(frame, known);
            probed[w] = probedOf(known, wraps[w]);
          }
        }
        const Domain domain{box, c.domain};
        const double truth = trueError(rig, light, light.position, domain, wraps[w], ++seed);
        EXPECT_TRUE(std::isfinite(bound.error) && bound.error >= 0);
        EXPECT_LE(truth, bound.error) << describe(light) << " wrap " << wraps[w];
        if (bound.peak == 0) {
          EXPECT_EQ(truth, 0);
        }
        if (truth > std::numeric_limits<float>::min()) {
          out.ratio.push_back(bound.error / truth);
        } else {
          ++out.dark;
        }
        if (!asked) continue;
        const float tight = probed[w](light).error;
        const double trueOfKnown = trueError(known, light, light.position, domain, wraps[w], seed);
        EXPECT_LE(trueOfKnown, tight) << describe(light) << " wrap " << wraps[w] << " box " << half.x;
        EXPECT_LE(tight, boundsOf(known, wraps[w])(light).error) << describe(light);
        if (trueOfKnown > std::numeric_limits<float>::min()) out.probed.push_back(tight / trueOfKnown);
      }
    }
    EXPECT_GT(out.ratio.size(), static_cast<std::size_t>(count / 2));
    return out;
  }

  template <class Next>
  void check(const char* kind, double median, Next next) {
    // The falloff of invquad has bounds of its own for every light, and they take a hundred times as long. The models
    // that were dropped are for comparison alone.
    const RigSpec spec = specOf(GetParam().spec);
    const bool dropped = spec.family != RigSpec::Family::tensor && spec.family != RigSpec::Family::poly;
    const bool fewer = spec.falloff || dropped;
    const int few = fewer ? 200 : 1000, many = fewer ? 11000 : 110000;
    Ratios ratios = measure(fullRun() ? many : few, next);
    print(kind, ratios);
    EXPECT_LT(Ratios::at(0.5, ratios.ratio), median);
    if (!ratios.probed.empty()) {
      // Of few lights medians vary.
      const double ofDisks = fullRun() || !fewer ? 3 : 4.5;
      EXPECT_LT(Ratios::at(0.5, ratios.probed), std::string(kind) == "disk" ? ofDisks : 7);
    }
  }

 private:
  void print(const char* kind, Ratios& r) {
    const char* domain = GetParam().domain == Domain::Kind::ball  ? "ball"
                         : GetParam().domain == Domain::Kind::box ? "box"
                                                                  : "ellipsoid";
    const auto line = [&](const char* name, std::vector<double>& ratio) {
      std::printf("%-22s %-9s %-6s %-6s %7zu lights %6d dark  min %.4f  median %.2f  90%% %.1f  max %.2g\n",
                  GetParam().spec.c_str(), domain, kind, name, ratio.size(), r.dark, Ratios::at(0, ratio),
                  Ratios::at(0.5, ratio), Ratios::at(0.9, ratio), Ratios::at(1, ratio));
    };
    line("bound", r.ratio);
    if (!r.probed.empty()) line("probed", r.probed);
  }
};

TEST_P(LightBound, IsNeverBelowTheTruthOfSpheres) {
  check("sphere", GetParam().medianSphere, [](RandomLights& lights) { return lights.sphere(); });
}
TEST_P(LightBound, IsNeverBelowTheTruthOfPoints) {
  check("point", GetParam().medianPoint, [](RandomLights& lights) { return lights.point(); });
}
TEST_P(LightBound, IsNeverBelowTheTruthOfSpots) {
  check("spot", GetParam().medianSpot, [](RandomLights& lights) { return lights.spot(); });
}
TEST_P(LightBound, IsNeverBelowTheTruthOfDisks) {
  check("disk", GetParam().medianDisk, [](RandomLights& lights) { return lights.disk(); });
}

std::string nameOf(const testing::TestParamInfo<Case>& info) {
  std::string name = info.param.spec + (info.param.domain == Domain::Kind::ball ? "_ball" : "");
  std::ranges::replace_if(
      name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Rigs, LightBound, testing::ValuesIn(kCases), nameOf);

const RigBox kBox{{-1, -0.5f, -0.4f}, {1, 0.5f, 0.4f}};
Rig boxRig(const std::string& spec) {
  const std::vector<Vec3> surface = ellipsoid({}, kBox.hi, 600);
  return *Rig::create(specOf(spec), {kBox, surface});
}

TEST(LightBoundCases, DirectionalLightsCostNoError) {
  for (const std::string& spec : everyKindOfSpec()) {
    const Rig rig = boxRig(spec);
    const LightBounds bounds(rig, {});
    EXPECT_EQ(bounds(DirectionalLight{{0, -1, 0}, {1, 1, 1}}).error, 0) << spec;
    EXPECT_NEAR(bounds(DirectionalLight{{0, -1, 0}, {1, 1, 1}}).peak, 1.0625, 1e-6);
    EXPECT_EQ(bounds(DirectionalLight{{0, 0, 0}, {1, 1, 1}}).peak, 0);
  }
}

TEST(LightBoundCases, WhatGivesNothingIsZero) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  for (const std::string& spec : everyKindOfSpec()) {
    const Rig rig = boxRig(spec);
    const LightBounds bounds(rig, {});
    const auto zero = [&](auto light) {
      const rigel::LightBound bound = bounds(light);
      return bound.error == 0 && bound.peak == 0;
    };
    EXPECT_TRUE(zero(SphereLight{{0, 3, 0}, 0, {1, 1, 1}})) << spec;
    EXPECT_TRUE(zero(SphereLight{{0, nan, 0}, 1, {1, 1, 1}})) << spec;
    EXPECT_TRUE(zero(SphereLight{{0, 3, 0}, nan, {1, 1, 1}})) << spec;
    EXPECT_TRUE(zero(SphereLight{{0, infinite, 0}, 1, {1, 1, 1}})) << spec;
    EXPECT_TRUE(zero(DiskLight{{0, 3, 0}, {0, -1, 0}, 0, {1, 1, 1}})) << spec;
    EXPECT_TRUE(zero(DiskLight{{0, 3, 0}, {0, -1, 0}, nan, {1, 1, 1}})) << spec;
    EXPECT_TRUE(zero(DiskLight{{0, 3, nan}, {0, -1, 0}, 1, {1, 1, 1}})) << spec;
    EXPECT_TRUE(zero(DiskLight{{0, 3, 0}, {0, 0, 0}, 1, {1, 1, 1}})) << spec;
    EXPECT_TRUE(zero(DiskLight{{0, 3, 0}, {0, nan, 0}, 1, {1, 1, 1}})) << spec;
    // Behind the disk, all of it or all but its top, and before its other face.
    EXPECT_TRUE(zero(DiskLight{{0, 3, 0}, {0, 1, 0}, 1, {1, 1, 1}})) << spec;
    EXPECT_TRUE(zero(DiskLight{{0, 0.7f, 0}, {0, 1, 0}, 5, {1, 1, 1}})) << spec;
    EXPECT_FALSE(zero(DiskLight{{0, 0.49f, 0}, {0, 1, 0}, 5, {1, 1, 1}})) << spec;
    // Just behind, it is expected to come to light.
    const rigel::LightBound behind = bounds(DiskLight{{0, 0.51f, 0}, {0, 1, 0}, 5, {1, 1, 1}});
    EXPECT_EQ(behind.peak, 0) << spec;
    EXPECT_GT(behind.error, 0) << spec;
    EXPECT_FALSE(zero(DiskLight{{0, 3, 0}, {0, 1, 0}, 1, {1, 1, 1}, true})) << spec;
    EXPECT_TRUE(zero(PointLight{{0, 3, 0}, {1, 1, 1}, 0.01f, 2.4f})) << spec;
    EXPECT_TRUE(zero(PointLight{{0, 3, 0}, {1, 1, 1}, 0.01f, -1})) << spec;
    EXPECT_TRUE(zero(PointLight{{0, 3, 0}, {1, 1, 1}, nan})) << spec;
    EXPECT_TRUE(zero(SpotLight{{0, 3, 0}, {0, 1, 0}, {1, 1, 1}, 0.2f, 0.5f})) << spec;
    EXPECT_TRUE(zero(SpotLight{{0, 3, 0}, {1, 0, 0}, {1, 1, 1}, 0.2f, 0.7f})) << spec;
    EXPECT_TRUE(zero(SpotLight{{0, 3, 0}, {0, 0, 0}, {1, 1, 1}, 0.2f, 0.5f})) << spec;
    EXPECT_TRUE(zero(SpotLight{{0, 3, 0}, {0, -1, 0}, {1, 1, 1}, nan, 0.5f})) << spec;
    EXPECT_FALSE(zero(SpotLight{{0, 3, 0}, {0, -1, 0}, {1, 1, 1}, 0.2f, 0.5f})) << spec;
    EXPECT_FALSE(zero(PointLight{{0, 3, 0}, {1, 1, 1}, 0.01f, 2.6f})) << spec;
  }
}

TEST(LightBoundCases, SpotThatLightsAllOfTheObjectIsAPoint) {
  for (const std::string& spec : everyKindOfSpec()) {
    const Rig rig = boxRig(spec);
    const LightBounds bounds(rig, {});
    const rigel::LightBound spot = bounds(SpotLight{{0, 4, 0}, {0, -1, 0}, {1, 1, 1}, 0.5f, 0.6f});
    const rigel::LightBound point = bounds(PointLight{{0, 4, 0}, {1, 1, 1}});
    EXPECT_FLOAT_EQ(spot.error, point.error) << spec;
    EXPECT_FLOAT_EQ(spot.peak, point.peak) << spec;
  }
}

TEST(LightBoundCases, IsFiniteForAnyFiniteLight) {
  Random random(5);
  for (const std::string& spec : everyKindOfSpec()) {
    const Rig rig = boxRig(spec);
    const LightBounds bounds(rig, {});
    for (int i = 0; i < 2000; ++i) {
      const auto scale = static_cast<float>(random.logUniform(1e-30, 1e30));
      const Vec3 p = random.direction() * scale;
      const auto radius = static_cast<float>(random.logUniform(1e-30, 1e18));
      const auto range = static_cast<float>(random.logUniform(1e-20, 1e30));
      for (const rigel::LightBound b :
           {bounds(SphereLight{p, radius, {1, 1, 1}}), bounds(PointLight{p, {1, 1, 1}, radius, range}),
            bounds(SpotLight{p, random.direction(), {1, 1, 1}, 0.1f, 0.1f, radius, range}),
            bounds(DiskLight{p, random.direction(), radius, {1, 1, 1}, i % 2 == 0})}) {
        ASSERT_TRUE(std::isfinite(b.error) && std::isfinite(b.peak)) << spec;
        ASSERT_GE(b.error, 0);
        ASSERT_GE(b.peak, 0);
      }
    }
  }
}

// Next to a light's surface the bound varies as a square root: 2e-7 of the path is 1e-3 of it.
constexpr double kSquareRoot = 3e-3;
// A face that comes out of the box lights less and less of it within a few micrometres.
constexpr double kFace = 6e-3;

TEST(LightBoundCases, IsContinuousInTheLight) {
  for (const std::string spec : {"constant", "gradient", "gradient@numeric", "lattice:3x2x2", "mixed:l3,g,c", "poly:6",
                                 "lattice:3x2x2@lsq", "lattice:3x2x2@gauss"}) {
    const Rig rig = boxRig(spec);
    const LightBounds bounds(rig, {});
    const auto path = [](float t) { return Vec3{-3 + 6 * t, 0.2f + 0.5f * t, 0.1f - 0.6f * t}; };
    const auto check = [&](const char* name, auto make, double allowed = kSquareRoot) {
      const auto error = [&](double t) { return double{bounds(make(static_cast<float>(t))).error}; };
      EXPECT_LT(largestJump(5000, error), allowed) << spec << ' ' << name;
    };
    check("sphere through the box", [&](float t) { return SphereLight{path(t), 0.3f, {1, 1, 1}}; });
    check("growing sphere", [&](float t) { return SphereLight{{1.5f, 1, 0.3f}, 3 * t, {1, 1, 1}}; });
    check("point with window", [&](float t) { return PointLight{path(t), {1, 1, 1}, 0.2f, 1.5f}; });
    check("spot through the box", [&](float t) {
      return SpotLight{path(t), {0.3f, -1, 0.2f}, {1, 1, 1}, 0.3f, 0.6f, 0.2f};
    });
    check(
        "disk through the box",
        [&](float t) {
          return DiskLight{path(t), {1, 0.3f, 0.2f}, 0.6f, {1, 1, 1}};
        },
        kFace);
    check("two-sided disk, edge on", [&](float t) {
      return DiskLight{path(t), {0.1f, 1, 0.2f}, 0.3f, {1, 1, 1}, true};
    });
    check("turning disk", [&](float t) {
      return DiskLight{{0.5f, 1, 0.7f}, {std::sin(6 * t), -std::cos(6 * t), 0.2f}, 0.4f, {1, 1, 1}};
    });
    check("growing disk", [&](float t) { return DiskLight{{1.2f, 1, 0.3f}, {-1, -0.5f, 0.2f}, 3 * t, {1, 1, 1}}; });
    check("turning spot", [&](float t) {
      return SpotLight{{0.5f, 2, 0.7f}, {std::sin(6 * t), -std::cos(6 * t), 0.2f}, {1, 1, 1}, 0.3f, 0.5f, 0.1f};
    });
  }
}

TEST(LightBoundCases, IsContinuousInThePose) {
  // As for lights; coordinates of poses are floats, and t moves them by few units in the last place.
  const std::vector<Vec3> surface = ellipsoid({}, kBox.hi, 600);
  for (const std::string spec : {"constant", "gradient", "gradient@numeric", "lattice:3x2x2", "lattice:4x3x2:cubic",
                                 "mixed:l3,g,c", "poly:6", "invquad:6", "lattice:3x2x2@lsq", "lattice:3x2x2@gauss"}) {
    Rig rig = boxRig(spec);
    std::vector<Vec3> anchors(rig.anchors().size());
    // Grows along x, sways along y, bends the anchors, and is nearly flat at t = 1/2.
    const auto posed = [&](double t) {
      const Vec3 scale{static_cast<float>(1 + t), 1, static_cast<float>(0.02 + std::abs(2 * t - 1))};
      const Vec3 shift{0, static_cast<float>(0.5 * std::sin(6 * t)), 0};
      const auto moved = [&](Vec3 p) { return Vec3{p.x * scale.x, p.y * scale.y, p.z * scale.z} + shift; };
      const auto bend = static_cast<float>(0.8 * t);
      for (std::size_t i = 0; i < anchors.size(); ++i) {
        const Vec3 p = surface[rig.anchors()[i]];
        anchors[i] = moved({p.x * (1 - bend * p.y * p.y), p.y, p.z});
      }
      rig.setPose({{moved(kBox.lo), moved(kBox.hi)}, anchors});
      return LightBounds(rig, {});
    };
    const auto check = [&](const char* name, auto light) {
      EXPECT_LT(largestJump(400, [&](double t) { return double{posed(t)(light).error}; }), kSquareRoot)
          << spec << ' ' << name;
    };
    check("sphere that touches", SphereLight{{1.5f, 0.6f, 0.1f}, 0.3f, {1, 1, 1}});
    check("point inside", PointLight{{0.4f, 0.1f, 0.05f}, {1, 1, 1}, 0.05f, 3});
    check("far point", PointLight{{5, 4, -3}, {1, 1, 1}});
    check("spot", SpotLight{{0.5f, 2, 0.7f}, {0.1f, -1, -0.3f}, {1, 1, 1}, 0.2f, 0.5f, 0.1f});
    check("disk", DiskLight{{0.5f, 0.6f, 0.7f}, {0.1f, -1, -0.3f}, 0.5f, {1, 1, 1}});
  }
}

/// Over points of the box and normals, half of which look at the light.
TEST(LightBoundCases, PeakHoldsTheIrradianceOfDisks) {
  const Rig rig = boxRig("constant");
  for (const float wrap : {0.0f, 0.5f, 1.0f, -0.25f}) {
    const LightBounds bounds(rig, {}, wrap);
    RandomLights lights(kBox, 7);
    Random random(8);
    double closest = 0;
    for (int i = 0; i < 1000; ++i) {
      const DiskLight light = lights.disk();
      const double peak = bounds(light).peak;
      for (int k = 0; k < 20; ++k) {
        Vec3 p, n = random.direction();
        for (int a = 0; a < 3; ++a) p[a] = std::clamp(light.position[a], kBox.lo[a], kBox.hi[a]);
        for (int a = 0; a < 3 && k > 0; ++a) p[a] = random.uniformf(kBox.lo[a], kBox.hi[a]);
        if (k % 2 == 0) n = light.position - p;
        if (!(length(n) > 0)) continue;
        const double exact = exactIrradiance(light, p, n, wrap).g;
        ASSERT_LE(exact, peak) << describe(light) << " at " << describe(p) << ", " << describe(n) << " wrap " << wrap;
        if (peak > 0) closest = std::max(closest, exact / peak);
      }
    }
    EXPECT_GT(closest, 0.5) << "nothing came near the bound";
  }
}

TEST(LightBoundCases, FollowsTheFrame) {
  const float co = std::cos(0.7f), si = std::sin(0.7f);
  const RigFrame turned{{co, 0, -si}, {0, 1, 0}, {si, 0, co}, {5, -2, 3}};
  for (const std::string& spec : everyKindOfSpec()) {
    const Rig rig = boxRig(spec);
    const LightBounds here(rig, {});
    const LightBounds there(rig, turned);
    RandomLights lights(kBox, 3);
    for (int i = 0; i < 50; ++i) {
      const SpotLight light = lights.spot();
      SpotLight moved = light;
      moved.position = turned.point(light.position);
      moved.direction = turned.vector(light.direction);
      const double distance = length(light.position);
      if (distance < 3) continue;  // beside the object's very surface, float positions move by more than 1e-3
      EXPECT_NEAR(there(moved).error, here(light).error, 1e-3 * std::abs(here(light).error)) << spec;
    }
  }
}

}  // namespace
}  // namespace rigel::test
