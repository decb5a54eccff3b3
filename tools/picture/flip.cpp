// All filters are sums of products of a function of x and one of y, so that each is two passes of one dimension. They
// repeat the pixels at the border.
#include "picture/flip.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>

namespace rigel::tools {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// Odd number of weights, the middle one for the pixel itself.
using Kernel = std::vector<float>;
using Plane = std::vector<float>;

template <class F>
Kernel makeKernel(int radius, const F& weight) {
  Kernel kernel;
  for (int x = -radius; x <= radius; ++x) kernel.push_back(static_cast<float>(weight(x)));
  return kernel;
}

/// Positive weights made to sum to 1, negative ones to -1.
Kernel normalised(Kernel kernel) {
  double positive = 0, negative = 0;
  for (const float w : kernel) (w > 0 ? positive : negative) += static_cast<double>(w);
  for (float& w : kernel)
    if (w != 0) w = static_cast<float>(static_cast<double>(w) / (w > 0 ? positive : -negative));
  return kernel;
}

/// Along lines of `count` pixels `step` apart, `lines` of them `lineStep` apart.
Plane convolved(const Plane& in, const Kernel& kernel, int count, int step, int lines, int lineStep) {
  const int radius = static_cast<int>(kernel.size() / 2);
  Plane out(in.size()), padded(static_cast<std::size_t>(count + 2 * radius));
  for (int line = 0; line < lines; ++line) {
    const auto at = [&](int i) { return static_cast<std::size_t>(line * lineStep + i * step); };
    for (int i = -radius; i < count + radius; ++i)
      padded[static_cast<std::size_t>(i + radius)] = in[at(std::clamp(i, 0, count - 1))];
    for (int i = 0; i < count; ++i) {
      float sum = 0;
      for (std::size_t k = 0; k < kernel.size(); ++k) sum += kernel[k] * padded[static_cast<std::size_t>(i) + k];
      out[at(i)] = sum;
    }
  }
  return out;
}

/// A picture's planes are filtered by kernels along x and along y.
struct Filter {
  int width, height;
  Plane operator()(const Plane& in, const Kernel& alongX, const Kernel& alongY) const {
    return convolved(convolved(in, alongX, width, 1, height, width), alongY, height, width, width, 1);
  }
};

/// Linear Rec.709 to CIE XYZ with the white of D65, each over that of white; and back.
struct Xyz {
  double x, y, z;
};
constexpr double kToXyz[3][3] = {{10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
                                 {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
                                 {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}};
constexpr double kWhite[3] = {kToXyz[0][0] + kToXyz[0][1] + kToXyz[0][2], kToXyz[1][0] + kToXyz[1][1] + kToXyz[1][2],
                              kToXyz[2][0] + kToXyz[2][1] + kToXyz[2][2]};
constexpr double kFromXyz[3][3] = {{3.241003275, -1.537398934, -0.498615861},
                                   {-0.969224334, 1.875930071, 0.041554224},
                                   {0.055639423, -0.204011202, 1.057148933}};

Xyz xyzOf(double r, double g, double b) {
  const auto row = [&](int i) { return (kToXyz[i][0] * r + kToXyz[i][1] * g + kToXyz[i][2] * b) / kWhite[i]; };
  return {row(0), row(1), row(2)};
}

double decodeSrgb(std::uint8_t byte) {
  const double s = byte / 255.0;
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

struct Colour {
  double l, a, b;
};

/// L* a* b* of a colour, its chroma less the darker it is (Hunt's effect).
Colour seenColour(Xyz c) {
  const auto f = [](double t) {
    constexpr double kDelta = 6.0 / 29;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29;
  };
  const double fx = f(c.x), fy = f(c.y), fz = f(c.z);
  const double l = 116 * fy - 16;
  return {l, 0.01 * l * 500 * (fx - fy), 0.01 * l * 200 * (fy - fz)};
}

/// HyAB distance, compressed.
double colourDistance(Colour p, Colour q) {
  constexpr double kExponent = 0.7;
  return std::pow(std::abs(p.l - q.l) + std::hypot(p.a - q.a, p.b - q.b), kExponent);
}

/// From distances to [0, 1]: most of the range is for the smaller ones.
double redistributed(double distance, double largest) {
  constexpr double kKnee = 0.4, kAtKnee = 0.95;
  const double knee = kKnee * largest;
  if (distance < knee) return kAtKnee / knee * distance;
  return kAtKnee + (distance - knee) / (largest - knee) * (1 - kAtKnee);
}

/// A term a sqrt(pi / b) exp(-pi^2 x^2 / b) of the eye's contrast sensitivity as a filter; x in degrees.
struct Term {
  double a, b;
};
constexpr Term kAchromatic[] = {{1, 0.0047}}, kRedGreen[] = {{1, 0.0053}},
               kBlueYellow[] = {{34.1, 0.04}, {13.5, 0.025}};
constexpr double kWidestTerm = 0.04;

Plane seenThrough(std::span<const Term> terms, const Plane& plane, const Filter& filter, double pixelsPerDegree) {
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(kWidestTerm / (2 * kPi * kPi)) * pixelsPerDegree));
  Plane out(plane.size());
  double total = 0;
  for (const Term& term : terms) {
    const auto gaussian = [&](int x) {
      const double degrees = x / pixelsPerDegree;
      return std::exp(-kPi * kPi * degrees * degrees / term.b);
    };
    double sum = 0;
    for (int x = -radius; x <= radius; ++x) sum += gaussian(x);
    const double weight = term.a * std::sqrt(kPi / term.b) * sum * sum;
    const Kernel kernel = normalised(makeKernel(radius, gaussian));
    const Plane part = filter(plane, kernel, kernel);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += static_cast<float>(weight) * part[i];
    total += weight;
  }
  for (float& v : out) v /= static_cast<float>(total);
  return out;
}

Plane lengths(const Plane& x, const Plane& y) {
  Plane out(x.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = std::hypot(x[i], y[i]);
  return out;
}

}  // namespace

Flip::Flip(const Image8& reference, double pixelsPerDegree)
    : width_(reference.width),
      height_(reference.height),
      pixelsPerDegree_(pixelsPerDegree),
      reference_(see(reference)) {}

Flip::Seen Flip::see(const Image8& image) const {
  const std::size_t count = image.pixels.size();
  const Filter filter{width_, height_};
  // Opponent colours that are linear in light: Y = 116 y - 16, Cx = 500 (x - y), Cz = 200 (y - z).
  Plane luminance(count), redGreen(count), blueYellow(count);
  std::array<double, 256> decoded;
  for (std::size_t i = 0; i < decoded.size(); ++i) decoded[i] = decodeSrgb(static_cast<std::uint8_t>(i));
  for (std::size_t i = 0; i < count; ++i) {
    const Rgb8 pixel = image.pixels[i];
    const Xyz c = xyzOf(decoded[pixel.r], decoded[pixel.g], decoded[pixel.b]);
    luminance[i] = static_cast<float>(c.y);
    redGreen[i] = static_cast<float>(500 * (c.x - c.y));
    blueYellow[i] = static_cast<float>(200 * (c.y - c.z));
  }

  Seen seen;
  const Plane y = seenThrough(kAchromatic, luminance, filter, pixelsPerDegree_);
  const Plane cx = seenThrough(kRedGreen, redGreen, filter, pixelsPerDegree_);
  const Plane cz = seenThrough(kBlueYellow, blueYellow, filter, pixelsPerDegree_);
  for (Plane& plane : seen.colour) plane.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double middle = static_cast<double>(y[i]);
    const double xyz[3] = {(middle + static_cast<double>(cx[i]) / 500) * kWhite[0], middle * kWhite[1],
                           (middle - static_cast<double>(cz[i]) / 200) * kWhite[2]};
    double rgb[3];
    for (int c = 0; c < 3; ++c)
      rgb[c] = std::clamp(kFromXyz[c][0] * xyz[0] + kFromXyz[c][1] * xyz[1] + kFromXyz[c][2] * xyz[2], 0.0, 1.0);
    const Colour colour = seenColour(xyzOf(rgb[0], rgb[1], rgb[2]));
    seen.colour[0][i] = static_cast<float>(colour.l);
    seen.colour[1][i] = static_cast<float>(colour.a);
    seen.colour[2][i] = static_cast<float>(colour.b);
  }

  // Derivatives of a Gaussian as wide as the eye's feature detectors.
  constexpr double kDetectorWidth = 0.082;  // degrees
  const double deviation = 0.5 * kDetectorWidth * pixelsPerDegree_;
  const int radius = static_cast<int>(std::ceil(3 * deviation));
  const auto gaussian = [&](int x) { return std::exp(-x * x / (2 * deviation * deviation)); };
  const Kernel smooth = normalised(makeKernel(radius, gaussian));
  const Kernel slope = normalised(makeKernel(radius, [&](int x) { return -x * gaussian(x); }));
  const Kernel bend =
      normalised(makeKernel(radius, [&](int x) { return (x * x / (deviation * deviation) - 1) * gaussian(x); }));
  seen.edge = lengths(filter(luminance, slope, smooth), filter(luminance, smooth, slope));
  seen.point = lengths(filter(luminance, bend, smooth), filter(luminance, smooth, bend));
  return seen;
}

std::vector<float> Flip::against(const Image8& test) const {
  assert(test.width == width_ && test.height == height_);
  const double largest = colourDistance(seenColour(xyzOf(0, 1, 0)), seenColour(xyzOf(0, 0, 1)));
  const Seen other = see(test);
  std::vector<float> out(test.pixels.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto colourOf = [i](const Seen& seen) {
      const auto value = [&](std::size_t c) { return static_cast<double>(seen.colour[c][i]); };
      return Colour{value(0), value(1), value(2)};
    };
    const double colour = redistributed(colourDistance(colourOf(reference_), colourOf(other)), largest);
    const auto change = [i](const Plane& a, const Plane& b) { return static_cast<double>(std::abs(a[i] - b[i])); };
    const double feature = std::sqrt(
        std::max(change(reference_.edge, other.edge), change(reference_.point, other.point)) / std::sqrt(2.0));
    out[i] = static_cast<float>(std::pow(colour, 1 - feature));
  }
  return out;
}

}  // namespace rigel::tools
