// The values of the C interface are those of C++ and of the shaders, member by member.
#include <rigel/crowd.h>
#include <rigel/rigel.h>

#include <cstddef>

namespace {

#define RIGEL_SAME(C, c_member, Cpp, cppMember) \
  static_assert(offsetof(C, c_member) == offsetof(Cpp, cppMember) && sizeof(C::c_member) == sizeof(Cpp::cppMember))

using rigel::GpuNearLight;
using rigel::GpuRig;

static_assert(sizeof(rigel_vec4) == sizeof(rigel::GpuVec4) && sizeof(rigel_half4) == sizeof(rigel::GpuHalf4));
static_assert(sizeof(rigel_transform) == sizeof(rigel::JointMatrix));
static_assert(RIGEL_MAX_NEAR_SLOTS == rigel::kMaxCrowdNear && RIGEL_MAX_INTERVAL == rigel::kMaxCrowdInterval);
static_assert(RIGEL_ALL_GROUPS == rigel::kAllLightGroups && int{RIGEL_STAGE_COUNT} == rigel::kCrowdStages);
static_assert(int{RIGEL_STAGE_SELECT} == static_cast<int>(rigel::CrowdStage::select));

static_assert(sizeof(rigel_gpu_rig) == sizeof(GpuRig));
RIGEL_SAME(rigel_gpu_rig, centre, GpuRig, centre);
RIGEL_SAME(rigel_gpu_rig, offset, GpuRig, offset);
RIGEL_SAME(rigel_gpu_rig, axis_x, GpuRig, axisX);
RIGEL_SAME(rigel_gpu_rig, axis_y, GpuRig, axisY);
RIGEL_SAME(rigel_gpu_rig, axis_z, GpuRig, axisZ);
RIGEL_SAME(rigel_gpu_rig, kind, GpuRig, kind);
RIGEL_SAME(rigel_gpu_rig, vectors, GpuRig, vectors);
RIGEL_SAME(rigel_gpu_rig, scale, GpuRig, scale);
RIGEL_SAME(rigel_gpu_rig, high_band, GpuRig, highBand);
RIGEL_SAME(rigel_gpu_rig, nodes, GpuRig, nodes);
RIGEL_SAME(rigel_gpu_rig, kernel, GpuRig, kernel);
RIGEL_SAME(rigel_gpu_rig, slope, GpuRig, slope);
RIGEL_SAME(rigel_gpu_rig, per_node, GpuRig, perNode);
RIGEL_SAME(rigel_gpu_rig, high_offset, GpuRig, highOffset);
RIGEL_SAME(rigel_gpu_rig, gauss_offset, GpuRig, gaussOffset);
RIGEL_SAME(rigel_gpu_rig, falloff, GpuRig, falloff);
RIGEL_SAME(rigel_gpu_rig, terms, GpuRig, terms);

static_assert(sizeof(rigel_gpu_near_light) == sizeof(GpuNearLight));
RIGEL_SAME(rigel_gpu_near_light, position, GpuNearLight, position);
RIGEL_SAME(rigel_gpu_near_light, radius, GpuNearLight, radius);
RIGEL_SAME(rigel_gpu_near_light, colour, GpuNearLight, colour);
RIGEL_SAME(rigel_gpu_near_light, kind, GpuNearLight, kind);
RIGEL_SAME(rigel_gpu_near_light, axis, GpuNearLight, axis);
RIGEL_SAME(rigel_gpu_near_light, inverse_range, GpuNearLight, inverseRange);
RIGEL_SAME(rigel_gpu_near_light, cos_outer, GpuNearLight, cosOuter);
RIGEL_SAME(rigel_gpu_near_light, inverse_cone_width, GpuNearLight, inverseConeWidth);
RIGEL_SAME(rigel_gpu_near_light, extent, GpuNearLight, extent);

#undef RIGEL_SAME

// No description has bytes that no member sets.
static_assert(sizeof(rigel_crowd_desc) == sizeof(std::size_t) + 2 * 4);
static_assert(sizeof(rigel_lights_desc) == 11 * sizeof(std::size_t) + 2 * 4);
static_assert(sizeof(rigel_kind_desc) == 6 * sizeof(std::size_t) + 10 * 4);
static_assert(sizeof(rigel_character_desc) == 3 * sizeof(std::size_t) + 16 * 4);
static_assert(sizeof(rigel_frame_desc) == 14 * sizeof(std::size_t) + 4 * 4);

}  // namespace
