// The functions of shader_arctangent.h and shader_near_cap.h in both languages, against the same formulas in double.
#include <gtest/gtest.h>
#include <rigel/near_light.h>
#include <rigel/shader_near_cap.h>

#include "gpu/gpu_test.h"
#include "gpu/near_rows.h"
#include "gpu/sh_double.h"
#include "gpu/twin.h"
#include "lights/describe.h"
#include "lights/random.h"

namespace rigel::test {
namespace {

constexpr int kCases = 100'000;

double wrapPowerDouble(double base, double a) { return base > 0 ? std::pow(base, 1 + a) : 0; }

double lambertCapDouble(double x, double s, double c) {
  if (std::abs(x) >= s) return std::max(x, 0.0);
  const double t = x / s, z = std::sqrt((1 - t) * (1 + t)), sz = s * z;
  // The terms of size s cancel to s^3; s is large enough here for double to bear it.
  return std::max(0.0, s * s * s * t * std::atan2(z, -c * t) - sz * c + std::atan2(sz, c)) / (kPi * s * s);
}

double blurredKernelDouble(double x, double width, const GpuWrap& wrap) {
  const double a = wrap.a, half = std::max(width, 1e-6);
  const double u = (x + a) / (1 + a);
  const double t = 1 + std::clamp(u / half, -1.0, 1.0);
  return wrapPowerDouble(0.25 * half * t * t + std::max(u - half, 0.0), a);
}

double shareDouble(double s2) { return std::max(0.0, 1 - s2 * (2.111 + 1.709 * s2)); }

double legendre(int l, double x) { return std::legendre(static_cast<unsigned>(l), x); }

double wrapCapDouble(double x, double s, double c, const GpuWrap& wrap) {
  const double s2 = s * s, h = shareDouble(s2), blur = s2 * (1 - 1.474 * s2);
  const double factor[5] = {2 / (1 + c), 1, c, 1 - 1.25 * s2, c * (1 - 1.75 * s2)};
  const double f[5] = {wrap.f.x, wrap.f.y, wrap.f.z, wrap.f.w, wrap.f4};
  const double band[5] = {wrap.blurBand.x, wrap.blurBand.y, wrap.blurBand.z, wrap.blurBand.w, wrap.blurBand4};
  double e = h * static_cast<double>(wrap.gain) * blurredKernelDouble(x, static_cast<double>(wrap.blur) * s, wrap);
  for (int l = 0; l < 5; ++l) e += (2 * l + 1) / 4.0 * (f[l] * (factor[l] - h) - h * blur * band[l]) * legendre(l, x);
  if (h <= 0) e = std::min(e, f[0] / s2);
  return std::max(e, 0.0);
}

double aboveBand2Double(double x, const GpuWrap& wrap) {
  double sum = wrap.a == 0 ? std::max(x, 0.0) : blurredKernelDouble(x, 0, wrap);
  sum *= static_cast<double>(wrap.gain);
  const double f[3] = {wrap.f.x, wrap.f.y, wrap.f.z};
  for (int l = 0; l < 3; ++l) sum -= (2 * l + 1) / 4.0 * f[l] * legendre(l, x);
  return sum;
}

TEST(GpuNearCap, Arctangent) {
  Random random(801);
  std::vector<float> rows;
  for (int k = 0; k < kCases; ++k) {
    const double y[] = {0, 1, random.uniform(), random.logUniform(1e-12, 1e12)};
    const double x[] = {0, 1, random.uniform(), random.logUniform(1e-12, 1e12)};
    rows.push_back(static_cast<float>(y[random.index(4)]));
    rows.push_back(static_cast<float>(x[random.index(4)]));
  }
  tools::ShaderFunctionSource source;
  source.prelude = "#include <rigel/shader_arctangent.h>\n";
  source.inputs = {"float y", "float x"};
  source.outputs = {"float angle", "float tail"};
  source.body = "angle = rigel_atanQuadrant(y, x);\ntail = rigel_atanTail(min(1.0, y * y));";
  const std::vector<float> values = evaluate(source, rows);
  TwinFamilies angles("arc tangent of the quadrant");
  TwinFamilies tails("arc tangent less its argument");
  for (int k = 0; k < kCases; ++k) {
    const float y = rows[2 * k], x = rows[2 * k + 1];
    const auto text = [&] { return "y " + describe(y) + ", x " + describe(x); };
    const std::string family = y == 0 || x == 0 ? "on an axis"
                               : y == x         ? "on the diagonal"
                               : y < 1e-3f * x  ? "all but on x"
                               : 1e-3f * y > x  ? "all but on y"
                               : y < x          ? "nearer x"
                                                : "nearer y";
    angles[family].add(values[2 * k], detail::atanQuadrant(y, x),
                       std::atan2(static_cast<double>(y), static_cast<double>(x)), kPi / 2, text);
    const float square = std::min(1.0f, y * y);
    const double root = std::sqrt(static_cast<double>(square));
    const double exact = root > 1e-2 ? (root - std::atan(root)) / (root * root * root)
                                     : 1.0 / 3 - root * root / 5 + std::pow(root, 4) / 7;
    tails[y >= 1      ? "from 1 on"
          : y > 0.01f ? "to 1"
                      : "to 0.01"]
        .add(values[2 * k + 1], detail::atanTail(square), exact, 1.0 / 3, text);
  }
  angles.expectWithinTwice();
  tails.expectWithinTwice();
}

TEST(GpuNearCap, Caps) {
  struct Row {
    float x, s, c, width;
    GpuWrap wrap;
    std::string family;
  };
  Random random(802);
  std::vector<Row> cases;
  std::vector<float> rows;
  for (int k = 0; k < kCases; ++k) {
    Row row;
    row.s = random.uniformf(1e-3, 1);
    if (random.index(8) == 0) row.s = 1;
    row.c = std::sqrt((1 - row.s) * (1 + row.s));
    const float x[] = {row.s, -row.s, 0, random.uniformf(-1, 1) * row.s, random.uniformf(-1, 1)};
    const char* where[] = {"at its rim above", "at its rim below", "at its middle", "across", "anywhere"};
    const int i = random.index(5);
    row.x = x[i];
    row.wrap = gpuWrap(random.index(4) == 0 ? 0.0f : random.uniformf(-0.25, 1), random.uniformf(0.5, 1.5));
    row.family = std::string("horizon ") + where[i] + (row.s == 1 ? ", all round" : "") +
                 (row.wrap.a == 0  ? ", Lambert"
                  : row.wrap.a < 0 ? ", a < 0"
                                   : ", a > 0");
    row.width = random.uniformf(0, 0.6);
    rows.insert(rows.end(), {row.x, row.s, row.c, row.width});
    append(rows, row.wrap);
    cases.push_back(row);
  }
  tools::ShaderFunctionSource source;
  source.prelude = "#include <rigel/shader_near_cap.h>\n";
  source.inputs = {"float x", "float s", "float c", "float width", "vec4 w0", "vec4 w1", "vec4 w2", "vec4 w3"};
  source.outputs = {"float lambert", "float cheap", "float kernel", "float share", "float cap", "float above"};
  source.body =
      "GpuWrap wrap = GpuWrap(w0, w1.x, w1.y, w1.z, w1.w, w2, w3.x, w3.y, 0.0, 0.0);\n"
      "lambert = rigel_lambertCap(x, s, c);\ncheap = rigel_lambertCapCheap(x, s, c);\n"
      "kernel = rigel_blurredKernel(x, width, wrap);\nshare = rigel_highBandShare(s * s);\n"
      "cap = rigel_wrapCap(x, s, c, wrap);\nabove = rigel_kernelAboveBand2(x, wrap);";
  const std::vector<float> values = evaluate(source, rows);
  TwinFamilies lambert("Lambert cap"), cheap("cheap Lambert cap"), kernel("blurred kernel"),
      share("share of high bands"), cap("wrap cap"), above("kernel above band 2");
  for (int k = 0; k < kCases; ++k) {
    const Row& row = cases[k];
    // The float c is c to within rounding; terms of size s that cancel to s^3 want s^2 + c^2 = 1.
    const double x = row.x, s = row.s, c = std::sqrt((1 - s) * (1 + s));
    const float* v = &values[6 * k];
    const auto text = [&] {
      return "x " + describe(row.x) + ", s " + describe(row.s) + ", width " + describe(row.width) + ", a " +
             describe(row.wrap.a);
    };
    lambert[row.family].add(v[0], detail::lambertCap(row.x, row.s, row.c), lambertCapDouble(x, s, c), 1, text);
    const double t = std::clamp(x / s, -1.0, 1.0), g = 1 + c * (-2.818 + c * (2.973 - c * 1.285));
    cheap[row.family].add(v[1], detail::lambertCapCheap(row.x, row.s, row.c),
                          std::max(x - s, 0.0) + 0.25 * s * (1 + t) * (1 + t + g * (1 - t)), 1, text);
    kernel[row.family].add(v[2], detail::blurredKernel(row.x, row.width, row.wrap),
                           blurredKernelDouble(x, static_cast<double>(row.width), row.wrap), 1, text);
    share[row.family].add(v[3], detail::highBandShare(row.s * row.s), shareDouble(s * s), 1, text);
    cap[row.family].add(v[4], detail::wrapCap(row.x, row.s, row.c, row.wrap), wrapCapDouble(x, s, c, row.wrap),
                        static_cast<double>(row.wrap.gain), text);
    above[row.family].add(v[5], detail::kernelAboveBand2(row.x, row.wrap), aboveBand2Double(x, row.wrap),
                          static_cast<double>(row.wrap.gain), text);
  }
  for (const TwinFamilies* check : {&lambert, &cheap, &kernel, &share, &cap, &above}) check->expectWithinTwice();
}

}  // namespace
}  // namespace rigel::test
