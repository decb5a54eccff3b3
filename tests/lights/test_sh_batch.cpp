// SH that vary from point to point, in vectors, on every instruction set of this machine, against sums in double over
// the basis that test_sh_basis.cpp holds to 50 digits.
#include <gtest/gtest.h>
#include <rigel/sh_batch.h>
#include <rigel/wrap.h>

#include <limits>

#include "lights/batch_points.h"
#include "lights/every_target.h"
#include "lights/random.h"
#include "reference/worst.h"

namespace rigel {
namespace {

using reference::Worst;
using test::BatchPoints;
using test::onEveryTarget;
using test::Random;

// Of the sum of the terms' sizes. Worst measured 2.3e-7 (SSE2, five bands): rounding of the polynomials and of some
// dozens of sums; of a single band 2.0e-7.
constexpr double kTolerance = 4e-7;
constexpr float kUntouched = -12345;
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

template <int B>
struct Batch {
  std::vector<RadianceSH<B>> sh;
  std::vector<float> weights;
  std::array<float, B> bands;
  BatchPoints normals;

  Batch(Random& random, std::size_t vectors, std::size_t points, float wrap, int offset)
      : sh(vectors), bands(wrapCoefficients<B>(wrap)), normals(offset) {
    for (auto& of : sh)
      for (int i = 0; i < 3 * shCount(B); ++i) of.data()[i] = random.uniformf(-1, 1);
    for (std::size_t i = 0; i < vectors * points; ++i) weights.push_back(i % 7 == 0 ? 0.0f : random.uniformf(-2, 2));
    for (std::size_t i = 0; i < points; ++i) normals.add(random.direction());
  }

  std::vector<float> irradiance() const {
    std::vector<float> out(3 * normals.size() + 1, kUntouched);
    irradianceBatch<B>(sh, weights, bands, normals.rows(), std::span(out).first(3 * normals.size()));
    EXPECT_EQ(out.back(), kUntouched);
    return out;
  }

  void compare(Worst& worst, const std::string& what) const {
    const std::size_t count = normals.size();
    const std::vector<float> all = irradiance();
    for (std::size_t p = 0; p < count; ++p) {
      float y[shCount(B)];
      shBasis<B>(normals[p], y);
      for (std::size_t c = 0; c < 3; ++c) {
        double sum = 0, size = 0;
        for (std::size_t k = 0; k < sh.size(); ++k)
          for (int l = 0, i = 0; l < B; ++l)
            for (; i < shCount(l + 1); ++i) {
              const double term = kPi * static_cast<double>(bands[l]) * static_cast<double>(y[i]) *
                                  static_cast<double>(sh[k].data()[3 * i + static_cast<int>(c)]) *
                                  static_cast<double>(weights[k * count + p]);
              sum += term;
              size += std::abs(term);
            }
        worst.add(std::abs(static_cast<double>(all[c * count + p]) - sum) / std::max(size, 1e-300),
                  [&] { return what; });
      }
    }
  }
};

template <int B>
void compareAll(Worst& worst) {
  Random random(B);
  for (const std::size_t points : {1, 2, 3, 7, 8, 15, 16, 17, 31, 33, 64, 65, 100})
    for (const std::size_t vectors : {1, 2, 6, 13, 64})
      Batch<B>(random, vectors, points, points % 2 == 0 ? 0.0f : 0.4f, static_cast<int>(points % 5))
          .compare(worst, std::to_string(B) + " bands, " + std::to_string(points) + " points, " +
                              std::to_string(vectors) + " vectors");
}

TEST(ShBatch, IsTheWeightedSum) {
  onEveryTarget([] {
    Worst worst("irradiance of weighted SH, of the terms' sizes");
    compareAll<2>(worst);
    compareAll<3>(worst);
    compareAll<4>(worst);
    compareAll<5>(worst);
    worst.expectWithin(kTolerance);
  });
}

TEST(ShBatch, AddsABand) {
  onEveryTarget([] {
    Worst worst("irradiance of one band");
    Random random(9);
    for (const int l : {3, 4})
      for (const std::size_t points : {1, 5, 16, 17, 40}) {
        std::vector<Rgb> c(static_cast<std::size_t>(2 * l + 1));
        for (Rgb& colour : c)
          for (int k = 0; k < 3; ++k) colour[k] = random.uniformf(-1, 1);
        BatchPoints normals(3);
        for (std::size_t i = 0; i < points; ++i) normals.add(random.direction());
        std::vector<float> all(3 * points + 1, 2);
        const float f = -0.0417f;
        addBandIrradianceBatch(l, c, f, normals.rows(), std::span(all).first(3 * points));
        EXPECT_EQ(all.back(), 2);
        for (std::size_t p = 0; p < points; ++p) {
          float y[shCount(kMaxBands)];
          shBasis<kMaxBands>(normals[p], y);
          for (std::size_t k = 0; k < 3; ++k) {
            double sum = 2;
            for (int m = 0; m <= 2 * l; ++m)
              sum += kPi * static_cast<double>(f) * static_cast<double>(y[l * l + m]) *
                     static_cast<double>(c[m][static_cast<int>(k)]);
            worst.add(std::abs(static_cast<double>(all[k * points + p]) - sum) / 2,
                      [&] { return "band " + std::to_string(l); });
          }
        }
      }
    worst.expectWithin(kTolerance);
  });
}

TEST(ShBatch, KeepsPointsApart) {
  onEveryTarget([] {
    Random random(4);
    Batch<3> batch(random, 6, 50, 0, 0);
    const std::vector<float> clean = batch.irradiance();
    batch.weights[2 * 50 + 17] = kNaN;
    const std::vector<float> all = batch.irradiance();
    for (std::size_t i = 0; i < 150; ++i) {
      if (i % 50 == 17) {
        EXPECT_NE(all[i], all[i]);
      } else {
        EXPECT_EQ(all[i], clean[i]) << i;
      }
    }
  });
}

TEST(ShBatch, NothingGivesNothing) {
  onEveryTarget([] {
    Random random(5);
    for (const float e : Batch<3>(random, 0, 20, 0, 0).irradiance()) EXPECT_TRUE(e == 0 || e == kUntouched);
    EXPECT_EQ(Batch<3>(random, 4, 0, 0, 0).irradiance().size(), 1u);
  });
}

}  // namespace
}  // namespace rigel
