// The buffers behind shade_object.glsl: rigs, coefficients, materials and near lights of all that a frame shades.
#pragma once

#include "gpu/commands.h"
#include "render/render_options.h"
#include "report/measure/rig_runner.h"

#include <rigel/gpu_rig.h>

namespace rigel::tools {

/// How to bind one thing shaded: the descriptor set's dynamic parts, and its near lights.
struct ShadingPlace {
  std::uint32_t rig = 0;  // bytes, of Object
  int firstNear = 0, nearCount = 0;
  GpuRig packed{};  // what Object holds there
};

/// What buffers must hold at most.
struct ShadingRoom {
  std::vector<const RigRunner*> rigs;  // one for each object with a rig
  std::vector<float> wraps;            // different ones; Lambert need not be among them
  int lights = 0;                      // of the scene, for what is lit by all of them exactly
  bool diskTable = false;              // light_near_diskTable: the table is opened and uploaded
};

/// Sizes are fixed when it is made; a frame allocates nothing.
class ShadingBuffers {
 public:
  static Result<ShadingBuffers> create(const GpuContext& context, const ShadingRoom& room, RigStorage storage);

  const GpuLayout& layout() const { return layout_; }
  /// Of the i-th rig; what has no rig takes any.
  const GpuBindings& bindings(std::size_t rig) const { return bindings_[rig]; }
  /// Bytes, of Material.
  std::uint32_t material(float wrap) const;
  bool hasDiskTable() const { return diskTable_.has_value(); }

  /// For points.comp: what it reads and writes.
  std::optional<Error> setPoints(const GpuBuffer& points, const GpuBuffer& results);

  // A frame, not while the device works on the last one.

  void begin() { nearUsed_ = 0; }
  /// The i-th rig and its near lights as they are now. Textures are staged: `upload` copies them.
  ShadingPlace pack(std::size_t rig, const RigRunner& runner);
  /// Something lit by near lights alone.
  ShadingPlace place(std::span<const NearLight> lights);
  void upload(GpuCommands& commands) const;

 private:
  ShadingBuffers(GpuLayout layout) : layout_(std::move(layout)) {}
  std::optional<Error> createBuffers(const GpuContext& context, const ShadingRoom& room, RigStorage storage);
  std::optional<Error> createBindings(const GpuContext& context, const ShadingRoom& room);

  GpuLayout layout_;
  RigStorage storage_ = RigStorage::float32;
  std::size_t uniformStep_ = 256;
  std::vector<float> wraps_;
  std::vector<GpuRigPlace> places_;
  std::vector<std::optional<Texture3d>> textures_;
  std::vector<GpuVec4> texels_;  // working memory of the textures
  std::vector<GpuHalf4> halfTexels_;
  std::optional<GpuBuffer> coefficients_, gaussNodes_, nearLights_, objects_, materials_, diskTable_;
  std::optional<Texture3d> noTexture_;
  std::vector<GpuBindings> bindings_;
  int nearUsed_ = 0;
};

}  // namespace rigel::tools
