// latticegrad and hermite: lattices whose nodes hold the light's value and its three slopes, so K = 4 x nodes. Both
// were tried and dropped by the paper.
//
// With x_k the nodes, c_k and g_k what they hold, b(p) the lattice's kernel and D the spacing:
//
//   latticegrad   sum_k b_k(p) (c_k + g_k . (p - x_k))
//   hermite       prod_a L_a + sum_a (H_a - L_a) prod_{b != a} L_b
//
// L_a is linear interpolation along axis a, from values alone, and H_a the cubic through the values and slopes of axis
// a: the Boolean sum of the two (W. J. Gordon), on one cell the element of A. Adini. It is continuous, keeps all cubics
// and needs no mixed derivatives. (The product of three cubics with mixed derivatives left at 0 is smooth, but does not
// even keep x y.) An axis of one node is a gradient axis in both.
#pragma once

#include "model.h"

namespace rigel {

class Rig::SlopeGridModel final : public Rig::Model {
 public:
  SlopeGridModel(RigSpec spec, const RigShape& rest);

  void setPose(const RigPose& pose) noexcept override;
  void basis(Vec3 p, RigBasis& out) const noexcept override;

 private:
  /// Of the (up to two) nodes of an axis that count at a point.
  struct AxisTerms {
    int first = 0;
    int count = 1;
    std::array<float, 2> blend{1};  // L_a or b
    std::array<float, 2> bend{};    // H_a - L_a, of the values
    std::array<float, 2> slope{};   // of the slopes, which are per spacing
  };
  AxisTerms termsOf(int a, float u) const noexcept;

  std::array<int, 3> nodes_{};   // along x, y, z
  std::array<int, 3> stride_{};  // nodes between neighbours along an axis
  BoxCoordinates box_;
};

}  // namespace rigel
