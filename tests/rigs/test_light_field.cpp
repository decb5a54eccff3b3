// The closed forms behind the bounds, against difference quotients of an independent light over random directions and
// normals, and against quadrature.
#include "bound_truth.h"
#include "light_field.h"
#include "lights/random.h"

#include <gtest/gtest.h>

namespace rigel::test {
namespace {

double valueAt(const Irradiance9& e, Vec3 n) {
  float y[9];
  shBasis<3>(n, y);
  double sum = 0;
  for (int i = 0; i < 9; ++i) sum += e[i] * double{y[i]};
  return sum;
}

constexpr float kWraps[] = {-0.25f, 0, 0.3f, 0.5f, 1};

/// A light of radius 1 at the origin, seen from a distance.
Irradiance9 lightAt(Vec3 p, float wrap) { return referenceIrradiance(SphereLight{{}, 1, {1, 1, 1}}, p, wrap); }

Vec3 acrossOf(Vec3 w, Vec3 t) {
  const Vec3 across = t - w * dot(t, w);
  return across * (1 / length(across));
}

TEST(LightField, DerivativesAreBoundedAndReached) {
  Random random(3);
  const int tries = fullRun() ? 100000 : 4000;
  for (const float wrap : kWraps) {
    const WrapField field = wrapField(wrap);
    const LightField light(field, kPi, 1);
    for (const double rho : {1.2, 1.5, 2.0, 5.0}) {
      const LightField::Slopes s = light.slopes(rho);
      double most[2][2] = {};  // largest share of the bound: first, second derivative; along, across
      for (int i = 0; i < tries; ++i) {
        // Half of the normals near the light's direction, where the field is strongest.
        const Vec3 w = random.direction();
        const Vec3 t = acrossOf(w, random.direction());
        Vec3 n = i % 2 ? random.direction() : w + random.direction() * random.uniformf(0, 0.3);
        n = n * (1 / length(n));
        const double angle = i % 3 == 0 ? 0 : i % 3 == 1 ? kPi / 2 : random.uniform(0, kPi / 2);
        const double co = std::cos(angle), si = std::sin(angle);
        const Vec3 direction = w * static_cast<float>(co) + t * static_cast<float>(si);
        const Vec3 p = w * static_cast<float>(-rho);
        const auto h = static_cast<float>(1e-2 * (rho - 1));
        const double ahead = valueAt(lightAt(p + direction * h, wrap), n);
        const double behind = valueAt(lightAt(p - direction * h, wrap), n);
        const double here = valueAt(lightAt(p, wrap), n);
        const double first = std::abs(ahead - behind) / (2 * double{h});
        const double second = std::abs(ahead + behind - 2 * here) / (double{h} * double{h});
        const double firstBound = std::hypot(s.first * co, s.firstAcross * si);
        const double secondBound = s.second * co * co + s.secondAcross * si * si;
        // Difference quotients of float positions at distance h: 1e-3 and 1e-2.
        ASSERT_LE(first, 1.002 * firstBound) << "wrap " << wrap << " rho " << rho << " angle " << angle;
        ASSERT_LE(second, 1.02 * secondBound) << "wrap " << wrap << " rho " << rho << " angle " << angle;
        if (i % 3 < 2) {
          most[0][i % 3] = std::max(most[0][i % 3], first / firstBound);
          most[1][i % 3] = std::max(most[1][i % 3], second / secondBound);
        }
      }
      if (rho < 2) continue;  // sharp where c > .8
      EXPECT_GT(most[0][0], 0.97) << wrap << ' ' << rho;
      EXPECT_GT(most[1][0], 0.95) << wrap << ' ' << rho;
      EXPECT_GT(most[1][1], 0.93) << wrap << ' ' << rho;
    }
  }
}

/// Midpoint rule after substituting the square root at the light's surface away.
template <class F>
double integrate(double from, double to, F f) {
  constexpr int kSteps = 20000;
  const double start = std::sqrt(from - 1);
  const double end = std::sqrt(to - 1);
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double x = start + (end - start) * (i + 0.5) / kSteps;
    sum += f(1 + x * x) * 2 * x;
  }
  return sum * (end - start) / kSteps;
}

TEST(LightField, ChangeAndRemainderAreIntegralsOfTheSlopes) {
  for (const float wrap : kWraps) {
    const WrapField field = wrapField(wrap);
    const LightField light(field, kPi, 1);
    for (const double near : {1.0, 1.001, 1.1, 1.3, 2.0})
      for (const double far : {2.1, 4.0, 30.0}) {
        const double change = integrate(near, far, [&](double rho) { return light.slopes(rho).first; });
        EXPECT_NEAR(light.change(near, far), change, 1e-4 * change) << wrap << ' ' << near << ' ' << far;
        if (near == 1.0) continue;  // (rho - near) / c^3: the midpoint rule does not see its end
        const double rest = integrate(near, far, [&](double rho) { return (rho - near) * light.slopes(rho).second; });
        EXPECT_NEAR(light.remainder(near, far), rest, 1e-3 * rest) << wrap << ' ' << near << ' ' << far;
      }
  }
}

TEST(LightField, PeaksBoundTheLightAtEveryDistance) {
  for (const float wrap : kWraps) {
    const WrapField field = wrapField(wrap);
    const LightField light(field, kPi, 1);
    double farther = 0;  // largest over all greater distances
    for (double rho = 3; rho >= 0; rho -= 0.01) {
      farther = std::max(farther, largestOverNormals(lightAt({static_cast<float>(rho), 0, 0}, wrap)));
      EXPECT_LE(farther, 1.0001 * light.peak(rho)) << wrap << ' ' << rho;
      if (rho <= 1.01) continue;
      EXPECT_GE(farther, 0.999 * light.peak(rho)) << wrap << ' ' << rho;
    }
  }
}

TEST(LightField, ChangeInsideBoundsTheDifferenceToTheSurface) {
  Random random(9);
  for (const float wrap : kWraps) {
    const WrapField field = wrapField(wrap);
    const LightField light(field, kPi, 1);
    for (int i = 0; i < 2000; ++i) {
      const Vec3 direction = random.direction();
      Vec3 inside = direction * random.uniformf(0, 1);
      const Irradiance9 surface = lightAt(direction, wrap);
      Irradiance9 e = lightAt(inside, wrap);
      for (int k = 0; k < 9; ++k) e[k] -= surface[k];
      EXPECT_LE(largestOverNormals(e), 1.0001 * light.changeInside(double{length(inside)}) + 1e-4) << wrap;
    }
  }
}

}  // namespace
}  // namespace rigel::test
