// An object that drives past lamps: what it is lit with when some of the lamps are near lights, against exact
// irradiance, frame by frame.
#pragma once

#include <rigel/exact.h>
#include <rigel/near_far.h>

#include <algorithm>
#include <functional>

#include "lamp_row.h"
#include "rig_fixture.h"

namespace rigel::test {

/// The weight of each light from its error and the seconds since the last frame.
using WeightPolicy = std::function<std::vector<float>(std::span<const float> errors, float seconds)>;

struct MotionResult {
  double maxJump = 0;  // largest change of the error between two frames, over points; relative to mean exact irradiance
  double rms = 0;      // of the error, relative to the same
  double nearLights = 0;  // lights with a weight, mean over frames
};

class LampRow {
 public:
  explicit LampRow(const std::string& spec) : rig_(rigOf(spec, surface_)) {
    for (int i : rig_.anchors()) anchors_.push_back(surface_[i]);
    rig_.setPose({boxOf(surface_), anchors_});
    functionals_.resize(rig_.projections());
    coefficients_.resize(rig_.shVectors());
  }

  /// Drives `seconds` at 8 m/s in frames of 1/rate.
  MotionResult drive(const WeightPolicy& policy, double rate, double seconds = 0.75) {
    MotionResult result;
    std::vector<double> last, now;
    double squares = 0, exactSum = 0;
    long count = 0;
    const int frames = static_cast<int>(seconds * rate);
    for (int i = 0; i <= frames; ++i) {
      light({static_cast<float>(-2 + 8 * i / rate), 0, 0}, policy, static_cast<float>(1 / rate));
      result.nearLights += static_cast<double>(near_.size()) / (frames + 1);
      errorsAtSurface(now, exactSum);
      for (std::size_t k = 0; k < now.size(); ++k) {
        squares += now[k] * now[k];
        ++count;
        if (!last.empty()) result.maxJump = std::max(result.maxJump, std::abs(now[k] - last[k]));
      }
      last.swap(now);
    }
    const double mean = exactSum / static_cast<double>(count);
    result.maxJump /= mean;
    result.rms = std::sqrt(squares / static_cast<double>(count)) / mean;
    return result;
  }

 private:
  /// Fits the rig and fills near_ for the object at `origin`.
  void light(Vec3 origin, const WeightPolicy& policy, float seconds) {
    frame_.origin = origin;
    std::vector<float> errors;
    for (int i = 0; i < lamps_.size(); ++i) errors.push_back(errorOf(lamps_.sphere(i)));
    splitLights(lamps_, policy(errors, seconds), far_, near_);
    projectSamples<3>(rig_, frame_, far_, functionals_);
    fitRig<3>(rig_, functionals_, coefficients_);
  }

  /// A light's peak on the object's bounding box, less the farther away it is: what a rig of few coefficients gets
  /// wrong, roughly.
  float errorOf(const SphereLight& lamp) const {
    const RigBox box = boxOf(surface_);
    const Vec3 p = frame_.inversePoint(lamp.position);
    Vec3 closest;
    for (int a = 0; a < 3; ++a) closest[a] = std::clamp(p[a], box.lo[a], box.hi[a]);
    const float e = length(p - closest) + 0.3f;
    return lamp.radiance.g * (lamp.radius / e) * (lamp.radius / e) / (e * e);
  }

  void errorsAtSurface(std::vector<double>& errors, double& exactSum) const {
    const auto f = wrapCoefficients<3>(0);
    errors.clear();
    for (Vec3 p : surface_) {
      const Vec3 n = normalAt(p);
      const Vec3 world = frame_.point(p);
      double e = irradiance<3>(evaluateRig<3>(rig_, coefficients_, p), f, n).g;
      for (const NearLight& light : near_) e += nearIrradiance(light, world, n).g;
      const double exact = exactIrradiance(lamps_, world, n).g;
      exactSum += exact;
      errors.push_back(e - exact);
    }
  }

  static Vec3 normalAt(Vec3 p) {
    const Vec3 slope{p.x / (kHalf.x * kHalf.x), p.y / (kHalf.y * kHalf.y), p.z / (kHalf.z * kHalf.z)};
    return slope * (1 / length(slope));
  }

  static constexpr Vec3 kHalf{1.5f, 0.6f, 0.7f};
  std::vector<Vec3> surface_ = ellipsoid({}, kHalf, 120);
  Rig rig_;
  std::vector<Vec3> anchors_;
  RigFrame frame_;
  LightSet lamps_ = lampRow(), far_;
  std::vector<NearLight> near_;
  std::vector<RadianceSH<3>> functionals_, coefficients_;
};

}  // namespace rigel::test
