// The dominant light on the GPU and in C++, against double precision.
#include <gtest/gtest.h>
#include <rigel/dominant_light.h>
#include <rigel/shader_constants.h>

#include <limits>

#include "gpu/gpu_test.h"
#include "gpu/twin.h"
#include "lights/describe.h"
#include "lights/random.h"

namespace rigel::test {
namespace {

constexpr int kCases = 100'000;

tools::ShaderFunction shader() {
  tools::ShaderFunctionSource source;
  source.prelude = "#include <rigel/dominant_light.glsl>\n";
  source.inputs = {"vec3 c1", "vec3 c2", "vec3 c3"};
  source.outputs = {"vec3 direction", "vec3 irradiance"};
  source.body =
      "vec3 sh[RIGEL_SH_COUNT];\nfor (int i = 0; i < RIGEL_SH_COUNT; ++i) sh[i] = vec3(7.0);\n"
      "sh[1] = c1; sh[2] = c2; sh[3] = c3;\n"
      "RigelDominantLight light = rigel_dominantLight(sh);\n"
      "direction = light.direction; irradiance = light.irradiance;";
  return shaderFunction(source);
}

/// pi times radiance in floats, and the radiance that C++ takes: 1/pi of just that in double.
struct Band1 {
  float c[3][3];  // coefficient, channel

  RadianceSH<2> radiance() const {
    RadianceSH<2> sh;
    for (int i = 0; i < 3; ++i)
      for (int channel = 0; channel < 3; ++channel)
        sh[i + 1][channel] = static_cast<float>(static_cast<double>(c[i][channel]) / kPi);
    return sh;
  }
};

struct Exact {
  double direction[3];
  double irradiance[3];
  double terms = 0;            // of a component of the direction
  double colourTerms[3] = {};  // of the irradiance
};

Exact exactOf(const Band1& band) {
  const double luminance[3] = {kRigelLuminanceR, kRigelLuminanceG, kRigelLuminanceB};
  const int axisOf[3] = {1, 2, 0};
  double v[3][3];  // axis, channel: the vector irradiance
  double sum[3] = {}, absolute = 0;
  for (int i = 0; i < 3; ++i)
    for (int channel = 0; channel < 3; ++channel) {
      const double value = static_cast<double>(band.c[i][channel]) / kPi * std::sqrt(4 * kPi / 3);
      v[axisOf[i]][channel] = value;
      sum[axisOf[i]] += luminance[channel] * value;
      absolute += std::abs(luminance[channel] * value);
    }
  Exact out;
  const double size = std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
  double held[3], heldLuminance = 0;
  for (int axis = 0; axis < 3; ++axis) out.direction[axis] = sum[axis] / size;
  for (int channel = 0; channel < 3; ++channel) {
    double along = 0;
    for (int axis = 0; axis < 3; ++axis) along += out.direction[axis] * v[axis][channel];
    held[channel] = std::max(0.0, along);
    heldLuminance += luminance[channel] * held[channel];
  }
  out.terms = absolute / size;
  for (int channel = 0; channel < 3; ++channel) {
    out.irradiance[channel] = held[channel] * (size / heldLuminance);
    for (int axis = 0; axis < 3; ++axis) out.colourTerms[channel] += std::abs(v[axis][channel]);
    // A turn of the direction changes the colour, and all colours change each other through the luminance.
    out.colourTerms[channel] = out.colourTerms[channel] * out.terms + out.irradiance[channel] * absolute / size;
  }
  return out;
}

TEST(GpuDominantLight, AnyLight) {
  Random random(701);
  std::vector<Band1> bands;
  std::vector<std::string> families;
  std::vector<float> rows;
  for (int k = 0; k < kCases; ++k) {
    Band1 band;
    const double scale = random.logUniform(1e-30, 1e30);
    const Vec3 shared = random.direction();
    const double tint = random.index(2) == 0 ? random.uniform() : 0;  // of its own direction a channel
    for (int channel = 0; channel < 3; ++channel) {
      const Vec3 own = random.direction();
      const double strength = random.uniform();
      for (int i = 0; i < 3; ++i) {
        const int axis = (i + 1) % 3;
        band.c[i][channel] = static_cast<float>(
            scale * strength * (static_cast<double>(shared[axis]) + tint * static_cast<double>(own[axis])));
      }
    }
    const std::string tinted = tint == 0 ? "one direction" : "a direction a channel";
    families.push_back(tinted + (scale < 1e-10 ? ", dim" : scale > 1e10 ? ", bright" : ""));
    for (const auto& coefficient : band.c) rows.insert(rows.end(), coefficient, coefficient + 3);
    bands.push_back(band);
  }
  tools::ShaderFunction function = shader();
  const std::vector<float> values = run(function, rows);
  TwinFamilies directions("dominant light, direction");
  TwinFamilies colours("dominant light, irradiance");
  for (int k = 0; k < kCases; ++k) {
    const Exact exact = exactOf(bands[k]);
    const DominantLight twin = dominantLight(bands[k].radiance());
    const auto text = [&] {
      std::string out;
      for (const auto& coefficient : bands[k].c)
        for (const float value : coefficient) out += describe(value) + " ";
      return out;
    };
    for (int i = 0; i < 3; ++i) {
      directions[families[k]].add(values[6 * k + i], twin.direction[i], exact.direction[i], exact.terms, text);
      colours[families[k]].add(values[6 * k + 3 + i], twin.irradiance[i], exact.irradiance[i], exact.colourTerms[i],
                               text);
    }
  }
  directions.expectWithinTwice();
  colours.expectWithinTwice();
}

TEST(GpuDominantLight, NoLight) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInf = std::numeric_limits<float>::infinity();
  tools::ShaderFunction function = shader();
  const std::vector<std::vector<float>> dark = {{0, 0, 0, 0, 0, 0, 0, 0, 0},
                                                {kNan, 0, 0, 0, 1, 0, 0, 0, 0},
                                                {0, 1, 0, 0, 0, kNan, 0, 0, 0},
                                                {0, 1, 0, 0, kInf, 0, 0, 0, 0}};
  for (const std::vector<float>& row : dark) {
    EXPECT_EQ(run(function, row), (std::vector<float>{0, 1, 0, 0, 0, 0}));
  }
}

}  // namespace
}  // namespace rigel::test
