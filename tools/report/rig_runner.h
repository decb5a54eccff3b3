// One rig of one object through the frames of a run: fitted, evaluated, timed.
#pragma once

#include "report/truth.h"

#include <memory>

namespace rigel::tools {

/// Microseconds of the stages of a fit, one after another on one thread.
struct FitTimes {
  double refresh = 0;  // anchors to the pose, samples and operator
  double project = 0;  // lights into the samples
  double fit = 0;      // c = P F

  double sum() const { return refresh + project + fit; }
};

/// Type-erased over the number of bands. Holds the pose and the lights of its last fit and nothing else that changes.
class RigRunner {
 public:
  virtual ~RigRunner() = default;

  /// Poses and fits the rig. `posed` is in world space.
  virtual FitTimes fit(const SceneObject& object, const PosedObject& posed, const LightSet& lights) = 0;

  /// Unclamped irradiance at points with their wraps. Returns the microseconds it took.
  virtual double shade(std::span<const PointAndNormal> points, std::span<const float> wrap, std::span<Rgb> out) = 0;

  virtual const Rig& rig() const = 0;
  virtual std::size_t bytes() const = 0;  // of the float32 coefficient buffer
};

/// Error from Rig::create.
Result<std::unique_ptr<RigRunner>> makeRigRunner(const RigSpec& spec, int bands, const SceneObject& object,
                                                 const PosedObject& rest, const SurfaceSet& surface);

}  // namespace rigel::tools
