// What a GPU needs to know of a rig besides its coefficients.
#pragma once

#include <rigel/gpu_rig.h>

namespace rigel {

/// World to box coordinates (centre and axes of `out`), in double: the centre is rounded to float, and what that loses
/// goes into the axes' w.
void placeRigBox(const RigBox& box, const RigFrame& worldFromRig, GpuRig& out) noexcept;

class GpuRigReader {
 public:
  explicit GpuRigReader(const Rig& rig) noexcept : rig_(rig) {}

  /// Everything but where the coefficients are, how many and their scale.
  GpuRig describe(const RigFrame& worldFromRig) const noexcept;

  /// Poly and invquad: monomial k > 0 is monomial `from` < k times coordinate `axis`.
  struct Term {
    int from, axis;
  };
  Term term(int k) const noexcept;

  /// @gauss: per axis pairs of (node, 1 / prod (node - others)), two a vec4, each axis beginning one.
  void gaussNodes(std::span<GpuVec4> out) const noexcept;

 private:
  void describePoly(GpuRig& out) const noexcept;
  void describeTensor(GpuRig& out) const noexcept;

  const Rig& rig_;
};

}  // namespace rigel
