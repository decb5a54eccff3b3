#include "report/measure/rig_runner.h"

#include "report/measure/double_rig.h"
#include "report/measure/half_coefficients.h"

#include <rigel/glm.h>
#include <rigel/probed_bounds.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace rigel::tools {
namespace {

/// Laps of a frame: the library says when a stage has ended, the clock is ours.
class StageClock {
 public:
  explicit StageClock(FitTimes& times) : times_(times) {}

  LightingProbe probe() {
    return {[](void* clock, LightingStage stage) { static_cast<StageClock*>(clock)->ended(stageOf(stage)); }, this};
  }

  void ended(FitTimes::Stage stage) {
    const auto now = Clock::now();
    auto& time = times_.stages[stage];
    time = time.value_or(0) + std::chrono::duration<double, std::micro>(now - last_).count();
    last_ = now;
  }

 private:
  using Clock = std::chrono::steady_clock;

  static FitTimes::Stage stageOf(LightingStage stage) {
    switch (stage) {
      case LightingStage::bound:
        return FitTimes::kBound;
      case LightingStage::choose:
        return FitTimes::kChoose;
      case LightingStage::project:
        return FitTimes::kProject;
      case LightingStage::fit:
        return FitTimes::kFit;
      case LightingStage::estimate:
        break;
    }
    return FitTimes::kEstimate;
  }

  FitTimes& times_;
  Clock::time_point last_ = Clock::now();
};

template <int B>
class RunnerOf final : public RigRunner {
 public:
  RunnerOf(ObjectLighting<B> lighting, const LightingOptions& asked, const SurfaceSet& surface)
      : lighting_(std::move(lighting)), asked_(asked) {
    for (int i : lighting_.anchors()) anchorPoints_.push_back(surface.candidates[i]);
    anchors_.resize(anchorPoints_.size());
  }

  void setReference(float irradiance) override { lighting_.options().reference = irradiance; }
  void reset() override { lighting_.reset(); }

  void pose(const SceneObject& object, const PosedObject& posed) override {
    const RigFrame frame = rigidFrame(posed.worldFromRig);
    const RigBox box = rigBox(frame, posed);  // an engine has its bounds already: not part of the rig's time
    times_ = {};
    StageClock clock(times_);
    const auto poseAnchors = [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i)
        anchors_[i] = frame.inversePoint(surfacePosition(object, posed, anchorPoints_[i]));
    };
    // The rig's own come first; the others are where its error is estimated.
    const std::size_t own = lighting_.rig().anchors().size();
    if (own < anchors_.size()) {
      poseAnchors(own, anchors_.size());
      clock.ended(FitTimes::kEstimate);
    }
    poseAnchors(0, own);
    lighting_.setPose({box, anchors_}, frame);
    frame_ = frame;
    clock.ended(FitTimes::kRefresh);
  }

  void light(const LightSet& lights, float seconds) override {
    lightKinds_ = lightEffects(lights);
    StageClock clock(times_);
    lighting_.light(lights, seconds, {}, clock.probe());
  }
  void weigh(const LightSet& lights, float seconds) override {
    StageClock clock(times_);
    lighting_.weigh(lights, seconds, {}, clock.probe());
    clock.ended(FitTimes::kChoose);
  }
  float costAt(float target) const override { return lighting_.costAt(target); }
  float lateNanoseconds() const override { return lighting_.lateNanoseconds(); }
  void settle(const LightSet& lights, float target, float seconds) override {
    lightKinds_ = lightEffects(lights);
    StageClock clock(times_);
    lighting_.settle(lights, target, seconds, {}, clock.probe());
  }
  const FitTimes& times() const override { return times_; }

  double shade(std::span<const PointAndNormal> points, std::span<const float> wrap, std::span<Shaded> out) override {
    if (shading_ != nullptr) return shading_->shade(*this, points, wrap, out);
    const auto start = std::chrono::steady_clock::now();
    MaterialWrap<B> material;
    float materialWrap = 0;
    for (std::size_t first = 0, last = 0; first < points.size(); first = last) {
      if (wrap[first] != materialWrap) material = MaterialWrap<B>(materialWrap = wrap[first]);
      const std::size_t end = std::min(points.size(), first + kRun);
      do ++last;
      while (last < end && wrap[last] == wrap[first]);
      shadeRun(points.subspan(first, last - first), material, out.subspan(first));
    }
    return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
  }

  void setShading(std::unique_ptr<PointShading> shading) override { shading_ = std::move(shading); }
  bool shadeHalf(std::span<const PointAndNormal> points, std::span<const float> wrap, std::span<Shaded> out) override {
    if (shading_ != nullptr) shading_->shadeHalf(*this, points, wrap, out);
    return shading_ != nullptr;
  }

  void shadeRounded(std::span<const PointAndNormal> points, std::span<const float> wrap,
                    std::span<Rgb> out) const override {
    const HalfCoefficients<B> rounded(lighting_.rig(), frame_, lighting_.coefficients(), lighting_.highBand());
    for (std::size_t i = 0; i < points.size(); ++i)
      out[i] = rounded.shade(points[i].position, points[i].normal, wrap[i]);
  }

  void shadeInDouble(const LightSet& lights, std::span<const PointAndNormal> points, std::span<const float> wrap,
                     std::span<RgbD> out) const override {
    const Rig& own = lighting_.rig();
    const auto rig = own.spec().adaptive ? DoubleRig<B>::widened(own, frame_, lighting_.coefficients())
                                         : DoubleRig<B>::fitted(own, frame_, lights, lighting_.verdicts());
    forSamples(points.size(),
               [&](std::size_t i) { out[i] = rig.shade(points[i].position, points[i].normal, wrap[i]); });
  }

  bool hasHighBand() const override { return lighting_.highBand().band >= B; }
  Rgb highBand(Vec3 normal, float wrap) const override {
    return highBandIrradiance(lighting_.highBand(), normal, wrap);
  }

  int shVectors() const override { return static_cast<int>(lighting_.coefficients().size()); }
  std::size_t bytes() const override {
    // As the shaders read them: an SH vector starts on a vec4.
    constexpr std::size_t kVec4 = 4 * sizeof(float);
    return lighting_.coefficients().size() * ((sizeof(RadianceSH<B>) + kVec4 - 1) / kVec4 * kVec4);
  }
  std::span<const LightVerdict> verdicts() const override { return lighting_.verdicts(); }
  std::vector<LightVerdict> promises(const LightSet& lights) const override {
    std::vector<LightVerdict> out(verdicts().begin(), verdicts().end());
    if (std::ranges::all_of(out, [](const LightVerdict& verdict) { return !(verdict.bound > 0); })) return out;
    ProbedBounds bounds(lighting_.rig(), frame_, asked_.wrap);
    for (std::size_t i = 0; i < out.size(); ++i) {
      if (!(out[i].bound > 0)) continue;
      lights.visit(static_cast<int>(i), [&](const auto& light) {
        const Rgb c = colourOf(light);
        const float promised = bounds(light).error * std::sqrt((c.r * c.r + c.g * c.g + c.b * c.b) / 3);
        out[i].bound = std::min(promised, std::numeric_limits<float>::max());
      });
    }
    return out;
  }
  std::optional<float> spatialEstimate() const override { return lighting_.spatialEstimate(); }
  std::optional<float> totalEstimate() const override { return lighting_.totalEstimate(); }
  float modelledNanoseconds() const override { return lighting_.modelledNanoseconds(); }
  float modelledMicroseconds() const override {
    return modelledNanoseconds() * static_cast<float>(asked_.points) / 1000;
  }
  const Rig& rig() const override { return lighting_.rig(); }
  const LightingOptions& asked() const override { return asked_; }

  int bands() const override { return B; }
  GpuRig pack(const GpuRigPlace& place, std::span<GpuVec4> buffer) const override { return packInto(place, buffer); }
  GpuRig pack(const GpuRigPlace& place, std::span<GpuHalf4> buffer) const override { return packInto(place, buffer); }
  GpuRig packTexture(std::span<GpuVec4> texels) const override { return packTexels(texels); }
  GpuRig packTexture(std::span<GpuHalf4> texels) const override { return packTexels(texels); }
  const HighBand& highBandVector() const override { return lighting_.highBand(); }
  std::span<const NearLight> nearLights() const override { return lighting_.nearLights(); }
  Effects effects(float wrap) const override { return frameEffects(lighting_, wrap); }
  Effects lightKinds() const override { return lightKinds_; }

 private:
  template <class Vec4>
  GpuRig packInto(const GpuRigPlace& place, std::span<Vec4> buffer) const {
    return packRig<B>(lighting_.rig(), frame_, lighting_.coefficients(), lighting_.highBand(), place, buffer);
  }
  template <class Vec4>
  GpuRig packTexels(std::span<Vec4> texels) const {
    return rigel::packTexture<B>(lighting_.rig(), frame_, lighting_.coefficients(), texels);
  }

  /// At most kRun points of one material.
  void shadeRun(std::span<const PointAndNormal> points, const MaterialWrap<B>& material, std::span<Shaded> out) const {
    float rows[6][kRun];
    typename ObjectLighting<B>::Parts parts[kRun];
    for (std::size_t i = 0; i < points.size(); ++i)
      for (int axis = 0; axis < 3; ++axis) {
        rows[axis][i] = points[i].position[axis];
        rows[3 + axis][i] = points[i].normal[axis];
      }
    const auto rowsFrom = [&](int first) -> Vec3Rows {
      return {{rows[first], points.size()}, {rows[first + 1], points.size()}, {rows[first + 2], points.size()}};
    };
    lighting_.shade(rowsFrom(0), rowsFrom(3), material, std::span(parts).first(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i) out[i] = {parts[i].rig, parts[i].nearLights};
  }

  static constexpr std::size_t kRun = 256;

  ObjectLighting<B> lighting_;
  RigFrame frame_;
  Effects lightKinds_;
  std::unique_ptr<PointShading> shading_;  // null: the CPU itself
  LightingOptions asked_;
  FitTimes times_;
  std::vector<SurfacePoint> anchorPoints_;
  std::vector<Vec3> anchors_;  // rig frame
};

}  // namespace

double fitMicroseconds(const FitTimes& times, const LightingOptions& asked) {
  double sum = 0;
  for (std::size_t stage = 0; stage < FitTimes::kStages; ++stage) {
    const bool bounds = asked.slots() > 0 || asked.target.kind != LightingTarget::Kind::none;
    const bool counts = stage != FitTimes::kEstimate && (stage != FitTimes::kBound || bounds);
    if (counts) sum += times.stages[stage].value_or(0);
  }
  return sum;
}

Result<std::unique_ptr<RigRunner>> makeRigRunner(const RigSpec& spec, const LightingOptions& asked, int bands,
                                                 const SceneObject& object, const PosedObject& rest,
                                                 const SurfaceSet& surface, bool promising) {
  const RigFrame frame = rigidFrame(rest.worldFromRig);
  std::vector<Vec3> points;
  for (const SurfacePoint& candidate : surface.candidates)
    points.push_back(frame.inversePoint(surfacePosition(object, rest, candidate)));
  return withBands(bands, [&]<int B>() -> Result<std::unique_ptr<RigRunner>> {
    auto lighting = ObjectLighting<B>::create(spec, {rigBox(frame, rest), points, promising}, asked);
    if (!lighting) return Error{lighting.error().line(), "object '" + object.name + "'"};
    return std::unique_ptr<RigRunner>(std::make_unique<RunnerOf<B>>(*std::move(lighting), asked, surface));
  });
}

void lightWithin(float microseconds, std::span<RigRunner* const> rigs, const LightSet& lights, float seconds,
                 std::span<BudgetShare> shares) {
  for (std::size_t i = 0; i < rigs.size(); ++i) {
    rigs[i]->weigh(lights, seconds);
    shares[i].wanted = rigs[i]->asked().target.value;
    shares[i].points = static_cast<float>(rigs[i]->asked().points);
    shares[i].late = rigs[i]->lateNanoseconds() * shares[i].points / 1000;
  }
  const auto costAt = [](void* all, std::size_t i, float target) {
    return (*static_cast<std::span<RigRunner* const>*>(all))[i]->costAt(target);
  };
  spreadBudget(shares, {costAt, &rigs}, microseconds);
  for (std::size_t i = 0; i < rigs.size(); ++i) rigs[i]->settle(lights, shares[i].granted, seconds);
}

}  // namespace rigel::tools
