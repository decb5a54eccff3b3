// Irradiance rigs: the one linear interface of all models.
//
// A rig is S sample functionals (the SH value, or its derivative along a direction, at a position), a K x S operator P
// and K basis functions of position. Per frame c_k = sum_s P_ks F_s (K SH vectors); per point L(p) = sum_k phi_k(p)
// c_k. Everything here is in the rig frame [m]; SH stay in world axes. After "Irradiance Rigs" (Yuan, Nowrouzezahrai,
// Sloan 2010), rbf, latticegrad and hermite being what they tried and dropped; @gauss, poly, invquad and least squares
// are ours.
#pragma once

#include <rigel/rig_spec.h>
#include <rigel/vec3.h>
#include <rigel/vec3_rows.h>

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace rigel {

/// Axis-aligned box in the rig frame; lo <= hi in every axis (flat boxes are fine).
struct RigBox {
  Vec3 lo, hi;
};

/// What a rig needs to know of its object, in the rest pose.
struct RigShape {
  RigBox box;
  std::span<const Vec3> surface;  // points spread evenly over the surface's area; several hundred are plenty
  bool tightBounds = false;       // ProbedBounds will be asked: creation takes 0.4 ms more for 600 points, 3 for 4096
};

/// The object in a frame's pose: its box, and where the surface points named by Rig::anchors() are now, in that order.
struct RigPose {
  RigBox box;
  std::span<const Vec3> anchors;
};

/// A position at which light is projected. Yields 1 + derivatives functionals, in this order: the SH value, then its
/// derivative along each direction (not unit: the derivative scales with its length).
struct RigSample {
  Vec3 position;
  int derivatives = 0;
  std::array<Vec3, 3> directions{};
  float footprint = 0;  // m; radius of the patch of surface that the position stands for (project.h), 0 for a point
  float share = 0;      // of the surface's area that the position stands for; least squares only, there they sum to 1
};

/// The basis functions that are not zero at a point.
struct RigBasis {
  static constexpr int kCapacity = 64;
  int count = 0;
  std::array<int, kCapacity> index;    // k
  std::array<float, kCapacity> value;  // phi_k(p)
};

/// One object's rig. Built once (allocates); `setPose` is called each frame and allocates nothing. Not thread safe
/// while setPose runs; otherwise any number of readers.
class Rig {
 public:
  /// A rig in its rest pose. Error when the spec is out of its limits (checkRigSpec) or the shape cannot carry it (no
  /// or non-finite surface points, box turned inside out). Anchors are the better of two placements for simulated
  /// lights, which takes 2 ms (`poly:6`) to 60 ms (`poly:56`) for a thousand surface points.
  static Result<Rig> create(const RigSpec& spec, const RigShape& rest);

  Rig(Rig&&) noexcept;
  Rig& operator=(Rig&&) noexcept;
  ~Rig();

  const RigSpec& spec() const noexcept;
  int shVectors() const noexcept;    // K
  int projections() const noexcept;  // S: functionals, so value + gradient counts 4

  /// Indices into RigShape::surface of the points that setPose wants posed; empty for @corners, @numeric and @gauss.
  std::span<const int> anchors() const noexcept;

  /// Moves samples, operator and basis to a pose. Continuous in the pose. Allocates nothing.
  void setPose(const RigPose& pose) noexcept;

  /// The current pose's box, and what each of its axes x, y, z is modelled with (tensor rigs).
  const RigBox& box() const noexcept;
  const std::array<AxisModel, 3>& axes() const noexcept;

  /// Positions of the current pose.
  std::span<const RigSample> samples() const noexcept;

  /// Makes the falloff of an `invquad` rig that of this light: P and phi_k change with it, and the rig is linear again
  /// until the next call. setPose takes the falloff back to 1. For every other rig does nothing. `functionals` as in
  /// `fit`; the first three of a row (L_00 in RGB) are what counts. Continuous in functionals and pose; allocates
  /// nothing. Not thread safe, like setPose.
  void adapt(std::span<const float> functionals, int width) noexcept;

  /// c = P F. `functionals` holds S rows of `width` floats (in the order of samples()), `coefficients` K such rows; the
  /// two must not overlap.
  void fit(std::span<const float> functionals, int width, std::span<float> coefficients) const noexcept;

  /// phi_k(p). Lattice axes and rbf clamp p to the box; gradient and poly extrapolate. A NaN counts as the box's
  /// centre.
  void basis(Vec3 p, RigBasis& out) const noexcept;

  /// The first `count` of them, kMaxBasisBatch at most, at as many points at most: row k of `values` is phi_k at all.
  static constexpr std::size_t kMaxBasisBatch = 64;
  void basisBatch(const Vec3Rows& points, int count, std::span<float> values) const noexcept;

  /// Condition number of the current least-squares problem (2-norm, estimated within a factor of a few, columns of unit
  /// length); 1 where nothing is solved. Up to about 100 the anchors determine the coefficients well; at kLostRank some
  /// basis functions cannot be told apart on this surface and are held small instead.
  static constexpr double kLostRank = 300;
  double condition() const noexcept;

  class Model;  // internal

 private:
  class TensorModel;
  class PolyModel;
  class RbfModel;
  class SlopeGridModel;
  friend class SamplePlanner;  // light_bound.h reads the operator
  friend class ProbedBounds;   // probed_bounds.h the probes
  friend class GpuRigReader;   // gpu_rig.h the monomials and nodes
  explicit Rig(std::unique_ptr<Model> model) noexcept;
  std::unique_ptr<Model> model_;
};

}  // namespace rigel
