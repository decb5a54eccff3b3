// A program in C that knows <rigel/rigel.h> alone: a crowd walks under a sun, past a lamp, and what comes out is
// checked against closed forms.
#include <rigel/rigel.h>

#include <stdio.h>
#include <stdlib.h>

#define kWalkers 40
#define kPoints 300
#define kJoints 2
#define kVectors 6
#define kVectorSize 7  // vec4 of an SH vector of 3 bands

static int checks = 0;
#define CHECK(condition)                                                                                      \
  do {                                                                                                        \
    ++checks;                                                                                                 \
    if (!(condition)) {                                                                                       \
      fprintf(stderr, "%s:%d: %s\nlast error: %s\n", __FILE__, __LINE__, #condition, rigel_get_last_error()); \
      exit(1);                                                                                                \
    }                                                                                                         \
  } while (0)

static const float kPi = 3.14159265f;

// A barrel, 1.8 m high, whose upper half rides on the second joint.
static rigel_kind* createWalker(void) {
  static rigel_vec3 surface[kPoints];
  static rigel_skin skin[kPoints];
  for (int i = 0; i < kPoints; ++i) {
    const float height = ((float)i + 0.5f) / kPoints, turn = 2.39996323f * (float)i;
    surface[i] = (rigel_vec3){0.3f * cosf(turn), 1.8f * height, 0.3f * sinf(turn)};
    skin[i] = (rigel_skin){{0, 1, 0, 0}, {1 - height, height, 0, 0}};
  }
  rigel_kind_desc desc = RIGEL_KIND_DESC_INIT;
  desc.rig = "poly:6";
  desc.surface = surface;
  desc.surface_count = kPoints;
  desc.skin = skin;
  desc.skin_count = kPoints;
  desc.box_lo = (rigel_vec3){-0.3f, 0, -0.3f};
  desc.box_hi = (rigel_vec3){0.3f, 1.8f, 0.3f};
  desc.near_slots = 1;
  rigel_kind* kind = NULL;
  CHECK(rigel_create_kind(&desc, &kind) == RIGEL_OK);
  rigel_kind_info info = RIGEL_KIND_INFO_INIT;
  CHECK(rigel_get_kind_info(kind, &info) == RIGEL_OK);
  CHECK(info.sh_vectors == kVectors && info.joints == kJoints && info.near_slots == 1 && info.projections >= kVectors);
  return kind;
}

typedef struct Stage {
  rigel_crowd* crowd;
  rigel_lights* lights;
  rigel_character walkers[kWalkers];
  rigel_transform palettes[kWalkers][kJoints];
  rigel_frame_desc frame;
  int tasks_run;
} Stage;

static void runBackwards(void* context, int32_t count, rigel_task task, void* work) {
  for (int32_t i = count; i-- > 0; ++((Stage*)context)->tasks_run) task(work, i);
}

static void build(Stage* stage) {
  rigel_crowd_desc desc = RIGEL_CROWD_DESC_INIT;
  desc.tasks = 2;
  CHECK(rigel_create_crowd(&desc, &stage->crowd) == RIGEL_OK);
  CHECK(rigel_create_lights(&stage->lights) == RIGEL_OK);
  rigel_kind* kind = createWalker();
  for (int i = 0; i < kWalkers; ++i) CHECK(rigel_add_character(stage->crowd, kind, &stage->walkers[i]) == RIGEL_OK);
  rigel_destroy_kind(kind);  // the crowd keeps it

  rigel_crowd_info info = RIGEL_CROWD_INFO_INIT;
  CHECK(rigel_get_crowd_info(stage->crowd, &info) == RIGEL_OK);
  CHECK(info.characters == kWalkers && info.rigs == kWalkers && info.near_lights == kWalkers);
  CHECK(info.coefficients == kWalkers * kVectors * kVectorSize && info.bytes > kWalkers * 1000);
  stage->frame = (rigel_frame_desc)RIGEL_FRAME_DESC_INIT;
  stage->frame.lights = stage->lights;
  stage->frame.rig_capacity = info.rigs;
  stage->frame.rigs = malloc(info.rigs * sizeof *stage->frame.rigs);
  stage->frame.coefficient_capacity = info.coefficients;
  stage->frame.coefficients = malloc(info.coefficients * sizeof *stage->frame.coefficients);
  stage->frame.near_light_capacity = info.near_lights;
  stage->frame.near_lights = malloc(info.near_lights * sizeof *stage->frame.near_lights);
  stage->frame.parallel_for = (rigel_parallel_for){runBackwards, stage};
  stage->frame.seconds = 1.0f / 60;
}

// Walkers stand 2 m apart along x and sway; the last is hidden.
static void pose(Stage* stage, int frame) {
  for (int i = 0; i < kWalkers; ++i) {
    rigel_transform* palette = stage->palettes[i];
    palette[0] = palette[1] = (rigel_transform)RIGEL_IDENTITY;
    palette[1].m[0][3] = 0.1f * sinf(0.2f * (float)(frame + i));
    rigel_character_desc desc = RIGEL_CHARACTER_DESC_INIT;
    desc.palette = palette;
    desc.joint_count = kJoints;
    desc.world_from_rig.m[0][3] = 2.0f * (float)i;
    desc.interval = i % 2 == 0 ? 1 : 4;
    desc.flags = i == kWalkers - 1 ? RIGEL_CHARACTER_HIDDEN : 0;
    CHECK(rigel_set_character(stage->crowd, stage->walkers[i], &desc) == RIGEL_OK);
  }
}

static rigel_place placeOf(const Stage* stage, int walker) {
  rigel_place place;
  CHECK(rigel_get_place(stage->crowd, stage->walkers[walker], &place) == RIGEL_OK);
  return place;
}

static const float* coefficientsOf(const Stage* stage, int walker) {
  return &stage->frame.coefficients[stage->frame.rigs[placeOf(stage, walker).rig].offset].x;
}

static int isNear(float a, float b, float tolerance) { return fabsf(a - b) <= tolerance; }

// The same light everywhere: the first vector is pi times its radiance SH, E Y, and the others are nothing.
static void checkSun(Stage* stage) {
  rigel_directional_light sun = RIGEL_DIRECTIONAL_LIGHT_INIT;
  sun.irradiance = (rigel_rgb){3, 2, 1};
  rigel_lights_desc lights = RIGEL_LIGHTS_DESC_INIT;
  lights.directional = &sun;
  lights.directional_count = 1;
  CHECK(rigel_set_lights(stage->lights, &lights) == RIGEL_OK);
  rigel_frame_info info = RIGEL_FRAME_INFO_INIT;
  for (int f = 0; f < 6; ++f) {
    pose(stage, f);
    CHECK(rigel_light_crowd(stage->crowd, &stage->frame, &info) == RIGEL_OK);
    CHECK(info.visible == kWalkers - 1 && info.unusable == 0);
    CHECK(f == 0 ? info.updated == kWalkers - 1 : info.updated < kWalkers - 1);
  }
  CHECK(stage->tasks_run == 12);
  const float y0 = kPi * sqrtf(1 / (4 * kPi)), y1 = kPi * sqrtf(3 / (4 * kPi));
  const float tolerance = 1e-5f;  // of an irradiance of 3; rounding, worst seen 2e-6
  for (int w = 0; w < kWalkers - 1; ++w) {
    CHECK(stage->frame.rigs[placeOf(stage, w).rig].vectors == kVectors);
    const float* c = coefficientsOf(stage, w);
    CHECK(isNear(c[0], 3 * y0, tolerance) && isNear(c[1], 2 * y0, tolerance) && isNear(c[2], y0, tolerance));
    CHECK(isNear(c[3], 3 * y1, tolerance));  // Y_1,-1 is that of y, where the light comes from
    for (int i = 4 * kVectorSize; i < 4 * kVectorSize * kVectors; ++i) CHECK(isNear(c[i], 0, tolerance));
  }
}

// A lamp beside walker 4 is near to it, with what the rig does not hold of it: all of it in the end.
static void checkLamp(Stage* stage) {
  rigel_point_light lamp = RIGEL_POINT_LIGHT_INIT;
  lamp.position = (rigel_vec3){8, 1, 0.6f};
  lamp.intensity = (rigel_rgb){2, 2, 2};
  lamp.range = 1;
  lamp.id = 77;
  rigel_lights_desc lights = RIGEL_LIGHTS_DESC_INIT;
  lights.point = &lamp;
  lights.point_count = 1;
  for (int f = 0; f < 6; ++f) {
    CHECK(rigel_set_lights(stage->lights, &lights) == RIGEL_OK);
    pose(stage, f);
    CHECK(rigel_light_crowd(stage->crowd, &stage->frame, NULL) == RIGEL_OK);
  }
  for (int w = 0; w < kWalkers - 1; ++w) CHECK(placeOf(stage, w).near_count == (w == 4));
  const rigel_gpu_near_light* light = &stage->frame.near_lights[placeOf(stage, 4).near_offset];
  CHECK(light->kind == 1 && light->position.x == 8 && light->position.z == 0.6f && light->colour.r == 2);
  const float* c = coefficientsOf(stage, 4);
  for (int i = 0; i < 4 * kVectorSize * kVectors; ++i) CHECK(c[i] == 0);
  CHECK(placeOf(stage, kWalkers - 1).rig == -1);
}

static void checkWrongUse(Stage* stage) {
  CHECK(rigel_light_crowd(stage->crowd, NULL, NULL) == RIGEL_ERROR_NULL);
  CHECK(rigel_remove_character(stage->crowd, stage->walkers[3]) == RIGEL_OK);
  CHECK(rigel_remove_character(stage->crowd, stage->walkers[3]) == RIGEL_ERROR_ID);
  printf("%s: %s\n", rigel_get_result_name(RIGEL_ERROR_ID), rigel_get_last_error());
}

int main(void) {
  CHECK(rigel_get_api_version() == RIGEL_API_VERSION);
  static Stage stage;
  build(&stage);
  checkSun(&stage);
  checkLamp(&stage);
  checkWrongUse(&stage);
  rigel_destroy_crowd(stage.crowd);
  rigel_destroy_lights(stage.lights);
  free(stage.frame.rigs);
  free(stage.frame.coefficients);
  free(stage.frame.near_lights);
  printf("%d checks\n", checks);
  return 0;
}
