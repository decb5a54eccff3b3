#include "samples/implicit_surface.h"

#include "mesh_checks.h"

#include <gmock/gmock.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>

namespace rigel::tools {
namespace {

TEST(MeshImplicit, BallHasItsRadiusNormalsAndVolume) {
  const glm::vec3 centre{0.3f, -0.2f, 0.1f};
  const auto field = [&](glm::vec3 p) { return glm::distance(p, centre) - 1; };
  const Primitive ball = meshImplicit(field, centre - 1.0f, centre + 1.0f, 0.08f);
  ASSERT_GT(ball.positions.size(), 1000u);
  float off = 0, turned = 0;
  for (std::size_t i = 0; i < ball.positions.size(); ++i) {
    const glm::vec3 r = ball.positions[i] - centre;
    off = std::max(off, std::abs(glm::length(r) - 1));
    turned = std::max(turned, glm::distance(ball.normals[i], r));
  }
  EXPECT_LT(off, 1e-5f) << "Newton steps end on the surface";
  EXPECT_LT(turned, 1e-3f);
  Mesh mesh;
  mesh.primitives.push_back(ball);
  EXPECT_EQ(test::openEdges(mesh), 0);
  EXPECT_NEAR(test::volume(mesh) / (4 / 3.0 * 3.14159265), 1, 5e-3);
}

TEST(MeshImplicit, FarBlocksDoNotHideThinParts) {
  // A thin rod in a large box: most blocks are skipped, none that it runs through may be.
  const auto field = [](glm::vec3 p) { return roundConeDistance(p, {-1, -1, -1}, {1, 0.9f, 1.1f}, 0.05f, 0.03f); };
  Mesh mesh;
  mesh.primitives.push_back(meshImplicit(field, glm::vec3(-1.2f), glm::vec3(1.2f), 0.02f));
  EXPECT_EQ(test::openEdges(mesh), 0);
  glm::vec3 low(9), high(-9);
  for (const glm::vec3 p : mesh.primitives[0].positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  EXPECT_LT(glm::distance(low, glm::vec3(-1.05f)), 0.01f);
  EXPECT_LT(glm::distance(high, glm::vec3(1.03f, 0.93f, 1.13f)), 0.01f);
}

TEST(RoundCone, IsTheUnionOfItsSpheres) {
  const glm::vec3 a{0, 0, 0}, b{1, 0.5f, -0.3f};
  for (const auto& [ra, rb] :
       {std::pair(0.4f, 0.1f), std::pair(0.1f, 0.4f), std::pair(0.2f, 0.2f), std::pair(2.0f, 0.1f)}) {
    float worst = 0;
    for (int i = 0; i < 500; ++i) {
      const auto f = static_cast<float>(i);
      const glm::vec3 p = 2.0f * glm::vec3(std::sin(f * 1.1f), std::cos(f * 0.7f), std::sin(f * 0.3f + 1));
      float nearest = 1e9f;
      constexpr int kSpheres = 4000;
      for (int s = 0; s <= kSpheres; ++s) {
        const float t = static_cast<float>(s) / kSpheres;
        nearest = std::min(nearest, glm::distance(p, glm::mix(a, b, t)) - glm::mix(ra, rb, t));
      }
      worst = std::max(worst, std::abs(roundConeDistance(p, a, b, ra, rb) - nearest));
    }
    EXPECT_LT(worst, 2e-6f) << ra << " to " << rb;
  }
}

TEST(SmoothUnion, EqualsMinFarFromTheSeamAndIsSymmetric) {
  EXPECT_EQ(smoothUnion(0.1f, 0.9f, 0.2f), 0.1f);
  EXPECT_EQ(smoothUnion(0.9f, 0.1f, 0.2f), 0.1f);
  EXPECT_FLOAT_EQ(smoothUnion(0.3f, 0.3f, 0.2f), 0.25f);
  EXPECT_EQ(smoothUnion(0.3f, 0.35f, 0.2f), smoothUnion(0.35f, 0.3f, 0.2f));
}

TEST(Ellipsoid, IsZeroOnItsSurfaceWithUnitSlope) {
  const glm::vec3 radii{0.1f, 0.3f, 0.2f};
  for (int i = 0; i < 100; ++i) {
    const auto f = static_cast<float>(i);
    const glm::vec3 u = glm::normalize(glm::vec3(std::sin(f), std::cos(2.3f * f), std::sin(1.7f * f + 1)));
    const glm::vec3 p = u * radii, n = glm::normalize(u / radii);
    EXPECT_NEAR(ellipsoidDistance(p, glm::vec3(0), radii), 0, 1e-6f);
    EXPECT_NEAR(ellipsoidDistance(p + 1e-3f * n, glm::vec3(0), radii), 1e-3f, 5e-5f);
  }
  EXPECT_FLOAT_EQ(ellipsoidDistance(glm::vec3(0), glm::vec3(0), radii), -0.1f);
}

}  // namespace
}  // namespace rigel::tools
