#include <gtest/gtest.h>
#include <rigel/shader_wrap.h>
#include <rigel/wrap.h>

#include <cmath>
#include <limits>

#include "lights/describe.h"
#include "lights/random.h"
#include "reference/worst.h"
#include "reference/wrap_reference.h"

namespace rigel {
namespace {

using reference::Worst;
using test::describe;

constexpr double kCoefficientTolerance = 1e-7;  // one float rounding of values up to 4/3

TEST(Wrap, CoefficientsMatchQuadratureOfTheKernel) {
  Worst worst("wrap coefficients against quadrature, absolute");
  for (int step = 0; step <= 50; ++step) {
    const float a = -0.25f + 0.025f * static_cast<float>(step);
    const std::array<float, 5> f = wrapCoefficients<5>(a);
    for (int l = 0; l < 5; ++l) {
      const double expected = reference::wrapCoefficientReference(l, std::min(a, 1.0f));
      worst.add(std::abs(f[l] - expected), [&] {
        return "a " + describe(a) + ", l " + std::to_string(l) + ": " + describe(f[l]) + ", expected " +
               describe(expected);
      });
    }
  }
  worst.expectWithin(kCoefficientTolerance);
}

TEST(Wrap, LambertAndHalfLambertAreTheKnownNumbers) {
  const std::array<float, 5> lambert = wrapCoefficients<5>(0);
  const float kLambert[] = {1, 2.0f / 3, 1.0f / 4, 0, -1.0f / 24};
  const std::array<float, 5> half = wrapCoefficients<5>(1);
  const float kHalf[] = {4.0f / 3, 2.0f / 3, 2.0f / 15, 0, 0};
  for (int l = 0; l < 5; ++l) {
    EXPECT_NEAR(lambert[l], kLambert[l], kCoefficientTolerance) << "l " << l;
    EXPECT_NEAR(half[l], kHalf[l], kCoefficientTolerance) << "l " << l;
  }
}

TEST(Wrap, FewerBandsAreAPrefix) {
  const std::array<float, 5> five = wrapCoefficients<5>(0.3f);
  for (int l = 0; l < 4; ++l) EXPECT_EQ(wrapCoefficients<4>(0.3f)[l], five[l]);
  for (int l = 0; l < 3; ++l) EXPECT_EQ(wrapCoefficients<3>(0.3f)[l], five[l]);
  for (int l = 0; l < 2; ++l) EXPECT_EQ(wrapCoefficients<2>(0.3f)[l], five[l]);
}

TEST(Wrap, ArgumentsOutOfRangeAreClamped) {
  EXPECT_EQ(wrapCoefficients<5>(2), wrapCoefficients<5>(kMaxWrap));
  EXPECT_EQ(wrapCoefficients<5>(-1), wrapCoefficients<5>(kMinWrap));
  EXPECT_EQ(wrapCoefficients<5>(std::numeric_limits<float>::quiet_NaN()), wrapCoefficients<5>(0));
  EXPECT_EQ(clampWrap(std::numeric_limits<float>::infinity()), kMaxWrap);
}

TEST(Wrap, KernelMatchesItsDefinition) {
  for (const double a : {-0.25, 0.0, 0.3, 1.0}) {
    for (const double x : {-1.0, -0.6, -a, 0.2, 0.9, 1.0}) {
      EXPECT_DOUBLE_EQ(wrapKernel(x, a), reference::wrapKernelReference(x, a)) << "a " << a << ", x " << x;
    }
  }
}

TEST(Wrap, PowerOfTheFloatKernelIsAPolynomialsAway) {
  // Two fits of 1e-7 and the rounding of their sums; worst measured 4.3e-7.
  constexpr double kPowerTolerance = 5e-7;
  Worst worst("base^(1+a) in float, of max(1, base^(1+a))");
  test::Random random(221);
  for (int k = 0; k < 1'000'000; ++k) {
    const auto base = static_cast<float>(random.index(2) == 0 ? random.uniform(0, 2) : random.logUniform(1e-22, 2));
    const float a = random.uniformf(kMinWrap, kMaxWrap);
    const double expected = std::pow(static_cast<double>(base), 1 + static_cast<double>(a));
    const double error = std::abs(static_cast<double>(detail::wrapPower(base, a)) - expected);
    worst.add(error / std::max(1.0, expected), [&] { return "base " + describe(base) + ", a " + describe(a); });
  }
  worst.expectWithin(kPowerTolerance);
  for (const float a : {-0.25f, 0.0f, 0.3f, 1.0f}) {
    EXPECT_EQ(detail::wrapPower(0, a), 0);
    EXPECT_EQ(detail::wrapPower(1, a), 1);
    EXPECT_TRUE(std::isnan(detail::wrapPower(std::numeric_limits<float>::quiet_NaN(), a)));
  }
  EXPECT_EQ(detail::wrapPower(0.3f, 0), 0.3f);
}

TEST(Wrap, EnergyNormalisedKernelReflectsWhatItReceives) {
  // Uniform light of radiance 1 gives pi whatever the wrap.
  RadianceSH<5> uniform;
  const auto value = static_cast<float>(std::sqrt(4 * kPi));
  uniform[0] = {value, value, value};
  for (const float a : {-0.25f, 0.0f, 0.2f, 0.5f, 1.0f, 7.0f, std::numeric_limits<float>::quiet_NaN()}) {
    const double published = evaluate(irradianceFromRadiance(uniform, a), Vec3{0, 1, 0}).r;
    EXPECT_NEAR(published * static_cast<double>(wrapEnergy(a)), kPi, 1e-6) << "a " << a;
  }
  EXPECT_EQ(wrapEnergy(0), 1);
  EXPECT_EQ(wrapEnergy(1), 0.75f);
}

TEST(Wrap, GainScalesEverything) {
  const GpuWrap plain = gpuWrap(0.4f);
  const GpuWrap scaled = gpuWrap(0.4f, 0.5f);
  EXPECT_EQ(plain.gain, 1);
  EXPECT_EQ(scaled.f.x, 0.5f * plain.f.x);
  EXPECT_EQ(scaled.f4, 0.5f * plain.f4);
  EXPECT_EQ(scaled.blurBand.z, 0.5f * plain.blurBand.z);
  EXPECT_EQ(scaled.blur, plain.blur);
  for (const float none :
       {0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    EXPECT_EQ(gpuWrap(0.4f, none).gain, 0);
    EXPECT_EQ(gpuWrap(0.4f, none).f.x, 0);
  }
}

TEST(Wrap, IrradianceIsPiTimesCoefficientTimesRadiance) {
  RadianceSH<5> radiance;
  for (int i = 0; i < 25; ++i) radiance[i] = {static_cast<float>(i + 1), 1, -2};
  const IrradianceSH<5> irradiance = irradianceFromRadiance(radiance, 0.5f);
  for (int l = 0; l < 5; ++l) {
    const double factor = kPi * reference::wrapCoefficientReference(l, 0.5);
    for (int i = shIndex(l, -l); i <= shIndex(l, l); ++i) {
      for (int channel = 0; channel < 3; ++channel) {
        const double expected = factor * radiance[i][channel];
        EXPECT_NEAR(irradiance[i][channel], expected, 3e-7 * 30) << "coefficient " << i << ", channel " << channel;
      }
    }
  }
}

// Derivatives by theta, f' = -sin(theta) u^a, u = (cos(theta) + a)/(1 + a). The exponent 1 + a has two effects, and
// they hold in different places:
//
// At the normal, u = 1, so that f' = 0 and f'' = -1 whatever a is: every wrap keeps the first two derivatives of the
// Lambert cosine there (and f''' = 0). Wrapping does not change how a highlight-free surface peaks.
//
// At the edge of the lit part, cos(theta) = -a, f' tends to 0 as u^a for every a > 0: value and first derivative are
// continuous, the second is not (it grows as u^(a-1)), save at a = 1, where f = cos^4(theta/2) and the edge is the
// antipode. a = 0 keeps Lambert's kink of slope -1, a < 0 meets the edge vertically.
double kernelAt(double theta, double a) { return wrapKernel(std::cos(theta), a); }

double firstDerivative(double theta, double a, double h) {
  return (kernelAt(theta + h, a) - kernelAt(theta - h, a)) / (2 * h);
}

double secondDerivative(double theta, double a, double h) {
  return (kernelAt(theta + h, a) - 2 * kernelAt(theta, a) + kernelAt(theta - h, a)) / (h * h);
}

TEST(Wrap, KeepsLambertsFirstTwoDerivativesAtTheNormal) {
  constexpr double kStep = 1e-3;
  constexpr double kDifferenceTolerance = 2e-6;  // h^2 f''''/12 plus rounding 1e-16/h^2
  for (const double a : {-0.25, -0.1, 0.0, 0.25, 0.5, 0.75, 1.0}) {
    EXPECT_DOUBLE_EQ(kernelAt(0, a), 1) << "a " << a;
    EXPECT_NEAR(firstDerivative(0, a, kStep), 0, kDifferenceTolerance) << "a " << a;
    EXPECT_NEAR(secondDerivative(0, a, kStep), -1, kDifferenceTolerance) << "a " << a;
  }
}

TEST(Wrap, FirstDerivativeIsContinuousAtTheEdgeForPositiveWrap) {
  for (const double a : {0.25, 0.5, 0.75, 0.9}) {
    const double edge = std::acos(-a);
    for (const double gap : {1e-4, 1e-6, 1e-8}) {
      const double inside = firstDerivative(edge - gap, a, gap / 8);
      const double expected = -std::sin(edge - gap) * std::pow((std::cos(edge - gap) + a) / (1 + a), a);
      // Differences over an eighth of the gap: (1/8)^2/6 a(a-1) < 1e-3 relative.
      EXPECT_NEAR(inside, expected, 2e-3 * std::abs(expected)) << "a " << a << ", gap " << gap;
      EXPECT_EQ(firstDerivative(edge + gap, a, gap / 8), 0) << "a " << a << ", gap " << gap;
    }
    // It falls as gap^a, so it does vanish at the edge: 1e-8 of the gap is 1e-8^a of the slope.
    const double far = firstDerivative(edge - 1e-4, a, 1e-5);
    const double near = firstDerivative(edge - 1e-8, a, 1e-9);
    EXPECT_NEAR(std::log(near / far) / std::log(1e-4), a, 0.02) << "a " << a;
  }
}

TEST(Wrap, SecondDerivativeIsContinuousAtTheEdgeOnlyForHalfLambert) {
  // a < 1: it grows without bound towards the edge and is 0 beyond it.
  for (const double a : {0.25, 0.5, 0.75}) {
    const double edge = std::acos(-a);
    const double far = secondDerivative(edge - 1e-3, a, 1e-4);
    const double near = secondDerivative(edge - 1e-5, a, 1e-6);
    EXPECT_GT(near, 2 * far) << "a " << a;
    EXPECT_EQ(secondDerivative(edge + 1e-3, a, 1e-4), 0) << "a " << a;
  }
  // a = 1: first and second derivative pass through 0 at the antipode, whose far side is the mirror image.
  for (const double gap : {1e-2, 1e-3}) {
    EXPECT_NEAR(firstDerivative(kPi - gap, 1, gap / 8), -gap * gap * gap / 4, 0.02 * gap * gap * gap) << "gap " << gap;
    EXPECT_NEAR(secondDerivative(kPi - gap, 1, gap / 8), 0.75 * gap * gap, 0.02 * gap * gap) << "gap " << gap;
  }
}

TEST(Wrap, LambertKeepsItsKink) {
  EXPECT_NEAR(firstDerivative(kPi / 2 - 1e-4, 0, 1e-5), -1, 1e-6);
  EXPECT_EQ(firstDerivative(kPi / 2 + 1e-4, 0, 1e-5), 0);
}

}  // namespace
}  // namespace rigel
