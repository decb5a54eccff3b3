// What a crowd gives a character is what Rig, projectSamples and fitRig give it, whatever surrounds it.
#include <rigel/half.h>

#include "crowd_fixture.h"
#include "lighting_fixture.h"
#include "lights/every_target.h"

namespace rigel::test {
namespace {

// In units of what all lights give at the sample that has most of it. Projections agree within 1e-6 of it; the operator
// and the polynomial magnify that a little. Worst seen: 1.4e-6.
constexpr double kAgreement = 5e-6;

template <int B>
double worstDisagreement(const std::string& spec, const LightSet& lights, int slots, int characters, bool rigid) {
  const BendingBody body;
  CrowdKindOptions options;
  options.nearSlots = slots;
  Stage<B> stage;
  stage.lights = lights;
  const int kind = stage.crowd.addKind(kindOf(spec, rigid ? body.rigidShape() : body.shape(), options));
  std::vector<CrowdId> ids;
  std::vector<std::vector<JointMatrix>> palettes(static_cast<std::size_t>(characters));
  for (int c = 0; c < characters; ++c) ids.push_back(stage.crowd.add(kind));
  stage.makeRoom();
  double worst = 0;
  SingleBody<B> single(spec, body);
  for (int f = 0; f < 3; ++f) {
    for (int c = 0; c < characters; ++c) {
      const auto n = static_cast<std::size_t>(c);
      const float t = static_cast<float>(c) + 0.01f * static_cast<float>(f);
      if (!rigid) palettes[n] = BendingBody::palette(0.8f * std::sin(t));
      CrowdInput& input = stage.crowd.input(ids[n]);
      input.worldFromRig = turned(t, {0.3f * t - 2, 0.1f * std::cos(t), 0.2f * std::sin(3 * t)});
      input.palette = palettes[n];
    }
    EXPECT_EQ(stage.frame(1.0f / 60).updated, characters);
    for (int c = 0; c < characters; ++c) {
      const CrowdId id = ids[static_cast<std::size_t>(c)];
      const CrowdInput& input = stage.crowd.input(id);
      single.fit(input.worldFromRig, input.palette, stage.lights, weightsOf<B>(stage, id));
      for (int p = 0; p < 400; p += 37) {
        const Vec3 at = input.worldFromRig.point(rigid ? body.surface[p] : body.posed(p, input.palette));
        const double off = distance<B>(stage.evaluate(id, at), single.evaluate(at));
        worst = std::max(worst, single.size() > 0 ? off / single.size() : off);
      }
    }
  }
  return worst;
}

TEST(Crowd, AgreesWithTheRigOfEachCharacter) {
  double worst = 0;
  onEveryTarget([&] {
    for (const std::string spec : {"poly:1", "poly:4", "poly:6", "poly:7", "poly:12"})
      for (const int characters : {1, 3, 16, 21}) {
        const double off = worstDisagreement<3>(spec, lightsAround(7, 24), 2, characters, false);
        EXPECT_LT(off, kAgreement) << spec << ", " << characters << " characters";
        worst = std::max(worst, off);
      }
  });
  RecordProperty("worst", std::to_string(worst));
}

TEST(Crowd, AgreesInEveryNumberOfBandsAndSlots) {
  const LightSet lights = lightsAround(8, 9);
  EXPECT_LT(worstDisagreement<2>("poly:6", lights, 0, 5, false), kAgreement);
  EXPECT_LT(worstDisagreement<3>("poly:6", lights, kMaxCrowdNear, 5, false), kAgreement);
  EXPECT_LT(worstDisagreement<4>("poly:6", lights, 1, 5, false), kAgreement);
  EXPECT_LT(worstDisagreement<5>("poly:6", lights, 3, 5, false), kAgreement);
  EXPECT_LT(worstDisagreement<3>("poly:6", lights, 2, 5, true), kAgreement) << "rigid";
}

// A body that is flat in its pose has functions that are nothing on it.
TEST(Crowd, AgreesInFlatPoses) {
  const BendingBody body;
  Stage<3> stage;
  stage.lights = lightsAround(9, 12);
  const CrowdId id = stage.crowd.add(stage.crowd.addKind(kindOf("poly:10", body.shape())));
  stage.makeRoom();
  std::vector<JointMatrix> flat(BendingBody::kJoints);
  for (JointMatrix& j : flat) j.m[2][2] = 0;
  stage.crowd.input(id).palette = flat;
  stage.frame(1);
  SingleBody<3> single("poly:10", body);
  single.fit({}, flat, stage.lights, weightsOf<3>(stage, id));
  for (int p = 0; p < 400; p += 7)
    EXPECT_LT(distance<3>(stage.evaluate(id, body.posed(p, flat)), single.evaluate(body.posed(p, flat))),
              kAgreement * single.size());
}

/// Everything that a crowd of two kinds gives in some frames.
struct Bits {
  std::vector<std::uint8_t> bytes;
  void add(const void* data, std::size_t size) {
    const auto* first = static_cast<const std::uint8_t*>(data);
    bytes.insert(bytes.end(), first, first + size);
  }
};

Bits bitsOf(int tasks, ParallelFor parallel) {
  const BendingBody body;
  Stage<3> stage(tasks);
  stage.parallel = parallel;
  stage.lights = lightsAround(3, 30);
  const int kinds[] = {stage.crowd.addKind(kindOf("poly:6", body.shape())),
                       stage.crowd.addKind(kindOf("poly:4", body.rigidShape()))};
  std::vector<CrowdId> ids;
  for (int c = 0; c < 150; ++c) ids.push_back(stage.crowd.add(kinds[c % 3 == 0]));
  stage.makeRoom();
  Bits bits;
  std::vector<std::vector<JointMatrix>> palettes(ids.size());
  for (int f = 0; f < 7; ++f) {
    for (std::size_t c = 0; c < ids.size(); ++c) {
      const float t = static_cast<float>(c) + 0.05f * static_cast<float>(f);
      palettes[c] = BendingBody::palette(std::sin(t));
      CrowdInput& input = stage.crowd.input(ids[c]);
      input.worldFromRig = turned(t, {std::fmod(t, 5.0f), 0, std::fmod(3 * t, 4.0f)});
      input.palette = palettes[c];
      input.interval = c % 4 == 0 ? 3 : 1;
    }
    stage.frame(1.0f / 60);
    bits.add(stage.rigs.data(), stage.rigs.size() * sizeof(GpuRig));
    bits.add(stage.coefficients.data(), stage.coefficients.size() * sizeof(GpuVec4));
    bits.add(stage.halves.data(), stage.halves.size() * sizeof(GpuHalf4));
    for (const CrowdId id : ids) {
      const CrowdResult result = stage.crowd.result(id);
      bits.add(&result, sizeof(result));
      bits.add(stage.near.data() + result.nearOffset,
               static_cast<std::size_t>(result.nearCount) * sizeof(GpuNearLight));
    }
  }
  return bits;
}

TEST(Crowd, GivesTheSameBitsOnAnyNumberOfThreads) {
  const Bits one = bitsOf(1, {});
  const ParallelFor threads = threadPerTask();
  ParallelFor backwards;
  backwards.run = [](void*, int count, ParallelFor::Task task, void* work) {
    for (int i = count; i-- > 0;) task(work, i);
  };
  EXPECT_EQ(one.bytes, bitsOf(2, threads).bytes);
  EXPECT_EQ(one.bytes, bitsOf(7, threads).bytes);
  EXPECT_EQ(one.bytes, bitsOf(3, backwards).bytes);
  EXPECT_EQ(one.bytes, bitsOf(4, {}).bytes);
}

/// Coefficients of a character.
std::vector<float> coefficientsOf(const Stage<3>& stage, CrowdId id) {
  const GpuRig& rig = stage.rig(id);
  const float* first = &stage.coefficients[static_cast<std::size_t>(rig.offset)].x;
  return {first, first + static_cast<std::size_t>(4 * gpuVectorSize(3) * rig.vectors)};
}

class CrowdHardCases : public testing::Test {
 protected:
  static constexpr int kCharacters = 20;

  CrowdHardCases() {
    stage_.lights = lightsAround(5, 10);
    kind_ = stage_.crowd.addKind(kindOf("poly:6", body_.shape()));
    for (int c = 0; c < kCharacters; ++c) ids_.push_back(stage_.crowd.add(kind_));
    stage_.makeRoom();
    palettes_.resize(kCharacters);
    for (int c = 0; c < kCharacters; ++c) {
      palettes_[c] = BendingBody::palette(0.1f * static_cast<float>(c));
      stage_.crowd.input(ids_[c]).palette = palettes_[c];
      stage_.crowd.input(ids_[c]).worldFromRig.origin = {0.3f * static_cast<float>(c) - 3, 0, 0};
    }
  }
  std::vector<std::vector<float>> frame() {
    last_ = stage_.frame(1.0f / 60);
    std::vector<std::vector<float>> all;
    for (const CrowdId id : ids_) all.push_back(coefficientsOf(stage_, id));
    return all;
  }
  static bool finite(std::span<const float> values) {
    return std::ranges::all_of(values, [](float v) { return std::isfinite(v); });
  }

  void expectHalves() {
    frame();
    for (const CrowdId id : ids_) {
      const GpuRig rig = stage_.rig(id);
      ASSERT_GT(rig.scale, 0);
      const auto coefficients = coefficientsOf(stage_, id);
      float largest = 0;
      for (std::size_t i = 0; i < coefficients.size(); ++i) {
        const float scaled = coefficients[i] / rig.scale;
        largest = std::max(largest, std::abs(scaled));
        const GpuHalf4& four = stage_.halves[static_cast<std::size_t>(rig.offset) + i / 4];
        const std::uint16_t half[] = {four.x, four.y, four.z, four.w};
        EXPECT_EQ(half[i % 4], halfFromFloat(scaled));
      }
      EXPECT_GE(largest, 16384);
      EXPECT_LE(largest, 32768);
    }
  }

  BendingBody body_;
  Stage<3> stage_;
  int kind_ = 0;
  std::vector<CrowdId> ids_;
  std::vector<std::vector<JointMatrix>> palettes_;
  CrowdStats last_;
};

TEST_F(CrowdHardCases, AnUnusablePoseIsDarkAndNobodyElseNotices) {
  const auto before = frame();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  palettes_[3][2].m[1][1] = nan;
  stage_.crowd.input(ids_[5]).worldFromRig.x.y = nan;
  stage_.crowd.input(ids_[7]).worldFromRig.origin.z = std::numeric_limits<float>::infinity();
  stage_.crowd.input(ids_[9]).palette = std::span(palettes_[9]).first(2);
  stage_.crowd.input(ids_[19]).palette = {};
  const auto during = frame();
  EXPECT_EQ(last_.unusable, 5);
  for (int c = 0; c < kCharacters; ++c) {
    const bool usable = c != 3 && c != 5 && c != 7 && c != 9 && c != 19;
    EXPECT_EQ(stage_.rig(ids_[c]).vectors, usable ? 6 : 0) << c;
    EXPECT_EQ(during[c].empty(), !usable);
    if (usable) {
      EXPECT_TRUE(during[c] == before[c]) << c;
    } else {
      EXPECT_EQ(stage_.crowd.result(ids_[c]).nearCount, 0) << c;
    }
  }
  std::ranges::copy(BendingBody::palette(0.3f), palettes_[3].begin());
  stage_.crowd.input(ids_[5]).worldFromRig = stage_.crowd.input(ids_[4]).worldFromRig;
  stage_.crowd.input(ids_[5]).worldFromRig.origin.x = 0.3f * 5 - 3;
  stage_.crowd.input(ids_[7]).worldFromRig.origin.z = 0;
  stage_.crowd.input(ids_[9]).palette = palettes_[9];
  stage_.crowd.input(ids_[19]).palette = palettes_[19];
  EXPECT_TRUE(frame() == before);
  EXPECT_EQ(last_.unusable, 0);
}

TEST_F(CrowdHardCases, NoLightsNoCharactersNothingVisible) {
  stage_.lights.clear();
  for (const auto& coefficients : frame())
    EXPECT_TRUE(std::ranges::all_of(coefficients, [](float v) { return v == 0; }));
  for (const CrowdId id : ids_) stage_.crowd.input(id).visible = false;
  EXPECT_EQ(stage_.frame(1.0f / 60).visible, 0);
  EXPECT_EQ(stage_.crowd.result(ids_[0]).rig, -1);
  for (const CrowdId id : ids_) stage_.crowd.remove(id);
  EXPECT_EQ(stage_.frame(1.0f / 60).visible, 0);
  EXPECT_EQ(stage_.crowd.size(), 0);
  Crowd<3> empty(3);
  PreparedLights none;
  const LightSet lights;
  EXPECT_EQ(empty.frame({&lights, &none, {}}, 1, {}).visible, 0);
}

TEST_F(CrowdHardCases, LightsInsideAndBrightAndWrong) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  const std::vector<Vec3> places = {{-3, 0, 0},  {0, 0.9f, 0},     {0.3f, 0, 0}, body_.surface[7],
                                    {nan, 0, 0}, {0, infinity, 0}, {1e20f, 0, 0}};
  for (const Vec3 p : places) {
    stage_.lights.add(SphereLight{p, 0.5f, {1, 2, 3}});
    stage_.lights.add(SphereLight{p, 0, {1, 2, 3}});
    stage_.lights.add(SphereLight{p, nan, {1, 2, 3}});
    stage_.lights.add(PointLight{p, {1e30f, 1, 1}, 0, 1});
    stage_.lights.add(PointLight{p, {nan, 1, 1}});
    stage_.lights.add(SpotLight{p, {0, 0, 0}, {1, 2, 3}});
    stage_.lights.add(SpotLight{p, {0, -1, 0}, {1, 2, 3}, 0.5f, 0.5f, 0, 0});
    stage_.lights.add(DiskLight{p, {1, 0, 0}, 0.5f, {1, 2, 3}});
    stage_.lights.add(DirectionalLight{p, {1, 2, 3}});
  }
  for (int f = 0; f < 3; ++f)
    for (const auto& coefficients : frame()) EXPECT_TRUE(finite(coefficients));
  for (const CrowdId id : ids_) {
    const CrowdResult result = stage_.crowd.result(id);
    for (int n = 0; n < result.nearCount; ++n) {
      const GpuNearLight& near = stage_.near[static_cast<std::size_t>(result.nearOffset + n)];
      EXPECT_TRUE(std::isfinite(near.position.x) && std::isfinite(near.colour.x) && std::isfinite(near.extent));
    }
  }
}

TEST_F(CrowdHardCases, CharactersAndLightsComeAndGo) {
  frame();
  const auto before = frame();
  // Others go, and their places are taken by others yet.
  for (int c = 0; c < kCharacters; c += 3) stage_.crowd.remove(ids_[c]);
  EXPECT_FALSE(stage_.crowd.contains(ids_[0]));
  EXPECT_FALSE(stage_.crowd.contains(CrowdId{}));
  stage_.frame(1.0f / 60);
  for (int c = 0; c < kCharacters; ++c)
    if (c % 3 != 0) {
      EXPECT_TRUE(coefficientsOf(stage_, ids_[c]) == before[c]) << c;
    }
  const CrowdId gone = ids_[0];
  for (int c = 0; c < kCharacters; c += 3) {
    ids_[c] = stage_.crowd.add(kind_);
    stage_.crowd.input(ids_[c]).palette = palettes_[c];
    stage_.crowd.input(ids_[c]).worldFromRig.origin = {0.3f * static_cast<float>(c) - 3, 0, 0};
  }
  EXPECT_FALSE(stage_.crowd.contains(gone));
  EXPECT_TRUE(frame() == before);
  const LightSet lights = stage_.lights;
  for (int count : {0, 40, 3, 10}) {
    stage_.lights = count == 10 ? lights : lightsAround(6, count);
    for (const auto& coefficients : frame()) EXPECT_TRUE(finite(coefficients));
  }
  stage_.crowd.frame({&stage_.lights, &stage_.prepared, {}}, 0,  // a cut
                     {stage_.rigs, stage_.coefficients, stage_.halves, stage_.near});
  EXPECT_TRUE(frame() == before);
}

TEST_F(CrowdHardCases, NobodyIsChangedByItsNeighbours) {
  const auto together = frame();
  for (int c = 0; c < kCharacters; c += 3) {
    for (int other = 0; other < kCharacters; ++other) stage_.crowd.input(ids_[other]).visible = other == c;
    EXPECT_EQ(stage_.frame(1.0f / 60).visible, 1);
    EXPECT_TRUE(coefficientsOf(stage_, ids_[c]) == together[c]) << c;
  }
}

TEST_F(CrowdHardCases, LightsOfOtherGroupsAreNotThere) {
  constexpr std::uint32_t kRed = 1, kBlue = 2;
  LightSet red, blue, both;
  for (int i = 0; i < 6; ++i) {
    const float t = static_cast<float>(i);
    const SphereLight sphere{{t - 3, 1.2f, 0.4f}, 0.2f, {4, 3, 2}};
    const DirectionalLight sun{{t - 3, -1, 0}, {1, 1, 2}};
    const DiskLight panel{{t - 2, 1.4f, 1}, {0, -1, 0}, 0.3f, {1, 2, 1}};
    (i % 2 == 0 ? red : blue).add(sphere);
    (i % 2 == 0 ? red : blue).add(sun);
    (i % 2 == 0 ? red : blue).add(panel);
    both.add(sphere, i % 2 == 0 ? kRed : kBlue);
    both.add(sun, i % 2 == 0 ? kRed : kBlue);
    both.add(panel, i % 2 == 0 ? kRed : kBlue);
  }
  const auto groupOf = [](int c) { return c % 4 == 3 ? 0 : c % 2 == 0 ? kRed : kBlue; };
  for (int c = 0; c < kCharacters; ++c) stage_.crowd.input(ids_[c]).groups = groupOf(c);
  stage_.lights = both;
  const auto mixed = frame();
  std::vector<CrowdResult> results;
  for (const CrowdId id : ids_) results.push_back(stage_.crowd.result(id));
  for (const auto& [lights, group] : {std::pair{red, kRed}, std::pair{blue, kBlue}}) {
    for (int c = 0; c < kCharacters; ++c) {
      stage_.crowd.input(ids_[c]).groups = kAllLightGroups;
      stage_.crowd.input(ids_[c]).cut = true;
    }
    stage_.lights = lights;
    const auto alone = frame();
    for (int c = 0; c < kCharacters; ++c) {
      if (groupOf(c) == 0) {
        EXPECT_TRUE(std::ranges::all_of(mixed[c], [](float v) { return v == 0; })) << c;
      }
      if (groupOf(c) != group) continue;
      EXPECT_EQ(results[c].nearCount, stage_.crowd.result(ids_[c]).nearCount) << c;
      for (std::size_t i = 0; i < mixed[c].size(); ++i) EXPECT_NEAR(mixed[c][i], alone[c][i], 1e-5) << c;
    }
  }
}

TEST_F(CrowdHardCases, AMaskedLightLeavesTheRigAtOnce) {
  LightSet both, rest;
  for (int i = 0; i < 4; ++i) {
    const SphereLight lamp{{static_cast<float>(i) - 2, 1.5f, 0.3f}, 0.1f, {9, 9, 9}};
    both.add(lamp, i == 1 ? 1 : 2);
    if (i != 1) rest.add(lamp);
  }
  stage_.lights = both;
  frame();
  const CrowdId id = ids_[6];
  ASSERT_GT(stage_.crowd.result(id).nearCount, 0);
  stage_.crowd.input(id).groups = 2;
  SingleBody<3> single("poly:6", body_);
  for (int f = 0; f < 6; ++f) {
    frame();
    // What is near of the others is not in the rig; what is near of the masked light only fades.
    std::vector<float> weights;
    const std::vector<float> all = weightsOf<3>(stage_, id);
    for (std::size_t i = 0; i < all.size(); ++i)
      if (i != 1) weights.push_back(all[i]);
    const CrowdInput& input = stage_.crowd.input(id);
    single.fit(input.worldFromRig, input.palette, rest, weights);
    const Vec3 at = input.worldFromRig.point(body_.posed(50, input.palette));
    EXPECT_LT(distance<3>(stage_.evaluate(id, at), single.evaluate(at)), kAgreement * single.size()) << f;
  }
}

TEST_F(CrowdHardCases, HalvesAreTheFloatsRounded) {
  onEveryTarget([&] { expectHalves(); });
}

TEST(CrowdKind, RefusesWhatItCannotServe) {
  const BendingBody body;
  const auto fails = [&](const std::string& spec, const CrowdShape& shape, const CrowdKindOptions& options) {
    const auto kind = CrowdKind::create(specOf(spec), shape, options);
    return !kind && !kind.error().line().empty();
  };
  EXPECT_FALSE(fails("poly:6", body.shape(), {}));
  for (const std::string spec : {"lattice:3x2x2", "auto", "invquad:6", "gradient@lsq"})
    EXPECT_TRUE(fails(spec, body.shape(), {})) << spec;
  CrowdKindOptions options;
  options.nearSlots = kMaxCrowdNear + 1;
  EXPECT_TRUE(fails("poly:6", body.shape(), options));
  options.nearSlots = -1;
  EXPECT_TRUE(fails("poly:6", body.shape(), options));
  CrowdShape shape = body.shape();
  shape.skin = shape.skin.first(10);
  EXPECT_TRUE(fails("poly:6", shape, {}));
  std::vector<SkinWeights> skin = body.skin;
  skin[5].weight[2] = std::numeric_limits<float>::infinity();
  shape.skin = skin;
  EXPECT_TRUE(fails("poly:6", shape, {}));
  EXPECT_TRUE(fails("poly:6", {{body.box, {}}, {}}, {}));
}

}  // namespace
}  // namespace rigel::test
