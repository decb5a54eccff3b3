// What `rigel pareto` compares: rigs over their sizes, near lights, bands, forms of near light, storage.
#pragma once

#include "report/run/run_options.h"

#include <string>
#include <vector>

namespace rigel::tools {

/// How near lights are evaluated (near_light.h). Programs and reports evaluate them exactly; the other two are
/// functions for shaders of one's own.
enum class NearForm {
  exact,      // nearIrradiance of the share that the rig leaves out
  cheap,      // cheapIrradiance of that share
  corrector,  // the rig holds all light; correctorIrradiance adds what its bands leave out
};
const char* nearFormName(NearForm form);

/// Where a rig keeps its near lights: how many, or what error it chooses them for.
struct NearSetting {
  NearChoice near;
  std::optional<LightingTarget> target;
};

/// All that is measured with one rig and one number of bands.
struct RigFamilyMember {
  RigSpec spec;
  int bands = 3;
  std::vector<NearSetting> near;  // the first leaves all light in the rig, except for `auto` rigs
  bool nearForms = false;         // the cheap ones, too
};

/// "poly", "lattice", "auto", ...
std::string familyOf(const RigSpec& spec);
/// "corners", "numeric", "gauss", "lsq"; "" where the family has but one way.
std::string fitOf(const RigSpec& spec);

/// "2", or "auto".
std::string nearText(const NearSetting& near);
/// What to type for it: "--rig poly:6 --near 2 --bands 4".
std::string argumentsOf(const RigSpec& spec, const NearSetting& near, int bands);

RunOptions runOptionsFor(const RigSpec& spec, const NearSetting& near, int bands);

/// The rigs that are measured unless others are named.
std::vector<RigSpec> paretoRigs();

/// `rigs` in every number of `bands`, with every choice of near lights: in 3 bands, or where there is but one number,
/// for as many targets as make a curve, and in every form.
std::vector<RigFamilyMember> configurations(std::span<const RigSpec> rigs, std::span<const int> bands);

}  // namespace rigel::tools
