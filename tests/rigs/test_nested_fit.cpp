// The nested least-squares fit of `auto` rigs, against a Householder QR of each subset of its functions in double.
#include "nested_fit.h"

#include "reference/worst.h"

#include <Eigen/Dense>

#include <algorithm>
#include <functional>
#include <numeric>

#include "rig_fixture.h"

namespace rigel::test {
namespace {

using reference::Worst;

constexpr int kFunctions = 12;
using Monomials = std::array<double, kFunctions>;

Monomials monomials(Vec3 p) {
  const double x = static_cast<double>(p.x), y = static_cast<double>(p.y), z = static_cast<double>(p.z);
  return {1, x, y, z, x * x, y * y, z * z, x * y, y * z, z * x, x * x * x, x * y * z};
}

/// What a light might do to points near a corner of the unit cube: four floats a point.
constexpr int kWidth = 4;
std::array<float, kWidth> lightAt(Vec3 p) {
  std::array<float, kWidth> out;
  for (int i = 0; i < kWidth; ++i) {
    const Vec3 d = p - Vec3{1.3f, 0.8f - 0.4f * static_cast<float>(i), 1.1f};
    out[i] = 1 / dot(d, d);
  }
  return out;
}

/// Points, shares and the fit of a field to them.
struct Problem {
  Problem(std::vector<Vec3> p, std::vector<float> s)
      : points(std::move(p)), shares(std::move(s)), fit(static_cast<int>(points.size()), kFunctions) {
    for (int i = 0; i < fit.points(); ++i) std::ranges::copy(monomials(points[i]), fit.row(i).begin());
    fit.factor(shares);
  }

  void analyse(const std::function<std::array<float, kWidth>(Vec3)>& field) {
    values.clear();
    for (std::size_t s = 0; s < points.size(); ++s)
      for (const float v : field(points[s])) values.push_back(std::sqrt(shares[s]) * v);
    coefficients.assign(kFunctions * kWidth, 0);
    residuals.assign(values.size(), 0);
    fit.analyse(values.data(), kWidth, coefficients.data(), residuals.data());
  }

  /// Coefficients of the first `count` given functions; `damped`: as in use, otherwise with the damping undone.
  std::vector<float> given(int count, bool damped = true) const {
    std::vector<float> weights(count, 1), out(count * kWidth);
    if (!damped)
      for (int j = 0; j < count; ++j) weights[j] = 1 / fit.damping()[j];
    fit.synthesise(coefficients.data(), kWidth, kWidth, weights, out.data());
    return out;
  }

  /// sum_k c_k phi_k at every point.
  std::vector<double> fitted(std::span<const float> given) const {
    std::vector<double> out;
    for (Vec3 p : points) {
      const Monomials phi = monomials(p);
      for (int i = 0; i < kWidth; ++i) {
        double sum = 0;
        for (std::size_t k = 0; k < given.size() / kWidth; ++k)
          sum += phi[k] * static_cast<double>(given[k * kWidth + i]);
        out.push_back(sum);
      }
    }
    return out;
  }

  /// The weighted least-squares fit of the first `count` functions at every point.
  std::vector<double> reference(int count) const {
    const auto n = static_cast<Eigen::Index>(points.size());
    Eigen::MatrixXd a(n, count), b(n, kWidth);
    for (Eigen::Index s = 0; s < n; ++s) {
      const double root = std::sqrt(static_cast<double>(shares[s]));
      const Monomials phi = monomials(points[s]);
      for (int k = 0; k < count; ++k) a(s, k) = root * phi[k];
      for (int i = 0; i < kWidth; ++i) b(s, i) = static_cast<double>(values[s * kWidth + i]);
    }
    const Eigen::MatrixXd c = a.householderQr().solve(b);
    std::vector<double> out;
    for (Vec3 p : points) {
      const Monomials phi = monomials(p);
      for (int i = 0; i < kWidth; ++i) {
        double sum = 0;
        for (int k = 0; k < count; ++k) sum += phi[k] * c(k, i);
        out.push_back(sum);
      }
    }
    return out;
  }

  std::vector<Vec3> points;
  std::vector<float> shares;
  NestedFit fit;
  std::vector<float> values, coefficients, residuals;
};

/// `count` points in the cube [-1, 1]^3 with unequal shares.
Problem randomProblem(unsigned seed, int count) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(-1, 1);
  std::vector<Vec3> points;
  std::vector<float> shares;
  float sum = 0;
  for (int i = 0; i < count; ++i) {
    points.push_back({unit(random), unit(random), unit(random)});
    shares.push_back(1.3f + unit(random));
    sum += shares.back();
  }
  for (float& s : shares) s /= sum;
  return {points, shares};
}

std::vector<float> evenShares(std::size_t count) { return std::vector<float>(count, 1 / static_cast<float>(count)); }

double rms(std::span<const double> values) {
  double sum = 0;
  for (double v : values) sum += v * v;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

double squares(std::span<const float> values) {
  double sum = 0;
  for (float v : values) sum += static_cast<double>(v) * static_cast<double>(v);
  return sum;
}

double largestDifference(std::span<const double> a, std::span<const double> b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
  return worst;
}

constexpr double kOrthonormal = 5e-6;  // float sums of 24 terms; worst 5.4e-7

TEST(NestedFit, FunctionsAreOrthonormal) {
  Worst worst("q . q' - delta");
  for (unsigned seed = 0; seed < 20; ++seed) {
    Problem problem = randomProblem(seed, 24);
    const int n = problem.fit.points();
    // Of one point's unit value the coefficients are q_k at the point.
    std::vector<float> identity(n * n), q(kFunctions * n), rest(n * n);
    for (int i = 0; i < n; ++i) identity[i * n + i] = 1;
    problem.fit.analyse(identity.data(), n, q.data(), rest.data());
    for (int j = 0; j < kFunctions; ++j)
      for (int k = 0; k <= j; ++k) {
        double sum = 0;
        for (int s = 0; s < n; ++s) sum += static_cast<double>(q[j * n + s]) * static_cast<double>(q[k * n + s]);
        worst.add(std::abs(sum - (j == k)), [&] { return "seed " + std::to_string(seed); });
      }
  }
  worst.expectWithin(kOrthonormal);
}

// With the damping undone float alone is left, 9.5e-7 at worst. Damping takes 1e-5 over a function's squared
// independent share, 1.8e-4 of the fit at worst.
constexpr double kUndamped = 1e-5, kDamped = 1e-3;

TEST(NestedFit, TheFirstFunctionsAreTheLeastSquaresFitOfThemAlone) {
  Worst exact("fit against QR, damping undone, over the field's rms"), damped("the same, damped");
  for (unsigned seed = 0; seed < 20; ++seed) {
    Problem problem = randomProblem(seed, 24 + 8 * static_cast<int>(seed % 4));
    problem.analyse(lightAt);
    for (int count = 1; count <= kFunctions; ++count) {
      const auto expected = problem.reference(count);
      const double scale = rms(expected);
      const auto where = [&] { return "seed " + std::to_string(seed) + ", " + std::to_string(count); };
      exact.add(largestDifference(problem.fitted(problem.given(count, false)), expected) / scale, where);
      damped.add(largestDifference(problem.fitted(problem.given(count)), expected) / scale, where);
    }
  }
  exact.expectWithin(kUndamped);
  damped.expectWithin(kDamped);
}

TEST(NestedFit, PolynomialsAreReproduced) {
  Worst worst("polynomial against its fit, over its rms");
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (unsigned seed = 0; seed < 20; ++seed) {
    Problem problem = randomProblem(seed, 24);
    std::array<Monomials, kWidth> c;
    for (auto& row : c) std::ranges::generate(row, [&] { return normal(random); });
    const auto field = [&](Vec3 p) {
      const Monomials phi = monomials(p);
      std::array<float, kWidth> out;
      for (int i = 0; i < kWidth; ++i)
        out[i] = static_cast<float>(std::inner_product(phi.begin(), phi.end(), c[i].begin(), 0.0));
      return out;
    };
    problem.analyse(field);
    std::vector<double> expected;
    for (Vec3 p : problem.points)
      for (float v : field(p)) expected.push_back(static_cast<double>(v));
    worst.add(largestDifference(problem.fitted(problem.given(kFunctions)), expected) / rms(expected),
              [&] { return "seed " + std::to_string(seed); });
  }
  worst.expectWithin(kDamped);
}

TEST(NestedFit, CoefficientsAndResidualsHoldAllEnergy) {
  Worst worst("energy of coefficients and residuals over that of the values, less 1");
  const auto check = [&](Problem problem, const std::string& what) {
    problem.analyse(lightAt);
    const double all = squares(problem.values);
    worst.add(std::abs((squares(problem.coefficients) + squares(problem.residuals)) / all - 1), [&] { return what; });
  };
  for (unsigned seed = 0; seed < 20; ++seed) check(randomProblem(seed, 24), "random");
  // Also where functions are damped away.
  for (const Vec3 half : {Vec3{1, 1, 1}, Vec3{1, 1, 0}, Vec3{1, 0, 0}, Vec3{0, 0, 0}, Vec3{1, 1, 0.003f}}) {
    const auto points = ellipsoid({}, half, 24);
    check({points, evenShares(points.size())}, "ellipsoid");
  }
  worst.expectWithin(3e-6);  // 24 x 12 float operations; worst 5.3e-7
}

TEST(NestedFit, ShapesThatCannotTellFunctionsApartStayFinite) {
  std::vector<std::vector<Vec3>> shapes;
  for (const Vec3 half : {Vec3{1, 1, 1}, Vec3{1, 1, 0}, Vec3{1, 0, 0}, Vec3{0, 0, 0}, Vec3{1, 1, 1e-12f},
                          Vec3{1e-6f, 1e-6f, 1e-6f}, Vec3{1e6f, 1e6f, 1e6f}})
    shapes.push_back(ellipsoid({}, half, 24));
  shapes.push_back(std::vector<Vec3>(24, Vec3{0.3f, 0.2f, 0.1f}));
  shapes.push_back({{0.5f, 0, 0}});  // fewer points than functions
  shapes.push_back({{0.5f, 0, 0}, {0, 0.5f, 0}, {0.5f, 0, 0}});
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    Problem problem(shapes[i], evenShares(shapes[i].size()));
    problem.analyse(lightAt);
    for (const float d : problem.fit.damping()) {
      EXPECT_GE(d, 0) << i;
      EXPECT_LE(d, 1) << i;
    }
    double peak = 0;
    for (Vec3 p : shapes[i])
      for (float v : lightAt(p)) peak = std::max(peak, static_cast<double>(v));
    for (const float c : problem.given(kFunctions)) EXPECT_TRUE(std::isfinite(c)) << i;
    for (const float r : problem.residuals) EXPECT_LE(std::abs(static_cast<double>(r)), peak) << i;
  }
  // x^2 + y^2 + z^2 = 1: of the three squares one is not independent, and does not take part.
  Problem ball(ellipsoid({}, {1, 1, 1}, 24), evenShares(24));
  EXPECT_LT(ball.fit.damping()[6], 1e-6f);
  EXPECT_GT(ball.fit.damping()[5], 0.99f);
}

/// Largest change of the fit from step to step while the shape goes through `shapeAt(t)`, t = -1 .. 1; relative to the
/// field's rms.
double largestStep(const std::function<std::vector<Vec3>(double)>& shapeAt, int steps) {
  std::vector<double> last;
  double worst = 0;
  for (int i = 0; i <= steps; ++i) {
    const auto points = shapeAt(2.0 * i / steps - 1);
    Problem problem(points, evenShares(points.size()));
    problem.analyse(lightAt);
    auto now = problem.fitted(problem.given(kFunctions));
    if (!last.empty()) worst = std::max(worst, largestDifference(now, last) / rms(now));
    last = std::move(now);
  }
  return worst;
}

// An odd number of steps: at thickness 0 itself a function that is 0 everywhere drops out, with the part of the
// residual (1 % here) that its values at these points happened to fit.
TEST(NestedFit, NothingJumpsAsAShapePassesThroughADegenerateOne) {
  const std::vector<std::pair<std::string, std::function<std::vector<Vec3>(double)>>> passages = {
      {"through a ball",
       [](double t) {
         return ellipsoid({}, {1, 1, 1 + 0.1f * static_cast<float>(t)}, 24);
       }},
      {"from a pear through a ball to a pear",
       [](double t) {
         auto points = ellipsoid({}, {1, 1, 1}, 24);
         for (Vec3& p : points) p = p * (1 + 0.03f * static_cast<float>(t) * p.x * p.x * p.z);
         return points;
       }},
      {"through a plane",
       [](double t) {
         return ellipsoid({}, {1, 1, 0.1f * static_cast<float>(t)}, 24);
       }},
      {"through a line",
       [](double t) {
         return ellipsoid({}, {1, 0.1f * static_cast<float>(t), 0.1f * static_cast<float>(t)}, 24);
       }},
      {"through a point", [](double t) {
         const float s = 0.1f * static_cast<float>(t);
         return ellipsoid({}, {s, s, s}, 24);
       }}};
  for (const auto& [what, shapeAt] : passages) {
    const double coarse = largestStep(shapeAt, 101), fine = largestStep(shapeAt, 801);
    std::printf("  %s: largest step %.4f of 101, %.4f of 801\n", what.c_str(), coarse, fine);
    EXPECT_LE(fine, 0.25 * coarse) << what;
  }
}

}  // namespace
}  // namespace rigel::test
