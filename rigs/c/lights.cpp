#include <algorithm>

#include "call.h"
#include "handles.h"

namespace rigel::c {
namespace {

// The name of the first member that no light can have, or null.

bool isLength(float v) noexcept { return v >= 0 && isFinite(v); }
bool isRange(float v) noexcept { return v >= 0; }

const char* faultOf(const rigel_directional_light& l) noexcept {
  return !isFinite(l.direction) ? "direction" : !isFinite(l.irradiance) ? "irradiance" : nullptr;
}
const char* faultOf(const rigel_point_light& l) noexcept {
  return !isFinite(l.position)    ? "position"
         : !isLength(l.radius)    ? "radius"
         : !isFinite(l.intensity) ? "intensity"
         : !isRange(l.range)      ? "range"
                                  : nullptr;
}
const char* faultOf(const rigel_spot_light& l) noexcept {
  constexpr float kHalfTurn = 3.14159274f;  // pi as floats have it
  return !isFinite(l.position)                                             ? "position"
         : !isLength(l.radius)                                             ? "radius"
         : !isFinite(l.intensity)                                          ? "intensity"
         : !isRange(l.range)                                               ? "range"
         : !isFinite(l.direction)                                          ? "direction"
         : !(l.inner_angle >= 0)                                           ? "inner_angle"
         : !(l.outer_angle >= l.inner_angle && l.outer_angle <= kHalfTurn) ? "outer_angle"
                                                                           : nullptr;
}
const char* faultOf(const rigel_sphere_light& l) noexcept {
  return !isFinite(l.position)   ? "position"
         : !isLength(l.radius)   ? "radius"
         : !isFinite(l.radiance) ? "radiance"
                                 : nullptr;
}
const char* faultOf(const rigel_disk_light& l) noexcept {
  return !isFinite(l.position)    ? "position"
         : !isLength(l.radius)    ? "radius"
         : !isFinite(l.radiance)  ? "radiance"
         : !isFinite(l.direction) ? "direction"
         : l.two_sided > 1        ? "two_sided"
                                  : nullptr;
}

DirectionalLight toLight(const rigel_directional_light& l) noexcept {
  return {toVec3(l.direction), toRgb(l.irradiance)};
}
PointLight toLight(const rigel_point_light& l) noexcept {
  return {toVec3(l.position), toRgb(l.intensity), l.radius, l.range};
}
SpotLight toLight(const rigel_spot_light& l) noexcept {
  return {toVec3(l.position), toVec3(l.direction), toRgb(l.intensity), l.inner_angle, l.outer_angle, l.radius, l.range};
}
SphereLight toLight(const rigel_sphere_light& l) noexcept { return {toVec3(l.position), l.radius, toRgb(l.radiance)}; }
DiskLight toLight(const rigel_disk_light& l) noexcept {
  return {toVec3(l.position), toVec3(l.direction), l.radius, toRgb(l.radiance), l.two_sided != 0};
}

template <class T>
rigel_result add(const Call& call, const T* items, std::size_t count, const char* name, rigel_lights::Frame& frame) {
  if (const auto e = call.array(items, count, name); e != RIGEL_OK) return e;
  for (std::size_t i = 0; i < count; ++i) {
    if (const char* fault = faultOf(items[i]); fault != nullptr)
      return call.fail(RIGEL_ERROR_VALUE, "%s light %zu, id %u: its %s is not finite or out of range", name, i,
                       items[i].id, fault);
    frame.set.add(toLight(items[i]), items[i].groups);
    frame.ids.push_back(items[i].id);
  }
  return RIGEL_OK;
}

/// In the order in which LightSet::visit counts.
rigel_result addAll(const Call& call, const rigel_lights_desc& desc, rigel_lights::Frame& frame) {
  frame.set.clear();
  frame.ids.clear();
  if (const auto e = add(call, desc.directional, desc.directional_count, "directional", frame); e != RIGEL_OK) return e;
  if (const auto e = add(call, desc.point, desc.point_count, "point", frame); e != RIGEL_OK) return e;
  if (const auto e = add(call, desc.spot, desc.spot_count, "spot", frame); e != RIGEL_OK) return e;
  if (const auto e = add(call, desc.sphere, desc.sphere_count, "sphere", frame); e != RIGEL_OK) return e;
  return add(call, desc.disk, desc.disk_count, "disk", frame);
}

rigel_result checkIds(const Call& call, const std::vector<std::uint32_t>& ids, std::vector<std::uint32_t>& sorted) {
  sorted = ids;
  if (!std::ranges::is_sorted(sorted)) std::ranges::sort(sorted);
  const auto twice = std::ranges::adjacent_find(sorted);
  return twice == sorted.end() ? RIGEL_OK : call.fail(RIGEL_ERROR_ID, "two lights have the id %u", *twice);
}

void prepare(rigel_lights::Frame& frame, std::uint32_t flags) {
  frame.prepared.set(frame.set);
  frame.hasTree = (flags & RIGEL_LIGHTS_TREE) != 0;
  if (!frame.hasTree) return;
  frame.tree.update(frame.set);
  for (const SphereLight& cluster : frame.tree.clusters()) frame.prepared.add(cluster);
}

}  // namespace
}  // namespace rigel::c

using namespace rigel::c;

rigel_result rigel_create_lights(rigel_lights** lights) {
  return guarded(__func__, [&](const Call& call) {
    if (const auto e = call.needs({{lights, "lights"}}); e != RIGEL_OK) return e;
    *lights = new rigel_lights;
    return RIGEL_OK;
  });
}

rigel_result rigel_set_lights(rigel_lights* lights, const rigel_lights_desc* desc) {
  return guarded(__func__, [&](const Call& call) {
    if (const auto e = call.needs({{lights, "lights"}}); e != RIGEL_OK) return e;
    rigel_lights_desc own;
    if (const auto e = call.read(desc, own); e != RIGEL_OK) return e;
    if ((own.flags & ~RIGEL_LIGHTS_TREE) != 0) return call.value("flags has unknown bits");
    if (own.reserved != 0) return call.value("reserved is not 0");
    if (const auto e = addAll(call, own, lights->next); e != RIGEL_OK) return e;
    if (const auto e = checkIds(call, lights->next.ids, lights->sorted); e != RIGEL_OK) return e;
    prepare(lights->next, own.flags);
    std::swap(lights->current, lights->next);
    return RIGEL_OK;
  });
}

void rigel_destroy_lights(rigel_lights* lights) { delete lights; }
