// Wrap kernel, coefficients and convolution on the GPU and in C++, against double precision.
#include <gtest/gtest.h>
#include <rigel/shader_wrap.h>
#include <rigel/wrap.h>

#include <limits>

#include "gpu/gpu_test.h"
#include "gpu/near_rows.h"
#include "gpu/sh_double.h"
#include "gpu/twin.h"
#include "lights/describe.h"
#include "lights/random.h"

namespace rigel::test {
namespace {

constexpr int kCases = 200'000;

tools::ShaderFunctionSource wrapSource(std::vector<std::string> inputs, std::vector<std::string> outputs,
                                       std::string body) {
  tools::ShaderFunctionSource source;
  source.prelude = "#define RIGEL_BANDS 5\n#include <rigel/wrap.glsl>\n";
  source.inputs = std::move(inputs);
  source.outputs = std::move(outputs);
  source.body = std::move(body);
  return source;
}

/// Wraps of every kind: the ends, Lambert, all but Lambert, any.
float hardWrap(Random& random) {
  switch (random.index(6)) {
    case 0:
      return kMinWrap;
    case 1:
      return kMaxWrap;
    case 2:
      return 0;
    case 3:
      return static_cast<float>(random.logUniform(1e-10, 1e-2)) * (random.index(2) == 0 ? 1.0f : -1.0f);
    default:
      return random.uniformf(kMinWrap, kMaxWrap);
  }
}

std::string familyOf(float a) {
  if (a == kMinWrap || a == kMaxWrap) return "a at an end";
  if (a == 0) return "Lambert";
  return std::abs(a) < 1e-2f ? "all but Lambert" : a < 0 ? "a < 0" : "a > 0";
}

TEST(GpuWrap, Power) {
  Random random(601);
  std::vector<float> rows;
  for (int k = 0; k < kCases; ++k) {
    const double bases[] = {
        0, 1, 2, random.uniform(0, 2), random.logUniform(1e-22, 1), 1 + random.uniform(-1e-5, 1e-5)};
    rows.push_back(static_cast<float>(bases[random.index(6)]));
    rows.push_back(hardWrap(random));
  }
  const std::vector<float> values =
      evaluate(wrapSource({"float base", "float a"}, {"float power"}, "power = rigel_wrapPower(base, a);"), rows);
  TwinFamilies families("power of the wrap kernel");
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float base = rows[2 * i], a = rows[2 * i + 1];
    const double exact = std::pow(static_cast<double>(base), 1 + static_cast<double>(a));
    const std::string range = base == 0 || base == 1 || base == 2 ? ", base 0, 1 or 2"
                              : std::abs(base - 1) <= 1e-5f       ? ", base about 1"
                              : base < 0.01f                      ? ", small base"
                                                                  : ", any base";
    families[familyOf(a) + range].add(values[i], detail::wrapPower(base, a), exact, std::max(1.0, exact),
                                      [&] { return "base " + describe(base) + ", a " + describe(a); });
    if (base == 0 || base == 1 || a == 0) {
      EXPECT_EQ(values[i], base);
    }
  }
  families.expectWithinTwice();
}

TEST(GpuWrap, Kernel) {
  Random random(602);
  std::vector<float> rows;
  for (int k = 0; k < kCases; ++k) {
    const float a = hardWrap(random);
    const float cosines[] = {
        -1, 1, -a, std::nextafter(-a, 1.0f), -a + random.uniformf(-1e-4, 1e-4), random.uniformf(-1, 1)};
    rows.push_back(cosines[random.index(6)]);
    rows.push_back(a);
  }
  const std::vector<float> values =
      evaluate(wrapSource({"float x", "float a"}, {"float f"}, "f = rigel_wrapKernel(x, a);"), rows);
  TwinFamilies families("wrap kernel");
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float x = rows[2 * i], a = rows[2 * i + 1];
    const std::string range = std::abs(x + a) <= 1e-4f ? ", at the horizon" : std::abs(x) == 1 ? ", at an end" : "";
    families[familyOf(a) + range].add(values[i], detail::wrapKernel(x, a),
                                      wrapKernel(static_cast<double>(x), static_cast<double>(a)), 1,
                                      [&] { return "x " + describe(x) + ", a " + describe(a); });
  }
  families.expectWithinTwice();
}

TEST(GpuWrap, CoefficientsAndEnergy) {
  Random random(603);
  std::vector<float> rows;
  for (int k = 0; k < kCases; ++k) rows.push_back(hardWrap(random));
  const std::vector<float> values = evaluate(wrapSource({"float a"}, {"float f[5]", "float energy"},
                                                        "rigel_wrapCoefficients(a, f);\nenergy = rigel_wrapEnergy(a);"),
                                             rows);
  TwinFamilies coefficients("wrap coefficients");
  TwinFamilies energies("wrap energy");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const float a = rows[i];
    const std::array<float, 5> twin = wrapCoefficients<5>(a);
    const std::array<double, 5> exact = wrapCoefficientsDouble(static_cast<double>(a));
    for (std::size_t l = 0; l < 5; ++l) {
      coefficients[familyOf(a)].add(values[6 * i + l], twin[l], exact[l], 1,
                                    [&] { return "l " + std::to_string(l) + ", a " + describe(a); });
    }
    energies[familyOf(a)].add(values[6 * i + 5], wrapEnergy(a), 1 / exact[0], 1, [&] { return "a " + describe(a); });
  }
  coefficients.expectWithinTwice();
  energies.expectWithinTwice();
}

TEST(GpuWrap, ArgumentsOutOfRangeAreClamped) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInf = std::numeric_limits<float>::infinity();
  const std::vector<float> values =
      evaluate(wrapSource({"float a"}, {"float clamped"}, "clamped = rigel_clampWrap(a);"),
               std::vector<float>{-1, -0.3f, -0.2f, 0.5f, 1, 1.1f, 7, kInf, -kInf, kNan});
  EXPECT_EQ(values, (std::vector<float>{-0.25f, -0.25f, -0.2f, 0.5f, 1, 1, 1, 1, -0.25f, 0}));
}

/// f_l Y_lm(n), with and without gain, for a wrap prepared in C++ and for one that only the shader knows.
TEST(GpuWrap, ConvolvedBasis) {
  Random random(604);
  constexpr int kNormals = 20'000;  // times 25
  std::vector<float> rows, wraps, gains;
  std::vector<Vec3> normals;
  for (int k = 0; k < kNormals; ++k) {
    wraps.push_back(hardWrap(random));
    gains.push_back(random.index(2) == 0 ? 1.0f : wrapEnergy(wraps.back()));
    normals.push_back(random.direction());
    append(rows, normals.back());
    append(rows, gpuWrap(wraps.back(), gains.back()));
  }
  const std::vector<float> values = evaluate(
      wrapSource({"vec3 n", "vec4 w0", "vec4 w1", "vec4 w2", "vec4 w3"}, {"float prepared[25]", "float made[25]"},
                 "rigel_wrapBasis(n, GpuWrap(w0, w1.x, w1.y, w1.z, w1.w, w2, w3.x, w3.y, 0.0, 0.0), prepared);\n"
                 "float f[RIGEL_BANDS];\nrigel_wrapCoefficients(w1.y, f);\n"
                 "rigel_shBasis(n, made);\nrigel_convolve(f, made);"),
      rows);
  TwinFamilies prepared("convolved basis, GpuWrap");
  TwinFamilies made("convolved basis, wrap of the shader's own");
  for (int k = 0; k < kNormals; ++k) {
    const std::array<double, 5> f = wrapCoefficientsDouble(static_cast<double>(wraps[k]));
    const std::array<float, 5> twinF = wrapCoefficients<5>(wraps[k]);
    const std::vector<double> y = shDouble(normals[k], 5);
    float twinY[25];
    shBasis<5>(normals[k], twinY);
    for (int i = 0; i < 25; ++i) {
      const int l = bandOf(i);
      const double gain = gains[k];
      const auto text = [&] {
        return "i " + std::to_string(i) + ", a " + describe(wraps[k]) + ", n " + describe(normals[k]);
      };
      prepared[familyOf(wraps[k])].add(values[50 * k + i], twinF[l] * gains[k] * twinY[i], f[l] * gain * y[i],
                                       bandScale(l) * gain, text);
      made[familyOf(wraps[k])].add(values[50 * k + 25 + i], twinF[l] * twinY[i], f[l] * y[i], bandScale(l), text);
    }
  }
  prepared.expectWithinTwice();
  made.expectWithinTwice();
}

}  // namespace
}  // namespace rigel::test
