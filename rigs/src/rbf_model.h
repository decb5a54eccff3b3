// rbf:K, normalised Gaussians about K points of the object's surface, fitted by least squares to light sampled on it.
// Radial basis functions were tried and dropped by the paper.
//
//   phi_k(p) = g_k(p) / sum_j g_j(p),   g_k = exp(-|p - x_k|^2 / w^2)      (J. Moody, C. Darken 1989)
//
// The centres x_k are anchors of the fit, and w is a multiple of the distance from centre to centre: both follow the
// pose. The functions sum to 1, so that constant light is exact without a constant term. Chosen among kernels by
// measurement (rigs/README.md).
#pragma once

#include "surface_fit.h"

namespace rigel {

class Rig::RbfModel final : public Rig::Model {
 public:
  RbfModel(RigSpec spec, const RigShape& rest, const Anchors& chosen);

  void setPose(const RigPose& pose) noexcept override;
  void basis(Vec3 p, RigBasis& out) const noexcept override;

 private:
  Vec3 place(Vec3 p) const noexcept;
  float squaredSpacing() const noexcept;

  std::vector<int> centreAnchors_;  // which anchors the centres are
  std::size_t distinct_ = 0;        // of them; the others repeat these
  std::vector<Vec3> centres_;       // placed
  BoxCoordinates box_;
  Vec3 aspect_;                    // of the box, largest half extent 1
  float inverseSquaredWidth_ = 0;  // 0: centres that coincide
  SurfaceFit surfaceFit_;
};

}  // namespace rigel
