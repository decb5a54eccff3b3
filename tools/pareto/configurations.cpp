#include "pareto/configurations.h"

#include <fmt/format.h>

#include <algorithm>

namespace rigel::tools {
namespace {

constexpr const char* kRigs =
    "constant;gradient;gradient@numeric;gradient@gauss;gradient@lsq;"
    "lattice:2x1x1;lattice:2x2x1;lattice:2x2x2;lattice:3x2x2;lattice:3x3x2;lattice:4x3x2;lattice:4x4x2;lattice:8x4x2;"
    "lattice:3x2x2:smooth;lattice:4x3x2:smooth;lattice:8x4x2:smooth;"
    "lattice:3x2x2:cubic;lattice:4x3x2:cubic;lattice:8x4x2:cubic;"
    "lattice:2x1x1@gauss;lattice:2x2x1@gauss;lattice:2x2x2@gauss;lattice:3x2x2@gauss;lattice:3x3x2@gauss;"
    "lattice:4x3x2@gauss;lattice:8x4x2@gauss;lattice:2x2x2@lsq;lattice:3x2x2@lsq;lattice:4x3x2@lsq;lattice:8x4x2@lsq;"
    "mixed:l2,g,c;mixed:l3,g,c;mixed:l4,g,c;mixed:l3,g,g;mixed:l3,l2,g;mixed:g,g,c;mixed:l3,g,c@gauss;"
    "mixed:l3,l2,g@gauss;mixed:l3,g,c@lsq;"
    "poly:1;poly:2;poly:3;poly:4;poly:6;poly:8;poly:10;poly:12;poly:16;poly:20;poly:28;poly:35;poly:56;"
    "invquad:1;invquad:3;invquad:4;invquad:6;invquad:8;invquad:10;invquad:12;invquad:16;invquad:20;"
    "rbf:4;rbf:6;rbf:12;rbf:24;rbf:48;latticegrad:2x1x1;latticegrad:3x1x1;latticegrad:2x2x2;latticegrad:4x2x2;"
    "hermite:2x1x1;hermite:3x1x1;hermite:2x2x2;hermite:4x2x2;"
    "auto;auto:30";

using Kind = LightingTarget::Kind;

constexpr float kManyTargets[] = {0.3f, 0.2f, 0.1f, 0.05f, 0.03f, 0.02f, 0.01f, 0.005f};
constexpr float kFixedTargets[] = {0.1f, 0.05f, 0.02f};
constexpr int kNearCounts[] = {0, 1, 2, 4};
constexpr NearChoice kAutomatic{true, 0};

std::vector<NearSetting> nearOfAuto(bool curve) {
  std::vector<NearSetting> all;
  for (const Kind kind : {Kind::spatialError, Kind::totalError})
    for (const float error : kManyTargets)
      if (curve || error == kDefaultTarget.value) all.push_back({kAutomatic, LightingTarget{kind, error}});
  if (!curve) return all;
  for (const int count : kNearCounts) all.push_back({{false, count}, kDefaultTarget});
  return all;
}

std::vector<NearSetting> nearOfFixed(bool curve) {
  std::vector<NearSetting> all;
  for (const int count : kNearCounts) all.push_back({{false, count}, {}});
  for (const float error : kFixedTargets)
    if (curve || error == kDefaultTarget.value) all.push_back({kAutomatic, LightingTarget{Kind::spatialError, error}});
  return all;
}

}  // namespace

const char* nearFormName(NearForm form) {
  switch (form) {
    case NearForm::cheap:
      return "cheap";
    case NearForm::corrector:
      return "corrector";
    case NearForm::exact:
      break;
  }
  return "exact";
}

std::string familyOf(const RigSpec& spec) { return spec.text.substr(0, spec.text.find_first_of(":@")); }

std::string fitOf(const RigSpec& spec) {
  if (spec.family != RigSpec::Family::tensor || familyOf(spec) == "constant") return "";
  switch (spec.fit) {
    case FitMethod::numeric:
      return "numeric";
    case FitMethod::gauss:
      return "gauss";
    case FitMethod::lsq:
      return "lsq";
    case FitMethod::corners:
      break;
  }
  return "corners";
}

std::string nearText(const NearSetting& near) {
  return near.near.automatic ? "auto" : fmt::format("{}", near.near.slots);
}

std::string argumentsOf(const RigSpec& spec, const NearSetting& near, int bands) {
  std::string text = fmt::format("--rig {}", spec.text);
  if (!(spec.adaptive && near.near.automatic)) text += " --near " + nearText(near);
  if (near.target) text += " " + aimOptions(near.target, {});
  return text + fmt::format(" --bands {}", bands);
}

RunOptions runOptionsFor(const RigSpec& spec, const NearSetting& near, int bands) {
  RunOptions options;
  options.rigs = {spec};
  options.near = near.near;
  options.target = near.target;
  options.bands = bands;
  return options;
}

std::vector<RigSpec> paretoRigs() { return *parseRigSpecs(kRigs); }

std::vector<RigFamilyMember> configurations(std::span<const RigSpec> rigs, std::span<const int> bands) {
  std::vector<RigFamilyMember> all;
  for (const int b : bands)
    for (const RigSpec& spec : rigs) {
      const bool curve = b == kDefaultBands || bands.size() == 1;
      all.push_back({spec, b, spec.adaptive ? nearOfAuto(curve) : nearOfFixed(curve), curve && !spec.adaptive});
    }
  return all;
}

}  // namespace rigel::tools
