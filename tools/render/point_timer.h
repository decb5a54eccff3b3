// What it takes a device to shade some points with a rig as it is lit.
#pragma once

#include "render/point_shader.h"

namespace rigel::tools {

class PointTimer {
 public:
  /// Few points are shaded `repeats` times at once: less than that is starting alone. The rig's wraps are those of the
  /// points; `out` takes the first result, for who compares it.
  static Result<PointTimer> create(const GpuContext& context, const RigRunner& rig,
                                   std::span<const PointAndNormal> points, std::span<const float> wraps,
                                   RigStorage storage, std::span<RigRunner::Shaded> out, int repeats = 1,
                                   Effect wrappedDisk = kWrappedDisk);

  /// Another state, of this rig or of one made like it; what was timed is forgotten.
  std::optional<Error> set(const RigRunner& rig, std::span<const PointAndNormal> points, std::span<const float> wraps,
                           std::span<RigRunner::Shaded> out);

  /// Times it once more, beside a shader that reads points and writes results without light.
  std::optional<Error> repeat();

  /// us for all points, net of the shader without light: of minima, since other load only adds.
  double microseconds() const;

  const PointShader& shader() const { return *shader_; }

 private:
  std::unique_ptr<PointShader> shader_;
  int repeats_ = 1;
  double lit_ = 0, empty_ = 0;  // least so far
};

}  // namespace rigel::tools
