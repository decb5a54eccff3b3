// Draws posed objects on the GPU, each lit by its rig and near lights, scenery by every light, per pixel or per vertex.
#pragma once

#include "gpu/commands.h"
#include "picture/camera.h"
#include "picture/raycast.h"
#include "render/draw_list.h"
#include "render/rendered_frame.h"
#include "render/shader_variant.h"
#include "render/shading_buffers.h"
#include "render/specialised_shaders.h"

namespace rigel::tools {

/// An object to be drawn; without a rig it is scenery.
struct DrawnObject {
  const SceneObject* object = nullptr;
  RigRunner* rig = nullptr;  // fitted to a frame of the scene before the renderer is made
};

struct RendererOptions {
  int bands = 3;
  RigStorage storage = RigStorage::float32;
  bool perVertex = false;                  // objects with rigs; scenery has too few vertices for it
  std::optional<float> wrap;               // overrides the materials'
  Effect wrappedDisk = kWrappedDisk;       // of RenderOptions
  bool points = false;                     // that `points` may be asked for
  std::filesystem::path shaderCache = {};  // of SpecialisedShaders
};

/// Everything is made and warmed up in `create`: afterwards no shader or pipeline is, whatever the frames hold.
class SceneRenderer {
 public:
  /// `lights` as the scene's frames have them: as many, of the same kinds.
  static Result<SceneRenderer> create(const GpuContext& context, std::span<const DrawnObject> objects,
                                      const LightSet& lights, const RendererOptions& options);

  /// A frame: `posed` has an entry an object, rigs are fitted, `markers` are how lights are shown. RenderedFrame::part
  /// of object i is 1 + i.
  Result<RenderedFrame> render(const Camera& camera, std::span<const PosedObject> posed, const LightSet& lights,
                               std::span<const LightMarker> markers);

  /// The same frame with what has a rig in constant colours: what is left is the cost of shading by rigs. [ms]
  Result<double> unlitMilliseconds(const Camera& camera);

  /// What the pixels of the same frame shaded. Only if RendererOptions::points.
  Result<RenderedPoints> points(const Camera& camera);

  bool hasDiskTable() const { return buffers_.hasDiskTable(); }
  int pipelines() const { return static_cast<int>(shelf_.size()); }
  /// What the shaders of the last frame were specialised to, over all draws.
  Effects effects() const { return effects_; }

 private:
  struct Drawn {
    const SceneObject* object = nullptr;
    RigRunner* rig = nullptr;
    std::size_t rigIndex = 0;
    DrawList draws;
    std::uint32_t firstVertex = 0;
  };
  struct Entry {
    ShaderVariant variant;
    bool perVertex = false;
    GpuPipeline pipeline;
  };
  struct Draw {
    const GpuPipeline* pipeline = nullptr;
    const GpuBindings* bindings = nullptr;
    std::array<std::uint32_t, 2> offsets{};
    std::uint32_t firstVertex = 0, vertices = 0;
    std::uint32_t part = 0;
    float radianceScale = 1;
    int firstNear = 0, nearCount = 0;
    bool hasRig = false;
  };

  SceneRenderer(const GpuContext& context, const RendererOptions& options, ShadingBuffers buffers, GpuCommands commands)
      : context_(&context),
        options_(options),
        buffers_(std::move(buffers)),
        commands_(std::move(commands)),
        shaders_(options.shaderCache) {}

  std::optional<Error> makePipelines(const LightSet& lights);
  std::optional<Error> addPipeline(const ShaderVariant& variant, bool perVertex, const RasterTarget& target);
  std::optional<Error> warmUp(const RasterTarget& target);
  std::optional<Error> makeRoom(std::size_t markers);
  std::optional<Error> fitTarget(const Camera& camera);
  const GpuPipeline* pipelineOf(const ShaderVariant& variant, bool perVertex) const;
  Effects nearKinds(const LightSet& lights, float wrap) const {
    return nearKindsOf(lightEffects(lights), wrap, options_.wrappedDisk);
  }
  bool isPerVertex(const Drawn& drawn) const { return options_.perVertex && drawn.rig != nullptr; }
  void fillVertices(std::span<const PosedObject> posed, std::span<const LightMarker> markers);
  std::optional<Error> listDraws(const LightSet& lights, std::size_t markers);
  void record(const Camera& camera, const Draw& draw, const GpuPipeline& pipeline);
  Result<double> run(const Camera& camera, const GpuPipeline* instead, bool rigsAlone = false);

  const GpuContext* context_;
  RendererOptions options_;
  std::vector<Drawn> drawn_;
  ShadingBuffers buffers_;
  GpuCommands commands_;
  SpecialisedShaders shaders_;
  std::vector<Entry> shelf_;
  std::optional<GpuPipeline> flat_;
  std::optional<GpuPipeline> surface_;
  std::vector<DrawVertex> ball_;  // of radius 1
  std::optional<GpuBuffer> vertices_;
  std::uint32_t objectVertices_ = 0;
  std::optional<RasterTarget> target_;
  std::vector<GpuBuffer> readBacks_;  // of the target's colours
  std::vector<Draw> list_;
  std::vector<NearLight> allLights_;
  Effects effects_;
};

}  // namespace rigel::tools
