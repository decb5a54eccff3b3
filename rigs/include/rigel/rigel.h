// Rigel from C (C99, C++): crowds of moving characters, lit in every frame. <rigel/crowd.h> behind a C interface.
//
// DRAFT, version 0. Nothing here is promised until an engine plugin has used it: rigs/README.md, "From C", lists what
// that has to answer. Until then a program and the library that it runs with are built from the same header.
//
//   rigel_kind    what characters have in common: a rig, points of the surface, a skin
//   rigel_lights  a frame's lights
//   rigel_crowd   characters of some kinds
//
// Once a frame: rigel_set_lights, rigel_set_character for each that moved, rigel_light_crowd, which writes rigs,
// coefficients and near lights into the caller's buffers, as the shaders of Rigel read them.
//
// Errors. What can fail returns a rigel_result. A call that failed has changed nothing and written nothing
// (rigel_light_crowd says for itself where it may have), and rigel_get_last_error has one line about it. NULL where
// something is needed, sizes that do not fit, numbers that are not finite or out of their range, and ids of characters
// that are gone are errors; pointers to what is no more cannot be told. No call throws, prints or ends the program.
//
// Structs are of two sorts. Values (vectors, lights, joints, ids, what shaders read) come in arrays, and never change
// their layout: what is new gets an array of its own. Descriptions (_desc: in, _info: out) begin with their size in
// bytes, which the RIGEL_..._INIT macros fill in along with the defaults, and grow at their end: there 0 is always what
// was before. A library takes a _desc of a newer header where all that it does not know is 0 (as openat2(2) does), else
// it says RIGEL_ERROR_SIZE; of a newer _info it sets the rest to 0. `reserved` is 0.
//
// Memory. The library allocates with C++'s operator new. rigel_set_lights and rigel_light_crowd do so only while lights
// are more than ever before (a set keeps them twice: in two frames). A caller's allocator would be two functions and a
// context at the end of each _desc that something is created from; all 0: as now.
//
// Threads. The library starts none, takes no lock, and has no state of its own but each thread's last error. Different
// objects may be used at the same time. Of one: a kind by any number of threads; lights by any number while none sets
// or destroys them; a crowd by one thread, but for rigel_set_character, which any number may call at a time, each for
// other characters, and rigel_get_place and ..._info, while nothing else goes on.
//
// Metres, radians, right-handed, +y up; linear Rec.709 radiometric units; 32-bit IEEE floats.
#ifndef RIGEL_RIGEL_H
#define RIGEL_RIGEL_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define RIGEL_API_VERSION 0u

/// RIGEL_API_VERSION of the library.
uint32_t rigel_get_api_version(void);

// Errors.

typedef enum rigel_result {
  RIGEL_OK = 0,
  RIGEL_ERROR_NULL = 1,      ///< a pointer is NULL
  RIGEL_ERROR_SIZE = 2,      ///< a description is not of this version's size, and not of a newer one without news
  RIGEL_ERROR_VALUE = 3,     ///< a number is not finite or out of its range, or two do not go together
  RIGEL_ERROR_ID = 4,        ///< no such character (any more), no such kind in the crowd, or two lights of one id
  RIGEL_ERROR_CAPACITY = 5,  ///< a buffer is smaller than rigel_crowd_info says
  RIGEL_ERROR_MEMORY = 6,    ///< no memory
  RIGEL_ERROR_CALLBACK = 7   ///< the caller's parallel_for did not do all of its tasks
} rigel_result;

/// "RIGEL_ERROR_ID" and so on; "unknown" for what is no rigel_result.
const char* rigel_get_result_name(rigel_result result);

/// What was wrong in the calling thread's last call that failed: "rigel_create_kind: surface is NULL". Never NULL; good
/// until the thread's next call that fails.
const char* rigel_get_last_error(void);

// Values.

typedef struct rigel_vec3 {
  float x, y, z;
} rigel_vec3;

typedef struct rigel_rgb {
  float r, g, b;
} rigel_rgb;

/// Rows first: p' = m (p, 1).
typedef struct rigel_transform {
  float m[3][4];
} rigel_transform;

/// The joints that move a point of the surface, as indices into a palette, and their weights, which sum to 1.
typedef struct rigel_skin {
  uint16_t joint[4];
  float weight[4];
} rigel_skin;

/// Four half floats, a texel of RGBA16F; four floats.
typedef struct rigel_half4 {
  uint16_t x, y, z, w;
} rigel_half4;

typedef struct rigel_vec4 {
  float x, y, z, w;
} rigel_vec4;

#define RIGEL_IDENTITY                           \
  {                                              \
    {                                            \
      {1, 0, 0, 0}, {0, 1, 0, 0}, { 0, 0, 1, 0 } \
    }                                            \
  }
/// A light shines on a character where their groups share a bit; a light or character of no group is dark.
#define RIGEL_ALL_GROUPS 0xffffffffu

// Kinds.

typedef struct rigel_kind rigel_kind;

/// Most near lights of a character.
#define RIGEL_MAX_NEAR_SLOTS 8u

typedef struct rigel_kind_desc {
  size_t size;
  const char* rig;            ///< "poly:K", K from 1 to 56: SH vectors of the rig; 6 is a good one
  const rigel_vec3* surface;  ///< points spread evenly over the area of the rest pose; several hundred are plenty
  size_t surface_count;
  const rigel_skin* skin;  ///< of each point, or NULL: rigid, no palette is read
  size_t skin_count;       ///< surface_count, or 0
  rigel_vec3 box_lo;       ///< box of the rest pose, in the frame of the rig
  rigel_vec3 box_hi;
  uint32_t near_slots;  ///< near lights of a character at most, fading ones included
  float tolerance;      ///< [W/m2] a light whose error is below it stays in the rig
  float weight_rate;    ///< [1/s] limit of a near light's fading; 0: none
  uint32_t reserved;
} rigel_kind_desc;
#define RIGEL_KIND_DESC_INIT \
  { sizeof(rigel_kind_desc), NULL, NULL, 0, NULL, 0, {0, 0, 0}, {0, 0, 0}, 2, 0, 20, 0 }

/// Reads all arrays before it returns. Takes 2 ms (poly:6) to 60 ms (poly:56) for a thousand points.
rigel_result rigel_create_kind(const rigel_kind_desc* desc, rigel_kind** kind);
/// Crowds keep what they need of it. NULL: nothing.
void rigel_destroy_kind(rigel_kind* kind);

typedef struct rigel_kind_info {
  size_t size;
  uint32_t sh_vectors;   ///< K
  uint32_t projections;  ///< points of the surface at which light is projected
  uint32_t joints;       ///< a palette has at least as many; 0: rigid
  uint32_t near_slots;
} rigel_kind_info;
#define RIGEL_KIND_INFO_INIT \
  { sizeof(rigel_kind_info), 0, 0, 0, 0 }

rigel_result rigel_get_kind_info(const rigel_kind* kind, rigel_kind_info* info);

// Lights. <rigel/light.h> has their formulas; angles are in radians. Directions need not be unit; there is no light
// where one has no length, nor with a range, or a sphere's or disk's radius, of 0.

/// `id`: the light's name from frame to frame, other than that of each other light: by it near lights fade.
typedef struct rigel_directional_light {
  rigel_vec3 direction;  ///< the way the light travels
  rigel_rgb irradiance;  ///< [W/m2] at normal incidence
  uint32_t groups, id;
} rigel_directional_light;

typedef struct rigel_point_light {
  rigel_vec3 position;
  float radius;         ///< [m] nearer than that it gets no brighter; 0 counts as 1e-6
  rigel_rgb intensity;  ///< [W/sr]
  float range;          ///< [m] of the window clamp(1 - (d/range)^4, 0, 1)^2; INFINITY: none
  uint32_t groups, id;
} rigel_point_light;

typedef struct rigel_spot_light {
  rigel_vec3 position;
  float radius;
  rigel_rgb intensity;
  float range;
  rigel_vec3 direction;
  float inner_angle, outer_angle;  ///< from the axis, 0 <= inner <= outer <= pi
  uint32_t groups, id;
} rigel_spot_light;

typedef struct rigel_sphere_light {
  rigel_vec3 position;
  float radius;
  rigel_rgb radiance;  ///< [W/(m2 sr)]
  uint32_t groups, id;
} rigel_sphere_light;

typedef struct rigel_disk_light {
  rigel_vec3 position;
  float radius;
  rigel_rgb radiance;
  rigel_vec3 direction;
  uint32_t two_sided;  ///< 0 or 1
  uint32_t groups, id;
} rigel_disk_light;

/// What C++ has for defaults.
#define RIGEL_DIRECTIONAL_LIGHT_INIT \
  { {0, -1, 0}, {0, 0, 0}, RIGEL_ALL_GROUPS, 0 }
#define RIGEL_POINT_LIGHT_INIT \
  { {0, 0, 0}, 0.01f, {0, 0, 0}, INFINITY, RIGEL_ALL_GROUPS, 0 }
#define RIGEL_SPOT_LIGHT_INIT \
  { {0, 0, 0}, 0.01f, {0, 0, 0}, INFINITY, {0, -1, 0}, 0, 0.785398163f, RIGEL_ALL_GROUPS, 0 }
#define RIGEL_SPHERE_LIGHT_INIT \
  { {0, 0, 0}, 0, {0, 0, 0}, RIGEL_ALL_GROUPS, 0 }
#define RIGEL_DISK_LIGHT_INIT \
  { {0, 0, 0}, 0, {0, 0, 0}, {0, -1, 0}, 0, RIGEL_ALL_GROUPS, 0 }

/// Flags of lights.
#define RIGEL_LIGHTS_TREE 1u  // with a structure over them, for frames with a light_target (light_tree.h)

/// An array may be NULL where its count is 0.
typedef struct rigel_lights_desc {
  size_t size;
  const rigel_directional_light* directional;
  size_t directional_count;
  const rigel_point_light* point;
  size_t point_count;
  const rigel_spot_light* spot;
  size_t spot_count;
  const rigel_sphere_light* sphere;
  size_t sphere_count;
  const rigel_disk_light* disk;
  size_t disk_count;
  uint32_t flags;
  uint32_t reserved;
} rigel_lights_desc;
#define RIGEL_LIGHTS_DESC_INIT \
  { sizeof(rigel_lights_desc), NULL, 0, NULL, 0, NULL, 0, NULL, 0, NULL, 0, 0, 0 }

typedef struct rigel_lights rigel_lights;

/// None yet.
rigel_result rigel_create_lights(rigel_lights** lights);
/// Replaces all of them by copies, for any number of crowds. Linear in the lights, but for ids that are not in order,
/// and for trees of lights that are more, fewer or of other kinds and groups than two calls before, or have moved far.
rigel_result rigel_set_lights(rigel_lights* lights, const rigel_lights_desc* desc);
void rigel_destroy_lights(rigel_lights* lights);

// Crowds.

typedef struct rigel_crowd rigel_crowd;

#define RIGEL_MAX_TASKS 1024u

typedef struct rigel_crowd_desc {
  size_t size;
  uint32_t bands;  ///< of SH, 2 to 5
  uint32_t tasks;  ///< into how many a frame is cut at most: threads it can use; 0.1 MB each; 1 to RIGEL_MAX_TASKS
} rigel_crowd_desc;
#define RIGEL_CROWD_DESC_INIT \
  { sizeof(rigel_crowd_desc), 3, 1 }

rigel_result rigel_create_crowd(const rigel_crowd_desc* desc, rigel_crowd** crowd);
/// Its characters, too.
void rigel_destroy_crowd(rigel_crowd* crowd);

/// A character's name in its crowd, until it is removed. {0, 0, 0} is nobody's.
typedef struct rigel_character {
  uint32_t kind, index, generation;
} rigel_character;

/// A character that is hidden until it is set. Allocates while the kind's are more than ever before in this crowd.
rigel_result rigel_add_character(rigel_crowd* crowd, const rigel_kind* kind, rigel_character* character);
rigel_result rigel_remove_character(rigel_crowd* crowd, rigel_character character);

/// Flags of a character.
#define RIGEL_CHARACTER_HIDDEN 1u  // neither computed nor written
#define RIGEL_CHARACTER_CUT 2u     // moved at once, not step by step: until the next frame is done, nothing of it fades

/// Most frames from one update of a character to the next.
#define RIGEL_MAX_INTERVAL 64u

typedef struct rigel_character_desc {
  size_t size;
  const rigel_transform* palette;  ///< from the rest pose to the rig's frame; NULL for rigid kinds
  size_t joint_count;
  rigel_transform world_from_rig;  ///< rotation and place; scale belongs into the palette
  uint32_t groups;
  uint32_t interval;  ///< frames from one update to the next, 1 to RIGEL_MAX_INTERVAL (crowd.h, "Update rates")
  uint32_t flags;
  uint32_t reserved;
} rigel_character_desc;
#define RIGEL_CHARACTER_DESC_INIT \
  { sizeof(rigel_character_desc), NULL, 0, RIGEL_IDENTITY, RIGEL_ALL_GROUPS, 1, 0, 0 }

/// Holds until it is set again. The palette is not copied: rigel_light_crowd reads it in each frame in which the
/// character is updated, unless hidden; so it stays where it is until the next call for this character, or its removal.
/// Joints that are not finite are no error: rigel_frame_info::unusable counts who is dark for them.
rigel_result rigel_set_character(rigel_crowd* crowd, rigel_character character, const rigel_character_desc* desc);

/// What a crowd is, and the buffers that a frame needs with all characters visible.
typedef struct rigel_crowd_info {
  size_t size;
  size_t characters;
  size_t rigs;          ///< for rigel_frame_desc::rig_capacity
  size_t coefficients;  ///< in vec4: for coefficient_capacity or half_capacity
  size_t near_lights;   ///< for near_light_capacity
  size_t bytes;         ///< that the crowd holds
} rigel_crowd_info;
#define RIGEL_CROWD_INFO_INIT \
  { sizeof(rigel_crowd_info), 0, 0, 0, 0, 0 }

rigel_result rigel_get_crowd_info(const rigel_crowd* crowd, rigel_crowd_info* info);

/// Of a character of a kind that is in the crowd, the caller's buffers not included: 1580 for poly:6, 3 bands and two
/// near slots.
rigel_result rigel_get_character_bytes(const rigel_crowd* crowd, const rigel_kind* kind, size_t* bytes);

// What shaders read. shaders/include/rigel/shader_types.h says the same to them, and what each member means.

/// A rig in a frame. L(p) = sum of monomial_k(u) c_k over k < vectors, with box coordinates
/// u.x = dot(axis_x.xyz, p - centre) + axis_x.w, and so on. c_k is 3 B^2 floats, interleaved RGB of pi times radiance
/// SH over `scale`, padded to whole vec4 (3, 7, 12, 19 for 2 to 5 bands), from vec4 offset + k * that number on.
typedef struct rigel_gpu_rig {
  rigel_vec3 centre;  ///< [m] world
  int32_t offset;     ///< vec4 of the coefficients where the first is
  rigel_vec4 axis_x, axis_y, axis_z;
  int32_t kind;     ///< 1, a polynomial
  int32_t vectors;  ///< 0: dark
  float scale;      ///< 1 without half floats
  int32_t high_band;
  int32_t nodes[3];
  int32_t kernel;
  int32_t slope[3];
  int32_t per_node;
  int32_t high_offset;
  int32_t gauss_offset;
  int32_t unused[2];
  rigel_vec4 falloff[3];
  int32_t terms[4][4];  ///< monomial k > 0 is monomial t / 4 times coordinate t % 4 of u, t: byte k % 4 of int k / 4
} rigel_gpu_rig;

/// A light that is evaluated exactly at every point, times its weight; the rig holds the rest of it.
typedef struct rigel_gpu_near_light {
  rigel_vec3 position;  ///< [m] world; directional: unit vector towards the light
  float radius;
  rigel_rgb colour;
  int32_t kind;     ///< 0 directional, 1 point, 2 spot, 3 sphere, 4 disk
  rigel_vec3 axis;  ///< of spots and disks, unit
  float inverse_range;
  float cos_outer;
  float inverse_cone_width;
  float extent;
  float unused;
} rigel_gpu_near_light;

/// Calls task(work, i) once for each i in [0, count), in any order, on any threads, and returns when all are done.
typedef void (*rigel_task)(void* work, int32_t i);
typedef struct rigel_parallel_for {
  void (*run)(void* context, int32_t count, rigel_task task, void* work);  ///< NULL: the calling thread does all
  void* context;
} rigel_parallel_for;

/// A clock for stages, which any thread may ask; NULL: none is timed.
typedef struct rigel_clock {
  uint64_t (*now)(void* context);
  void* context;
} rigel_clock;

/// Buffers are written as far as they are used, and never read: they may be mapped memory of a GPU. Coefficients in
/// floats, in half floats, or both; a buffer that is NULL, with a capacity of 0, is not written.
typedef struct rigel_frame_desc {
  size_t size;
  const rigel_lights* lights;
  rigel_gpu_rig* rigs;  ///< one a visible character
  size_t rig_capacity;
  rigel_vec4* coefficients;
  size_t coefficient_capacity;
  rigel_half4* halves;
  size_t half_capacity;
  rigel_gpu_near_light* near_lights;  ///< near_slots a visible character, of which some are lit (rigel_place)
  size_t near_light_capacity;
  rigel_parallel_for parallel_for;
  rigel_clock clock;
  float seconds;  ///< since the last frame; 0: a cut for all characters
  /// Where there are many lights: the share of anybody's light that may be merged or dropped at most, 0 to 1; the
  /// lights are to have a tree then. 0: all lights one by one.
  float light_target;
  float light_cell;  ///< [m] those who are in a cell of that size share what is asked of the tree (crowd.h, CrowdTree)
  float light_wrap;  ///< of the materials, -1/4 to 1
} rigel_frame_desc;
#define RIGEL_FRAME_DESC_INIT \
  { sizeof(rigel_frame_desc), NULL, NULL, 0, NULL, 0, NULL, 0, NULL, 0, {NULL, NULL}, {NULL, NULL}, 0, 0, 8, 0 }

/// Stages of rigel_frame_info::ticks.
enum {
  RIGEL_STAGE_POSE,
  RIGEL_STAGE_REFRESH,
  RIGEL_STAGE_RANK,
  RIGEL_STAGE_PROJECT,
  RIGEL_STAGE_FIT,
  RIGEL_STAGE_PACK,
  RIGEL_STAGE_SELECT,  // by a tree, between refresh and rank
  RIGEL_STAGE_COUNT
};

typedef struct rigel_frame_info {
  size_t size;
  uint32_t visible;   ///< characters written
  uint32_t updated;   ///< fitted anew; the others go on from one update to the next
  uint32_t unusable;  ///< of these, with a palette that is not finite: dark until it is
  float merged;       ///< with a tree, largest share of anybody's light that merged lights may be wrong by: a bound
  uint64_t ticks[RIGEL_STAGE_COUNT];  ///< of the clock, summed over threads
  uint64_t lights, clusters;          ///< taken one by one, and in place of others, summed over those updated
} rigel_frame_info;
#define RIGEL_FRAME_INFO_INIT \
  { sizeof(rigel_frame_info), 0, 0, 0, 0, {0, 0, 0, 0, 0, 0, 0}, 0, 0 }

/// Lights all visible characters: the same bits on any number of threads. Linear in characters x lights, but for those
/// in a tree. `info` may be NULL. After RIGEL_ERROR_CALLBACK (`run` left tasks out, or threw) what is in the buffers is
/// not to be used, and the next frame is a cut.
rigel_result rigel_light_crowd(rigel_crowd* crowd, const rigel_frame_desc* desc, rigel_frame_info* info);

/// Where a character is in the last frame's buffers.
typedef struct rigel_place {
  int32_t rig;          ///< -1: not visible
  int32_t near_offset;  ///< of its first near light
  int32_t near_count;   ///< that are lit
} rigel_place;

rigel_result rigel_get_place(const rigel_crowd* crowd, rigel_character character, rigel_place* place);

#ifdef __cplusplus
}  // extern "C"
#endif

#endif
