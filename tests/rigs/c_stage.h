// A crowd of the C interface with all that a frame needs, like Stage of crowd_fixture.h.
#pragma once

#include <rigel/rigel.h>

#include <memory>
#include <vector>

#include "crowd_fixture.h"

namespace rigel::test {

inline rigel_vec3 toC(Vec3 v) { return {v.x, v.y, v.z}; }
inline rigel_rgb toC(Rgb v) { return {v.r, v.g, v.b}; }

/// A name for light `i` of a set; each has another in each `shift`.
constexpr std::uint32_t lightId(int i, int shift) { return static_cast<std::uint32_t>((5 * i + shift) % 997); }

/// Lights as C has them.
struct CLights {
  std::vector<rigel_directional_light> directional;
  std::vector<rigel_point_light> point;
  std::vector<rigel_spot_light> spot;
  std::vector<rigel_sphere_light> sphere;
  std::vector<rigel_disk_light> disk;
  std::uint32_t flags = 0;

  explicit CLights(const LightSet& lights, int shift = 0) {
    for (int i = 0; i < lights.size(); ++i)
      lights.visit(i, [&](const auto& l) { add(l, lights.groups(i), lightId(i, shift)); });
  }
  rigel_lights_desc desc() const {
    return {sizeof(rigel_lights_desc),
            directional.data(),
            directional.size(),
            point.data(),
            point.size(),
            spot.data(),
            spot.size(),
            sphere.data(),
            sphere.size(),
            disk.data(),
            disk.size(),
            flags,
            0};
  }

 private:
  void add(const DirectionalLight& l, std::uint32_t groups, std::uint32_t id) {
    directional.push_back({toC(l.direction), toC(l.irradiance), groups, id});
  }
  void add(const PointLight& l, std::uint32_t groups, std::uint32_t id) {
    point.push_back({toC(l.position), l.radius, toC(l.intensity), l.range, groups, id});
  }
  void add(const SpotLight& l, std::uint32_t groups, std::uint32_t id) {
    spot.push_back({toC(l.position), l.radius, toC(l.intensity), l.range, toC(l.direction), l.innerAngle, l.outerAngle,
                    groups, id});
  }
  void add(const SphereLight& l, std::uint32_t groups, std::uint32_t id) {
    sphere.push_back({toC(l.position), l.radius, toC(l.radiance), groups, id});
  }
  void add(const DiskLight& l, std::uint32_t groups, std::uint32_t id) {
    disk.push_back({toC(l.position), l.radius, toC(l.radiance), toC(l.direction), l.twoSided, groups, id});
  }
};

struct Destroy {
  void operator()(rigel_kind* p) const { rigel_destroy_kind(p); }
  void operator()(rigel_lights* p) const { rigel_destroy_lights(p); }
  void operator()(rigel_crowd* p) const { rigel_destroy_crowd(p); }
};
template <class T>
using Owned = std::unique_ptr<T, Destroy>;

/// The description of a bending body's kind.
struct CBody {
  BendingBody body;
  std::vector<rigel_vec3> surface;
  std::vector<rigel_skin> skin;

  CBody() {
    for (Vec3 p : body.surface) surface.push_back(toC(p));
    for (const SkinWeights& s : body.skin)
      skin.push_back(
          {{s.joint[0], s.joint[1], s.joint[2], s.joint[3]}, {s.weight[0], s.weight[1], s.weight[2], s.weight[3]}});
  }
  rigel_kind_desc desc(const char* rig, bool rigid = false) const {
    rigel_kind_desc desc = RIGEL_KIND_DESC_INIT;
    desc.rig = rig;
    desc.surface = surface.data();
    desc.surface_count = surface.size();
    if (!rigid) desc.skin = skin.data();
    if (!rigid) desc.skin_count = skin.size();
    desc.box_lo = toC(body.box.lo);
    desc.box_hi = toC(body.box.hi);
    return desc;
  }
};

inline Owned<rigel_kind> cKindOf(const rigel_kind_desc& desc) {
  rigel_kind* kind = nullptr;
  EXPECT_EQ(rigel_create_kind(&desc, &kind), RIGEL_OK) << rigel_get_last_error();
  return Owned<rigel_kind>(kind);
}

inline rigel_character_desc cInput(const CrowdInput& input) {
  rigel_character_desc desc = RIGEL_CHARACTER_DESC_INIT;
  desc.palette = reinterpret_cast<const rigel_transform*>(input.palette.data());
  desc.joint_count = input.palette.size();
  const Vec3 columns[] = {input.worldFromRig.x, input.worldFromRig.y, input.worldFromRig.z, input.worldFromRig.origin};
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c) desc.world_from_rig.m[r][c] = columns[c][r];
  desc.groups = input.groups;
  desc.interval = static_cast<std::uint32_t>(input.interval);
  desc.flags = (input.visible ? 0 : RIGEL_CHARACTER_HIDDEN) | (input.cut ? RIGEL_CHARACTER_CUT : 0);
  return desc;
}

struct CStage {
  Owned<rigel_crowd> crowd;
  Owned<rigel_lights> lights;
  std::vector<rigel_gpu_rig> rigs;
  std::vector<rigel_vec4> coefficients;
  std::vector<rigel_half4> halves;
  std::vector<rigel_gpu_near_light> near;
  rigel_parallel_for parallel{};
  float lightTarget = 0;

  explicit CStage(std::uint32_t bands = 3, std::uint32_t tasks = 1) {
    const rigel_crowd_desc desc{sizeof(rigel_crowd_desc), bands, tasks};
    rigel_crowd* newCrowd = nullptr;
    EXPECT_EQ(rigel_create_crowd(&desc, &newCrowd), RIGEL_OK);
    crowd.reset(newCrowd);
    rigel_lights* newLights = nullptr;
    EXPECT_EQ(rigel_create_lights(&newLights), RIGEL_OK);
    lights.reset(newLights);
  }
  rigel_character add(const rigel_kind* kind) {
    rigel_character character;
    EXPECT_EQ(rigel_add_character(crowd.get(), kind, &character), RIGEL_OK);
    return character;
  }
  void set(const LightSet& set, int shift = 0) {
    CLights items(set, shift);
    if (lightTarget > 0) items.flags = RIGEL_LIGHTS_TREE;
    const rigel_lights_desc desc = items.desc();
    EXPECT_EQ(rigel_set_lights(lights.get(), &desc), RIGEL_OK) << rigel_get_last_error();
  }
  void makeRoom() {
    rigel_crowd_info info = RIGEL_CROWD_INFO_INIT;
    EXPECT_EQ(rigel_get_crowd_info(crowd.get(), &info), RIGEL_OK);
    rigs.assign(info.rigs, {});
    coefficients.assign(info.coefficients, {});
    halves.assign(info.coefficients, {});
    near.assign(info.near_lights, {});
  }
  rigel_frame_desc desc(float seconds) {
    rigel_frame_desc desc = RIGEL_FRAME_DESC_INIT;
    desc.lights = lights.get();
    desc.rigs = rigs.data();
    desc.rig_capacity = rigs.size();
    desc.coefficients = coefficients.data();
    desc.coefficient_capacity = coefficients.size();
    desc.halves = halves.data();
    desc.half_capacity = halves.size();
    desc.near_lights = near.data();
    desc.near_light_capacity = near.size();
    desc.parallel_for = parallel;
    desc.seconds = seconds;
    desc.light_target = lightTarget;
    desc.light_cell = 4;
    return desc;
  }
  rigel_frame_info frame(float seconds) {
    const rigel_frame_desc frame = desc(seconds);
    rigel_frame_info info = RIGEL_FRAME_INFO_INIT;
    EXPECT_EQ(rigel_light_crowd(crowd.get(), &frame, &info), RIGEL_OK) << rigel_get_last_error();
    return info;
  }
};

}  // namespace rigel::test
