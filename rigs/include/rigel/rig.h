// Irradiance rigs: the one linear interface of all models.
//
// A rig is S sample functionals (the SH value, or its derivative along a direction, at a position), a K x S operator P
// and K basis functions of position. Per frame c_k = sum_s P_ks F_s (K SH vectors); per point L(p) = sum_k phi_k(p)
// c_k. Everything here is in the rig frame [m]; SH stay in world axes. After "Irradiance Rigs" (Yuan, Nowrouzezahrai,
// Sloan 2010); poly and least squares are ours.
#pragma once

#include <rigel/rig_spec.h>
#include <rigel/vec3.h>

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
  /// A rig in its rest pose. Error when the shape cannot carry the model (no or non-finite surface points, box turned inside out).
  static Result<Rig> create(const RigSpec& spec, const RigShape& rest);

  Rig(Rig&&) noexcept;
  Rig& operator=(Rig&&) noexcept;
  ~Rig();

  const RigSpec& spec() const noexcept;
  int shVectors() const noexcept;    // K
  int projections() const noexcept;  // S: functionals, so value + gradient counts 4

  /// Indices into RigShape::surface of the points that setPose wants posed; empty for @corners and @numeric.
  std::span<const int> anchors() const noexcept;

  /// Moves samples, operator and basis to a pose. Continuous in the pose. Allocates nothing.
  void setPose(const RigPose& pose) noexcept;

  /// Positions of the current pose.
  std::span<const RigSample> samples() const noexcept;

  /// c = P F. `functionals` holds S rows of `width` floats (in the order of samples()), `coefficients` K such rows.
  void fit(std::span<const float> functionals, int width, std::span<float> coefficients) const noexcept;

  /// phi_k(p). Lattice axes clamp p to the box; gradient and poly extrapolate.
  void basis(Vec3 p, RigBasis& out) const noexcept;

  /// Condition number of the current least-squares problem (2-norm, estimated); 1 where nothing is solved.
  double condition() const noexcept;

  class Model;  // internal

 private:
  class TensorModel;
  class PolyModel;
  explicit Rig(std::unique_ptr<Model> model) noexcept;
  std::unique_ptr<Model> model_;
};

}  // namespace rigel
