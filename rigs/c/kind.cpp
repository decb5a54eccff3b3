#include "call.h"
#include "handles.h"

namespace rigel::c {
namespace {

constexpr float kSkinSum = 0.02f;  // weights of 8 bits each sum to 1 within 4 halves of 1/255

/// The number of the first point whose weights are no weights, or the count.
std::size_t firstBadSkin(const rigel_kind_desc& desc) noexcept {
  for (std::size_t i = 0; i < desc.skin_count; ++i) {
    const float* w = desc.skin[i].weight;
    if (!(std::abs(w[0] + w[1] + w[2] + w[3] - 1) <= kSkinSum)) return i;
  }
  return desc.skin_count;
}

rigel_result check(const Call& call, const rigel_kind_desc& desc) noexcept {
  if (const auto e = call.needs({{desc.rig, "rig"}, {desc.surface, "surface"}}); e != RIGEL_OK) return e;
  if (const auto e = call.array(desc.surface, desc.surface_count, "surface"); e != RIGEL_OK) return e;
  if (const auto e = call.array(desc.skin, desc.skin_count, "skin"); e != RIGEL_OK) return e;
  if (desc.skin != nullptr && desc.skin_count != desc.surface_count)
    return call.fail(RIGEL_ERROR_VALUE, "skin_count is %zu, surface_count %zu", desc.skin_count, desc.surface_count);
  if (const std::size_t bad = firstBadSkin(desc); bad < desc.skin_count)
    return call.fail(RIGEL_ERROR_VALUE, "weights of skin %zu do not sum to 1", bad);
  if (desc.near_slots > RIGEL_MAX_NEAR_SLOTS)
    return call.fail(RIGEL_ERROR_VALUE, "near_slots is %u, more than %u", desc.near_slots, RIGEL_MAX_NEAR_SLOTS);
  if (!(desc.tolerance >= 0) || !isFinite(desc.tolerance)) return call.value("tolerance is negative or not finite");
  if (!(desc.weight_rate >= 0) || !isFinite(desc.weight_rate))
    return call.value("weight_rate is negative or not finite");
  if (desc.reserved != 0) return call.value("reserved is not 0");
  return RIGEL_OK;
}

rigel_result create(const Call& call, const rigel_kind_desc& desc, rigel_kind** out) {
  const auto spec = parseRigSpec(desc.rig);
  if (!spec) return call.fail(RIGEL_ERROR_VALUE, "%s", spec.error().line().c_str());
  std::vector<Vec3> surface;
  surface.reserve(desc.surface_count);
  for (std::size_t i = 0; i < desc.surface_count; ++i) surface.push_back(toVec3(desc.surface[i]));
  std::vector<SkinWeights> skin(desc.skin_count);
  for (std::size_t i = 0; i < desc.skin_count; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      skin[i].joint[j] = desc.skin[i].joint[j];
      skin[i].weight[j] = desc.skin[i].weight[j];
    }
  const CrowdShape shape{{{toVec3(desc.box_lo), toVec3(desc.box_hi)}, surface}, skin};
  const CrowdKindOptions options{static_cast<int>(desc.near_slots), desc.tolerance, desc.weight_rate};
  auto kind = CrowdKind::create(*spec, shape, options);
  if (!kind) return call.fail(RIGEL_ERROR_VALUE, "%s", kind.error().line().c_str());
  *out = new rigel_kind{*std::move(kind)};
  return RIGEL_OK;
}

}  // namespace
}  // namespace rigel::c

using namespace rigel::c;

rigel_result rigel_create_kind(const rigel_kind_desc* desc, rigel_kind** kind) {
  return guarded(__func__, [&](const Call& call) {
    rigel_kind_desc own;
    if (const auto e = call.read(desc, own); e != RIGEL_OK) return e;
    if (const auto e = call.needs({{kind, "kind"}}); e != RIGEL_OK) return e;
    if (const auto e = check(call, own); e != RIGEL_OK) return e;
    return create(call, own, kind);
  });
}

void rigel_destroy_kind(rigel_kind* kind) { delete kind; }

rigel_result rigel_get_kind_info(const rigel_kind* kind, rigel_kind_info* info) {
  return guarded(__func__, [&](const Call& call) {
    if (const auto e = call.needs({{kind, "kind"}}); e != RIGEL_OK) return e;
    if (const auto e = call.checkInfo(info); e != RIGEL_OK) return e;
    const rigel::CrowdKind& k = *kind->kind;
    rigel_kind_info own = RIGEL_KIND_INFO_INIT;
    own.sh_vectors = static_cast<uint32_t>(k.rig().shVectors());
    own.projections = static_cast<uint32_t>(k.rig().projections());
    own.joints = static_cast<uint32_t>(k.joints());
    own.near_slots = static_cast<uint32_t>(k.options().nearSlots);
    Call::write(own, info);
    return RIGEL_OK;
  });
}
