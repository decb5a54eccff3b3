// Points of one object shaded on the GPU by the same shader code that draws it: what `rigel report --device gpu`
// measures and what the table of costs times.
#pragma once

#include "gpu/commands.h"
#include "render/shader_variant.h"
#include "render/shading_buffers.h"

namespace rigel::tools {

/// Everything is made and warmed up in `create`; a call of `shade` allocates nothing on the device.
class PointShader {
 public:
  /// `rig` is fitted to a frame of the scene; other frames have lights of the same kinds. `wraps` are those that points
  /// may have, `mostPoints` their number at most; `wrappedDisk` as in RenderOptions.
  static Result<PointShader> create(const GpuContext& context, const RigRunner& rig, std::span<const float> wraps,
                                    RigStorage storage, std::size_t mostPoints, Effect wrappedDisk = kWrappedDisk);
  std::size_t mostPoints() const;
  bool knowsWraps(std::span<const float> wraps) const;

  /// Irradiance [W/m2] at points with their wraps, by the rig as it is fitted. Returns the device's microseconds; all
  /// is done `repeats` times at once, for who wants the time of few points without that of starting.
  Result<double> shade(const RigRunner& rig, std::span<const PointAndNormal> points, std::span<const float> wraps,
                       std::span<RigRunner::Shaded> out, int repeats = 1);

  /// The last points once more. Returns the device's microseconds.
  Result<double> again();
  /// What it takes to read the last points and write results, without light.
  Result<double> emptyMicroseconds();
  /// What the shader of the last points was specialised to, the first where wraps differ.
  const ShaderVariant& variant() const { return batches_.front().variant; }

 private:
  struct Entry {
    ShaderVariant variant;
    GpuPipeline pipeline;
  };
  /// Points of one wrap: dispatched together.
  struct Batch {
    float wrap = 0;
    std::uint32_t first = 0, count = 0;
    ShaderVariant variant{};
  };

  PointShader(const GpuContext& context, ShadingBuffers buffers, GpuCommands commands, GpuBuffer points,
              GpuBuffer results)
      : context_(&context),
        buffers_(std::move(buffers)),
        commands_(std::move(commands)),
        points_(std::move(points)),
        results_(std::move(results)) {}

  Effects nearKinds(float wrap) const { return nearKindsOf(lightKinds_, wrap, wrappedDisk_); }
  std::optional<Error> warmUp();
  void fillPoints(std::span<const PointAndNormal> points, std::span<const float> wraps);
  std::optional<Error> add(const GpuContext& context, const ShaderVariant& variant);
  void dispatch(const GpuPipeline& pipeline, const Batch& batch);
  Result<double> run(const GpuPipeline* instead);
  const GpuPipeline* pipelineOf(const ShaderVariant& variant) const;

  const GpuContext* context_;
  ShadingBuffers buffers_;
  GpuCommands commands_;
  GpuBuffer points_, results_;
  std::vector<Entry> shelf_;
  std::vector<std::uint32_t> order_;  // of the points in the buffer
  Effects lightKinds_;
  Effect wrappedDisk_ = kWrappedDisk;
  std::vector<float> wraps_;
  int repeats_ = 1;
  ShadingPlace place_;
  std::vector<Batch> batches_;
};

}  // namespace rigel::tools
