// Only the effects that a scene calls for: what a shader lacks leaves no trace in it, and no stage runs for it.
#include "gpu/scene_case.h"
#include "gpu/shader_compiler.h"
#include "lights/random.h"
#include "shader_binaries.h"
#include "spirv/specialise.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

namespace rigel::test {
namespace {

using namespace tools;
using Words = std::vector<std::uint32_t>;

Effects operator+(Effects a, Effects b) {
  a.add(b);
  return a;
}
Effects operator+(Effects a, Effect b) { return a + Effects{b}; }

std::vector<Effect> listOf(Effects effects) {
  std::vector<Effect> all;
  for (const Effect effect : kAllEffects)
    if (effects.has(effect)) all.push_back(effect);
  return all;
}

std::string namesOf(Effects effects) {
  std::string names;
  for (const Effect effect : listOf(effects)) names += (names.empty() ? "" : " + ") + effectName(effect);
  return "{" + names + "}";
}

std::string identifier(Effect effect) {
  switch (effect) {
#define RIGEL_EFFECT(name, id) \
  case Effect::name:           \
    return #name;
    RIGEL_EFFECTS(RIGEL_EFFECT)
#undef RIGEL_EFFECT
  }
  return "";
}

/// `macro` of a kind k false for the kinds of the effects that are missing, and as `otherwise` for the rest; the
/// compiler drops what hangs on a constant before it puts out anything.
std::string hasMacro(const std::string& macro, Effects missing,
                     const std::vector<std::pair<Effect, std::string>>& kinds, const std::string& otherwise) {
  std::string text = otherwise;
  for (const auto& [effect, kind] : kinds)
    if (missing.has(effect)) text = "((k) == " + kind + " ? false : " + text + ")";
  return "#define " + macro + " " + text + "\n";
}

/// What makes shade_object.glsl a shader that never had these effects.
std::string preludeWithout(Effects missing) {
  std::string text = "#define RIGEL_EFFECTS_DECLARED\n";
  for (const Effect effect : kAllEffects) {
    if (!missing.has(effect)) text += "layout(constant_id = " + std::to_string(static_cast<int>(effect)) + ") ";
    text += "const bool " + identifier(effect) + " = false;\n";
  }
  text += hasMacro("RIGEL_HAS_NEAR(k)", missing,
                   {{Effect::light_near_directional, "kGpuDirectional"},
                    {Effect::light_near_point, "kGpuPoint"},
                    {Effect::light_near_spot, "kGpuSpot"},
                    {Effect::light_near_sphere, "kGpuSphere"},
                    {Effect::light_near_disk, "kGpuDisk"}},
                   "hasNear(k)");
  text += hasMacro("RIGEL_IS_KIND(rig, k)", missing,
                   {{Effect::rig_constant, "kGpuRigConstant"},
                    {Effect::rig_poly, "kGpuRigPoly"},
                    {Effect::rig_invquad, "kGpuRigInvquad"},
                    {Effect::rig_tensor, "kGpuRigTensor"},
                    {Effect::rig_gauss, "kGpuRigGauss"}},
                   "(hasKind(k) && rig.kind == (k))");
  // Whole files of the library are not even included.
  const bool poly = !missing.has(Effect::rig_poly) || !missing.has(Effect::rig_invquad);
  const bool tensor = !missing.has(Effect::rig_tensor) || !missing.has(Effect::rig_gauss);
  if (!poly)
    text +=
        "#define RIGEL_RIG_POLY_GLSL\n"
        "#define rigel_polyIrradiance(source, rig, u, y) vec3(0.0)\n"
        "#define rigel_polySh(source, rig, u, sh)\n"
        "#define rigel_falloff(rig, u) 1.0\n";
  if (!tensor)
    text +=
        "#define RIGEL_RIG_TENSOR_GLSL\n"
        "#define rigel_tensorIrradiance(source, rig, u, y) vec3(0.0)\n"
        "#define rigel_tensorSh(source, rig, u, sh)\n"
        "#define rigel_gaussIrradiance(source, rig, u, y) vec3(0.0)\n"
        "#define rigel_gaussSh(source, rig, u, sh)\n";
  if (!poly && !tensor) text += "#define RIGEL_OFFSET(rig) rig.offset\n";
  if (missing.has(Effect::light_near_disk))
    text +=
        "#define RIGEL_NEAR_DISK_GLSL\n"
        "#define rigel_nearDisk(light, p, n, wrap) 0.0\n"
        "#define rigel_cheapDisk(light, p, n) 0.0\n"
        "#define rigel_correctorDisk(light, p, n, wrap) 0.0\n";
  if (missing.has(Effect::light_near_diskTable)) text += "#define RIGEL_WITHOUT_diskTable\n";
  if (missing.has(Effect::rig_texture)) text += "#define RIGEL_WITHOUT_texture\n";
  if (missing.has(Effect::rig_highBand)) text += "#define RIGEL_WITHOUT_highBand\n";
  const auto isMissing = [&](Effect effect) { return missing.has(effect); };
  if (std::ranges::all_of(listOf(kNearEffects), isMissing)) text += "#define RIGEL_WITHOUT_near\n";
  return text;
}

/// An entry shader compiled anew, without some effects.
Words compileWithout(const std::string& file, Effects missing, int bands) {
  const std::filesystem::path folder = shaderLibrary().parent_path() / "entry";
  std::string body = contentOf(folder / file);
  const std::string version = "#version 450";
  body.replace(body.find(version), version.size(), "");
  const ShaderText parts[] = {
      {"prelude", version + "\n#define RIGEL_BANDS " + std::to_string(bands) + "\n" + preludeWithout(missing)},
      {file, body}};
  const std::filesystem::path folders[] = {folder, shaderLibrary()};
  const ShaderKind kind = file.ends_with(".comp")   ? ShaderKind::compute
                          : file.ends_with(".vert") ? ShaderKind::vertex
                                                    : ShaderKind::fragment;
  return must(compileShader(kind, parts, folders)).spirv;
}

Words specialised(std::span<const std::uint32_t> words, Effects effects) {
  std::vector<SpecialisedConstant> constants;
  for (const Effect effect : listOf(effects)) constants.push_back({static_cast<std::uint32_t>(effect), 1});
  return must(specialise(words, constants));
}

Effects shaderEffectsBut(Effects effects) {
  Effects others;
  for (const Effect effect : listOf(kShaderEffects))
    if (!effects.has(effect)) others.add(effect);
  return others;
}

// An effect, and effects of a scene where it has code of its own.
struct Pair {
  Effect effect;
  Effects others;
};
const Pair kPairs[] = {
    {Effect::light_near_directional, {Effect::rig_poly, Effect::light_near_sphere}},
    {Effect::light_near_point, {Effect::rig_poly, Effect::light_near_sphere}},
    {Effect::light_near_spot, {Effect::rig_poly, Effect::light_near_point}},
    {Effect::light_near_sphere, {Effect::rig_poly, Effect::light_near_directional}},
    {Effect::light_near_sphere, {Effect::rig_poly}},
    {Effect::light_near_wrap, {Effect::rig_poly, Effect::material_wrap, Effect::light_near_sphere}},
    {Effect::light_near_disk, {Effect::rig_poly, Effect::light_near_sphere}},
    {Effect::light_near_disk, {Effect::rig_poly}},
    {Effect::light_near_diskTable,
     {Effect::rig_poly, Effect::material_wrap, Effect::light_near_disk, Effect::light_near_wrap}},
    {Effect::light_near_diskQuadrature,
     {Effect::rig_poly, Effect::material_wrap, Effect::light_near_disk, Effect::light_near_wrap}},
    {Effect::material_wrap, {Effect::rig_poly}},
    {Effect::rig_constant, {}},
    {Effect::rig_constant, {Effect::rig_poly, Effect::light_near_spot}},
    {Effect::rig_poly, {Effect::light_near_sphere}},
    {Effect::rig_poly, {Effect::rig_tensor}},
    {Effect::rig_invquad, {Effect::rig_poly}},
    {Effect::rig_tensor, {Effect::light_near_point}},
    {Effect::rig_tensor, {Effect::rig_poly}},
    {Effect::rig_gauss, {Effect::rig_tensor}},
    {Effect::rig_texture, {Effect::light_near_sphere}},
    {Effect::rig_texture, {Effect::rig_poly}},
    {Effect::rig_highBand, {Effect::rig_poly}},
};

constexpr const char* kEntryShaders[] = {"object.frag", "object_per_vertex.vert", "points.comp"};

class EntryShader : public ::testing::TestWithParam<const char*> {
 protected:
  std::span<const std::uint32_t> shipped(int bands = 3) const {
    return shaderBinary(std::string(GetParam()) + ".bands" + std::to_string(bands));
  }
  Words without(Effects missing, int bands = 3) const { return compileWithout(GetParam(), missing, bands); }
};
INSTANTIATE_TEST_SUITE_P(Effects, EntryShader, ::testing::ValuesIn(kEntryShaders), [](const auto& shader) {
  std::string name = shader.param;
  std::ranges::replace(name, '.', '_');
  return name;
});

TEST_P(EntryShader, PairsCoverEveryEffectOfShaders) {
  Effects covered;
  for (const Pair& pair : kPairs) covered.add(pair.effect);
  EXPECT_EQ(namesOf(covered), namesOf(kShaderEffects));
}

TEST_P(EntryShader, WhatShipsIsWhatIsComparedHere) {
  for (const int bands : {2, 5}) {
    ASSERT_FALSE(shipped(bands).empty());
    EXPECT_EQ(specialised(shipped(bands), kShaderEffects), specialised(without({}, bands), kShaderEffects)) << bands;
  }
}

TEST_P(EntryShader, WithoutAnEffectIsAsIfItHadNeverBeen) {
  std::set<Words> different;
  // They share their code: an ordinary run deals the pairs out among them.
  const std::size_t step = fullRun() ? 1 : std::size(kEntryShaders);
  const std::size_t first = static_cast<std::size_t>(std::ranges::find(kEntryShaders, std::string_view(GetParam())) -
                                                     std::begin(kEntryShaders));
  for (std::size_t i = fullRun() ? 0 : first; i < std::size(kPairs); i += step) {
    const auto& [effect, others] = kPairs[i];
    SCOPED_TRACE(effectName(effect) + " against " + namesOf(others));
    const Words lacking = specialised(shipped(), others);
    EXPECT_EQ(lacking, specialised(without({effect}), others)) << "never had it";
    EXPECT_EQ(lacking, specialised(without(shaderEffectsBut(others)), others)) << "never had anything else";
    const Words having = specialised(shipped(), others + effect);
    EXPECT_NE(having, lacking) << "the effect does something";
    different.insert(having);
  }
  EXPECT_GT(different.size(), 3u) << "the comparison can tell shaders apart";
}

TEST_P(EntryShader, NoEffectAtAllLeavesNoLight) {
  const Words nothing = specialised(shipped(), {});
  EXPECT_EQ(nothing, specialised(without(kShaderEffects), {}));
  EXPECT_LT(instructionCount(nothing), 40);
}

TEST_P(EntryShader, CodeThatWasNeverThereIsNotOnlyOptimisedAway) {
  // The compiler's own output, before any specialisation, or the comparisons above would compare a thing with itself.
  const int all = instructionCount(without({}));
  EXPECT_LT(instructionCount(without(kNearEffects)), all - 200);
  EXPECT_LT(instructionCount(without({Effect::light_near_disk})), all - 400);
  EXPECT_LT(instructionCount(without({Effect::light_near_diskTable})), all - 50);
  EXPECT_LT(instructionCount(without({Effect::rig_poly, Effect::rig_invquad})), all - 200);
  EXPECT_LT(instructionCount(without({Effect::rig_tensor, Effect::rig_gauss})), all - 200);
  EXPECT_LT(instructionCount(without({Effect::rig_texture})), all - 30);
  EXPECT_LT(instructionCount(without({Effect::rig_highBand})), all - 100);
}

/// Descriptors that are left.
std::set<std::uint32_t> bindingsOf(const Words& words) {
  constexpr std::uint32_t kOpDecorate = 71, kBinding = 33;
  std::set<std::uint32_t> bindings;
  for (std::size_t i = 5; i < words.size(); i += words[i] >> 16)
    if ((words[i] & 0xffff) == kOpDecorate && words[i + 2] == kBinding) bindings.insert(words[i + 3]);
  return bindings;
}

TEST_P(EntryShader, BindsOnlyWhatItsEffectsRead) {
  enum : std::uint32_t { kCoefficients, kGaussNodes, kNearLights, kLattice, kObject, kMaterial, kDiskTable = 8 };
  using ::testing::ElementsAre;
  const auto bindings = [&](Effects effects) {
    std::set<std::uint32_t> all = bindingsOf(specialised(shipped(), effects));
    for (const std::uint32_t own : {6u, 7u}) all.erase(own);  // the points of points.comp
    return all;
  };
  EXPECT_THAT(bindings({}), ElementsAre());
  EXPECT_THAT(bindings({Effect::rig_poly}), ElementsAre(kCoefficients, kObject));
  EXPECT_THAT(bindings({Effect::rig_poly, Effect::material_wrap}), ElementsAre(kCoefficients, kObject, kMaterial));
  EXPECT_THAT(bindings({Effect::rig_tensor}), ElementsAre(kCoefficients, kObject));
  EXPECT_THAT(bindings({Effect::rig_tensor, Effect::rig_gauss}), ElementsAre(kCoefficients, kGaussNodes, kObject));
  EXPECT_THAT(bindings({Effect::rig_texture}), ElementsAre(kLattice, kObject));
  EXPECT_THAT(bindings({Effect::light_near_sphere}), ElementsAre(kNearLights));
  EXPECT_THAT(bindings({Effect::light_near_spot, Effect::light_near_wrap}), ElementsAre(kNearLights, kMaterial));
  const Effects disk{Effect::light_near_disk, Effect::light_near_wrap};
  EXPECT_THAT(bindings(disk + Effect::light_near_diskQuadrature), ElementsAre(kNearLights, kMaterial));
  EXPECT_THAT(bindings(disk + Effect::light_near_diskTable), ElementsAre(kNearLights, kMaterial, kDiskTable));
  EXPECT_THAT(bindings({Effect::light_near_disk}), ElementsAre(kNearLights)) << "Lambert reads no table";
  EXPECT_THAT(bindings({Effect::rig_highBand}), ElementsAre(kCoefficients, kObject));
}

// Frames

std::vector<std::string> stagesOf(const FitTimes& times) {
  std::vector<std::string> names;
  for (int s = 0; s < FitTimes::kStages; ++s)
    if (times.stages[s]) names.push_back(FitTimes::kNames[s]);
  return names;
}

struct StageCase {
  SceneCase what;
  std::vector<std::string> stages;
  std::vector<Effect> called, absent;
};

TEST(FrameEffects, OnlyStagesThatAreCalledForRun) {
  using E = Effect;
  const FrameRange frames{30, 60, 30};
  const StageCase cases[] = {
      {{"sample:street", "poly:6", "0", frames},
       {"refresh", "project", "fit"},
       {E::rig_poly, E::light_spot},
       {E::light_near_spot, E::light_near_sphere, E::rig_auto, E::rig_highBand, E::material_wrap, E::light_point}},
      {{"sample:street", "poly:6", "2", frames},
       {"refresh", "bound", "choose", "project", "fit"},
       {E::rig_poly, E::light_near_spot},
       {E::rig_auto, E::rig_highBand, E::light_near_wrap, E::light_near_point}},
      {{"sample:stage", "lattice:3x2x2", "0", frames},
       {"refresh", "project", "fit"},
       {E::rig_tensor, E::light_spot, E::light_sphere},
       {E::rig_gauss, E::rig_texture, E::light_near_spot, E::light_directional, E::light_point}},
      {{"sample:stage", "lattice:3x2x2@gauss", "0", frames},
       {"refresh", "project", "fit"},
       {E::rig_gauss},
       {E::rig_poly}},
      {{.scene = "sample:stage", .rig = "lattice:3x2x2", .frames = frames, .storage = RigStorage::texture32},
       {"refresh", "project", "fit"},
       {E::rig_texture},
       {E::rig_tensor}},
      {{.scene = "sample:stage", .rig = "constant", .frames = frames, .wrap = 0.5f},
       {"refresh", "project", "fit"},
       {E::rig_constant, E::material_wrap},
       {E::light_near_wrap, E::rig_tensor}},
      {{.scene = "sample:corridor", .rig = "constant", .near = "1", .frames = {30, 30, 1}, .wrap = 0.5f},
       {"refresh", "bound", "choose", "project", "fit"},
       {E::light_disk, E::light_near_disk, E::light_near_diskQuadrature},
       {E::light_near_diskTable, E::light_near_sphere, E::light_sphere}},
      {{"sample:touch", "auto", "", frames},
       {"refresh", "bound", "choose", "project", "fit"},
       {E::rig_auto, E::rig_poly},
       {E::light_near_spot, E::light_spot, E::light_near_wrap}},
  };
  for (const StageCase& wanted : cases) {
    SCOPED_TRACE(wanted.what.text());
    SceneRender render = sceneRender(renderOptions(wanted.what));
    const RunOptions run = renderOptions(wanted.what).run;
    LightingOptions asked = lightingOptions(run.rigs[0], run);
    asked.estimate = false;
    for (const int frame : render.frames()) {
      const RenderResult result = must(render.render(frame));
      EXPECT_EQ(stagesOf(result.stages), wanted.stages);
      for (const Effect effect : wanted.called) EXPECT_TRUE(result.effects.has(effect)) << effectName(effect);
      for (const Effect effect : wanted.absent) EXPECT_FALSE(result.effects.has(effect)) << effectName(effect);
      for (const auto& [stage, time] : {std::pair{LightingStage::bound, FitTimes::kBound},
                                        {LightingStage::choose, FitTimes::kChoose},
                                        {LightingStage::project, FitTimes::kProject},
                                        {LightingStage::fit, FitTimes::kFit},
                                        {LightingStage::estimate, FitTimes::kEstimate}})
        EXPECT_TRUE(!result.stages.stages[time] || callsFor(stage, result.effects, asked)) << FitTimes::kNames[time];
    }
  }
}

TEST(FrameEffects, TheTableOfDisksIsOpenedForItsEffectAlone) {
  struct TableCase {
    const char* scene;
    float wrap;
    Effect bands;
    bool opened;
  };
  constexpr Effect kTable = Effect::light_near_diskTable, kQuadrature = Effect::light_near_diskQuadrature;
  for (const auto& [scene, wrap, bands, opened] : {TableCase{"sample:corridor", 0.5f, kTable, true},
                                                   {"sample:corridor", 0.5f, kQuadrature, false},
                                                   {"sample:corridor", 0.0f, kTable, false},
                                                   {"sample:street", 0.5f, kTable, false}}) {
    SceneCase what{.scene = scene, .rig = "constant", .near = "1", .frames = {30, 30, 1}, .wrap = wrap};
    what.wrappedDisk = bands;
    SCOPED_TRACE(what.text());
    SceneRender render = sceneRender(renderOptions(what));
    EXPECT_EQ(render.hasDiskTable(), opened);
    const Effects effects = must(render.render(30)).effects;
    EXPECT_EQ(effects.has(kTable), opened);
  }
}

}  // namespace
}  // namespace rigel::test
