// Runs a rig's shader functions beside their C++ twins and the double reference.
#pragma once

#include "gpu/gpu_test.h"
#include "gpu/packed_rig.h"
#include "gpu/rig_cases.h"
#include "gpu/rig_reference.h"
#include "gpu/twin.h"

#include <numbers>
#include <sstream>

namespace rigel::test {

/// `body` sets e from rig, p and y, or sh from rig and p. `defines` come before the library.
inline tools::ShaderFunctionSource rigSource(int bands, const std::string& defines, const std::string& body,
                                             bool wantsSh = false) {
  const std::string count = std::to_string(bands * bands);
  tools::ShaderFunctionSource source;
  source.prelude = "#define RIGEL_BANDS " + std::to_string(bands) + "\n" + defines +
                   "#include <rigel/rig.glsl>\n#include <rigel/rig_texture.glsl>\n";
  source.inputs = {"vec3 p", "float y[" + count + "]"};
  source.outputs = {wantsSh ? "vec3 sh[" + count + "]" : "vec3 e"};
  source.uniforms = "GpuRig rig;";
  source.body = body;
  source.texels = true;
  return source;
}

template <class T>
void setUniforms(tools::ShaderFunction& function, const T& value) {
  function.setUniforms(std::as_bytes(std::span(&value, 1)));
}

/// A rig with what is evaluated of it.
template <int B>
struct RigRun {
  std::string name;
  const Rig& rig;
  RigFrame frame;
  std::vector<RadianceSH<B>> coefficients;  // K, or fewer for a prefix
  std::vector<Vec3> points;
  std::vector<float> basis;  // a row of f_l Y_lm a point

  RigRun(std::string what, const Rig& r, const RigFrame& f, int vectors, int count, Random& random)
      : name(std::move(what)), rig(r), frame(f) {
    coefficients = randomCoefficients<B>(vectors, random.logUniform(1e-3, 1e4), random);
    points = rigPoints(rig.box(), frame, count, random);
    for (std::size_t i = 0; i < points.size(); ++i) {
      float y[shCount(B)];
      shBasis<B>(random.direction(), y);
      const auto wrap = wrapCoefficients<B>(random.index(2) == 0 ? 0.0f : random.uniformf(-0.25, 1));
      for (int l = 0, j = 0; l < B; ++l)
        for (; j < (l + 1) * (l + 1); ++j) basis.push_back(y[j] * wrap[l]);
    }
  }

  std::span<const float> basisOf(std::size_t i) const { return std::span(basis).subspan(i * shCount(B), shCount(B)); }

  std::vector<float> rows() const {
    std::vector<float> out;
    for (std::size_t i = 0; i < points.size(); ++i) {
      out.insert(out.end(), {points[i].x, points[i].y, points[i].z});
      out.insert(out.end(), basisOf(i).begin(), basisOf(i).end());
    }
    return out;
  }

  /// In float32 from `offset` on, with the nodes of @gauss behind; moves `offset` beyond.
  GpuRig packInto(std::span<GpuVec4> buffer, int& offset, int paddedVectors = 0) const {
    const int gaussOffset = offset + packRigBound(rig, B, paddedVectors);
    const GpuRig packed = packRig<B>(rig, frame, coefficients, {}, {offset, paddedVectors, gaussOffset}, buffer);
    packGaussNodes(rig, buffer.subspan(gaussOffset));
    offset = gaussOffset + packGaussNodesBound(rig);
    return packed;
  }

  /// The SH vector at a point in C++, the K vectors' prefix.
  RadianceSH<B> twinSh(Vec3 world) const {
    RigBasis phi;
    rig.basis(frame.inversePoint(world), phi);
    RadianceSH<B> sum;
    for (int j = 0; j < phi.count; ++j) {
      const auto k = static_cast<std::size_t>(phi.index[j]);
      if (k >= coefficients.size()) continue;
      for (int i = 0; i < shCount(B); ++i) sum[i] += coefficients[k][i] * phi.value[j];
    }
    return sum * static_cast<float>(kPi);
  }

  static bool isNumber(Vec3 p) { return dot(p, p) >= 0; }

  std::string describe(std::size_t i) const {
    std::ostringstream text;
    text.precision(9);
    const Vec3 p = points[i];
    text << name << ", K " << coefficients.size() << ", p " << p.x << ' ' << p.y << ' ' << p.z << ", origin "
         << frame.origin.x << ' ' << frame.origin.y << ' ' << frame.origin.z;
    return text.str();
  }

  /// `results`: irradiance a point. Points without a number count for `nowhere`, where there is one.
  void checkIrradiance(std::span<const float> results, TwinCheck& numbers, TwinCheck* nowhere = nullptr) const {
    checkIrradiance(results, numbers, nowhere, [this](Vec3 p) { return twinSh(p); });
  }

  /// Beside another twin: an SH vector at a point.
  template <class TwinSh>
  void checkIrradiance(std::span<const float> results, TwinCheck& numbers, TwinCheck* nowhere,
                       const TwinSh& twinAt) const {
    const RigReference reference(rig, frame);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const RigReference::Basis phi = reference.at(points[i]);
      const RadianceSH<B> sh = twinAt(points[i]);
      TwinCheck& check = isNumber(points[i]) || nowhere == nullptr ? numbers : *nowhere;
      Rgb twin;
      for (int j = 0; j < shCount(B); ++j) twin += sh[j] * basisOf(i)[j];
      for (int c = 0; c < 3; ++c) {
        double exact = 0, sum = 0;
        for (std::size_t k = 0; k < coefficients.size(); ++k)
          for (int j = 0; j < shCount(B); ++j) {
            const double term =
                std::numbers::pi * static_cast<double>(coefficients[k][j][c]) * static_cast<double>(basisOf(i)[j]);
            exact += term * phi.value[k];
            sum += std::abs(term) * phi.absolute[k];
          }
        check.add(results[3 * i + c], twin[c], exact, sum, [&] { return describe(i); });
      }
    }
  }

  /// `results`: an SH vector a point.
  void checkSh(std::span<const float> results, TwinCheck& numbers, TwinCheck* nowhere = nullptr) const {
    const RigReference reference(rig, frame);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const RigReference::Basis phi = reference.at(points[i]);
      const RadianceSH<B> twin = twinSh(points[i]);
      TwinCheck& check = isNumber(points[i]) || nowhere == nullptr ? numbers : *nowhere;
      for (int j = 0; j < shCount(B); ++j)
        for (int c = 0; c < 3; ++c) {
          double exact = 0, sum = 0;
          for (std::size_t k = 0; k < coefficients.size(); ++k) {
            const double term = std::numbers::pi * static_cast<double>(coefficients[k][j][c]);
            exact += term * phi.value[k];
            sum += std::abs(term) * phi.absolute[k];
          }
          check.add(results[3 * (i * shCount(B) + j) + c], twin[j][c], exact, sum, [&] { return describe(i); });
        }
    }
  }
};

/// `run_` alone, in a buffer whose other numbers are not any; `function` of rigSource.
template <int B>
std::vector<float> runPacked(tools::ShaderFunction& function, const RigRun<B>& run_, int paddedVectors = 0) {
  const auto nan = std::numeric_limits<float>::quiet_NaN();
  // Always of one size, or lavapipe compiles anew.
  std::vector<GpuVec4> buffer(10240, GpuVec4{nan, nan, nan, nan});
  int offset = 5;
  setUniforms(function, run_.packInto(buffer, offset, paddedVectors));
  function.setTexels(floatsOf(buffer));
  return run(function, run_.rows());
}

}  // namespace rigel::test
