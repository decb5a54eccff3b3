// Shapes, fields and rigs that the rig tests share.
#pragma once

#include <rigel/rig_light.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace rigel::test {

/// Points on the surface of an axis-aligned ellipsoid around `centre`, evenly spread (Fibonacci).
inline std::vector<Vec3> ellipsoid(Vec3 centre, Vec3 half, int count) {
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2.0 * i + 1) / count;
    const double phi = i * 2.39996322972865332;
    const double s = std::sqrt(1 - z * z);
    points.push_back({centre.x + half.x * static_cast<float>(s * std::cos(phi)),
                      centre.y + half.y * static_cast<float>(s * std::sin(phi)),
                      centre.z + half.z * static_cast<float>(z)});
  }
  return points;
}

inline RigBox boxOf(const std::vector<Vec3>& points) {
  RigBox box{points.front(), points.front()};
  for (Vec3 p : points)
    for (int a = 0; a < 3; ++a) {
      box.lo[a] = std::min(box.lo[a], p[a]);
      box.hi[a] = std::max(box.hi[a], p[a]);
    }
  return box;
}

inline const std::vector<std::string>& everyKindOfSpec() {
  static const std::vector<std::string> specs = {"constant",
                                                 "gradient",
                                                 "gradient@numeric",
                                                 "constant@lsq",
                                                 "gradient@lsq",
                                                 "lattice:2x2x2",
                                                 "lattice:3x2x2",
                                                 "lattice:3x2x2:smooth",
                                                 "lattice:4x3x2:cubic",
                                                 "lattice:3x2x2@lsq",
                                                 "lattice:8x4x2",
                                                 "mixed:l3,g,c",
                                                 "constant@gauss",
                                                 "gradient@gauss",
                                                 "lattice:3x2x2@gauss",
                                                 "lattice:8x4x2@gauss",
                                                 "mixed:l3,g,c@gauss",
                                                 "mixed:l3,g,c@numeric",
                                                 "mixed:l3,g,c@lsq",
                                                 "mixed:xyz:c,l4,g",
                                                 "mixed:g,g,c",
                                                 "mixed:l2,g,g@lsq",
                                                 "poly:1",
                                                 "poly:4",
                                                 "poly:6",
                                                 "poly:12",
                                                 "poly:20",
                                                 "auto",
                                                 "invquad:1",
                                                 "invquad:6",
                                                 "invquad:12",
                                                 "rbf:1",
                                                 "rbf:6",
                                                 "rbf:12",
                                                 "latticegrad:1x1x1",
                                                 "latticegrad:3x2x2",
                                                 "latticegrad:2x2x1:smooth",
                                                 "hermite:1x1x1",
                                                 "hermite:3x2x2"};
  return specs;
}

inline RigSpec specOf(const std::string& text) {
  auto spec = parseRigSpec(text);
  EXPECT_TRUE(spec) << (spec ? "" : spec.error().line());
  return spec ? *spec : RigSpec{};
}

inline Rig rigOf(const std::string& text, const std::vector<Vec3>& surface) {
  auto rig = Rig::create(specOf(text), {boxOf(surface), surface});
  EXPECT_TRUE(rig) << (rig ? "" : rig.error().line());
  return *std::move(rig);
}

/// Fits `rig` to a scalar field with its gradient and returns the fitted function.
template <class Field, class Gradient>
auto fitField(Rig& rig, Field field, Gradient gradient) {
  std::vector<float> functionals;
  for (const RigSample& sample : rig.samples()) {
    functionals.push_back(field(sample.position));
    for (int i = 0; i < sample.derivatives; ++i)
      functionals.push_back(dot(gradient(sample.position), sample.directions[i]));
  }
  std::vector<float> coefficients(rig.shVectors());
  rig.adapt(functionals, 1);
  rig.fit(functionals, 1, coefficients);
  return [&rig, coefficients](Vec3 p) {
    RigBasis phi;
    rig.basis(p, phi);
    float sum = 0;
    for (int j = 0; j < phi.count; ++j) sum += phi.value[j] * coefficients[phi.index[j]];
    return sum;
  };
}

}  // namespace rigel::test
