// The basis functions of a rig in double, by their definitions: slow and obviously right.
#pragma once

#include <rigel/gpu_rig.h>

#include <array>
#include <vector>

namespace rigel::test {

class RigReference {
 public:
  /// In the rig's pose and falloff of the moment. What monomials there are, the falloff's coefficients and the nodes of
  /// @gauss are taken as the packing gives them (test_gpu_rig.cpp holds it to the rig).
  RigReference(const Rig& rig, const RigFrame& worldFromRig);

  /// phi_k at a point of the world, and for each the sum of the absolute values of the terms that it is made of.
  struct Basis {
    std::vector<double> value, absolute;
  };
  Basis at(Vec3 world) const;

  using Point = std::array<double, 3>;

  /// Box coordinates, and the sum of absolute terms of each.
  std::array<Point, 2> coordinates(Vec3 world) const;

 private:
  Basis poly(const Point& u, const Point& absolute) const;
  Basis tensor(const Point& u, const Point& absolute) const;
  std::vector<double> axisWeights(int axis, double u) const;

  const Rig& rig_;
  RigFrame frame_;
  GpuRig packed_;
  std::vector<GpuVec4> gaussNodes_;
};

}  // namespace rigel::test
