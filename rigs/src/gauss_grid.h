// @gauss: the samples of a tensor rig where the object's surface is.
#pragma once

#include "gauss_axis.h"
#include "model.h"

namespace rigel {

/// The tensor product of the Gauss nodes of the surface's three axis marginals, in box coordinates, so that samples
/// follow the pose. Slopes are secants between the two Gauss nodes of their axis, and values of such rigs weighted
/// means over these: a node with s slopes takes 2s samples.
class GaussGrid {
 public:
  /// Sets up samples and operator of `model`, the coefficients in the order of TensorModel.
  GaussGrid(Rig::Model& model, std::array<int, 3> nodes, std::vector<int> slopeAxes, const RigShape& rest);

  void setPose(Rig::Model& model, const BoxCoordinates& box) noexcept;

  const GaussAxis& axis(int a) const noexcept { return axes_[a]; }

 private:
  void buildOperator(Rig::Model& model) const;

  std::vector<GaussAxis> axes_;     // x, y, z: one node along a slope's axis
  std::vector<GaussAxis> secants_;  // two nodes along each slope's axis
  std::vector<int> slopeAxes_;
  int nodes_ = 1;
};

}  // namespace rigel
