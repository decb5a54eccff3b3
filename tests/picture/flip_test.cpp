#include "picture/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>

namespace rigel::tests {
namespace {

using tools::Flip;
using tools::Image8;
using tools::Rgb8;

constexpr double kPi = 3.14159265358979323846;

// The paper's formulas one by one, in double, each filter as one sum over a square.

using Plane = std::vector<double>;
using Weight = std::function<double(int x, int y)>;

struct Lab {
  double l, a, b;
};

struct Reference {
  int width, height;
  double ppd;

  double at(const Plane& plane, int x, int y) const {
    return plane[static_cast<std::size_t>(std::clamp(y, 0, height - 1) * width + std::clamp(x, 0, width - 1))];
  }

  Plane filtered(const Plane& plane, int radius, const Weight& weight) const {
    double positive = 0, negative = 0;
    for (int y = -radius; y <= radius; ++y)
      for (int x = -radius; x <= radius; ++x) (weight(x, y) > 0 ? positive : negative) += std::abs(weight(x, y));
    Plane out(plane.size());
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (int v = -radius; v <= radius; ++v)
          for (int u = -radius; u <= radius; ++u)
            if (const double w = weight(u, v); w != 0)
              out[static_cast<std::size_t>(y * width + x)] +=
                  w / (w > 0 ? positive : negative) * at(plane, x + u, y + v);
    return out;
  }

  /// X, Y, Z of linear Rec.709 as the sRGB standard's primaries and D65 give them.
  static std::array<double, 3> xyz(double r, double g, double b) {
    return {0.412386563252992 * r + 0.357591490920625 * g + 0.180450491203564 * b,
            0.212636821677324 * r + 0.715182981841251 * g + 0.072180196481426 * b,
            0.019330620152484 * r + 0.119197163640208 * g + 0.950372587005435 * b};
  }
  static Lab huntLab(double r, double g, double b) {
    const auto c = xyz(r, g, b), white = xyz(1, 1, 1);
    const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : t * 841 / 108 + 4.0 / 29; };
    const double l = 116 * f(c[1] / white[1]) - 16;
    return {l, 0.01 * l * 500 * (f(c[0] / white[0]) - f(c[1] / white[1])),
            0.01 * l * 200 * (f(c[1] / white[1]) - f(c[2] / white[2]))};
  }
  static double hyab(Lab p, Lab q) {
    return std::abs(p.l - q.l) + std::sqrt(std::pow(p.a - q.a, 2) + std::pow(p.b - q.b, 2));
  }

  /// Solves for linear RGB by Cramer's rule: no second matrix to get wrong.
  static std::array<double, 3> linear(const std::array<double, 3>& wanted) {
    const auto r = xyz(1, 0, 0), g = xyz(0, 1, 0), b = xyz(0, 0, 1);
    const auto det = [](const auto& p, const auto& q, const auto& s) {
      return p[0] * (q[1] * s[2] - q[2] * s[1]) - q[0] * (p[1] * s[2] - p[2] * s[1]) +
             s[0] * (p[1] * q[2] - p[2] * q[1]);
    };
    const double d = det(r, g, b);
    return {det(wanted, g, b) / d, det(r, wanted, b) / d, det(r, g, wanted) / d};
  }

  struct Seen {
    std::vector<Lab> colour;
    Plane edge, point;
  };
  Seen see(const Image8& image) const {
    std::array<Plane, 3> opponent;
    const auto white = xyz(1, 1, 1);
    for (const Rgb8 pixel : image.pixels) {
      const auto decode = [](std::uint8_t byte) {
        const double s = byte / 255.0;
        return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
      };
      const auto c = xyz(decode(pixel.r), decode(pixel.g), decode(pixel.b));
      opponent[0].push_back(116 * c[1] / white[1] - 16);
      opponent[1].push_back(500 * (c[0] / white[0] - c[1] / white[1]));
      opponent[2].push_back(200 * (c[1] / white[1] - c[2] / white[2]));
    }
    const auto csf = [&](double a1, double b1, double a2, double b2) {
      return [=, this](int x, int y) {
        const double z2 = (x * x + y * y) / (ppd * ppd);
        return a1 * std::sqrt(kPi / b1) * std::exp(-kPi * kPi * z2 / b1) +
               a2 * std::sqrt(kPi / b2) * std::exp(-kPi * kPi * z2 / b2);
      };
    };
    const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * kPi * kPi)) * ppd));
    const Plane y = filtered(opponent[0], radius, csf(1, 0.0047, 0, 1));
    const Plane cx = filtered(opponent[1], radius, csf(1, 0.0053, 0, 1));
    const Plane cz = filtered(opponent[2], radius, csf(34.1, 0.04, 13.5, 0.025));
    Seen seen;
    for (std::size_t i = 0; i < y.size(); ++i) {
      const double middle = (y[i] + 16) / 116;
      auto rgb = linear({(middle + cx[i] / 500) * white[0], middle * white[1], (middle - cz[i] / 200) * white[2]});
      for (double& channel : rgb) channel = std::clamp(channel, 0.0, 1.0);
      seen.colour.push_back(huntLab(rgb[0], rgb[1], rgb[2]));
    }
    Plane achromatic = opponent[0];
    for (double& v : achromatic) v = (v + 16) / 116;
    const double sd = 0.5 * 0.082 * ppd;
    const int reach = static_cast<int>(std::ceil(3 * sd));
    const auto gauss = [sd](int u, int v) { return std::exp(-(u * u + v * v) / (2 * sd * sd)); };
    const Plane ex = filtered(achromatic, reach, [&](int u, int v) { return -u * gauss(u, v); });
    const Plane ey = filtered(achromatic, reach, [&](int u, int v) { return -v * gauss(u, v); });
    const Plane px = filtered(achromatic, reach, [&](int u, int v) { return (u * u / (sd * sd) - 1) * gauss(u, v); });
    const Plane py = filtered(achromatic, reach, [&](int u, int v) { return (v * v / (sd * sd) - 1) * gauss(u, v); });
    for (std::size_t i = 0; i < ex.size(); ++i) {
      seen.edge.push_back(std::sqrt(ex[i] * ex[i] + ey[i] * ey[i]));
      seen.point.push_back(std::sqrt(px[i] * px[i] + py[i] * py[i]));
    }
    return seen;
  }

  Plane flip(const Image8& one, const Image8& other) const {
    const Seen p = see(one), q = see(other);
    const double cmax = std::pow(hyab(huntLab(0, 1, 0), huntLab(0, 0, 1)), 0.7);
    Plane out;
    for (std::size_t i = 0; i < p.edge.size(); ++i) {
      const double c = std::pow(hyab(p.colour[i], q.colour[i]), 0.7);
      const double ec = c < 0.4 * cmax ? 0.95 / (0.4 * cmax) * c : 0.95 + (c - 0.4 * cmax) / (cmax - 0.4 * cmax) * 0.05;
      const double ef =
          std::pow(std::max(std::abs(p.edge[i] - q.edge[i]), std::abs(p.point[i] - q.point[i])) / std::sqrt(2.0), 0.5);
      out.push_back(std::pow(ec, 1 - ef));
    }
    return out;
  }
};

Image8 noise(int width, int height, int low, int high, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> byte(low, high);
  Image8 image(width, height);
  for (Rgb8& pixel : image.pixels) {
    const auto next = [&] { return static_cast<std::uint8_t>(byte(random)); };
    pixel.r = next();
    pixel.g = next();
    pixel.b = next();
  }
  return image;
}

Image8 disk(int size, double radius, Rgb8 inside, Rgb8 outside) {
  Image8 image(size, size, outside);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      if (std::hypot(x - size / 2, y - size / 2) < radius) image.at(x, y) = inside;
  return image;
}

double mean(const std::vector<float>& values) {
  double sum = 0;
  for (const float v : values) sum += static_cast<double>(v);
  return sum / static_cast<double>(values.size());
}

TEST(Flip, FollowsThePaper) {
  const auto disks = [](Rgb8 a, Rgb8 b) {
    return std::pair{disk(26, 8, a, {20, 20, 20}), disk(26, 7, b, {20, 20, 20})};
  };
  const std::pair<Image8, Image8> pairs[] = {{noise(24, 17, 0, 255, 1), noise(24, 17, 0, 255, 2)},
                                             {noise(9, 31, 0, 20, 3), noise(9, 31, 0, 20, 4)},
                                             {noise(1, 12, 200, 255, 5), noise(1, 12, 200, 255, 6)},
                                             disks({255, 0, 0}, {0, 0, 255}),
                                             disks({250, 250, 250}, {240, 250, 250}),
                                             disks({0, 255, 0}, {0, 255, 0})};
  constexpr double kTolerance = 1e-4;  // float planes against double; worst 3.5e-5
  for (const double ppd : {tools::kFlipPixelsPerDegree, 22.3}) {
    for (const auto& [one, other] : pairs) {
      const std::vector<float> fast = Flip(one, ppd).against(other);
      const Plane slow = Reference{one.width, one.height, ppd}.flip(one, other);
      ASSERT_EQ(fast.size(), slow.size());
      for (std::size_t i = 0; i < slow.size(); ++i) ASSERT_NEAR(static_cast<double>(fast[i]), slow[i], kTolerance) << i;
    }
  }
}

TEST(Flip, NothingIsSeenBetweenEqualPictures) {
  const Image8 image = noise(40, 30, 0, 255, 11);
  for (const float v : Flip(image).against(image)) EXPECT_EQ(v, 0);
}

TEST(Flip, EitherMayBeTheReference) {
  const Image8 one = noise(40, 30, 0, 255, 12), other = disk(40, 9, {200, 80, 10}, {10, 10, 10});
  Image8 cut(40, 30);
  std::copy_n(other.pixels.begin(), cut.pixels.size(), cut.pixels.begin());
  EXPECT_EQ(Flip(one).against(cut), Flip(cut).against(one));
}

TEST(Flip, KnownValues) {
  // Without structure the filters change nothing: black on white is a distance of 100 in L*, green on blue the largest.
  const auto flat = [](Rgb8 a, Rgb8 b) { return mean(Flip(Image8(32, 32, a)).against(Image8(32, 32, b))); };
  EXPECT_NEAR(flat({0, 0, 0}, {255, 255, 255}), 0.967381, 2e-5);
  EXPECT_NEAR(flat({0, 255, 0}, {0, 0, 255}), 1, 1e-5);
  EXPECT_LT(flat({100, 100, 100}, {101, 101, 101}), 0.05) << "a step of a byte is hardly seen";
}

TEST(Flip, SmallDetailsVanishWithDistance) {
  // A checkerboard of single pixels and its negative: grey from afar, two patterns from close by.
  Image8 board(48, 48), negative(48, 48);
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 48; ++x) {
      const bool light = (x + y) % 2;
      board.at(x, y) = light ? Rgb8{200, 200, 200} : Rgb8{100, 100, 100};
      negative.at(x, y) = light ? Rgb8{100, 100, 100} : Rgb8{200, 200, 200};
    }
  }
  const double far = mean(Flip(board, 120).against(negative)), near = mean(Flip(board, 8).against(negative));
  EXPECT_LT(far, 0.02);
  EXPECT_GT(near, 0.4);
}

TEST(Flip, LargerDifferencesAreLarger) {
  const Image8 reference = disk(48, 14, {120, 120, 120}, {30, 30, 30});
  double last = 0;
  for (const int step : {2, 6, 20, 60, 120}) {
    const auto v = static_cast<std::uint8_t>(120 + step);
    const double now = mean(Flip(reference).against(disk(48, 14, {v, v, v}, {30, 30, 30})));
    EXPECT_GT(now, last);
    last = now;
  }
}

}  // namespace
}  // namespace rigel::tests
