#include "report/words/disk_words.h"

#include "report/words/wording.h"

#include <fmt/format.h>

#include <algorithm>

namespace rigel::tools {
namespace {

DiskUse useOf(const LightReport& light, const ObjectReport& object, const RigReport& rig, bool wraps) {
  const int near = light.framesOf(LightRole::exact) + light.framesOf(LightRole::blended);
  const bool inRig = light.framesOf(LightRole::inRig) + light.framesOf(LightRole::blended) > 0;
  DiskUse use{light.name, object.name, rig.spec, "none", light.why};
  if (near == 0 && !inRig) return use;
  use.method = near == 0 ? "quadrature-6" : inRig ? "near, quadrature-6" : "near";
  if (near > 0) {
    use.why += wraps ? "; near: the closed form, or five bands and a rest where the material wraps"
                     : "; near: the closed form";
  }
  if (inRig) use.why += near > 0 ? "; in the rig: 6 nodes" : "; in the rig by 6 nodes";
  return use;
}

const DiskMethodRow& row(const std::vector<DiskMethodRow>& methods, std::string_view name) {
  return *std::ranges::find(methods, name, &DiskMethodRow::method);
}

std::string small(double relative) { return smallPercentage(relative) + " %"; }

}  // namespace

std::vector<DiskUse> diskUses(const ObjectReport& object, bool wraps) {
  std::vector<DiskUse> uses;
  for (const RigReport& rig : object.rigs) {
    for (const LightReport& light : rig.lights)
      if (light.type == "disk") uses.push_back(useOf(light, object, rig, wraps));
  }
  return uses;
}

std::string diskChoice(const std::vector<DiskMethodRow>& methods) {
  const DiskMethodRow &six = row(methods, "quadrature-6"), &table = row(methods, "table"), &near = row(methods, "near"),
                      &wallace = row(methods, "wallace");
  return fmt::format(
      "Rigs project disks by quadrature with 6 nodes: wrong by at most {} of the coefficients' norm in {:.0f} ns, "
      "where "
      "the table is wrong by {} in {:.0f} ns. Their bands cannot hold all of a disk's light ({} of its peak at worst), "
      "so "
      "disks too close for the rig are evaluated by the closed form: {} at worst in {:.0f} ns, where Wallace's "
      "approximation is wrong by {}.",
      small(six.sh->max), six.nanoseconds, small(table.sh->max), table.nanoseconds, percent(six.irradiance.max),
      small(near.irradiance.max), near.nanoseconds, percent(wallace.irradiance.max));
}

}  // namespace rigel::tools
