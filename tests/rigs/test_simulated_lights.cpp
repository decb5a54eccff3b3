// Which of two placements of anchors a rig takes.
#include "simulated_lights.h"

#include "fekete.h"
#include "rig_fixture.h"

namespace rigel::test {
namespace {

double errorOf(const std::string& text, const std::vector<Vec3>& surface) {
  const RigShape rest{boxOf(surface), surface};
  const RigSpec spec = specOf(text);
  const auto model = Rig::Model::create(spec, rest, chooseAnchors(surface, 2 * spec.shVectors()));
  return SimulatedLights(rest).error(*model);
}

TEST(SimulatedLights, TellGoodRigsFromBadOnes) {
  const auto body = ellipsoid({}, {2, 0.5f, 0.7f}, 500);
  const double one = errorOf("poly:1", body), six = errorOf("poly:6", body), twenty = errorOf("poly:20", body);
  EXPECT_GT(one, 0.1);
  EXPECT_LT(six, 0.6 * one);
  EXPECT_LT(twenty, 0.6 * six);
}

TEST(SimulatedLights, DoNotDependOnTheUnitOrThePlace) {
  const double here = errorOf("poly:6", ellipsoid({}, {2, 0.5f, 0.7f}, 500));
  // Float positions; worst measured 3e-5.
  EXPECT_NEAR(errorOf("poly:6", ellipsoid({}, {2000, 500, 700}, 500)) / here, 1, 1e-3);
  EXPECT_NEAR(errorOf("poly:6", ellipsoid({30, -20, 10}, {2, 0.5f, 0.7f}, 500)) / here, 1, 1e-3);
}

/// Geometric mean over lights of the relative RMS error, over the surface, about 1/d^2 of lights that the simulated
/// ones know nothing of.
double errorOfInverseSquares(const RigSpec& spec, const std::vector<Vec3>& surface, const Anchors& anchors) {
  const auto model = Rig::Model::create(spec, {boxOf(surface), surface}, anchors);
  std::mt19937 random(5);
  std::normal_distribution<float> normal;
  std::uniform_real_distribution<float> unit(0, 1);
  const RigBox box = boxOf(surface);
  const Vec3 half = (box.hi - box.lo) * 0.5f;
  double logarithms = 0;
  constexpr int kLights = 200;
  for (int i = 0; i < kLights; ++i) {
    Vec3 u{normal(random), normal(random), normal(random)};
    u = u * (1 / length(u));
    const float off =
        2 * std::max({half.x, half.y, half.z}) * std::exp(std::lerp(std::log(0.1f), std::log(2.0f), unit(random)));
    const Vec3 at = (box.lo + box.hi) * 0.5f + Vec3{u.x * half.x, u.y * half.y, u.z * half.z} + u * off;
    const auto field = [&](Vec3 p) { return 1 / dot(p - at, p - at); };
    std::vector<float> functionals, coefficients(static_cast<std::size_t>(spec.shVectors()));
    for (const RigSample& sample : model->samples) functionals.push_back(field(sample.position));
    model->op.apply(functionals, 1, coefficients);
    const auto fitted = [&](Vec3 p) {
      RigBasis phi;
      model->basis(p, phi);
      float sum = 0;
      for (int j = 0; j < phi.count; ++j) sum += phi.value[j] * coefficients[phi.index[j]];
      return sum;
    };
    double square = 0, mean = 0;
    for (Vec3 p : surface) {
      square += std::pow(static_cast<double>(fitted(p) - field(p)), 2) / static_cast<double>(surface.size());
      mean += static_cast<double>(field(p)) / static_cast<double>(surface.size());
    }
    logarithms += std::log(std::sqrt(square) / mean) / kLights;
  }
  return std::exp(logarithms);
}

/// A creature: a long body, a thin neck or tail at each end, two wings.
std::vector<Vec3> creature() {
  std::vector<Vec3> points = ellipsoid({}, {1.2f, 0.5f, 0.5f}, 300);
  const auto add = [&](Vec3 centre, Vec3 half, int count) {
    for (Vec3 p : ellipsoid(centre, half, count)) points.push_back(p);
  };
  add({2.4f, 0.5f, 0}, {1.4f, 0.15f, 0.15f}, 120);
  add({-2.6f, 0, 0}, {1.6f, 0.12f, 0.12f}, 120);
  add({0, 0.4f, 1.2f}, {0.5f, 0.04f, 0.9f}, 100);
  add({0, 0.4f, -1.2f}, {0.5f, 0.04f, 0.9f}, 100);
  return points;
}

// Fekete points have to be clearly better, and other lights may see it otherwise where the two are nearly as good;
// worst measured 1.095. The better of the two differ by up to 1.6.
constexpr double kSameError = 1.12, kBetter = 0.97;

TEST(SimulatedLights, GiveARigTheBetterOfClustersAndFeketePoints) {
  const std::vector<std::vector<Vec3>> shapes = {creature(), ellipsoid({}, {1, 1, 1}, 600),
                                                 ellipsoid({}, {4, 0.5f, 0.5f}, 600),
                                                 ellipsoid({}, {0.3f, 0.9f, 0.2f}, 600)};
  int clusters = 0, fekete = 0;
  for (const auto& surface : shapes) {
    for (const char* text : {"poly:4", "poly:6", "poly:12", "poly:24", "lattice:3x2x2@lsq", "mixed:l3,g,c@lsq"}) {
      const RigSpec spec = specOf(text);
      const Anchors first = chooseAnchors(surface, 2 * spec.shVectors());
      const Anchors second = feketeAnchors(surface, 2 * spec.shVectors());
      const Rig rig = rigOf(text, surface);
      if (rig.projections() != 2 * spec.shVectors()) continue;  // more points, for their condition
      const std::vector<int> chosen(rig.anchors().begin(), rig.anchors().end());
      ASSERT_TRUE(chosen == first.index || chosen == second.index) << text;
      const bool tookClusters = chosen == first.index;
      const double ofClusters = errorOfInverseSquares(spec, surface, first);
      const double ofFekete = errorOfInverseSquares(spec, surface, second);
      const double ratio = tookClusters ? ofClusters / ofFekete : ofFekete / ofClusters;
      std::printf("%s: %s, %.3f of the other\n", text, tookClusters ? "clusters" : "Fekete", ratio);
      EXPECT_LT(ratio, kSameError) << text;
      if (ratio < kBetter) ++(tookClusters ? clusters : fekete);
    }
  }
  EXPECT_GT(clusters, 0);
  EXPECT_GT(fekete, 0);
}

}  // namespace
}  // namespace rigel::test
