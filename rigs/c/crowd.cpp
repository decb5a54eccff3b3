#include <algorithm>

#include "call.h"
#include "handles.h"

namespace rigel::c {
namespace {

CrowdId toId(rigel_character c) noexcept { return {c.kind, c.index, c.generation}; }

/// A crowd, and a character that is in it.
rigel_result checkCharacter(const Call& call, const rigel_crowd* crowd, rigel_character character) noexcept {
  if (const auto e = call.needs({{crowd, "crowd"}}); e != RIGEL_OK) return e;
  if (crowd->visit([&](const auto& c) { return c.contains(toId(character)); })) return RIGEL_OK;
  return call.fail(RIGEL_ERROR_ID, "character {%u, %u, %u} is not in the crowd", character.kind, character.index,
                   character.generation);
}

std::size_t findKind(const rigel_crowd& crowd, const rigel_kind& kind) noexcept {
  return static_cast<std::size_t>(std::ranges::find(crowd.kinds, kind.kind) - crowd.kinds.begin());
}

std::size_t findOrAddKind(rigel_crowd& crowd, const rigel_kind& kind) {
  const std::size_t known = findKind(crowd, kind);
  if (known < crowd.kinds.size()) return known;
  crowd.kinds.reserve(known + 1);  // before the crowd has it: what comes after cannot fail
  crowd.visit([&](auto& c) { c.addKind(kind.kind); });
  crowd.kinds.push_back(kind.kind);
  return known;
}

constexpr float kOrthonormal = 1e-3f;  // by how much axes may miss it; what is put in box coordinates is off by as much

RigFrame toFrame(const rigel_transform& t) noexcept {
  const auto column = [&](int i) { return Vec3{t.m[0][i], t.m[1][i], t.m[2][i]}; };
  return {column(0), column(1), column(2), column(3)};
}

bool isPlacement(const RigFrame& f) noexcept {
  const auto close = [](float a, float b) { return std::abs(a - b) <= kOrthonormal; };  // not for NaN
  return close(dot(f.x, f.x), 1) && close(dot(f.y, f.y), 1) && close(dot(f.z, f.z), 1) && close(dot(f.x, f.y), 0) &&
         close(dot(f.y, f.z), 0) && close(dot(f.z, f.x), 0) && std::isfinite(f.origin.x + f.origin.y + f.origin.z);
}

rigel_result checkPalette(const Call& call, const rigel_character_desc& desc, int joints) noexcept {
  if (const auto e = call.array(desc.palette, desc.joint_count, "palette"); e != RIGEL_OK) return e;
  if ((desc.flags & RIGEL_CHARACTER_HIDDEN) != 0 || desc.joint_count >= static_cast<std::size_t>(joints))
    return RIGEL_OK;
  return call.fail(RIGEL_ERROR_VALUE, "joint_count is %zu, the kind has %d joints", desc.joint_count, joints);
}

rigel_result check(const Call& call, const rigel_character_desc& desc, int joints) noexcept {
  if (const auto e = checkPalette(call, desc, joints); e != RIGEL_OK) return e;
  if (!isPlacement(toFrame(desc.world_from_rig)))
    return call.value("world_from_rig is not finite, or not a rotation and a place");
  if (desc.interval < 1 || desc.interval > RIGEL_MAX_INTERVAL)
    return call.fail(RIGEL_ERROR_VALUE, "interval is %u, not 1 to %u", desc.interval, RIGEL_MAX_INTERVAL);
  if ((desc.flags & ~(RIGEL_CHARACTER_HIDDEN | RIGEL_CHARACTER_CUT)) != 0) return call.value("flags has unknown bits");
  if (desc.reserved != 0) return call.value("reserved is not 0");
  return RIGEL_OK;
}

void set(CrowdInput& input, const rigel_character_desc& desc) noexcept {
  input.worldFromRig = toFrame(desc.world_from_rig);
  input.palette = {reinterpret_cast<const JointMatrix*>(desc.palette), desc.joint_count};
  input.groups = desc.groups;
  input.interval = static_cast<int>(desc.interval);
  input.visible = (desc.flags & RIGEL_CHARACTER_HIDDEN) == 0;
  input.cut = input.cut || (desc.flags & RIGEL_CHARACTER_CUT) != 0;
}

rigel_result create(const Call& call, const rigel_crowd_desc& desc, rigel_crowd** out) {
  if (desc.tasks < 1 || desc.tasks > RIGEL_MAX_TASKS)
    return call.fail(RIGEL_ERROR_VALUE, "tasks is %u, not 1 to %u", desc.tasks, RIGEL_MAX_TASKS);
  const int tasks = static_cast<int>(desc.tasks);
  switch (desc.bands) {
    case 2:
      *out = new rigel_crowd{Crowd<2>(tasks), {}};
      return RIGEL_OK;
    case 3:
      *out = new rigel_crowd{Crowd<3>(tasks), {}};
      return RIGEL_OK;
    case 4:
      *out = new rigel_crowd{Crowd<4>(tasks), {}};
      return RIGEL_OK;
    case 5:
      *out = new rigel_crowd{Crowd<5>(tasks), {}};
      return RIGEL_OK;
    default:
      return call.fail(RIGEL_ERROR_VALUE, "bands is %u, not 2 to 5", desc.bands);
  }
}

}  // namespace
}  // namespace rigel::c

using namespace rigel::c;

rigel_result rigel_create_crowd(const rigel_crowd_desc* desc, rigel_crowd** crowd) {
  return guarded(__func__, [&](const Call& call) {
    rigel_crowd_desc own;
    if (const auto e = call.read(desc, own); e != RIGEL_OK) return e;
    if (const auto e = call.needs({{crowd, "crowd"}}); e != RIGEL_OK) return e;
    return create(call, own, crowd);
  });
}

void rigel_destroy_crowd(rigel_crowd* crowd) { delete crowd; }

rigel_result rigel_add_character(rigel_crowd* crowd, const rigel_kind* kind, rigel_character* character) {
  return guarded(__func__, [&](const Call& call) {
    if (const auto e = call.needs({{crowd, "crowd"}, {kind, "kind"}, {character, "character"}}); e != RIGEL_OK)
      return e;
    const std::size_t number = findOrAddKind(*crowd, *kind);
    const rigel::CrowdId id = crowd->visit([&](auto& c) {
      const rigel::CrowdId added = c.add(static_cast<int>(number));
      c.input(added).visible = false;
      return added;
    });
    *character = {id.kind, id.index, id.generation};
    return RIGEL_OK;
  });
}

rigel_result rigel_remove_character(rigel_crowd* crowd, rigel_character character) {
  return guarded(__func__, [&](const Call& call) {
    if (const auto e = checkCharacter(call, crowd, character); e != RIGEL_OK) return e;
    crowd->visit([&](auto& c) { c.remove(toId(character)); });
    return RIGEL_OK;
  });
}

rigel_result rigel_set_character(rigel_crowd* crowd, rigel_character character, const rigel_character_desc* desc) {
  return guarded(__func__, [&](const Call& call) {
    if (const auto e = checkCharacter(call, crowd, character); e != RIGEL_OK) return e;
    rigel_character_desc own;
    if (const auto e = call.read(desc, own); e != RIGEL_OK) return e;
    if (const auto e = check(call, own, crowd->kinds[character.kind]->joints()); e != RIGEL_OK) return e;
    crowd->visit([&](auto& c) { set(c.input(toId(character)), own); });
    return RIGEL_OK;
  });
}

rigel_result rigel_get_crowd_info(const rigel_crowd* crowd, rigel_crowd_info* info) {
  return guarded(__func__, [&](const Call& call) {
    if (const auto e = call.needs({{crowd, "crowd"}}); e != RIGEL_OK) return e;
    if (const auto e = call.checkInfo(info); e != RIGEL_OK) return e;
    rigel_crowd_info own = RIGEL_CROWD_INFO_INIT;
    crowd->visit([&](const auto& c) {
      const rigel::CrowdOutputBound bound = c.outputBound();
      own.characters = static_cast<std::size_t>(c.size());
      own.rigs = bound.rigs;
      own.coefficients = bound.coefficients;
      own.near_lights = bound.nearLights;
      own.bytes = c.bytes();
    });
    Call::write(own, info);
    return RIGEL_OK;
  });
}

rigel_result rigel_get_character_bytes(const rigel_crowd* crowd, const rigel_kind* kind, size_t* bytes) {
  return guarded(__func__, [&](const Call& call) {
    if (const auto e = call.needs({{crowd, "crowd"}, {kind, "kind"}, {bytes, "bytes"}}); e != RIGEL_OK) return e;
    const std::size_t number = findKind(*crowd, *kind);
    if (number == crowd->kinds.size()) return call.fail(RIGEL_ERROR_ID, "the crowd has no character of the kind");
    *bytes = crowd->visit([&](const auto& c) { return c.bytesPerCharacter(static_cast<int>(number)); });
    return RIGEL_OK;
  });
}

rigel_result rigel_get_place(const rigel_crowd* crowd, rigel_character character, rigel_place* place) {
  return guarded(__func__, [&](const Call& call) {
    if (const auto e = checkCharacter(call, crowd, character); e != RIGEL_OK) return e;
    if (const auto e = call.needs({{place, "place"}}); e != RIGEL_OK) return e;
    const rigel::CrowdResult result = crowd->visit([&](const auto& c) { return c.result(toId(character)); });
    *place = {result.rig, result.nearOffset, result.nearCount};
    return RIGEL_OK;
  });
}
