// How wrong a rig can be about one light: a conservative bound, cheap enough for every light in every frame.
//
// Error means |E_rig(p, n) - E_sh(p, n)|, both three-band SH irradiance, largest over all unit normals n and over the
// points p served: the box of the pose (or a ball in it), for poly, rbf and @lsq the surface, known by the anchors and
// the extremes of their patches. Constant, gradient, lattice and mixed rigs: theorems (light_field.h, light_bound.cpp),
// with a median of bound/true of 1.0 - 1.9 for point and sphere lights, 1.1 - 2.2 for disks (disk_bound.cpp);
// latticegrad and hermite: theorems too, of the light's curvature. Poly, rbf, @lsq and @gauss: the weights of the rig's
// own operator times Chebyshev coefficients of the light (sample_bound.cpp), 2 - 16, checked rather than proven.
// invquad: for the falloff the rig has when LightBounds is made (Rig::adapt); its weights are bounded by theorem
// (falloff_weights.h), which is loose. What ranks lights need not be tight; what is promised is ProbedBounds'
// (probed_bounds.h). Figures: rigs/README.md.
#pragma once

#include <rigel/light.h>
#include <rigel/rig_light.h>

#include <array>
#include <cstdint>
#include <limits>

namespace rigel {

/// Irradiance [W/m2] per unit of the light's colour (irradiance, intensity or radiance), largest over the points the
/// rig serves and over all normals.
struct LightBound {
  float error = 0;  // of the rig's SH against the SH of the same bands at each point
  float peak = 0;   // of the light's own irradiance; 0 only where it gives the object nothing at all
  /// Distance to the face of a disk light, or less, in radii of the object; infinite for other lights. What passes from
  /// behind to before a face leaps from darkness to all of the light; no rig can follow, and only a light that is
  /// evaluated exactly leaps with it.
  float gap = std::numeric_limits<float>::infinity();
};

namespace detail {

/// What the bounds need of the wrap; light_field.h explains.
struct WrapField {
  double s0 = 0, s1 = 0, s2 = 0;
  double across = 0;
  double lobe = 0;
  double inside = 0;
  double fullSphere = 0;
};

/// What the bounds need of a rig that samples values anywhere: where, how strongly they count, and which polynomials
/// it spans.
struct SamplePlan {
  static constexpr int kMaxSamples = 128;
  static constexpr int kMaxProbes = 3 * kMaxSamples;
  static constexpr int kMaxTerms = 192;
  static constexpr int kMaxDegree = 17;
  struct Sample {
    float x = 0, y = 0, z = 0;
    float footprint = 0;
    float weight = 0;  // largest |weight| at a point served
  };
  /// Error per strength of the field's Chebyshev coefficient of these degrees, or of these and higher ones.
  struct Term {
    std::array<std::uint8_t, 3> degree{};
    float factor = 0;
    bool single = false;
  };
  int samples = 0;
  int terms = 0;
  std::array<Sample, kMaxSamples> sample;
  std::array<Term, kMaxTerms> term;
  int degree = 0;  // largest of the terms
  int probes = 0;
  std::array<std::array<float, 3>, kMaxProbes> probe;  // more points of the surface
  float cover = -1;     // m; no point served is farther from the nearest sample or probe; negative: the box is served
  float footprint = 0;  // largest
};

struct SeenLight;  // what ProbedBounds adds

/// What the bounds need of a rig in a pose.
struct BoundPlan {
  enum class Kind { tensor, ball, samples };
  struct Axis {
    double half = 0;      // of the box
    double node = 0;      // of the box of the rig's own samples
    double spacing = 0;   // of these, where how close a light comes to them must be known better than their box tells
    double first = 0;     // error per largest slope along the axis ...
    double second = 0;    // ... and per largest curvature
    double gradient = 0;  // m that slopes along the axis reach from their samples, where it is modelled by slopes
    double reach = 0;     // the same of an expansion, whose error is gradient * reach / 2 per curvature
    double kink = 0;      // error per jump of the slope along the axis
  };
  Kind kind = Kind::tensor;
  std::array<Axis, 3> axis;
  std::array<double, 3> centre{};
  double radius = 0;             // of a ball about the centre that holds all points served
  double nodeRadius = kNoRange;  // the same of the rig's own samples
  double lebesgue = 1;           // largest sum of |weights| of the samples, slopes apart
  int gradients = 0;             // axes
  double offset = 0;             // error of constant light
  bool numeric = false;          // slopes are secants
  bool constant = false;         // no slope, no lattice: one value
  bool linear = false;           // kind samples: spans linear functions
  bool polynomial = false;       // kind samples: spans polynomials; else what `axis` says
};

}  // namespace detail

/// The bounds of one rig in one pose. Made once a frame and object: 0.2 us, for poly, @lsq and @gauss 7 to 70 us (K 6
/// to 20), for invquad 70 to 550 (the steeper its falloff, the more). A light costs 70 - 160 ns (spot 170 - 310, but 1
/// to 2.5 us where it lights only a part of the object; disk 240 - 310), of poly, @lsq and @gauss 230 - 500 (spot 330 -
/// 600, disk 420 - 490); a projection takes 42 - 66. `rigel bench --filter bound` measures some. Nothing allocates.
/// Results are finite, continuous in the light and in poses that are not exactly flat, and 0 for lights that hold a NaN
/// or are infinitely far.
class LightBounds {
 public:
  /// `wrap` is that of the object's materials (the one with the larger bound where they differ). `radius` [m]: of a
  /// ball about the box's centre that holds the object, where one smaller than the box's own is known.
  LightBounds(const Rig& rig, const RigFrame& worldFromRig, float wrap = 0, float radius = kNoRange) noexcept;

  /// The rig, in the same pose, is elsewhere.
  void place(const RigFrame& worldFromRig) noexcept { worldFromRig_ = worldFromRig; }

  LightBound operator()(const DirectionalLight& light) const noexcept;
  LightBound operator()(const PointLight& light) const noexcept { return of(light, nullptr); }
  LightBound operator()(const SpotLight& light) const noexcept { return of(light, nullptr); }
  LightBound operator()(const SphereLight& light) const noexcept { return of(light, nullptr); }
  LightBound operator()(const DiskLight& light) const noexcept { return of(light, nullptr); }

 private:
  friend class ProbedBounds;
  using Seen = detail::SeenLight;
  LightBound of(const PointLight& light, const Seen* seen) const noexcept;
  LightBound of(const SpotLight& light, const Seen* seen) const noexcept;
  LightBound of(const SphereLight& light, const Seen* seen) const noexcept;
  LightBound of(const DiskLight& light, const Seen* seen) const noexcept;

  RigFrame worldFromRig_;
  detail::WrapField wrap_;
  detail::SamplePlan samples_;  // kind samples; filled by plan_
  detail::BoundPlan plan_;
};

}  // namespace rigel
