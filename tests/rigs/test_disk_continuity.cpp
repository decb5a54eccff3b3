// No popping at a disk light: an object moves through its face, past its rim and behind it, at 60 and at 480 frames a
// second. What passes the face leaps from darkness to all of the light, as the truth does: that is no error where the
// light is evaluated exactly, and one that no frame rate makes smaller where a part of it is in the rig.
#include <rigel/object_lighting.h>

#include "lights/random.h"

#include "lighting_fixture.h"

namespace rigel::test {
namespace {

using Kind = LightingTarget::Kind;

struct Passage {
  std::string name;
  Vec3 from, velocity;
  bool crossesFace = false;
  Vec3 acceleration{};

  Vec3 at(double t) const {
    const auto s = static_cast<float>(t);
    return from + velocity * s + acceleration * (s * s / 2);
  }
};

constexpr Vec3 kHalf{0.5f, 0.9f, 0.4f};
constexpr double kSeconds = 1.5;

/// The disk stands upright at the origin, shines along +x, and is twice as far from rim to rim as the object is deep.
LightSet aroundADisk(bool twoSided) {
  LightSet lights;
  lights.add(DiskLight{{0, 0, 0}, {1, 0.1f, 0}, 0.8f, {3, 3, 3}, twoSided});
  lights.add(PointLight{{1, 3, 1}, {10, 10, 10}});
  lights.add(SphereLight{{-2, 2, 2}, 0.2f, {60, 60, 60}});
  lights.add(DiskLight{{-1, 3.5f, -1}, {0.2f, -1, 0.3f}, 0.3f, {20, 20, 20}});
  lights.add(DirectionalLight{{0.2f, -1, 0.1f}, {1, 1, 1}});
  return lights;
}

std::vector<Passage> passages() {
  return {{"through the face", {-1.6f, 0.05f, 0.1f}, {2.1f, 0.1f, 0}, true},
          {"through the face at eight radii a second", {-7, 0.05f, 0.1f}, {7.2f, 0.1f, 0}, true},
          {"past the rim, before the face", {0.56f, -2.4f, 0.1f}, {0, 3.2f, 0}},
          {"past the rim, into its plane and behind", {0.2f, 2.6f, 0.1f}, {-0.3f, -3.3f, 0.1f}, true},
          {"behind", {-0.7f, 2.2f, 0}, {0, -2.9f, 0}},
          {"beside the rim, across the plane", {-1.5f, 2, 0.2f}, {2, 0, 0}},
          {"from a stand behind the face", {-0.62f, 0.05f, 0.1f}, {}, true, {4, 0, 0}}};
}

struct Jump {
  double error = 0;  // largest change of the error at a point from frame to frame, over the reference
  double truth = 0;  // the same of exact irradiance
};

constexpr float kReference = 4;  // W/m2, about the mean

template <class Shade>
Jump drive(LitBody<3>& lit, const Body& body, const LightSet& lights, const Passage& passage, double rate,
           Shade shade) {
  Jump jump;
  std::vector<std::array<double, 2>> last;
  lit.lighting.reset();
  for (int i = 0; i <= static_cast<int>(kSeconds * rate); ++i) {
    lit.place(passage.at(i / rate));
    lit.lighting.light(lights, static_cast<float>(1 / rate));
    const auto irradiance = shade();
    std::vector<std::array<double, 2>> now;
    for (std::size_t p = 0; p < body.points.size(); ++p) {
      const double exact = exactIrradiance(lights, lit.world(p), body.normals[p]).g;
      now.push_back({irradiance(p) - exact, exact});
      if (last.empty()) continue;
      jump.error = std::max(jump.error, std::abs(now[p][0] - last[p][0]) / double{kReference});
      jump.truth = std::max(jump.truth, std::abs(now[p][1] - last[p][1]) / double{kReference});
    }
    last.swap(now);
  }
  return jump;
}

Jump drive(LitBody<3>& lit, const Body& body, const LightSet& lights, const Passage& passage, double rate) {
  return drive(lit, body, lights, passage, rate, [&] {
    return [&](std::size_t p) {
      const auto parts = lit.shade(p);
      return static_cast<double>(parts.rig.g + parts.nearLights.g);
    };
  });
}

struct Aim {
  std::string spec, name;
  Kind kind;
  float value;
  std::optional<int> slots;
};

void PrintTo(const Aim& aim, std::ostream* out) { *out << aim.name; }

LightingOptions optionsOf(const Aim& aim) {
  LightingOptions options;
  options.target = {aim.kind, aim.value};
  options.nearSlots = aim.slots;
  options.reference = kReference;
  return options;
}

// Of the reference: a step of an 8-bit display.
constexpr double kNoise = 1.0 / 255;

class DiskContinuity : public testing::TestWithParam<Aim> {};

TEST_P(DiskContinuity, JumpsShrinkWithTheFrame) {
  const Body body = ellipsoidBody(kHalf, 100);
  LitBody<3> lit(GetParam().spec, body, optionsOf(GetParam()));
  for (const bool twoSided : {false, true}) {
    if (twoSided && !fullRun()) break;
    const LightSet lights = aroundADisk(twoSided);
    for (const Passage& passage : passages()) {
      const Jump slow = drive(lit, body, lights, passage, 60), fast = drive(lit, body, lights, passage, 480);
      std::printf("  %s, %s, %d faces: jump %.4f %.4f, %.2f; truth %.2f %.2f\n", GetParam().name.c_str(),
                  passage.name.c_str(), twoSided ? 2 : 1, slow.error, fast.error, fast.error / slow.error, slow.truth,
                  fast.truth);
      EXPECT_LE(fast.error, std::max(0.25 * slow.error, kNoise)) << passage.name << ' ' << twoSided;
      if (passage.crossesFace) {
        EXPECT_GT(fast.truth, 0.5) << "nothing passed the face";
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, DiskContinuity,
                         testing::Values(Aim{"auto", "auto", Kind::totalError, 0.03f, {}},
                                         Aim{"auto", "autoSpatial", Kind::spatialError, 0.05f, {}},
                                         Aim{"poly:6", "poly6", Kind::totalError, 0.03f, {}},
                                         Aim{"mixed:l3,g,c", "mixed", Kind::totalError, 0.03f, {}},
                                         Aim{"gradient", "gradient", Kind::totalError, 0.03f, {}},
                                         Aim{"poly:6", "poly6near2", Kind::none, 0, 2},
                                         Aim{"lattice:3x2x2", "latticeNear2", Kind::none, 0, 2}),
                         [](const auto& aim) { return aim.param.name; });

/// Where nothing is near, the rig alone must pass the plane of a distant disk, at which the slope of its light jumps.
TEST(DiskContinuityCases, RigsPassThePlaneOfADistantDisk) {
  const Body body = ellipsoidBody(kHalf, 100);
  LightSet lights;
  lights.add(DiskLight{{2.5f, 0, 0}, {0, 1, 0.05f}, 0.4f, {20, 20, 20}});
  const Passage passage{"across the plane", {0, -1.5f, 0}, {0, 2, 0}};
  for (const std::string spec : {"gradient", "mixed:l3,g,c", "lattice:3x2x2", "poly:6"}) {
    LitBody<3> lit(spec, body, {});
    const Jump slow = drive(lit, body, lights, passage, 60), fast = drive(lit, body, lights, passage, 480);
    std::printf("  %s alone: jump %.4f %.4f, %.2f\n", spec.c_str(), slow.error, fast.error, fast.error / slow.error);
    EXPECT_LE(fast.error, std::max(0.25 * slow.error, kNoise)) << spec;
  }
}

/// The same lights, near or far as the larger part of each is.
TEST(DiskContinuityCases, AHardSwitchFailsTheSameTest) {
  const Body body = ellipsoidBody(kHalf, 100);
  const LightSet lights = aroundADisk(false);
  LitBody<3> lit("poly:6", body, optionsOf({"poly:6", "poly6", Kind::totalError, 0.03f, {}}));
  const auto f = wrapCoefficients<3>(0);
  std::vector<RadianceSH<3>> functionals(lit.lighting.rig().projections());
  std::vector<RadianceSH<3>> coefficients(lit.lighting.rig().shVectors());
  LightSet far;
  std::vector<NearLight> near;
  int failed = 0;
  for (const Passage& passage : passages()) {
    const auto shade = [&] {
      std::vector<float> weights;
      for (const LightVerdict& v : lit.lighting.verdicts()) weights.push_back(v.weight > 0.5f ? 1.0f : 0.0f);
      splitLights(lights, weights, far, near);
      projectSamples<3>(lit.lighting.rig(), lit.frame(), far, functionals);
      fitRig<3>(lit.lighting.rig(), functionals, coefficients);
      return [&](std::size_t p) {
        double e =
            irradiance<3>(evaluateRig<3>(lit.lighting.rig(), coefficients, body.points[p]), f, body.normals[p]).g;
        for (const NearLight& light : near) e += double{nearIrradiance(light, lit.world(p), body.normals[p]).g};
        return e;
      };
    };
    const Jump slow = drive(lit, body, lights, passage, 60, shade);
    const Jump fast = drive(lit, body, lights, passage, 480, shade);
    std::printf("  hard switch, %s: %.4f %.4f, %.2f\n", passage.name.c_str(), slow.error, fast.error,
                fast.error / slow.error);
    failed += fast.error > std::max(0.25 * slow.error, kNoise) ? 1 : 0;
  }
  EXPECT_GE(failed, 3);
}

}  // namespace
}  // namespace rigel::test
