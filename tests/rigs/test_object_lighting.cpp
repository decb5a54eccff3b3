// The lighting of one object: no light is lost between rig and near lights, targets are met, estimates are honest.
#include <rigel/object_lighting.h>

#include "lights/random.h"
#include "reference/worst.h"

#include "lighting_fixture.h"

namespace rigel::test {
namespace {

using Kind = LightingTarget::Kind;
using reference::Worst;

const Body& testBody() {
  static const Body body = ellipsoidBody({1.5f, 0.6f, 0.7f}, 300);
  return body;
}

LightingOptions optionsOf(Kind kind, double value, std::optional<int> slots = {}, float wrap = 0) {
  LightingOptions options;
  options.target = {kind, static_cast<float>(value)};
  options.nearSlots = slots;
  options.wrap = wrap;
  options.estimate = true;
  return options;
}

double rigIrradiance(const LightSet& lights, Vec3 p, Vec3 n, int channel) {
  return static_cast<double>(irradiance<3>(project<3>(lights, p), wrapCoefficients<3>(0), n)[channel]);
}

// Whatever the weights, a distant light's rig part and near part sum to it: SH times 1 - w and exact times w.
TEST(ObjectLighting, DistantLightsAreAllThere) {
  Worst worst("irradiance of distant lights, relative");
  LightSet lights;
  for (int i = 0; i < 5; ++i)
    lights.add(PointLight{{1e4f * std::cos(static_cast<float>(i)), 1e4f * std::sin(static_cast<float>(i)), 2e3f},
                          {1e8f, 2e8f, 3e8f}});
  lights.add(DirectionalLight{{0.3f, -1, 0.2f}, {3, 2, 1}});
  const std::vector<std::pair<std::string, LightingOptions>> all = {
      {"constant", optionsOf(Kind::none, 0, 2)},        {"poly:6", optionsOf(Kind::none, 0, 4)},
      {"lattice:3x2x2", optionsOf(Kind::none, 0, 0)},   {"auto", optionsOf(Kind::spatialError, 0.02)},
      {"auto", optionsOf(Kind::spatialError, 0.02, 2)}, {"poly:6", optionsOf(Kind::spatialError, 0.02, 2)}};
  for (const auto& [spec, options] : all) {
    LitBody<3> lit(spec, testBody(), options);
    lit.lighting.light(lights, 1.0f / 60);
    const auto verdicts = lit.lighting.verdicts();
    for (std::size_t p = 0; p < testBody().points.size(); p += 7) {
      const auto parts = lit.shade(p);
      for (int c = 0; c < 3; ++c) {
        double expected = 0, size = 0;
        for (int i = 0; i < lights.size(); ++i) {
          const double w = verdicts.empty() ? 0 : static_cast<double>(verdicts[i].weight);
          LightSet one;
          lights.visit(i, [&](const auto& light) { one.add(light); });
          const double exact = exactIrradiance(one, lit.world(p), testBody().normals[p])[c];
          expected += w * exact + (1 - w) * rigIrradiance(one, lit.world(p), testBody().normals[p], c);
          size += static_cast<double>(one.directionalCount() > 0 ? 3.0f : 3.0f);
        }
        worst.add(std::abs(static_cast<double>(parts.rig[c] + parts.nearLights[c]) - expected) / size,
                  [&] { return spec; });
      }
    }
  }
  worst.expectWithin(1e-3);  // the lights' own variation over the object, at 1e4 m, and auto's few coefficients
}

TEST(ObjectLighting, ManyPointsAsOneAfterAnother) {
  const Body& body = testBody();
  LitBody<3> lit("poly:6", body, optionsOf(Kind::totalError, 0.03, 3));
  lit.lighting.light(lightsAround(1, 60), 1.0f / 60);
  ASSERT_FALSE(lit.lighting.nearLights().empty());
  ASSERT_GT(lit.lighting.highBand().band, 0);
  std::vector<float> rows[6];
  for (std::size_t p = 0; p < body.points.size(); ++p)
    for (int axis = 0; axis < 3; ++axis) {
      rows[axis].push_back(lit.world(p)[axis]);
      rows[3 + axis].push_back(body.normals[p][axis]);
    }
  for (const float wrap : {0.0f, 0.3f}) {
    const MaterialWrap<3> material(wrap);
    std::vector<ObjectLighting<3>::Parts> all(body.points.size());
    lit.lighting.shade({rows[0], rows[1], rows[2]}, {rows[3], rows[4], rows[5]}, material, all);
    for (std::size_t p = 0; p < all.size(); ++p) {
      const auto one = lit.lighting.shade(lit.world(p), body.normals[p], material);
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(all[p].rig[c], one.rig[c], 1e-5f * (1 + one.rig.r)) << p;
        EXPECT_NEAR(all[p].nearLights[c], one.nearLights[c], 1e-5f * (1 + one.nearLights.r)) << p;
      }
    }
  }
}

// As many slots as there are, asked for or left open: speeds tell which disks will be touched, and an object that
// stands beside one has it in its rig. Where slots are few, it is near in good time.
TEST(ObjectLighting, AllSlotsAskedForAreAllSlotsLeftOpen) {
  LightSet lights;
  lights.add(DiskLight{{2.1f, 0, 0}, {-1, 0, 0}, 0.2f, {0.1f, 0.1f, 0.1f}});  // 0.4 of the object's radius before it
  lights.add(DirectionalLight{{0.2f, -1, 0.1f}, {5, 5, 5}});
  const auto near = [&](std::optional<int> slots) {
    LitBody<3> lit("auto", testBody(), optionsOf(Kind::spatialError, 0.3, slots));
    lit.lighting.light(lights, 1.0f / 60);
    return lit.lighting.nearLights().size();
  };
  EXPECT_EQ(near({}), 0u);
  EXPECT_EQ(near(kMaxNearLights), 0u);
  EXPECT_EQ(near(4), 1u);
}

TEST(ObjectLighting, VerdictsAreConsistent) {
  for (const std::string spec : {"auto", "poly:6", "constant"})
    for (const LightingOptions& options :
         {optionsOf(Kind::none, 0, 3), optionsOf(Kind::none, 0), optionsOf(Kind::spatialError, 0.05),
          optionsOf(Kind::totalError, 0.03), optionsOf(Kind::budget, 1.5), optionsOf(Kind::totalError, 0.03, 2),
          optionsOf(Kind::spatialError, 0.05, 0)}) {
      LitBody<3> lit(spec, testBody(), options);
      LightSet lights = lightsAround(1, 60);
      lights.add(PointLight{{0, 5, 0}, {0, 0, 0}});
      lights.add(PointLight{{0, 50, 0}, {5, 5, 5}, 0.01f, 10});
      lit.lighting.light(lights, 1.0f / 60);
      const auto verdicts = lit.lighting.verdicts();
      ASSERT_EQ(verdicts.size(), static_cast<std::size_t>(lights.size()));
      double sum = 0;
      std::size_t near = 0;
      for (const LightVerdict& v : verdicts) {
        sum += static_cast<double>(v.share);
        near += v.weight > 0 ? 1 : 0;
        EXPECT_EQ(v.role == LightRole::exact, v.weight == 1);
        EXPECT_EQ(v.role == LightRole::blended, v.weight > 0 && v.weight < 1);
        if (v.role == LightRole::culled) {
          EXPECT_EQ(v.share, 0);
        }
      }
      EXPECT_NEAR(sum, 1, 1e-5) << spec;
      EXPECT_EQ(near, lit.lighting.nearLights().size()) << spec;
      EXPECT_LE(near, static_cast<std::size_t>(options.slots())) << spec;
      EXPECT_EQ(std::ranges::count_if(verdicts, [](const auto& v) { return v.role == LightRole::culled; }), 2) << spec;
    }
}

TEST(ObjectLighting, TwoStepsAreTheSameAsOne) {
  for (const Kind kind : {Kind::spatialError, Kind::totalError}) {
    LitBody<3> one("auto", testBody(), optionsOf(kind, 0.04)), two("auto", testBody(), optionsOf(kind, 0.04));
    for (int frame = 0; frame < 4; ++frame) {
      const LightSet lights = lightsAround(static_cast<unsigned>(frame), 20);
      one.lighting.light(lights, 1.0f / 60);
      two.lighting.weigh(lights, 1.0f / 60);
      const float cost = two.lighting.costAt(0.04f);
      two.lighting.settle(lights, 0.04f, 1.0f / 60);
      EXPECT_GT(cost, 0);
      EXPECT_EQ(one.lighting.coefficients().size(), two.lighting.coefficients().size());
      EXPECT_EQ(one.lighting.modelledNanoseconds(), two.lighting.modelledNanoseconds());
      EXPECT_EQ(one.lighting.totalEstimate(), two.lighting.totalEstimate());
      for (std::size_t p = 0; p < testBody().points.size(); p += 29) EXPECT_EQ(one.shade(p).rig, two.shade(p).rig);
    }
  }
}

struct Tally {
  int frames = 0, met = 0, covered = 0;
  std::vector<double> ratio;
  double worst = 0;

  double median() {
    std::ranges::nth_element(ratio, ratio.begin() + static_cast<std::ptrdiff_t>(ratio.size() / 2));
    return ratio[ratio.size() / 2];
  }
};

/// `frames` random frames of 4 to 40 lights.
Tally tally(const std::string& spec, const LightingOptions& options, int frames, bool total) {
  Tally out;
  LitBody<3> lit(spec, testBody(), options);
  for (int frame = 0; frame < frames; ++frame) {
    const LightSet lights = lightsAround(static_cast<unsigned>(frame) + 100, 4 + 36 * (frame % 4) / 3);
    lit.lighting.reset();
    lit.lighting.light(lights, 1.0f / 60);
    const LightingErrors errors = lit.errors(lights, 2);
    const double truth = (total ? errors.total : errors.spatial) / errors.mean;
    const auto estimate = static_cast<double>(total ? *lit.lighting.totalEstimate() : *lit.lighting.spatialEstimate());
    if (truth < 1e-5) continue;
    ++out.frames;
    out.met += truth <= static_cast<double>(options.target.value) ? 1 : 0;
    out.covered += 1.6 * estimate >= truth ? 1 : 0;
    out.worst = std::max(out.worst, truth);
    out.ratio.push_back(estimate / truth);
  }
  return out;
}

TEST(ObjectLighting, TargetsAreMet) {
  const int frames = fullRun() ? 400 : 40;
  for (const float wrap : {0.0f, 0.5f})
    for (const auto& [kind, value] : {std::pair{Kind::spatialError, 0.05},
                                      {Kind::spatialError, 0.02},
                                      {Kind::totalError, 0.03},
                                      {Kind::totalError, 0.02}}) {
      const bool total = kind == Kind::totalError;
      Tally t = tally("auto", optionsOf(kind, value, {}, wrap), frames, total);
      std::printf("  wrap %.1f %s %.2f: met %d of %d, worst %.4f, estimate/true %.2f\n", static_cast<double>(wrap),
                  total ? "total" : "spatial", value, t.met, t.frames, t.worst, t.median());
      EXPECT_GE(t.met, 0.95 * t.frames);
      EXPECT_LE(t.worst, 1.5 * value);
      EXPECT_GE(t.covered, 0.8 * t.frames);
    }
}

TEST(ObjectLighting, EstimatesOfFixedRigs) {
  const int frames = fullRun() ? 200 : 24;
  for (const std::string spec : {"constant", "mixed:l3,g,c", "poly:6", "poly:12", "lattice:3x2x2", "auto"})
    for (const int slots : {0, 4}) {
      Tally t = tally(spec, optionsOf(Kind::none, 0, slots), frames, false);
      std::printf("  %s, %d near: 1.6 x estimate covers %d of %d, estimate/true %.2f\n", spec.c_str(), slots, t.covered,
                  t.frames, t.median());
      EXPECT_GE(t.covered, 0.85 * t.frames) << spec;
      EXPECT_GE(t.median(), 0.7) << spec;
      EXPECT_LE(t.median(), 4) << spec;  // poly:12 expects more of points it has not seen
    }
}

TEST(ObjectLighting, ABudgetIsSpentAndKept) {
  // 10000 points: 1 us is 0.1 ns a point. All 24 lights near take 132 ns.
  for (const double budget : {40, 60, 120}) {
    LitBody<3> lit("auto", testBody(), optionsOf(Kind::budget, 10 * budget));
    double largest = 0;
    for (unsigned seed = 0; seed < 12; ++seed) {
      lit.lighting.reset();
      lit.lighting.light(lightsAround(seed, 24), 1.0f / 60);
      largest = std::max(largest, static_cast<double>(lit.lighting.modelledNanoseconds()));
    }
    std::printf("  %.0f ns a point: at most %.0f\n", budget, largest);
    EXPECT_LE(largest, budget + 15);  // test_trade_off.cpp says why not the budget itself
    EXPECT_GE(largest, 0.7 * budget);
  }
}

TEST(ObjectLighting, NobodyFadesAfterAReset) {
  LitBody<3> lit("auto", testBody(), optionsOf(Kind::totalError, 0.02)),
      fresh("auto", testBody(), optionsOf(Kind::totalError, 0.02));
  lit.lighting.light(lightsAround(3, 20), 1.0f / 60);
  lit.lighting.reset();
  lit.lighting.light(lightsAround(4, 20), 1.0f / 60);
  fresh.lighting.light(lightsAround(4, 20), 1.0f / 60);
  for (std::size_t i = 0; i < 20; ++i)
    EXPECT_EQ(lit.lighting.verdicts()[i].weight, fresh.lighting.verdicts()[i].weight);
}

}  // namespace
}  // namespace rigel::test
