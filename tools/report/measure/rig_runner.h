// One rig of one object through the frames of a run: lit, evaluated, timed.
#pragma once

#include "report/measure/truth.h"

#include <rigel/effects.h>
#include <rigel/gpu_rig.h>
#include <rigel/light_budget.h>

#include <memory>

namespace rigel::tools {

/// Microseconds of a frame's stages, one after another on one thread; empty for those that did not run.
struct FitTimes {
  enum Stage { kRefresh, kBound, kChoose, kProject, kFit, kEstimate, kStages };
  static constexpr const char* kNames[kStages] = {"refresh", "bound", "choose", "project", "fit", "estimate"};

  std::array<std::optional<double>, kStages> stages;
};

/// Of what a game would do: estimates, and the bounds of a rig that leaves no light to exact evaluation, are made for
/// the report alone.
double fitMicroseconds(const FitTimes& times, const LightingOptions& asked);

class PointShading;

/// Type-erased over the number of bands. Near lights fade with the frames it is shown (reset, fit).
class RigRunner {
 public:
  virtual ~RigRunner() = default;

  /// What errors are relative to [W/m2]; 0 leaves it to each frame.
  virtual void setReference(float irradiance) = 0;

  /// The next frame does not follow on the last: nothing fades.
  virtual void reset() = 0;

  /// `posed` is in world space. The frame's times start anew.
  virtual void pose(const SceneObject& object, const PosedObject& posed) = 0;

  /// Lights the posed rig, `seconds` after the last time.
  virtual void light(const LightSet& lights, float seconds) = 0;

  /// The same in two steps, as ObjectLighting has them, for rigs that choose and share a frame's time.
  virtual void weigh(const LightSet& lights, float seconds) = 0;
  virtual float costAt(float target) const = 0;
  virtual float lateNanoseconds() const = 0;
  virtual void settle(const LightSet& lights, float target, float seconds) = 0;

  FitTimes fit(const SceneObject& object, const PosedObject& posed, const LightSet& lights, float seconds) {
    pose(object, posed);
    light(lights, seconds);
    return times();
  }
  virtual const FitTimes& times() const = 0;  // since pose()

  /// Irradiance of a point; the rig's part is not clamped.
  struct Shaded {
    Rgb rig, near;
    Rgb clamped() const { return Rgb{std::max(0.0f, rig.r), std::max(0.0f, rig.g), std::max(0.0f, rig.b)} + near; }
  };

  /// At points with their wraps. Returns the microseconds it took.
  virtual double shade(std::span<const PointAndNormal> points, std::span<const float> wrap, std::span<Shaded> out) = 0;

  /// Leaves evaluation to another: `shade` is then its, as is what a device reports.
  virtual void setShading(std::unique_ptr<PointShading> shading) = 0;
  /// As `shade`, with coefficients in half floats; false where nobody has them.
  virtual bool shadeHalf(std::span<const PointAndNormal> points, std::span<const float> wrap,
                         std::span<Shaded> out) = 0;

  /// As the CPU's `shade` without near lights, with coefficients rounded to half floats as gpu_rig.h stores them.
  virtual void shadeRounded(std::span<const PointAndNormal> points, std::span<const float> wrap,
                            std::span<Rgb> out) const = 0;

  /// As the CPU's `shade` without near lights and high band, with the rig's arithmetic in double (double_rig.h): of the
  /// lights it was last lit by.
  virtual void shadeInDouble(const LightSet& lights, std::span<const PointAndNormal> points,
                             std::span<const float> wrap, std::span<RgbD> out) const = 0;

  /// The part of Shaded::rig that lies beyond the rig's bands: no part of its spatial error.
  virtual bool hasHighBand() const = 0;
  virtual Rgb highBand(Vec3 normal, float wrap) const = 0;

  // Of the last frame.
  virtual int shVectors() const = 0;
  virtual std::size_t bytes() const = 0;                       // of their float32 buffer
  virtual std::span<const LightVerdict> verdicts() const = 0;  // in the order of the lights
  /// The same with the bounds that the fitted rig can promise (ProbedBounds), where verdicts have bounds to choose by.
  virtual std::vector<LightVerdict> promises(const LightSet& lights) const = 0;
  virtual std::optional<float> spatialEstimate() const = 0;
  virtual std::optional<float> totalEstimate() const = 0;
  virtual float modelledNanoseconds() const = 0;   // a point
  virtual float modelledMicroseconds() const = 0;  // all points shaded in a frame

  virtual const Rig& rig() const = 0;
  virtual const LightingOptions& asked() const = 0;  // as it was made

  // Of the last frame, as shaders read it (gpu_rig.h, near_light.h).
  virtual int bands() const = 0;
  virtual GpuRig pack(const GpuRigPlace& place, std::span<GpuVec4> buffer) const = 0;
  virtual GpuRig pack(const GpuRigPlace& place, std::span<GpuHalf4> buffer) const = 0;
  virtual GpuRig packTexture(std::span<GpuVec4> texels) const = 0;
  virtual GpuRig packTexture(std::span<GpuHalf4> texels) const = 0;
  virtual const HighBand& highBandVector() const = 0;
  virtual std::span<const NearLight> nearLights() const = 0;
  virtual Effects effects(float wrap) const = 0;
  virtual Effects lightKinds() const = 0;  // of the lights last fitted to
};

/// Who evaluates a fitted rig and its near lights at points, in the CPU's place.
class PointShading {
 public:
  virtual ~PointShading() = default;
  /// As RigRunner::shade and shadeHalf. What goes wrong with a device is thrown, as std::runtime_error.
  virtual double shade(const RigRunner& rig, std::span<const PointAndNormal> points, std::span<const float> wrap,
                       std::span<RigRunner::Shaded> out) = 0;
  virtual void shadeHalf(const RigRunner& rig, std::span<const PointAndNormal> points, std::span<const float> wrap,
                         std::span<RigRunner::Shaded> out) = 0;
};

/// Error from ObjectLighting::create. `promising`: its promises are to be tight (RigShape::tightBounds).
Result<std::unique_ptr<RigRunner>> makeRigRunner(const RigSpec& spec, const LightingOptions& asked, int bands,
                                                 const SceneObject& object, const PosedObject& rest,
                                                 const SurfaceSet& surface, bool promising = false);

/// Lights rigs that choose and are posed, within `microseconds` of modelled time together, as nearly as it allows to
/// the errors that they want. `shares`: one a rig, filled here; errors of all count alike.
void lightWithin(float microseconds, std::span<RigRunner* const> rigs, const LightSet& lights, float seconds,
                 std::span<BudgetShare> shares);

}  // namespace rigel::tools
