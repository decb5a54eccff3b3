// Frames of a scene, posed, lit and drawn: the work behind `rigel render`.
#pragma once

#include "picture/image.h"
#include "render/compare.h"
#include "render/scene_renderer.h"
#include "report/run/loaded_scene.h"

#include <memory>

namespace rigel::tools {

/// What an object's rig is in a frame.
struct RigState {
  std::string object;
  int shVectors = 0;
  std::vector<int> near;  // lights, by number, evaluated exactly in whole or part
};

/// What came of a frame.
struct RenderResult {
  int number = 0;
  double time = 0;                       // s
  Image radiance;                        // linear
  float exposure = 1;                    // that shows it
  double frameMilliseconds = 0;          // of the device, at the picture's size without supersampling
  double unlitMilliseconds = 0;          // of the same frame, what has rigs in constant colours
  double drawMilliseconds = 0;           // by the clock, until the frame has been read back: rigs are fitted before
  std::optional<Difference> difference;  // where RenderOptions::against asks for it
  Effects effects;                       // of the frame's shaders and lights
  FitTimes stages;                       // of the CPU, all objects together
  std::vector<RigState> rigs;
};

class SceneRender {
 public:
  /// Errors: what LoadedScene gives, no such object, a rig that cannot be built, no device.
  static Result<SceneRender> create(const RenderOptions& options, const GpuContext& context);

  /// Numbers of the frames asked for, rising.
  const std::vector<int>& frames() const { return timeline().frames; }
  Result<RenderResult> render(int frame);

  const std::vector<std::string>& notes() const { return scene_->notes(); }
  int pipelines() const { return renderer_->pipelines(); }
  /// Whether the table of disk lights was opened and uploaded.
  bool hasDiskTable() const { return renderer_->hasDiskTable(); }
  /// By the clock: buffers, pipelines and their first draws; not the scene.
  double loadMilliseconds() const { return loadMilliseconds_; }

 private:
  struct Lit {
    const SceneObject* object = nullptr;
    std::unique_ptr<RigRunner> rig;  // null: scenery
    SurfaceSet surface;
  };

  explicit SceneRender(const RenderOptions& options) : options_(options) {}
  const Timeline& timeline() const { return scene_->timelines().front(); }
  std::optional<Error> load();
  std::optional<Error> makeRigs();
  void survey();
  void pose(int frame);
  FitTimes fit(float seconds);
  std::vector<RigState> rigStates() const;
  Camera camera(int width, int height) const;
  Result<RenderedFrame> draw(const Camera& camera);
  BoundingSphere framedSphere() const;
  float exposureOf(const RenderedFrame& frame) const;
  Image picture(const RenderedFrame& frame, float exposure) const;
  Difference compareWith(const RenderedFrame& frame, const RenderedPoints& points, const Camera& camera);
  std::vector<Rgb> irradianceOfRigs(const VisibleSurface& seen) const;

  RenderOptions options_;
  std::unique_ptr<std::optional<LightDonor>> donor_;  // its address is kept by the scene
  std::unique_ptr<LoadedScene> scene_;
  std::unique_ptr<Stage> stage_;
  std::vector<Lit> lit_;
  std::vector<PosedObject> posed_;
  std::vector<std::size_t> framed_;  // objects that the camera looks at
  float framedRadius_ = 0;           // m, largest over the frames
  std::unique_ptr<SceneRenderer> renderer_;
  double loadMilliseconds_ = 0;
  std::vector<BudgetShare> shares_;  // of --budget-us
  int lastFrame_ = -1;
};

}  // namespace rigel::tools
