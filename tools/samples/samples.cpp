#include "samples/samples.h"

#include "samples/scenes.h"

#include <array>

namespace rigel::tools {

std::span<const Sample> samples() {
  static const std::array<Sample, 7> kSamples{{
      {"street", "a car drives past twelve street lamps and into oncoming headlights: lights that rush by", makeStreet},
      {"stage", "a skinned figure reaches out of a spotlight's cone: light that leaves the fingertips", makeStage},
      {"dragon", "a long skinned body undulates among forty small lights: many lights, some close", makeDragon},
      {"touch", "lights brush, touch, graze, enter and cross a morphing body: every singular place", makeTouch},
      {"figure1", "a car with lights just off the corners of its box and its roof: a still, the paper's figure 1",
       makeFigure1},
      {"corridor", "a figure walks under round ceiling panels, two of them at its head: disks from below and behind",
       makeCorridor},
      {"gallery", "a bust glides along a wall of small disk lights at grazing angles, some all but touching it",
       makeGallery},
  }};
  return kSamples;
}

}  // namespace rigel::tools
