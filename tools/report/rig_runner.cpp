#include "report/rig_runner.h"

#include <rigel/glm.h>

#include <chrono>

namespace rigel::tools {
namespace {

using Clock = std::chrono::steady_clock;

/// Microseconds since `from`, which moves on to now.
double lap(Clock::time_point& from) {
  const auto now = Clock::now();
  const double microseconds = std::chrono::duration<double, std::micro>(now - from).count();
  from = now;
  return microseconds;
}

template <int B>
class RunnerOf final : public RigRunner {
 public:
  RunnerOf(Rig rig, const SurfaceSet& surface) : rig_(std::move(rig)) {
    for (int i : rig_.anchors()) anchorPoints_.push_back(surface.candidates[i]);
    anchors_.resize(anchorPoints_.size());
    functionals_.resize(rig_.projections());
    coefficients_.resize(rig_.shVectors());
  }

  FitTimes fit(const SceneObject& object, const PosedObject& posed, const LightSet& lights) override {
    frame_ = rigidFrame(posed.worldFromRig);
    const RigBox box = rigBox(frame_, posed);  // an engine has its bounds already: not part of the rig's time
    FitTimes times;
    auto clock = Clock::now();
    for (std::size_t i = 0; i < anchors_.size(); ++i)
      anchors_[i] = frame_.inversePoint(surfacePosition(object, posed, anchorPoints_[i]));
    rig_.setPose({box, anchors_});
    times.refresh = lap(clock);
    projectSamples<B>(rig_, frame_, lights, functionals_);
    times.project = lap(clock);
    fitRig<B>(rig_, functionals_, coefficients_);
    times.fit = lap(clock);
    return times;
  }

  double shade(std::span<const PointAndNormal> points, std::span<const float> wrap, std::span<Rgb> out) override {
    auto clock = Clock::now();
    std::array<float, B> f = wrapCoefficients<B>(0);
    float fWrap = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (wrap[i] != fWrap) f = wrapCoefficients<B>(fWrap = wrap[i]);
      const Vec3 p = frame_.inversePoint(points[i].position);
      out[i] = irradiance<B>(evaluateRig<B>(rig_, coefficients_, p), f, points[i].normal);
    }
    return lap(clock);
  }

  const Rig& rig() const override { return rig_; }
  std::size_t bytes() const override {
    // As the shaders read them: an SH vector starts on a vec4.
    constexpr std::size_t kVec4 = 4 * sizeof(float);
    return coefficients_.size() * ((sizeof(RadianceSH<B>) + kVec4 - 1) / kVec4 * kVec4);
  }

 private:
  Rig rig_;
  RigFrame frame_;
  std::vector<SurfacePoint> anchorPoints_;
  std::vector<Vec3> anchors_;  // rig frame
  std::vector<RadianceSH<B>> functionals_;
  std::vector<RadianceSH<B>> coefficients_;
};

}  // namespace

Result<std::unique_ptr<RigRunner>> makeRigRunner(const RigSpec& spec, int bands, const SceneObject& object,
                                                 const PosedObject& rest, const SurfaceSet& surface) {
  const RigFrame frame = rigidFrame(rest.worldFromRig);
  std::vector<Vec3> points;
  for (const SurfacePoint& candidate : surface.candidates)
    points.push_back(frame.inversePoint(surfacePosition(object, rest, candidate)));
  auto rig = Rig::create(spec, {rigBox(frame, rest), points});
  if (!rig) return Error{rig.error().line(), "object '" + object.name + "'"};
  return withBands(bands, [&]<int B>() -> std::unique_ptr<RigRunner> {
    return std::make_unique<RunnerOf<B>>(*std::move(rig), surface);
  });
}

}  // namespace rigel::tools
