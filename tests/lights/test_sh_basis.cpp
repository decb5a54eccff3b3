#include <gtest/gtest.h>
#include <rigel/sh.h>

#include "lights/describe.h"
#include "lights/random.h"
#include "reference/sh_reference.h"
#include "reference/worst.h"

namespace rigel {
namespace {

using reference::Real50;
using reference::Vec50;
using reference::Worst;
using test::describe;

// Float rounding of the direction's polynomials, which are compared at exactly the float direction.
constexpr double kValueTolerance = 3e-7;
constexpr double kGradientTolerance = 1.5e-6;

/// The polynomial extension is compared through its tangential part, the derivative along the sphere:
/// Y(w cos h + t sin h) to first order, by central differences in 50 digits.
Real50 tangentialReference(int l, int m, const Vec50& w, const Vec50& tangent) {
  const Real50 h("1e-16");
  const auto at = [&](const Real50& step) {
    const Vec50 moved{w.x + tangent.x * step, w.y + tangent.y * step, w.z + tangent.z * step};
    return reference::shReference(l, m, moved * (1 / reference::length(moved)));
  };
  return (at(h) - at(-h)) / (2 * h);
}

std::vector<Vec3> testDirections() {
  std::vector<Vec3> directions = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  test::Random random(11);
  for (int i = 0; i < 300; ++i) directions.push_back(random.direction());
  return directions;
}

TEST(ShBasis, Band1IsYZX) {
  float y[4];
  shBasis<2>({0.25f, 0.5f, 0.75f}, y);
  const float k = std::sqrt(3 / (4 * static_cast<float>(kPi)));
  EXPECT_FLOAT_EQ(y[0], std::sqrt(1 / (4 * static_cast<float>(kPi))));
  EXPECT_FLOAT_EQ(y[1], k * 0.5f);
  EXPECT_FLOAT_EQ(y[2], k * 0.75f);
  EXPECT_FLOAT_EQ(y[3], k * 0.25f);
}

TEST(ShBasis, MatchesTheDefinition) {
  Worst worst("SH basis against 50 digits, absolute");
  for (const Vec3 w : testDirections()) {
    float y[25];
    shBasis<5>(w, y);
    const Vec50 exact = reference::exactly(w);
    const Vec50 unit = exact * (1 / reference::length(exact));
    for (int l = 0; l < 5; ++l) {
      for (int m = -l; m <= l; ++m) {
        const auto expected = static_cast<double>(reference::shReference(l, m, unit));
        worst.add(std::abs(y[shIndex(l, m)] - expected), [&] {
          return "l " + std::to_string(l) + ", m " + std::to_string(m) + ", w " + describe(w) + ": " +
                 describe(y[shIndex(l, m)]) + ", expected " + describe(expected);
        });
      }
    }
  }
  worst.expectWithin(kValueTolerance);
}

TEST(ShBasis, GradientMatchesDifferencesAlongTheSphere) {
  Worst worst("SH basis gradient against 50-digit differences, absolute");
  for (const Vec3 w : testDirections()) {
    float y[25];
    Vec3 dy[25];
    shBasisGradient<5>(w, y, dy);
    const Vec50 exact = reference::exactly(w);
    const Vec50 unit = exact * (1 / reference::length(exact));
    for (int axis = 0; axis < 3; ++axis) {
      Vec50 tangent = unit * -unit[axis];
      tangent[axis] += 1;  // (I - w w^T) e_axis
      for (int l = 0; l < 5; ++l) {
        for (int m = -l; m <= l; ++m) {
          const Vec3 gradient = dy[shIndex(l, m)];
          const double along = static_cast<double>(dot(gradient, w));
          const double actual = static_cast<double>(gradient[axis]) - along * static_cast<double>(w[axis]);
          const auto expected = static_cast<double>(tangentialReference(l, m, unit, tangent));
          worst.add(std::abs(actual - expected), [&] {
            return "l " + std::to_string(l) + ", m " + std::to_string(m) + ", w " + describe(w) + ", axis " +
                   std::to_string(axis) + ": " + describe(actual) + ", expected " + describe(expected);
          });
        }
      }
    }
  }
  worst.expectWithin(kGradientTolerance);
}

TEST(ShBasis, GradientIsOfTheHomogeneousPolynomial) {
  Worst worst("w . grad Y against l Y, absolute");
  for (const Vec3 w : testDirections()) {
    float y[25];
    Vec3 dy[25];
    shBasisGradient<5>(w, y, dy);
    for (int l = 0; l < 5; ++l) {
      for (int i = shIndex(l, -l); i <= shIndex(l, l); ++i) {
        const double actual = dot(w, dy[i]);
        const double expected = static_cast<double>(l) * static_cast<double>(y[i]);
        worst.add(std::abs(actual - expected), [&] {
          return "coefficient " + std::to_string(i) + ", w " + describe(w) + ": " + describe(actual) + ", expected " +
                 describe(expected);
        });
      }
    }
  }
  worst.expectWithin(kGradientTolerance);
}

template <int B>
void expectPrefixOfFiveBands(Vec3 w) {
  float few[shCount(B)];
  float all[25];
  shBasis<B>(w, few);
  shBasis<5>(w, all);
  float fewAgain[shCount(B)];
  Vec3 slopes[shCount(B)];
  Vec3 allSlopes[25];
  shBasisGradient<B>(w, fewAgain, slopes);
  shBasisGradient<5>(w, all, allSlopes);
  for (int i = 0; i < shCount(B); ++i) {
    EXPECT_EQ(few[i], all[i]) << B << " bands, coefficient " << i;
    EXPECT_EQ(fewAgain[i], all[i]) << B << " bands, coefficient " << i;
    EXPECT_EQ(slopes[i], allSlopes[i]) << B << " bands, coefficient " << i;
  }
}

TEST(ShBasis, FewerBandsAreAPrefix) {
  const Vec3 w{2.0f / 7, -3.0f / 7, 6.0f / 7};
  expectPrefixOfFiveBands<2>(w);
  expectPrefixOfFiveBands<3>(w);
  expectPrefixOfFiveBands<4>(w);
}

TEST(ShBasis, EvaluateIsTheDotProduct) {
  RadianceSH<3> sh;
  for (int i = 0; i < 9; ++i) sh[i] = {1.0f + static_cast<float>(i), 2, -0.5f};
  const Vec3 w{2.0f / 7, -3.0f / 7, 6.0f / 7};
  float y[9];
  shBasis<3>(w, y);
  Rgb expected;
  for (int i = 0; i < 9; ++i) expected += sh[i] * y[i];
  const Rgb actual = evaluate(sh, w);
  EXPECT_FLOAT_EQ(actual.r, expected.r);
  EXPECT_FLOAT_EQ(actual.g, expected.g);
  EXPECT_FLOAT_EQ(actual.b, expected.b);
}

}  // namespace
}  // namespace rigel
