// What the page shows of an object in three dimensions. Recorded by view3d_recorder, written by view3d_json.
#pragma once

#include <rigel/rig_light.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace rigel::tools {

/// One frame of an object. Points are in its rig frame [m], irradiance in W/m2.
struct ObjectViewFrame {
  rigel::RigFrame worldFromLocal;  // not the report's
  std::vector<Vec3> positions;     // of the mesh's vertices
  std::vector<Rgb> truth;          // exact irradiance at them

  struct OfRig {
    RigBox box;
    std::vector<Vec3> samples;         // where it projects light
    std::vector<Rgb> error;            // at the vertices: (clamped rig + near lights - truth) / mean of the run
    std::vector<std::uint8_t> lights;  // of the scene's view: kViewCulled, kViewFar, else how near (255: wholly)
  };
  std::vector<OfRig> rigs;  // in the order of the report's
};

inline constexpr std::uint8_t kViewCulled = 0, kViewFar = 1, kViewLeastNear = 2, kViewNear = 255;

struct ObjectView {
  std::vector<std::array<std::uint16_t, 3>> triangles;  // of the vertices
  std::vector<ObjectViewFrame> frames;                  // in the order of SceneView::frames
};

/// A light where it stands and shines in one frame.
struct ViewLightPlace {
  Vec3 position;   // world [m]; of a directional light nothing
  Vec3 direction;  // that its light travels, unit; 0 where it has none
  float radius = 0;
};

struct ViewLight {
  int index = 0;  // among the scene's lights
  Rgb colour;     // intensity, irradiance or radiance: its hue is drawn
  float innerAngle = 0, outerAngle = 0;
  bool twoSided = false;
};

/// The moments that views of a scene's objects show, and the lights in them.
struct SceneView {
  std::vector<std::size_t> frames;                  // among the run's
  std::vector<ViewLight> lights;                    // those that matter most, in the order of the scene's
  std::vector<std::vector<ViewLightPlace>> places;  // per frame, per light
};

}  // namespace rigel::tools
