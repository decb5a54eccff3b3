// What a selection of lights and clusters is off by: double sums over all lights, at points of the ball and over
// normals.
#pragma once

#include <rigel/light_tree.h>
#include <rigel/project.h>
#include <rigel/wrap.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace rigel::test {

using DoubleSh = std::array<std::array<double, 3>, 9>;

inline void addTo(DoubleSh& sum, const RadianceSH<3>& sh, double share = 1) {
  for (int i = 0; i < 9; ++i) {
    for (int c = 0; c < 3; ++c) sum[i][c] += share * sh[i][c];
  }
}

/// All lights of the query's groups, one by one.
inline DoubleSh trueSh(const LightSet& lights, const LightQuery& query, Vec3 p) {
  DoubleSh sum{};
  for (int i = 0; i < lights.size(); ++i) {
    if ((lights.groups(i) & query.groups) == 0) continue;
    lights.visit(i, [&](const auto& light) { addTo(sum, project<3>(light, p)); });
  }
  return sum;
}

template <class F>
void visitUse(const LightSet& lights, const LightTree& tree, const LightUse& use, F&& f) {
  const auto count = static_cast<std::uint32_t>(lights.size());
  if (use.light < count)
    lights.visit(static_cast<int>(use.light), f);
  else
    f(tree.clusters()[use.light - count]);
}

/// What the selection gives at p: near uses there, distant ones by value and slope at the centre.
inline DoubleSh selectedSh(const LightSet& lights, const LightTree& tree, const LightQuery& query,
                           const LightSelection& selection, Vec3 p) {
  DoubleSh sum{};
  for (const LightUse& use : selection.nearby)
    visitUse(lights, tree, use, [&](const auto& light) { addTo(sum, project<3>(light, p), use.share); });
  const Vec3 off = p - query.centre;
  for (const LightUse& use : selection.distant) {
    visitUse(lights, tree, use, [&](const auto& light) {
      const auto sh = projectWithGradient<3>(light, query.centre);
      addTo(sum, sh.value, use.share);
      for (int axis = 0; axis < 3; ++axis) addTo(sum, sh.gradient.d[axis], use.share * double{off[axis]});
    });
  }
  return sum;
}

/// Of three-band irradiance, root mean square over the colours.
struct Irradiance {
  double rms = 0;   // over normals
  double peak = 0;  // over some thousand normals
  double mean = 0;  // over normals and colours, signed
};

inline Irradiance irradianceOf(const DoubleSh& sh, float wrap) {
  const std::array<float, 3> f = wrapCoefficients<3>(wrap);
  Irradiance out;
  DoubleSh e = sh;
  for (int i = 0; i < 9; ++i) {
    for (int c = 0; c < 3; ++c) {
      e[i][c] *= M_PI * f[i == 0 ? 0 : i < 4 ? 1 : 2];
      out.rms += e[i][c] * e[i][c] / (3 * 4 * M_PI);
    }
  }
  out.rms = std::sqrt(out.rms);
  const double y0 = std::sqrt(1 / (4 * M_PI));
  for (int c = 0; c < 3; ++c) out.mean += e[0][c] * y0 / 3;
  constexpr int kNormals = 600;
  for (int i = 0; i < kNormals; ++i) {
    const double z = 1 - (2 * i + 1.0) / kNormals, phi = i * 2.399963229728653, s = std::sqrt(1 - z * z);
    const Vec3 n{static_cast<float>(s * std::cos(phi)), static_cast<float>(s * std::sin(phi)), static_cast<float>(z)};
    float y[9];
    shBasis<3>(n, y);
    double square = 0;
    for (int c = 0; c < 3; ++c) {
      double sum = 0;
      for (int k = 0; k < 9; ++k) sum += e[k][c] * y[k];
      square += sum * sum / 3;
    }
    out.peak = std::max(out.peak, std::sqrt(square));
  }
  return out;
}

inline DoubleSh difference(const DoubleSh& a, const DoubleSh& b) {
  DoubleSh out;
  for (int i = 0; i < 9; ++i) {
    for (int c = 0; c < 3; ++c) out[i][c] = a[i][c] - b[i][c];
  }
  return out;
}

/// The centre, ends of the axes and random points of the ball.
inline std::vector<Vec3> pointsOf(const LightQuery& query, std::mt19937& random, int count) {
  std::vector<Vec3> points{query.centre};
  std::normal_distribution<float> normal;
  std::uniform_real_distribution<float> unit(0, 1);
  for (int i = 0; i < count; ++i) {
    Vec3 v{normal(random), normal(random), normal(random)};
    v = v * (query.radius * (i % 2 == 0 ? 1 : unit(random)) / std::max(length(v), 1e-6f));
    points.push_back(query.centre + v);
  }
  return points;
}

/// Most that errors are of their bounds, over the points, and the true mean at the centre.
struct SelectionError {
  double rms = 0, peak = 0;
  double mean = 0;
};

/// What float leaves of sums of projections and slopes, per whole light (5e-7 and 2e-6 in project.h).
inline constexpr double kProjectionRounding = 3e-6;

inline SelectionError errorOf(const LightSet& lights, const LightTree& tree, const LightQuery& query,
                              const LightSelection& selection, std::mt19937& random, int points = 6) {
  SelectionError out;
  for (const Vec3 p : pointsOf(query, random, points)) {
    const DoubleSh truth = trueSh(lights, query, p);
    const Irradiance whole = irradianceOf(truth, query.wrap);
    const Irradiance error = irradianceOf(difference(selectedSh(lights, tree, query, selection, p), truth), query.wrap);
    if (p == query.centre) out.mean = whole.mean;
    const double rounding = kProjectionRounding * whole.peak + 1e-30;
    out.rms = std::max(out.rms, error.rms / (selection.bound + rounding));
    out.peak = std::max(out.peak, error.peak / (selection.worst + rounding));
  }
  return out;
}

}  // namespace rigel::test
