#include "render/gpu_shading.h"

#include "render/point_shader.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace rigel::tools {
namespace {

// Few points take no longer than starting does: they are shaded over and over, this many in all.
constexpr std::size_t kTimedPoints = 65536;
constexpr int kEmptyRuns = 5;

/// A PointShader that grows.
class GrowingShader {
 public:
  GrowingShader(const GpuContext& context, RigStorage storage) : context_(&context), storage_(storage) {}

  double shade(const RigRunner& rig, std::span<const PointAndNormal> points, std::span<const float> wraps,
               std::span<RigRunner::Shaded> out, bool timed) {
    if (points.empty()) return 0;
    if (!shader_ || shader_->mostPoints() < points.size() || !shader_->knowsWraps(wraps)) make(rig, points, wraps);
    const int repeats = timed ? static_cast<int>(std::max<std::size_t>(1, kTimedPoints / points.size())) : 1;
    const double lit = valueOf(shader_->shade(rig, points, wraps, out, repeats));
    if (!timed) return 0;
    if (emptyPoints_ != points.size()) {
      emptyPoints_ = points.size();
      empty_ = std::numeric_limits<double>::infinity();
      for (int i = 0; i < kEmptyRuns; ++i) empty_ = std::min(empty_, valueOf(shader_->emptyMicroseconds()));
    }
    return std::max(0.0, lit - empty_) / repeats;
  }

 private:
  static double valueOf(const Result<double>& microseconds) {
    if (!microseconds) throw std::runtime_error(microseconds.error().line());
    return *microseconds;
  }

  void make(const RigRunner& rig, std::span<const PointAndNormal> points, std::span<const float> wraps) {
    for (const float wrap : wraps)
      if (std::ranges::find(wraps_, wrap) == wraps_.end()) wraps_.push_back(wrap);
    const std::size_t most = std::max(points.size(), shader_ ? shader_->mostPoints() : 0);
    auto shader = PointShader::create(*context_, rig, wraps_, storage_, most);
    if (!shader) throw std::runtime_error(shader.error().line());
    shader_ = *std::move(shader);
  }

  const GpuContext* context_;
  RigStorage storage_;
  std::vector<float> wraps_;
  std::optional<PointShader> shader_;
  std::size_t emptyPoints_ = 0;  // at how many points empty_ was taken
  double empty_ = 0;             // us, of reading points and writing results
};

class GpuShading final : public PointShading {
 public:
  explicit GpuShading(const GpuContext& context)
      : whole_(context, RigStorage::float32), half_(context, RigStorage::float16) {}

  double shade(const RigRunner& rig, std::span<const PointAndNormal> points, std::span<const float> wrap,
               std::span<RigRunner::Shaded> out) override {
    return whole_.shade(rig, points, wrap, out, true);
  }
  void shadeHalf(const RigRunner& rig, std::span<const PointAndNormal> points, std::span<const float> wrap,
                 std::span<RigRunner::Shaded> out) override {
    half_.shade(rig, points, wrap, out, false);
  }

 private:
  GrowingShader whole_, half_;
};

}  // namespace

std::unique_ptr<PointShading> makeGpuShading(const GpuContext& context) {
  return std::make_unique<GpuShading>(context);
}

}  // namespace rigel::tools
