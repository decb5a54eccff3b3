#include "render/point_timer.h"

#include <algorithm>
#include <limits>

namespace rigel::tools {

Result<PointTimer> PointTimer::create(const GpuContext& context, const RigRunner& rig,
                                      std::span<const PointAndNormal> points, std::span<const float> wraps,
                                      RigStorage storage, std::span<RigRunner::Shaded> out, int repeats,
                                      Effect wrappedDisk) {
  std::vector<float> different(wraps.begin(), wraps.end());
  std::ranges::sort(different);
  different.erase(std::unique(different.begin(), different.end()), different.end());
  auto shader = PointShader::create(context, rig, different, storage, points.size(), wrappedDisk);
  if (!shader) return shader.error();
  PointTimer timer;
  timer.shader_ = std::make_unique<PointShader>(*std::move(shader));
  timer.repeats_ = repeats;
  if (auto error = timer.set(rig, points, wraps, out)) return *error;
  return timer;
}

std::optional<Error> PointTimer::set(const RigRunner& rig, std::span<const PointAndNormal> points,
                                     std::span<const float> wraps, std::span<RigRunner::Shaded> out) {
  lit_ = empty_ = std::numeric_limits<double>::infinity();
  if (const auto first = shader_->shade(rig, points, wraps, out, repeats_); !first) return first.error();
  if (const auto first = shader_->emptyMicroseconds(); !first) return first.error();
  return std::nullopt;
}

std::optional<Error> PointTimer::repeat() {
  const auto lit = shader_->again();
  if (!lit) return lit.error();
  const auto empty = shader_->emptyMicroseconds();
  if (!empty) return empty.error();
  lit_ = std::min(lit_, *lit);
  empty_ = std::min(empty_, *empty);
  return std::nullopt;
}

double PointTimer::microseconds() const { return std::max(0.0, lit_ - empty_) / repeats_; }

}  // namespace rigel::tools
