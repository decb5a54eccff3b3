#include <gtest/gtest.h>

#include "reference/cap_quadrature.h"
#include "reference/sh_reference.h"
#include "reference/worst.h"

namespace rigel::reference {
namespace {

constexpr double kQuadratureTolerance = 2e-14;  // double rounding of 2560 nodes

TEST(ShReference, IsOrthonormal) {
  const std::vector<CapNode> nodes = capNodes({0.36, 0.48, 0.8}, M_PI);
  constexpr int kBands = 5;
  std::vector<std::vector<double>> basis;
  for (const CapNode& node : nodes) {
    const Vec50 w{Real50(node.direction.x), Real50(node.direction.y), Real50(node.direction.z)};
    std::vector<double>& values = basis.emplace_back();
    for (int l = 0; l < kBands; ++l) {
      for (int m = -l; m <= l; ++m) values.push_back(static_cast<double>(shReference(l, m, w)));
    }
  }
  Worst worst("SH products integrated over the sphere, absolute");
  for (int i = 0; i < kBands * kBands; ++i) {
    for (int j = 0; j <= i; ++j) {
      double product = 0;
      for (std::size_t k = 0; k < nodes.size(); ++k) product += basis[k][i] * basis[k][j] * nodes[k].solidAngle;
      worst.add(std::abs(product - (i == j ? 1 : 0)), [&] {
        return "coefficients " + std::to_string(i) + ", " + std::to_string(j) + ": " + std::to_string(product);
      });
    }
  }
  worst.expectWithin(kQuadratureTolerance);
}

// The convention: no Condon-Shortley sign, Y1 = sqrt(3/4pi) (y, z, x). One function of every band pins the signs.
TEST(ShReference, FollowsTheConvention) {
  const Vec50 w{Real50(2) / 7, Real50(3) / 7, Real50(6) / 7};
  const Real50 pi = pi50();
  const Real50 x = w.x, y = w.y, z = w.z;
  const auto expectSame = [&](int l, int m, const Real50& expected) {
    EXPECT_LT(abs(shReference(l, m, w) - expected), Real50("1e-47")) << "l " << l << ", m " << m;
  };
  expectSame(0, 0, sqrt(1 / (4 * pi)));
  expectSame(1, -1, sqrt(3 / (4 * pi)) * y);
  expectSame(1, 0, sqrt(3 / (4 * pi)) * z);
  expectSame(1, 1, sqrt(3 / (4 * pi)) * x);
  expectSame(2, -2, sqrt(15 / (4 * pi)) * x * y);
  expectSame(2, -1, sqrt(15 / (4 * pi)) * y * z);
  expectSame(2, 0, sqrt(5 / (16 * pi)) * (3 * z * z - 1));
  expectSame(2, 1, sqrt(15 / (4 * pi)) * x * z);
  expectSame(2, 2, sqrt(15 / (16 * pi)) * (x * x - y * y));
  expectSame(3, -3, sqrt(35 / (32 * pi)) * y * (3 * x * x - y * y));
  expectSame(3, 1, sqrt(21 / (32 * pi)) * x * (5 * z * z - 1));
  expectSame(4, -4, sqrt(315 / (16 * pi)) * x * y * (x * x - y * y));
  expectSame(4, 3, sqrt(315 / (32 * pi)) * x * z * (x * x - 3 * y * y));
}

TEST(ShReference, LegendreMatchesClosedForms) {
  for (const double value : {-1.0, -0.625, 0.0, 0.25, 1.0}) {
    const Real50 x(value);
    EXPECT_LT(abs(legendreReference(2, x) - (3 * x * x - 1) / 2), Real50("1e-48")) << "x " << value;
    EXPECT_LT(abs(legendreReference(5, x) - (63 * x * x * x * x * x - 70 * x * x * x + 15 * x) / 8), Real50("1e-48"))
        << "x " << value;
  }
}

}  // namespace
}  // namespace rigel::reference
