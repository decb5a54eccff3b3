// Keyframe interpolation against values worked out by hand and by plain double arithmetic.
#include "scene/animation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace rigel::tools {
namespace {

// Outputs are floats computed in double: half an ulp of values up to 8, with a little room.
constexpr double kFloatRounding = 6e-7;

Channel channel(AnimationPath path, Interpolation interpolation, int width, std::vector<float> times,
                std::vector<float> values) {
  return {0, path, interpolation, width, std::move(times), std::move(values)};
}

std::vector<float> at(const Channel& c, double time) {
  std::vector<float> out(static_cast<std::size_t>(c.width), -99.f);
  sampleChannel(c, time, out.data());
  return out;
}

void expectNear(const std::vector<float>& actual, const std::vector<double>& expected, double tolerance) {
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(actual[i], expected[i], tolerance) << "component " << i;
}

TEST(Animation, LinearVectors) {
  const Channel c =
      channel(AnimationPath::translation, Interpolation::linear, 3, {1, 2, 4}, {0, 0, 0, 1, 2, 3, 5, 6, 7});
  expectNear(at(c, 1.25), {0.25, 0.5, 0.75}, kFloatRounding);
  expectNear(at(c, 2), {1, 2, 3}, 0);
  expectNear(at(c, 3.5), {4, 5, 6}, kFloatRounding);
}

TEST(Animation, TimesOutsideAreClamped) {
  const Channel c = channel(AnimationPath::translation, Interpolation::linear, 3, {1, 2}, {1, 2, 3, 4, 5, 6});
  for (const double before : {-1e30, 0.0, 0.999, std::numeric_limits<double>::quiet_NaN()})
    expectNear(at(c, before), {1, 2, 3}, 0);
  for (const double after : {2.0, 2.001, 1e30, std::numeric_limits<double>::infinity()})
    expectNear(at(c, after), {4, 5, 6}, 0);
}

TEST(Animation, StepHoldsUntilTheNextKey) {
  const Channel c = channel(AnimationPath::scale, Interpolation::step, 3, {0, 1, 2}, {1, 1, 1, 2, 2, 2, 3, 3, 3});
  expectNear(at(c, 0.9999), {1, 1, 1}, 0);
  expectNear(at(c, 1), {2, 2, 2}, 0);
  expectNear(at(c, 1.9999), {2, 2, 2}, 0);
  expectNear(at(c, 2), {3, 3, 3}, 0);
}

TEST(Animation, OneKeyIsAConstant) {
  for (const Interpolation kind : {Interpolation::step, Interpolation::linear}) {
    const Channel c = channel(AnimationPath::scale, kind, 3, {0.5f}, {2, 3, 4});
    for (const double t : {0.0, 0.5, 1.0}) expectNear(at(c, t), {2, 3, 4}, 0);
  }
  const Channel cubic =
      channel(AnimationPath::scale, Interpolation::cubicSpline, 3, {0.5f}, {9, 9, 9, 2, 3, 4, 9, 9, 9});
  for (const double t : {0.0, 0.5, 1.0}) expectNear(at(cubic, t), {2, 3, 4}, 0);
}

// p(u) = (2u^3-3u^2+1) p0 + td (u^3-2u^2+u) b0 + (-2u^3+3u^2) p1 + td (u^3-u^2) a1, glTF 2.0 appendix C.5.
TEST(Animation, CubicSplineScalesTangentsByTheKeyDistance) {
  const Channel c = channel(AnimationPath::weights, Interpolation::cubicSpline, 1, {1, 3},
                            {100, 2, 0.5f, /* in, value, out */ -1, 6, 100});
  // At u = 1/4, td = 2: 0.84375*2 + 2*0.140625*0.5 + 0.15625*6 + 2*(-0.046875)*(-1)
  expectNear(at(c, 1.5), {1.6875 + 0.140625 + 0.9375 + 0.09375}, kFloatRounding);
  // At u = 1/2: the mean of the ends plus td (out - in) / 8.
  expectNear(at(c, 2), {4 + 2 * (0.5 + 1) / 8}, kFloatRounding);
  expectNear(at(c, 1), {2}, 0);
  expectNear(at(c, 3), {6}, 0);
}

TEST(Animation, CubicSplineReproducesACubic) {
  // f(t) = t^3 - t: values and derivatives at the keys determine it everywhere between.
  const auto f = [](double t) { return t * t * t - t; };
  const auto slope = [](double t) { return static_cast<float>(3 * t * t - 1); };
  std::vector<float> values;
  for (const double t : {0.0, 0.5, 2.0}) {
    values.insert(values.end(), {slope(t), static_cast<float>(f(t)), slope(t)});
  }
  const Channel c = channel(AnimationPath::weights, Interpolation::cubicSpline, 1, {0, 0.5f, 2}, values);
  for (double t = 0; t <= 2; t += 0.05) expectNear(at(c, t), {f(t)}, kFloatRounding);
}

TEST(Animation, SlerpTurnsAtConstantSpeed) {
  // 0 to 120 degrees about x.
  const float h = static_cast<float>(std::sin(M_PI / 3)), w = static_cast<float>(std::cos(M_PI / 3));
  const Channel c = channel(AnimationPath::rotation, Interpolation::linear, 4, {0, 1}, {0, 0, 0, 1, h, 0, 0, w});
  for (double t = 0; t <= 1; t += 0.0625) {
    expectNear(at(c, t), {std::sin(t * M_PI / 3), 0, 0, std::cos(t * M_PI / 3)}, kFloatRounding);
  }
}

TEST(Animation, SlerpTakesTheShortArc) {
  // The second key is minus the rotation by 40 degrees: the same rotation, so half way is 20 degrees.
  const double half = 20 * M_PI / 180;
  const Channel c =
      channel(AnimationPath::rotation, Interpolation::linear, 4, {0, 1},
              {0, 0, 0, 1, 0, static_cast<float>(-std::sin(half)), 0, static_cast<float>(-std::cos(half))});
  expectNear(at(c, 0.5), {0, std::sin(half / 2), 0, std::cos(half / 2)}, kFloatRounding);
}

TEST(Animation, SlerpOfNearlyEqualRotationsKeepsItsPrecision) {
  for (const double angle : {1e-3, 1e-5, 1e-7, 0.0}) {
    const auto s = static_cast<float>(std::sin(angle)), w = static_cast<float>(std::cos(angle));
    const Channel c = channel(AnimationPath::rotation, Interpolation::linear, 4, {0, 1}, {0, 0, 0, 1, 0, 0, s, w});
    const std::vector<float> q = at(c, 0.25);
    EXPECT_NEAR(q[2], std::sin(0.25 * angle), 1e-6 * angle + 1e-12) << angle;
  }
}

TEST(Animation, OppositeRotationsStayUnitAndFinite) {
  const Channel c = channel(AnimationPath::rotation, Interpolation::linear, 4, {0, 1}, {0, 0, 0, 1, 1, 0, 0, 0});
  for (double t = 0; t <= 1; t += 0.125) {
    const std::vector<float> q = at(c, t);
    EXPECT_NEAR(std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3])), 1, kFloatRounding);
  }
}

TEST(Animation, RotationsComeOutUnit) {
  const std::vector<float> keys = {0,      0, 0, 0, /**/ 0, 0, 0, 1.01f, /**/ 3, 0, 0, 0,
                                   /**/ 0, 2, 0, 0, /**/ 1, 0, 0, 0,     /**/ 0, 0, 0, 0};
  const Channel cubic = channel(AnimationPath::rotation, Interpolation::cubicSpline, 4, {0, 1}, keys);
  const Channel linear =
      channel(AnimationPath::rotation, Interpolation::linear, 4, {0, 1}, {0, 0, 0, 1.01f, 0.99f, 0, 0, 0});
  for (const Channel& c : {cubic, linear}) {
    for (double t = 0; t <= 1; t += 0.0625) {
      const std::vector<float> q = at(c, t);
      EXPECT_NEAR(std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3])), 1, kFloatRounding);
    }
  }
}

TEST(Animation, ManyKeysFindTheirInterval) {
  std::vector<float> times, values;
  for (int i = 0; i < 1000; ++i) {
    times.push_back(static_cast<float>(i) / 30);
    values.push_back(static_cast<float>(i));
  }
  const Channel c = channel(AnimationPath::weights, Interpolation::linear, 1, times, values);
  for (int i = 0; i < 999; ++i) {
    const double middle = 0.5 * (double{times[i]} + times[i + 1]);
    expectNear(at(c, middle), {i + 0.5}, 1e-4);  // values to 1000: an ulp is 6e-5
    expectNear(at(c, times[i]), {double(i)}, 0);
  }
}

}  // namespace
}  // namespace rigel::tools
