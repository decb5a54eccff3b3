// Constant, gradient, lattice and mixed rigs: one model an axis of the box, as a tensor product.
//
// Lattice axes multiply: their nodes form a grid of N positions. Gradient axes add: each gives every node one slope.
// So K = N (1 + gradient axes); "gradient" is mixed:g,g,g (value + 3 slopes) and "constant" mixed:c,c,c. Products of
// slopes are left out: they would need second derivatives of the light.
#pragma once

#include "gauss_grid.h"
#include "surface_fit.h"

#include <optional>

namespace rigel {

class Rig::TensorModel final : public Rig::Model {
 public:
  TensorModel(RigSpec spec, const RigShape& rest, const Anchors& chosen);

  void setPose(const RigPose& pose) noexcept override;
  void basis(Vec3 p, RigBasis& out) const noexcept override;
  void basisBatch(const Vec3Rows& points, int count, std::span<float> values) const noexcept override;

  /// @gauss only.
  const GaussAxis& gaussAxis(int a) const noexcept { return gaussGrid_->axis(a); }

 private:
  void buildSamples();
  void buildOperator();
  void placeSamples() noexcept;
  /// Of all nodes of an axis, a row each, at coordinates `u`.
  void axisRows(int axis, std::span<const float> u, std::span<float> rows) const noexcept;

  std::array<AxisModel, 3> axis_;  // of x, y, z
  std::array<int, 3> stride_;      // nodes between neighbours along an axis
  std::vector<int> slopeAxes_;
  int nodes_ = 1;
  BoxCoordinates box_;
  std::optional<GaussGrid> gaussGrid_;    // @gauss only
  std::optional<SurfaceFit> surfaceFit_;  // @lsq only
};

}  // namespace rigel
