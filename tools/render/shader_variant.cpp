#include "render/shader_variant.h"

#include <fmt/format.h>

#include <algorithm>

namespace rigel::tools {
namespace {

constexpr int kUnrolledTerms = 16;  // RIGEL_POLY_MAX of shade_object.glsl
constexpr int kKnownTerms = 24;     // of a loop over monomials that are known

Effects common(Effects a, Effects b) {
  Effects both;
  for (const Effect effect : kAllEffects)
    if (a.has(effect) && b.has(effect)) both.add(effect);
  return both;
}

Effects without(Effects a, Effects b) {
  for (const Effect effect : kAllEffects)
    if (b.has(effect)) a.remove(effect);
  return a;
}

bool isPoly(const GpuRig& packed) {
  return packed.kind == shader_types::kGpuRigPoly || packed.kind == shader_types::kGpuRigInvquad;
}

}  // namespace

std::string ShaderVariant::binary(const std::string& entry) const {
  return fmt::format("{}.bands{}{}", entry, bands, loop > 0 ? fmt::format(".loop{}", loop) : "");
}

std::vector<ShaderConstant> ShaderVariant::constants() const {
  std::vector<ShaderConstant> all;
  for (const Effect effect : kAllEffects)
    if (effects.has(effect)) all.push_back(shaderConstant(static_cast<std::uint32_t>(effect), true));
  // As shade_object.glsl numbers them.
  constexpr std::uint32_t kVectors = 40, kNodes = 41, kSlope = 44, kPerNode = 47, kKernel = 48, kTermsKnown = 49,
                          kTerms = 50;
  all.push_back(shaderConstant(kVectors, vectors));
  for (std::uint32_t a = 0; a < 3; ++a) {
    all.push_back(shaderConstant(kNodes + a, nodes[a]));
    all.push_back(shaderConstant(kSlope + a, slope[a]));
  }
  all.push_back(shaderConstant(kPerNode, perNode));
  all.push_back(shaderConstant(kKernel, kernel));
  all.push_back(shaderConstant(kTermsKnown, termsKnown));
  for (std::uint32_t i = 0; i < terms.size(); ++i) all.push_back(shaderConstant(kTerms + i, terms[i]));
  return all;
}

ShaderVariant variantOf(const RigRunner& runner, const GpuRig& packed, Effects effects, Effects nearKinds) {
  ShaderVariant variant;
  variant.bands = runner.bands();
  variant.effects = without(common(effects, kShaderEffects), kNearEffects);
  if (effects.hasAny(kNearEffects)) variant.effects.add(nearKinds);
  if (packed.kind == shader_types::kGpuRigTexture &&
      variant.effects.hasAny({Effect::rig_tensor, Effect::rig_constant})) {
    variant.effects.remove(Effect::rig_tensor);
    variant.effects.remove(Effect::rig_constant);
    variant.effects.add(Effect::rig_texture);
  }
  if (packed.kind == shader_types::kGpuRigConstant && variant.effects.has(Effect::rig_tensor)) {
    variant.effects.remove(Effect::rig_tensor);
    variant.effects.remove(Effect::rig_gauss);
    variant.effects.add(Effect::rig_constant);
  }
  const RigSpec& spec = runner.rig().spec();
  if (!spec.adaptive) variant.vectors = runner.rig().shVectors();
  if (isPoly(packed)) {
    const int vectors = runner.rig().shVectors();
    variant.termsKnown = vectors <= kKnownTerms;
    if (variant.termsKnown) {
      if (spec.adaptive || vectors > kUnrolledTerms) variant.loop = kKnownTerms;
      const auto &first = packed.terms[0], &second = packed.terms[1];
      variant.terms = {first.x, first.y, first.z, first.w, second.x, second.y};
    } else {
      variant.loop = kMaxPolyTerms;
    }
  } else {
    variant.nodes = {packed.nodes.x, packed.nodes.y, packed.nodes.z};
    variant.slope = {packed.slope.x, packed.slope.y, packed.slope.z};
    variant.perNode = packed.perNode;
    variant.kernel = packed.kernel;
  }
  return variant;
}

Effects nearKindsOf(Effects lightKinds, float wrap, Effect wrappedDisk) {
  Effects kinds;
  if (lightKinds.has(Effect::light_directional)) kinds.add(Effect::light_near_directional);
  if (lightKinds.has(Effect::light_point)) kinds.add(Effect::light_near_point);
  if (lightKinds.has(Effect::light_spot)) kinds.add(Effect::light_near_spot);
  if (lightKinds.has(Effect::light_sphere)) kinds.add(Effect::light_near_sphere);
  if (lightKinds.has(Effect::light_disk)) kinds.add(Effect::light_near_disk);
  if (lightKinds.has(Effect::light_disk) && wrap != 0) kinds.add(wrappedDisk);
  if (!kinds.empty() && wrap != 0) kinds.add(Effect::light_near_wrap);
  return kinds;
}

std::vector<ShaderVariant> possibleVariants(const RigRunner& runner, const GpuRig& packed, float wrap,
                                            Effects nearKinds) {
  const LightingOptions& asked = runner.asked();
  const bool chooses = asked.target.kind != LightingTarget::Kind::none;
  const Effects rig = rigEffects(runner.rig().spec());
  std::vector<ShaderVariant> all;
  for (const bool hasRig : {true, false}) {
    if (!hasRig && !chooses) continue;
    for (const bool near : {false, true}) {
      if (near && (nearKinds.empty() || asked.slots() == 0)) continue;
      for (const bool high : {false, true}) {
        if (high && asked.target.kind != LightingTarget::Kind::totalError &&
            asked.target.kind != LightingTarget::Kind::budget)
          continue;
        Effects effects = hasRig ? rig : Effects{};
        if (near) effects.add(nearKinds);
        if (high) effects.add(Effect::rig_highBand);
        if (wrap != 0 && (hasRig || high)) effects.add(Effect::material_wrap);
        all.push_back(variantOf(runner, packed, effects, nearKinds));
      }
    }
  }
  return all;
}

ShaderVariant nearVariant(int bands, Effects nearKinds) {
  ShaderVariant variant;
  variant.bands = bands;
  variant.effects = nearKinds;
  return variant;
}

}  // namespace rigel::tools
