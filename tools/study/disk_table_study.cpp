// What the disk table's size and format cost in error, beside the table as one would lay it out first: the moments
// themselves over the angles ax and asin t. Errors are relative to ||q||, over all of the table's domain, eight points
// a texel and axis.
#include <rigel/disk.h>
#include <rigel/disk_table.h>
#include <rigel/half.h>
#include <rigel/make_disk_table.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "look_up.h"

namespace rigel::tools {
namespace {

using Cone = detail::DiskCone<double>;
using Moments = detail::DiskMoments<double>;

constexpr int kPointsPerTexel = 8;

/// Of moments per vector irradiance; q10 is Y_10(Z).
struct Error {
  double threeBands = 0, fiveBands = 0;

  static Error between(const Moments& q, const Moments& exact) {
    const auto square = [](double x) { return x * x; };
    const double norm3 = square(kRigelY1) + square(exact.q00) + square(exact.q20) + square(exact.q22);
    const double norm5 =
        norm3 + square(exact.q30) + square(exact.q32) + square(exact.q40) + square(exact.q42) + square(exact.q44);
    const double error3 = square(q.q00 - exact.q00) + square(q.q20 - exact.q20) + square(q.q22 - exact.q22);
    const double error5 = error3 + square(q.q30 - exact.q30) + square(q.q32 - exact.q32) + square(q.q40 - exact.q40) +
                          square(q.q42 - exact.q42) + square(q.q44 - exact.q44);
    return {std::sqrt(error3 / norm3), std::sqrt(error5 / norm5)};
  }
};

/// The worst of all points, and the root mean square with five bands.
struct Summary {
  Error worst;
  double squares = 0;
  int count = 0;

  void add(Error error) {
    worst = {std::max(worst.threeBands, error.threeBands), std::max(worst.fiveBands, error.fiveBands)};
    squares += error.fiveBands * error.fiveBands;
    ++count;
  }
  double rms() const { return std::sqrt(squares / count); }
};

/// `f(x, y)`, both in (0, 1): centres of a grid that is finer than the table.
template <class F>
Summary overDomain(int size, const F& f) {
  const int n = kPointsPerTexel * (size - 1);
  Summary summary;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) summary.add(f((i + 0.5) / n, (j + 0.5) / n));
  }
  return summary;
}

float throughHalf(float x) {
  const std::uint16_t half = halfFromFloat(x);
  const int exponent = half >> 10 & 31;
  const double mantissa = half & 1023;
  const double size = exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
  return static_cast<float>(half & 0x8000 ? -size : size);
}

/// Rigel's, by the look-up of the library.
Summary ours(int size, bool half) {
  DiskTableTexels table = makeDiskTable(size);
  if (half) {
    for (auto& texture : table.texels) std::ranges::transform(texture, texture.begin(), throughHalf);
  }
  const DiskTableView view{size, table.texels[0], table.texels[1]};
  return overDomain(size, [&](double x, double y) {
    const double u = std::pow(1 - y, 4.0 / 3.0);
    const Cone cone = detail::diskConeOf(std::sqrt(x * (2 - x)), 1 - x, std::sqrt((1 - u) * (1 + u)), u * u);
    const auto narrow = [](double value) { return static_cast<float>(value); };
    const auto seen = detail::diskConeOf(narrow(cone.sx), narrow(cone.cx), narrow(cone.t), narrow(u * u));
    const auto q = detail::tabulatedMoments<5>(view, seen);
    return Error::between({q.q00, q.q20, q.q22, q.q30, q.q32, q.q40, q.q42, q.q44}, detail::exactDiskMoments(cone));
  });
}

/// The moments, sampled at the texels, over x = ax/90 degrees and y = asin(t)/90 degrees.
Summary overAngles(int size, bool half) {
  const auto coneAt = [](double x, double y) {
    const double ax = x * kPi / 2, beta = y * kPi / 2, u = y == 1 ? 0 : std::cos(beta);
    return detail::diskConeOf(std::sin(ax), x == 1 ? 0 : std::cos(ax), std::sin(beta), u * u);
  };
  using Texel = std::array<float, 6>;
  std::vector<Texel> texels;
  for (int j = 0; j < size; ++j) {
    for (int i = 0; i < size; ++i) {
      const Moments q = detail::exactDiskMoments(coneAt(i / (size - 1.0), j / (size - 1.0)));
      Texel texel;
      std::ranges::transform(std::array{q.q00, q.q20, q.q22, q.q40, q.q42, q.q44}, texel.begin(), [&](double value) {
        return half ? throughHalf(static_cast<float>(value)) : static_cast<float>(value);
      });
      texels.push_back(texel);
    }
  }
  return overDomain(size, [&](double x, double y) {
    const int i = static_cast<int>(x * (size - 1)), j = static_cast<int>(y * (size - 1));
    const double right = x * (size - 1) - i, down = y * (size - 1) - j;
    const Texel* texel = &texels[static_cast<std::size_t>(j * size + i)];
    const auto value = [&](std::size_t m) {
      const double upper = std::lerp(double(texel[0][m]), double(texel[1][m]), right);
      return std::lerp(upper, std::lerp(double(texel[size][m]), double(texel[size + 1][m]), right), down);
    };
    const Moments exact = detail::exactDiskMoments(coneAt(x, y));
    return Error::between({value(0), value(1), value(2), exact.q30, exact.q32, value(3), value(4), value(5)}, exact);
  });
}

void print(const char* layout, int size, bool half, const Summary& summary) {
  const int bytes = 2 * 4 * size * size * (half ? 2 : 4);
  fmt::print("| {} | {} | {} | {} | {:.1e} | {:.1e} | {:.1e} |\n", layout, size, half ? "half" : "float", bytes,
             summary.worst.threeBands, summary.worst.fiveBands, summary.rms());
}

void run() {
  fmt::print("| texels hold | size | format | bytes | worst, 3 bands | worst, 5 bands | rms, 5 bands |\n");
  fmt::print("|---|---|---|---|---|---|---|\n");
  for (const int size : {16, 32, 64}) {
    for (const bool half : {false, true}) print("what one node leaves", size, half, ours(size, half));
  }
  for (const int size : {16, 32, 64}) {
    for (const bool half : {false, true}) print("moments over angles", size, half, overAngles(size, half));
  }
}

}  // namespace
}  // namespace rigel::tools

int main() { rigel::tools::run(); }
