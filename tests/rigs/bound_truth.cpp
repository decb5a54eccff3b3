#include "bound_truth.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace rigel::test {
namespace {

using Vec = std::array<double, 3>;

double dotOf(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vec difference(Vec3 a, Vec3 b) {
  return {double{a.x} - double{b.x}, double{a.y} - double{b.y}, double{a.z} - double{b.z}};
}

Vec unit(const Vec& v) {
  const double length = std::sqrt(dotOf(v, v));
  return length > 0 ? Vec{v[0] / length, v[1] / length, v[2] / length} : Vec{0, 0, 1};
}

std::array<double, 9> basis(const Vec& n) {
  const double a = std::sqrt(1 / (4 * kPi)), b = std::sqrt(3 / (4 * kPi)), c = std::sqrt(15 / (4 * kPi));
  const auto [x, y, z] = n;
  return {a,
          b * y,
          b * z,
          b * x,
          c * x * y,
          c * y * z,
          c / std::sqrt(12.0) * (3 * z * z - 1),
          c * x * z,
          c / 2 * (x * x - y * y)};
}

/// Of radiance L = 1 seen from outside or, continued, inside: pi f_l 2 pi g_l Y_lm(w), times `modulation`.
Irradiance9 sphere(const Vec& toLight, double radius, double modulation, float wrap) {
  const double d2 = dotOf(toLight, toLight);
  const double r2 = radius * radius;
  const bool inside = d2 < r2;
  const double s2 = inside ? d2 / r2 : r2 / d2;
  const double c = std::sqrt(std::max(0.0, inside ? (r2 - d2) / r2 : (d2 - r2) / d2)) * (inside ? -1 : 1);
  const std::array<double, 3> g{inside ? 1 - c : s2 / (1 + c), s2 / 2, c * s2 / 2};
  const std::array<float, 3> f = wrapCoefficients<3>(wrap);
  Irradiance9 e = basis(unit(toLight));
  for (int i = 0; i < 9; ++i) {
    const int l = i == 0 ? 0 : i < 4 ? 1 : 2;
    e[i] *= 2 * kPi * kPi * double{f[l]} * g[l] * modulation;
  }
  return e;
}

double window(double distance, double range) {
  if (!(range > 0)) return 0;
  const double u = std::max(0.0, 1 - std::pow(distance / range, 4));
  return u * u;
}

}  // namespace

Irradiance9 referenceIrradiance(const DirectionalLight& light, Vec3, float wrap) {
  const Vec towards = unit(difference({}, light.direction));
  const std::array<float, 3> f = wrapCoefficients<3>(wrap);
  Irradiance9 e = basis(towards);
  for (int i = 0; i < 9; ++i) e[i] *= kPi * double{f[i == 0 ? 0 : i < 4 ? 1 : 2]};
  return e;
}

Irradiance9 referenceIrradiance(const SphereLight& light, Vec3 p, float wrap) {
  return sphere(difference(light.position, p), light.radius, 1, wrap);
}

Irradiance9 referenceIrradiance(const PointLight& light, Vec3 p, float wrap) {
  const double radius = std::max(light.radius, kMinPointRadius);
  const Vec v = difference(light.position, p);
  const double d = std::sqrt(dotOf(v, v));
  return sphere(v, radius, window(d, light.range) / (kPi * radius * radius), wrap);
}

Irradiance9 referenceIrradiance(const SpotLight& light, Vec3 p, float wrap) {
  const double radius = std::max(light.radius, kMinPointRadius);
  const Vec v = difference(light.position, p);
  const double d = std::sqrt(dotOf(v, v));
  const Vec axis = unit(difference(light.direction, {}));
  const double outer = std::cos(double{light.outerAngle});
  const double width = std::max<double>(std::cos(double{light.innerAngle}) - outer, kMinConeWidth);
  const double cosine = -dotOf(unit(v), axis) * std::min(1.0, d / radius);
  const double t = std::clamp((cosine - outer) / width, 0.0, 1.0);
  return sphere(v, radius, t * t * (3 - 2 * t) * window(d, light.range) / (kPi * radius * radius), wrap);
}

Irradiance9 referenceIrradiance(const DiskLight& light, Vec3 p, float wrap) {
  // In the frame of the cone's bisector (research/light_maths.md, section 3) the second moments are diagonal; their
  // integrals over the rim are periodic, and the midpoint rule converges geometrically.
  const Vec v = difference(light.position, p);
  Vec towards = unit(difference({}, light.direction));  // from the receiver, against the emission
  double z = dotOf(v, towards);
  if (light.twoSided && z < 0) {
    z = -z;
    for (double& x : towards) x = -x;
  }
  Irradiance9 e{};
  if (!(z > 0)) return e;
  Vec lateral;
  for (int i = 0; i < 3; ++i) lateral[i] = v[i] - z * towards[i];
  const double R = light.radius, off = std::sqrt(dotOf(lateral, lateral)), rho = off / R;
  Vec aside = unit(lateral);
  if (!(off > 0)) {
    const Vec other = std::abs(towards[0]) < 0.5 ? Vec{1, 0, 0} : Vec{0, 1, 0};
    for (int i = 0; i < 3; ++i) aside[i] = other[i] - dotOf(other, towards) * towards[i];
    aside = unit(aside);
  }
  z /= R;
  const double edge = (off - R) / R, d1 = std::hypot(rho + 1, z), d2 = std::hypot(edge, z), D = d1 * d2;
  const double m = edge * (rho + 1) + z * z, t = 4 * rho / ((d1 + d2) * (d1 + d2));
  const double sx2 = m > 0 ? 2 * z * z / (D * (D + m)) : (D - m) / (2 * D);
  const double cx2 = m > 0 ? (D + m) / (2 * D) : 2 * z * z / (D * (D - m));
  const double sy2 = sx2 + t * t * cx2, sx = std::sqrt(sx2), cx = std::sqrt(cx2), sy = std::sqrt(sy2);
  double solid = 0, cosine = 0, spread = 0;
  constexpr int kSteps = 24;
  for (int i = 0; i < kSteps; ++i) {
    const double psi = (i + 0.5) / kSteps * kPi / 2, c2 = std::cos(psi) * std::cos(psi), s2 = 1 - c2;
    const double c = cx * std::sqrt(c2 + (1 - t * t) * s2);
    solid += 1 / (1 + c);
    cosine += c;
    spread += (2 + c) * (sx2 * c2 - sy2 * s2) / (3 * (1 + c) * (1 + c));
  }
  const double V = kPi * sx * sy, scale = 2 * V / kSteps;
  solid *= scale;                        // of dw
  const double zz = cosine * scale / 2;  // of (3 z^2 - 1)/2
  spread *= 1.5 * scale;                 // of 3 (x^2 - y^2)/2
  const std::array<double, 3> moments{(spread - zz) / 2, (-spread - zz) / 2, zz};
  std::array<Vec, 3> axes;
  for (int i = 0; i < 3; ++i) {
    axes[0][i] = (sx * aside[i] - t * cx * towards[i]) / sy;
    axes[2][i] = (t * cx * aside[i] + sx * towards[i]) / sy;
  }
  for (int i = 0; i < 3; ++i)
    axes[1][i] = axes[2][(i + 1) % 3] * axes[0][(i + 2) % 3] - axes[2][(i + 2) % 3] * axes[0][(i + 1) % 3];
  const std::array<float, 3> f = wrapCoefficients<3>(wrap);
  const Irradiance9 bisector = basis(axes[2]);
  e[0] = kPi * double{f[0]} * solid * bisector[0];
  for (int i = 1; i < 4; ++i) e[i] = kPi * double{f[1]} * V * bisector[i];
  // A quadratic form n^T diag(a, b, c) n of trace 0 is a combination of Y2 about the three axes: sum a_k (2/3) P2_k.
  for (int k = 0; k < 3; ++k) {
    const Irradiance9 y = basis(axes[k]);
    for (int i = 4; i < 9; ++i) e[i] += kPi * double{f[2]} * moments[k] * 2 / 3 * y[i];
  }
  return e;
}

double largestOverNormals(const Irradiance9& e) {
  // e0 + v.n + n^T Q n, Q symmetric.
  const double a = std::sqrt(1 / (4 * kPi)), b = std::sqrt(3 / (4 * kPi)), c = std::sqrt(15 / (4 * kPi));
  const double k = c / std::sqrt(12.0);
  const double constant = e[0] * a - e[6] * k;
  const Vec v{e[3] * b, e[1] * b, e[2] * b};
  const double xx = e[8] * c / 2, zz = 3 * e[6] * k, xy = e[4] * c / 2, yz = e[5] * c / 2, xz = e[7] * c / 2;
  const auto timesQ = [&](const Vec& n) {
    return Vec{xx * n[0] + xy * n[1] + xz * n[2], xy * n[0] - xx * n[1] + yz * n[2], xz * n[0] + yz * n[1] + zz * n[2]};
  };
  const auto value = [&](const Vec& n) { return constant + dotOf(v, n) + dotOf(n, timesQ(n)); };
  static const std::vector<Vec> directions = [] {
    std::vector<Vec> d;
    constexpr int kCount = 60;
    for (int i = 0; i < kCount; ++i) {
      const double z = 1 - (2.0 * i + 1) / kCount, phi = i * 2.39996322972865332, s = std::sqrt(1 - z * z);
      d.push_back({s * std::cos(phi), s * std::sin(phi), z});
    }
    return d;
  }();
  Vec best = directions[0];
  double largest = 0;
  for (const Vec& n : directions)
    if (const double x = std::abs(value(n)); x > largest) largest = x, best = n;
  // Ascent n <- normalise(grad + shift n), which converges for a shift above the spread of Q.
  const double sign = value(best) > 0 ? 1 : -1;
  const double shift = 2 * (std::abs(xx) + std::abs(zz) + std::abs(xy) + std::abs(yz) + std::abs(xz));
  for (int i = 0; i < 8; ++i) {
    const Vec q = timesQ(best);
    Vec next;
    for (int j = 0; j < 3; ++j) next[j] = sign * (v[j] + 2 * q[j]) + shift * best[j];
    best = unit(next);
    largest = std::max(largest, std::abs(value(best)));
  }
  return largest;
}

double searchLargest(const Domain& domain, Vec3 light, unsigned seed, const std::function<double(Vec3)>& error) {
  double largest = 0;
  const Vec3 centre = domain.box.lo * 0.5f + domain.box.hi * 0.5f;
  const Vec3 half = domain.box.hi * 0.5f - domain.box.lo * 0.5f;
  const auto hold = [&](Vec3 p) {
    if (domain.kind != Domain::Kind::box) {
      Vec3 off = p - centre;
      if (domain.kind == Domain::Kind::ellipsoid && length(off) == 0) off = {half.x, 0, 0};
      const float r = length({off.x / half.x, off.y / half.y, off.z / half.z});
      if (r > 1 || domain.kind == Domain::Kind::ellipsoid) p = centre + off * (0.999999f / r);
    }
    for (int a = 0; a < 3; ++a) p[a] = std::clamp(p[a], domain.box.lo[a], domain.box.hi[a]);
    return p;
  };
  std::minstd_rand random(seed);
  std::uniform_real_distribution<float> uniform(-1, 1);
  const auto anywhere = [&] {
    return centre + Vec3{uniform(random) * half.x, uniform(random) * half.y, uniform(random) * half.z};
  };

  struct Candidate {
    double value;
    Vec3 p;
  };
  std::vector<Candidate> found;
  const auto consider = [&](Vec3 p) {
    p = hold(p);
    found.push_back({error(p), p});
  };
  consider(centre);
  consider(light);
  consider(centre * 2 - light);
  for (int corner = 0; corner < 8; ++corner)
    consider(centre +
             Vec3{corner & 1 ? half.x : -half.x, corner & 2 ? half.y : -half.y, corner & 4 ? half.z : -half.z});
  const Vec3 nearest = hold(light);
  for (int i = 0; i < 12; ++i) consider(anywhere());
  for (int i = 0; i < 12; ++i) consider(nearest + (anywhere() - centre) * (0.5f / static_cast<float>(1 << (i % 6))));
  std::ranges::sort(found, std::ranges::greater{}, &Candidate::value);

  // Random local search from the best two, with a step that shrinks on failure.
  for (int start = 0; start < 2; ++start) {
    Candidate at = found[start];
    float step = 0.3f;
    for (int i = 0; i < 40 && step > 1e-4f; ++i) {
      const Vec3 p = hold(at.p + (anywhere() - centre) * step);
      const double value = error(p);
      if (value > at.value) {
        at = {value, p};
        step *= 1.3f;
      } else {
        step *= 0.8f;
      }
    }
    largest = std::max(largest, at.value);
  }
  return largest;
}

}  // namespace rigel::test
