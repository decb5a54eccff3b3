// Uses the C library through the installed package: a crowd of nobody in no light.
#include <rigel/rigel.h>

#include <stdio.h>

int main(void) {
  const rigel_crowd_desc desc = RIGEL_CROWD_DESC_INIT;
  rigel_crowd* crowd = NULL;
  rigel_lights* lights = NULL;
  rigel_frame_desc frame = RIGEL_FRAME_DESC_INIT;
  rigel_frame_info info = RIGEL_FRAME_INFO_INIT;
  if (rigel_get_api_version() != RIGEL_API_VERSION) return fprintf(stderr, "header and library differ\n"), 1;
  if (rigel_create_crowd(&desc, &crowd) != RIGEL_OK || rigel_create_lights(&lights) != RIGEL_OK) return 1;
  frame.lights = lights;
  if (rigel_light_crowd(crowd, &frame, &info) != RIGEL_OK || info.visible != 0)
    return fprintf(stderr, "%s\n", rigel_get_last_error()), 1;
  rigel_destroy_lights(lights);
  rigel_destroy_crowd(crowd);
  return rigel_create_lights(NULL) == RIGEL_ERROR_NULL ? 0 : 1;
}
