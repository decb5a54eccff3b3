// The SH basis, SH sums and irradiance from SH on the GPU and in C++, against double precision; 2 to 5 bands.
#include <gtest/gtest.h>
#include <rigel/sh.h>
#include <rigel/wrap.h>

#include <algorithm>
#include <limits>

#include "gpu/gpu_test.h"
#include "gpu/near_rows.h"
#include "gpu/sh_double.h"
#include "gpu/twin.h"
#include "lights/describe.h"
#include "lights/random.h"

namespace rigel::test {
namespace {

constexpr int kCases = 100'000;

tools::ShaderFunctionSource sourceFor(int bands, const std::string& file) {
  tools::ShaderFunctionSource source;
  source.prelude = "#define RIGEL_BANDS " + std::to_string(bands) + "\n#include <rigel/" + file + ">\n";
  return source;
}

/// The axes, the diagonals, all but the axes, and anything.
std::vector<Vec3> hardDirections(int count) {
  Random random(501);
  std::vector<Vec3> out;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        const Vec3 v{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
        if (x != 0 || y != 0 || z != 0) out.push_back(v * (1 / length(v)));
      }
  while (static_cast<int>(out.size()) < count) {
    Vec3 v = random.direction();
    if (random.index(4) == 0) {
      v[random.index(3)] *= static_cast<float>(random.logUniform(1e-30, 1e-2));
      v = v * (1 / length(v));
    }
    out.push_back(v);
  }
  return out;
}

std::string familyOf(Vec3 w) {
  const float least = std::min({std::abs(w.x), std::abs(w.y), std::abs(w.z)});
  return least == 0 ? "in a plane of the axes" : least < 1e-2f ? "all but in such a plane" : "any";
}

template <int B>
void checkBasis() {
  tools::ShaderFunctionSource source = sourceFor(B, "sh.glsl");
  source.inputs = {"vec3 w"};
  source.outputs = {"float y[" + std::to_string(shCount(B)) + "]"};
  source.body = "rigel_shBasis(w, y);";
  const std::vector<Vec3> directions = hardDirections(kCases);
  std::vector<float> rows;
  for (const Vec3& w : directions) append(rows, w);
  const std::vector<float> y = evaluate(source, rows);
  ASSERT_EQ(y.size(), directions.size() * shCount(B));

  TwinFamilies families("SH basis, " + std::to_string(B) + " bands");
  for (std::size_t k = 0; k < directions.size(); ++k) {
    float twin[shCount(B)];
    shBasis<B>(directions[k], twin);
    const std::vector<double> exact = shDouble(directions[k], B);
    for (int i = 0; i < shCount(B); ++i) {
      families[familyOf(directions[k])].add(y[k * shCount(B) + i], twin[i], exact[i], bandScale(bandOf(i)), [&] {
        return "coefficient " + std::to_string(i) + " at " + describe(directions[k]);
      });
    }
  }
  families.expectWithinTwice();
}

TEST(GpuSh, Basis) {
  checkBasis<2>();
  checkBasis<3>();
  checkBasis<4>();
  checkBasis<5>();
}

/// Random coefficients over many orders of magnitude, alternating so that sums cancel.
template <int B>
RadianceSH<B> anyRadiance(Random& random) {
  RadianceSH<B> sh;
  const float scale = static_cast<float>(random.logUniform(1e-6, 1e6));
  for (int i = 0; i < shCount(B); ++i) {
    sh[i] = {random.uniformf(-1, 1) * scale, random.uniformf(-1, 1) * scale, random.uniformf(-1, 1) * scale};
  }
  return sh;
}

template <int B>
void checkSums() {
  Random random(502);
  const std::vector<Vec3> directions = hardDirections(kCases);
  const std::string count = std::to_string(shCount(B));
  tools::ShaderFunctionSource source = sourceFor(B, "irradiance.glsl");
  source.inputs = {"vec3 c[" + count + "]",
                   "vec3 e[" + count + "]",
                   "vec3 w",
                   "vec4 wrap0",
                   "vec4 wrap1",
                   "vec4 wrap2",
                   "vec4 wrap3"};
  source.outputs = {"vec3 value", "vec3 irradiance"};
  source.body =
      "GpuWrap wrap = GpuWrap(wrap0, wrap1.x, wrap1.y, wrap1.z, wrap1.w, wrap2, wrap3.x, wrap3.y, 0.0, 0.0);\n"
      "value = rigel_evaluate(c, w);\nirradiance = rigel_irradiance(e, w, wrap);";
  TwinFamilies values("SH sum, " + std::to_string(B) + " bands");
  TwinFamilies irradiances("irradiance of SH, " + std::to_string(B) + " bands, any wrap");
  constexpr int kBlock = 10'000;
  tools::ShaderFunction function = shaderFunction(source);
  for (int begin = 0; begin < kCases; begin += kBlock) {
    std::vector<RadianceSH<B>> shs;
    std::vector<float> wraps;
    std::vector<float> rows;
    for (int k = begin; k < begin + kBlock; ++k) {
      shs.push_back(anyRadiance<B>(random));
      wraps.push_back(random.index(3) == 0 ? 0.0f : random.uniformf(-0.25, 1));
      for (int i = 0; i < shCount(B); ++i) rows.insert(rows.end(), {shs.back()[i].r, shs.back()[i].g, shs.back()[i].b});
      for (int i = 0; i < shCount(B); ++i)
        for (int c = 0; c < 3; ++c) rows.push_back(static_cast<float>(kPi * static_cast<double>(shs.back()[i][c])));
      append(rows, directions[k]);
      append(rows, gpuWrap(wraps.back()));
    }
    const std::vector<float> results = run(function, rows);
    for (int k = 0; k < kBlock; ++k) {
      const Vec3 w = directions[begin + k];
      const Rgb value = evaluate(shs[k], w);
      const Rgb irradiance = evaluate(irradianceFromRadiance(shs[k], wraps[k]), w);
      const std::vector<double> y = shDouble(w, B);
      const std::array<double, 5> f = wrapCoefficientsDouble(static_cast<double>(wraps[k]));
      for (int c = 0; c < 3; ++c) {
        double sum = 0, terms = 0, convolved = 0, convolvedTerms = 0;
        for (int i = 0; i < shCount(B); ++i) {
          const double term = static_cast<double>(shs[k][i][c]) * y[i];
          const double factor = kPi * f[bandOf(i)];
          sum += term;
          terms += std::abs(term);
          convolved += factor * term;
          convolvedTerms += std::abs(factor * term);
        }
        const auto text = [&] { return "direction " + describe(w) + ", wrap " + describe(wraps[k]); };
        values[familyOf(w)].add(results[6 * k + c], value[c], sum, terms, text);
        irradiances[familyOf(w) + (wraps[k] == 0  ? ", Lambert"
                                   : wraps[k] < 0 ? ", a < 0"
                                                  : ", a > 0")]
            .add(results[6 * k + 3 + c], irradiance[c], convolved, convolvedTerms, text);
      }
    }
  }
  values.expectWithinTwice();
  irradiances.expectWithinTwice();
}

TEST(GpuSh, SumsAndIrradiance) {
  checkSums<2>();
  checkSums<3>();
  checkSums<4>();
  checkSums<5>();
}

TEST(GpuSh, ClampedIrradianceIsNeverNegativeNorNan) {
  tools::ShaderFunctionSource source = sourceFor(3, "irradiance.glsl");
  source.inputs = {"vec3 e"};
  source.outputs = {"vec3 clamped"};
  source.body = "clamped = rigel_clampIrradiance(e);";
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> result = evaluate(source, std::vector<float>{-1, 0, 2, kNan, -1e30f, 1e-30f});
  EXPECT_EQ(result, (std::vector<float>{0, 0, 2, 0, 0, 1e-30f}));
}

}  // namespace
}  // namespace rigel::test
