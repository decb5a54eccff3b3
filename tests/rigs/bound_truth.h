// The true error of leaving a light in a rig, by search: an independent double-precision light, the rig as the runtime
// fits it, and the largest difference over points and normals.
#pragma once

#include <rigel/rig_light.h>

#include <array>
#include <functional>
#include <span>

namespace rigel::test {

/// Three-band SH of one light of colour 1, times pi f_l: coefficients of irradiance.
using Irradiance9 = std::array<double, 9>;

/// From the definitions in <rigel/light.h>, in double.
Irradiance9 referenceIrradiance(const DirectionalLight& light, Vec3 p, float wrap);
Irradiance9 referenceIrradiance(const PointLight& light, Vec3 p, float wrap);
Irradiance9 referenceIrradiance(const SpotLight& light, Vec3 p, float wrap);
Irradiance9 referenceIrradiance(const SphereLight& light, Vec3 p, float wrap);
Irradiance9 referenceIrradiance(const DiskLight& light, Vec3 p, float wrap);

/// Largest |sum_i e_i Y_i(n)| over unit n: 60 directions, and ascent from the best. At most 1e-3 too small.
double largestOverNormals(const Irradiance9& e);

/// Points served: a box, the ball or the surface of the ellipsoid that it holds.
struct Domain {
  enum class Kind { box, ball, ellipsoid };
  RigBox box;
  Kind kind = Kind::box;
};

/// Largest error over the domain and all normals: found at fixed and random points and by local search, so at most the
/// truth.
template <class Light>
double trueError(const Rig& rig, const Light& light, Vec3 lightPosition, const Domain& domain, float wrap,
                 unsigned seed);

double searchLargest(const Domain& domain, Vec3 lightPosition, unsigned seed, const std::function<double(Vec3)>& error);

template <class Light>
double trueError(const Rig& rig, const Light& light, Vec3 lightPosition, const Domain& domain, float wrap,
                 unsigned seed) {
  LightSet set;
  set.add(light);
  std::array<RadianceSH<3>, 2048> functionals;
  std::array<RadianceSH<3>, kMaxShVectors> coefficients;
  const std::span f(functionals.data(), rig.projections());
  const std::span c(coefficients.data(), rig.shVectors());
  projectSamples<3>(rig, {}, set, f);
  fitRig<3>(rig, f, c);
  const std::array<float, 3> fl = wrapCoefficients<3>(wrap);
  return searchLargest(domain, lightPosition, seed, [&](Vec3 p) {
    Irradiance9 e = referenceIrradiance(light, p, wrap);
    RigBasis basis;
    rig.basis(p, basis);
    for (int i = 0; i < 9; ++i) {
      double sum = 0;
      for (int j = 0; j < basis.count; ++j) sum += double{basis.value[j]} * double{c[basis.index[j]][i].g};
      e[i] = kPi * double{fl[i == 0 ? 0 : i < 4 ? 1 : 2]} * sum - e[i];
    }
    return largestOverNormals(e);
  });
}

}  // namespace rigel::test
