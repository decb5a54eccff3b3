// What a test of whole frames draws: a scene, a rig and their options, small.
#pragma once

#include "gpu/gpu_test.h"
#include "render/scene_render.h"

#include <ostream>

namespace rigel::test {

struct SceneCase {
  std::string scene;
  std::string rig;
  std::string near = {};  // "": as `rigel render` has it
  tools::FrameRange frames = {};
  tools::RigStorage storage = tools::RigStorage::float32;
  std::optional<float> wrap = {};
  int bands = 3;
  std::optional<LightingTarget> target = {};
  std::string lights = {};  // borrowed from this scene
  Effect wrappedDisk = kWrappedDisk;

  /// As a user types it.
  std::string text() const;
};

std::ostream& operator<<(std::ostream& out, const SceneCase& what);

/// Pictures of 240 x 180 pixels, without supersampling.
tools::RenderOptions renderOptions(const SceneCase& what);

/// Loaded and warmed up on gpu().
tools::SceneRender sceneRender(const tools::RenderOptions& options);

}  // namespace rigel::test
