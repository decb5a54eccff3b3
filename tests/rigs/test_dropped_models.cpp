// rbf, latticegrad and hermite against slow references in double, and what each of them reproduces.
#include "anchors.h"
#include "rig_fixture.h"

#include <algorithm>
#include <functional>

namespace rigel::test {
namespace {

using Point = std::array<double, 3>;

const auto kBody = ellipsoid({0.5f, 1, -2}, {2, 0.4f, 0.8f}, 600);

Point wide(Vec3 p) { return {p.x, p.y, p.z}; }

std::vector<Vec3> pointsIn(const RigBox& box, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<Vec3> points(count);
  for (Vec3& p : points)
    for (int a = 0; a < 3; ++a) p[a] = box.lo[a] + unit(random) * (box.hi[a] - box.lo[a]);
  return points;
}

/// Value and gradient of a field.
struct Field {
  std::function<double(Point)> value;
  std::function<Point(Point)> gradient;

  float at(Vec3 p) const { return static_cast<float>(value(wide(p))); }
  Vec3 slope(Vec3 p) const {
    const Point g = gradient(wide(p));
    return {static_cast<float>(g[0]), static_cast<float>(g[1]), static_cast<float>(g[2])};
  }
};

/// x^i y^j z^k about a point.
Field monomial(std::array<int, 3> e) {
  constexpr Point kAbout{0.7, 0.9, -1.8};
  const auto power = [](double x, int n) { return n < 0 ? 0 : std::pow(x, n); };
  return {[=](Point p) {
            double product = 1;
            for (int a = 0; a < 3; ++a) product *= power(p[a] - kAbout[a], e[a]);
            return product;
          },
          [=](Point p) {
            Point g{};
            for (int a = 0; a < 3; ++a) {
              g[a] = e[a] * power(p[a] - kAbout[a], e[a] - 1);
              for (int b = 0; b < 3; ++b)
                if (b != a) g[a] *= power(p[b] - kAbout[b], e[b]);
            }
            return g;
          }};
}

const Field kWaves{
    [](Point p) { return std::sin(2 * p[0]) * std::cos(p[1]) + std::exp(p[2] + 0.3 * p[0]); },
    [](Point p) {
      const double e = std::exp(p[2] + 0.3 * p[0]);
      return Point{2 * std::cos(2 * p[0]) * std::cos(p[1]) + 0.3 * e, -std::sin(2 * p[0]) * std::sin(p[1]), e};
    }};

auto fitted(Rig& rig, const Field& field) {
  return fitField(
      rig, [&](Vec3 p) { return field.at(p); }, [&](Vec3 p) { return field.slope(p); });
}

float worstIn(const std::string& text, const Field& field) {
  Rig rig = rigOf(text, kBody);
  const auto fit = fitted(rig, field);
  float worst = 0;
  for (Vec3 p : pointsIn(rig.box(), 300, 3)) worst = std::max(worst, std::abs(fit(p) - field.at(p)));
  return worst;
}

// Fields are up to 10 in size: a few roundings of a float.
constexpr float kRounding = 1e-5f;

/// A lattice of value and slopes over a box, evaluated node by node in double.
struct SlowGrid {
  RigBox box;
  std::array<int, 3> nodes;
  const Field& field;

  /// Position of node i along axis a, and of p in spacings from it.
  double node(int a, int i) const {
    const double lo = box.lo[a], hi = box.hi[a];
    return nodes[a] == 1 ? (lo + hi) / 2 : lo + (hi - lo) * i / (nodes[a] - 1);
  }
  double spacing(int a) const {
    return nodes[a] == 1 ? 0 : (static_cast<double>(box.hi[a]) - static_cast<double>(box.lo[a])) / (nodes[a] - 1);
  }
  double hat(int a, int i, double x) const {
    return nodes[a] == 1 ? 1 : std::max(0.0, 1 - std::abs(x - node(a, i)) / spacing(a));
  }

  template <class Term>
  double sum(Point p, Term term) const {
    double total = 0;
    for (int i = 0; i < nodes[0]; ++i)
      for (int j = 0; j < nodes[1]; ++j)
        for (int k = 0; k < nodes[2]; ++k) {
          const Point at{node(0, i), node(1, j), node(2, k)};
          const Point weight{hat(0, i, p[0]), hat(1, j, p[1]), hat(2, k, p[2])};
          total += term(at, weight, field.value(at), field.gradient(at));
        }
    return total;
  }

  double expansions(Point p, bool smooth) const {
    return sum(p, [&](Point at, Point weight, double value, Point gradient) {
      double b = 1, expansion = value;
      for (int a = 0; a < 3; ++a) {
        b *= smooth ? weight[a] * weight[a] * (3 - 2 * weight[a]) : weight[a];
        expansion += gradient[a] * (p[a] - at[a]);
      }
      return b * expansion;
    });
  }

  /// L_x L_y L_z, and along each axis what the cubic through values and slopes adds.
  double hermite(Point p) const {
    return sum(p, [&](Point at, Point weight, double value, Point gradient) {
      double total = value * weight[0] * weight[1] * weight[2];
      for (int a = 0; a < 3; ++a) {
        const double l = weight[a], d = p[a] - at[a];
        const double others = weight[(a + 1) % 3] * weight[(a + 2) % 3];
        if (nodes[a] == 1) {
          total += gradient[a] * d * others;
        } else {
          total += (value * (l * l * (3 - 2 * l) - l) + gradient[a] * d * l * l) * others;
        }
      }
      return total;
    });
  }
};

TEST(SlopeGrids, AreTheirDefinitions) {
  // kBody is longest along x, then z, then y.
  const std::vector<std::pair<std::string, std::array<int, 3>>> cases = {
      {"3x2x2", {3, 2, 2}}, {"4x1x2", {4, 2, 1}}, {"2x2x1", {2, 1, 2}}, {"1x1x1", {1, 1, 1}}, {"7x2x2", {7, 2, 2}}};
  for (const auto& [counts, nodes] : cases) {
    const SlowGrid slow{boxOf(kBody), nodes, kWaves};
    for (const std::string name : {"latticegrad:", "hermite:"}) {
      for (const std::string kernel : {"", ":smooth"}) {
        const bool smooth = !kernel.empty();
        if (smooth && name == "hermite:") continue;
        Rig rig = rigOf(name + counts + kernel, kBody);
        EXPECT_EQ(rig.projections(), 4 * nodes[0] * nodes[1] * nodes[2]);
        const auto fit = fitted(rig, kWaves);
        for (Vec3 p : pointsIn(rig.box(), 100, 5)) {
          const double expected = name == "hermite:" ? slow.hermite(wide(p)) : slow.expansions(wide(p), smooth);
          EXPECT_NEAR(fit(p), expected, kRounding) << name << counts << kernel;
        }
      }
    }
  }
}

TEST(SlopeGrids, LatticegradReproducesLinearLightWithEveryKernel) {
  for (const std::string text :
       {"latticegrad:1x1x1", "latticegrad:2x1x1", "latticegrad:3x2x2", "latticegrad:3x2x2:smooth"}) {
    for (const std::array<int, 3> e : {std::array{1, 0, 0}, {0, 1, 0}, {0, 0, 1}})
      EXPECT_LT(worstIn(text, monomial(e)), kRounding) << text;
  }
  EXPECT_GT(worstIn("latticegrad:2x2x2", monomial({2, 0, 0})), 0.5f) << "no more than that";
}

TEST(SlopeGrids, HermiteReproducesCubics) {
  for (int i = 0; i <= 3; ++i)
    for (int j = 0; i + j <= 3; ++j)
      for (int k = 0; i + j + k <= 3; ++k)
        for (const std::string text : {"hermite:2x2x2", "hermite:4x2x3"})
          EXPECT_LT(worstIn(text, monomial({i, j, k})), 3 * kRounding) << text << " " << i << j << k;
  // And cubic along one axis times linear along others.
  EXPECT_LT(worstIn("hermite:2x2x2", monomial({3, 1, 1})), 3 * kRounding);
  EXPECT_GT(worstIn("hermite:2x2x2", monomial({2, 0, 2})), 0.05f) << "no more than that";
  // Along an axis of one node it is an expansion.
  EXPECT_LT(worstIn("hermite:2x1x1", monomial({3, 0, 0})), 3 * kRounding);
  EXPECT_LT(worstIn("hermite:2x1x1", monomial({0, 1, 0})), 3 * kRounding);
}

TEST(SlopeGrids, OfOneNodeAreTheGradientRig) {
  Rig gradient = rigOf("gradient", kBody);
  const auto expected = fitted(gradient, kWaves);
  for (const std::string text : {"latticegrad:1x1x1", "hermite:1x1x1"}) {
    Rig rig = rigOf(text, kBody);
    const auto fit = fitted(rig, kWaves);
    for (Vec3 p : pointsIn(rig.box(), 50, 9)) EXPECT_NEAR(fit(p), expected(p), kRounding) << text;
  }
}

TEST(SlopeGrids, HoldValueAndSlopesAtTheirNodes) {
  for (const std::string text : {"latticegrad:3x2x2:smooth", "hermite:3x2x2"}) {
    Rig rig = rigOf(text, kBody);
    const auto fit = fitted(rig, kWaves);
    const Vec3 centre = (rig.box().lo + rig.box().hi) * 0.5f;
    for (const RigSample& node : rig.samples()) {
      EXPECT_NEAR(fit(node.position), kWaves.at(node.position), kRounding) << text;
      for (int a = 0; a < 3; ++a) {
        // Into the box.
        constexpr float kStep = 2e-3f;
        Vec3 p = node.position;
        const float step = p[a] > centre[a] ? -kStep : kStep;
        p[a] += step;
        // 0.03: the curvature, up to 5 a metre squared, times the step.
        EXPECT_NEAR((fit(p) - fit(node.position)) / step, kWaves.slope(node.position)[a], 0.03f) << text << " " << a;
      }
    }
  }
}

TEST(SlopeGrids, AreContinuousFromCellToCell) {
  for (const std::string text : {"latticegrad:4x3x2", "latticegrad:4x3x2:smooth", "hermite:4x3x2"}) {
    Rig rig = rigOf(text, kBody);
    const auto fit = fitted(rig, kWaves);
    for (Vec3 p : pointsIn(rig.box(), 100, 13)) {
      for (const RigSample& node : rig.samples()) {
        for (int a = 0; a < 3; ++a) {
          Vec3 before = p, after = p;
          before[a] = std::nextafter(node.position[a], -10.0f) - 1e-6f;
          after[a] = std::nextafter(node.position[a], 10.0f) + 1e-6f;
          EXPECT_NEAR(fit(before), fit(after), 5 * kRounding) << text;
        }
      }
    }
  }
}

/// What rbf:K is made of, in metres and double.
struct SlowRbf {
  std::vector<Point> centres;
  double squaredWidth = 0;

  SlowRbf(const Rig& rig, const std::vector<Vec3>& rest, const std::vector<Vec3>& posed) {
    std::vector<Vec3> anchors;
    for (int i : rig.anchors()) anchors.push_back(rest[i]);
    for (int i : chooseAnchors(anchors, rig.shVectors()).index) centres.push_back(wide(posed[rig.anchors()[i]]));
    for (std::size_t k = 0; k < centres.size(); ++k) {
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t j = 0; j < centres.size(); ++j)
        if (j != k) nearest = std::min(nearest, square(centres[j], centres[k]));
      squaredWidth += 6.25 * nearest / static_cast<double>(centres.size());
    }
  }
  static double square(Point a, Point b) {
    double sum = 0;
    for (int i = 0; i < 3; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
  }
  std::vector<double> operator()(Vec3 p) const {
    std::vector<double> g;
    double sum = 0;
    for (const Point& c : centres) {
      g.push_back(std::exp(-square(wide(p), c) / squaredWidth));
      sum += g.back();
    }
    for (double& x : g) x /= sum;
    return g;
  }
};

std::vector<Vec3> bent(float by) {
  std::vector<Vec3> points;
  for (Vec3 p : kBody) points.push_back({p.x * (1 + 0.3f * by), p.y + by * 0.4f * p.x * p.x, p.z - by});
  return points;
}

void poseAs(Rig& rig, const std::vector<Vec3>& surface) {
  std::vector<Vec3> anchors;
  for (int i : rig.anchors()) anchors.push_back(surface[i]);
  rig.setPose({boxOf(surface), anchors});
}

TEST(Rbf, IsNormalisedGaussiansAboutItsAnchors) {
  for (const std::string text : {"rbf:2", "rbf:6", "rbf:12", "rbf:48"}) {
    Rig rig = rigOf(text, kBody);
    for (const float by : {0.0f, 1.0f}) {
      const auto surface = bent(by);
      poseAs(rig, surface);
      const SlowRbf slow(rig, kBody, surface);
      ASSERT_EQ(slow.centres.size(), static_cast<std::size_t>(rig.shVectors()));
      RigBasis phi;
      for (Vec3 p : pointsIn(rig.box(), 50, 17)) {
        rig.basis(p, phi);
        const auto expected = slow(p);
        ASSERT_EQ(phi.count, rig.shVectors());
        for (int k = 0; k < phi.count; ++k) EXPECT_NEAR(phi.value[k], expected[phi.index[k]], 3e-6) << text;
      }
    }
  }
}

TEST(Rbf, ReproducesItsOwnFunctions) {
  for (const std::string text : {"rbf:6", "rbf:12"}) {
    Rig rig = rigOf(text, kBody);
    const SlowRbf slow(rig, kBody, kBody);
    for (std::size_t k = 0; k < slow.centres.size(); ++k) {
      const Field own{[&](Point p) {
                        return slow({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])})[k];
                      },
                      {}};
      const auto fit = fitted(rig, own);
      // The pull of least squares, 1e-6 times the condition squared (about 40).
      for (Vec3 p : kBody) EXPECT_NEAR(fit(p), own.at(p), 4e-3f) << text << " " << k;
    }
  }
}

TEST(Rbf, IsCloseToLinearLight) {
  // No linear part: what twelve overlapping bumps make of a slope over the body, of its range.
  for (int a = 0; a < 3; ++a) {
    Rig rig = rigOf("rbf:12", kBody);
    std::array<int, 3> e{};
    e[a] = 1;
    const Field field = monomial(e);
    const auto fit = fitted(rig, field);
    float worst = 0;
    for (Vec3 p : kBody) worst = std::max(worst, std::abs(fit(p) - field.at(p)));
    EXPECT_LT(worst, 0.05f * (rig.box().hi[a] - rig.box().lo[a])) << a;
  }
}

TEST(Rbf, OfOneCentreIsTheMeanOfItsAnchors) {
  Rig rig = rigOf("rbf:1", kBody), constant = rigOf("constant@lsq", kBody);
  const auto fit = fitted(rig, kWaves), expected = fitted(constant, kWaves);
  for (Vec3 p : kBody) EXPECT_NEAR(fit(p), expected(p), kRounding);
}

TEST(Rbf, KeepsConstantLight) {
  for (const std::string text : {"rbf:24", "rbf:64"}) {
    Rig rig = rigOf(text, kBody);
    const auto fit = fitted(rig, monomial({0, 0, 0}));
    // Many wide bumps take large coefficients: the operator's floats round at up to 100 times the value.
    for (Vec3 p : kBody) EXPECT_NEAR(fit(p), 1, 5e-5f) << text;
  }
}

TEST(Rbf, KeepsAllItsVectorsWherePointsAreFew) {
  const std::vector<Vec3> three{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  Rig rig = rigOf("rbf:12", three);
  EXPECT_EQ(rig.shVectors(), 12);
  const Field field = monomial({1, 0, 0});
  const auto fit = fitted(rig, field);
  for (Vec3 p : three) EXPECT_NEAR(fit(p), field.at(p), 1e-2f);
}

/// The largest change of the fitted field at points of the body from one pose to the next, over poses that bend and at
/// half way are flat.
float largestJump(const std::string& text, int steps) {
  Rig rig = rigOf(text, kBody);
  float worst = 0;
  std::vector<float> last;
  for (int step = 0; step <= steps; ++step) {
    const float t = static_cast<float>(step) / static_cast<float>(steps);
    auto surface = bent(t);
    for (Vec3& p : surface) p.z = -2 + (p.z + 2) * (1 - 2 * t);
    poseAs(rig, surface);
    const auto fit = fitted(rig, kWaves);
    std::vector<float> now;
    for (std::size_t i = 0; i < surface.size(); i += 20) now.push_back(fit(surface[i]));
    for (std::size_t i = 0; i < last.size(); ++i) worst = std::max(worst, std::abs(now[i] - last[i]));
    last = std::move(now);
  }
  return worst;
}

TEST(DroppedModels, AreContinuousInThePose) {
  for (const std::string text : {"rbf:6", "rbf:24", "latticegrad:3x2x2", "hermite:3x2x2"}) {
    // Eight times the steps: an eighth of the jumps where nothing jumps.
    EXPECT_LT(largestJump(text, 800), 0.2f * largestJump(text, 100)) << text;
  }
}

}  // namespace
}  // namespace rigel::test
