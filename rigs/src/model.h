// What every rig model implements. Models keep their samples and operator here; the operator is a sparse row per SH
// vector, so that a lattice (one sample each) and a least-squares fit (all samples each) are the same thing.
#pragma once

#include <rigel/rig.h>

#include "anchors.h"
#include "surface_probes.h"

namespace rigel {

/// P, row k: entries [rowStart[k], rowStart[k+1]) of column and weight. Built once with its final sparsity; setPose
/// changes weights only.
struct SparseOperator {
  std::vector<int> rowStart{0};
  std::vector<int> column;
  std::vector<float> weight;

  void addEntry(int functional, float value) {
    column.push_back(functional);
    weight.push_back(value);
  }
  void endRow() { rowStart.push_back(static_cast<int>(column.size())); }
  int rows() const noexcept { return static_cast<int>(rowStart.size()) - 1; }

  /// `coefficients` (rows x width) = P `functionals` (columns x width); not overlapping.
  void apply(std::span<const float> functionals, int width, std::span<float> coefficients) const noexcept;
};

class Rig::Model {
 public:
  explicit Model(RigSpec s) : spec(std::move(s)) {}
  virtual ~Model() = default;
  /// In its rest pose. `anchors` where the spec samples the surface (anchorCount), else empty.
  static std::unique_ptr<Model> create(const RigSpec& spec, const RigShape& rest, const Anchors& anchors);

  virtual void setPose(const RigPose& pose) noexcept = 0;
  virtual void adapt(std::span<const float> /*light*/, int /*width*/) noexcept {}
  virtual void basis(Vec3 p, RigBasis& out) const noexcept = 0;
  virtual void basisBatch(const Vec3Rows& points, int count, std::span<float> values) const noexcept;

  RigSpec spec;
  RigBox box;                     // of the current pose; kept by Rig
  std::array<AxisModel, 3> axes;  // of x, y, z; tensor models
  std::vector<int> anchors;
  SurfaceProbes probes;  // between the anchors; kept by Rig
  std::vector<RigSample> samples;
  int functionals = 0;  // sum of 1 + derivatives
  SparseOperator op;
  double condition = 1;
};

/// Centre and half extents of a box; `inverseHalf` is 0 along an axis of (next to) no extent, so that coordinates there
/// are 0.
struct BoxCoordinates {
  Vec3 centre, half, inverseHalf;

  explicit BoxCoordinates(const RigBox& box = {}) noexcept
      : centre(box.lo * 0.5f + box.hi * 0.5f), half(box.hi * 0.5f - box.lo * 0.5f) {
    for (int axis = 0; axis < 3; ++axis) inverseHalf[axis] = half[axis] > kLeastExtent ? 1 / half[axis] : 0;
  }
  /// [-1, 1] inside the box; 0 for a coordinate that is not a number.
  Vec3 operator()(Vec3 p) const noexcept { return {along(0, p.x), along(1, p.y), along(2, p.z)}; }
  float along(int axis, float p) const noexcept {
    const float u = (p - centre[axis]) * inverseHalf[axis];
    return u == u ? u : 0.0f;
  }

  /// Of at most Rig::kMaxBasisBatch points.
  using Rows = std::array<std::array<float, Rig::kMaxBasisBatch>, 3>;
  void rows(const Vec3Rows& points, Rows& out) const noexcept {
    const std::span<const float> from[] = {points.x, points.y, points.z};
    for (int axis = 0; axis < 3; ++axis)
      for (std::size_t i = 0; i < points.size(); ++i) out[axis][i] = along(axis, from[axis][i]);
  }

 private:
  static constexpr float kLeastExtent = 1e-30f;  // m; its inverse, squared in a polynomial, is still a float
};

}  // namespace rigel
