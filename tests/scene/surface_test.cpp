// Surface samples: stratification, uniformity, degenerate triangles, evaluation.
#include "scene/surface.h"

#include "scene_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace rigel::tools {
namespace {

struct Posed {
  SceneObject object;
  PosedObject posed;
};

Posed poseTriangles(const std::vector<glm::vec3>& corners) {
  const Scene scene = test::triangleScene(corners);
  ScenePose pose;
  poseScene(scene, kRestPose, 0, pose);
  Posed out{findObjects(scene).at(0), {}};
  poseObject(scene, out.object, pose, out.posed);
  return out;
}

// Triangles whose areas span nine orders of magnitude.
std::vector<glm::vec3> unequalTriangles() {
  std::vector<glm::vec3> corners;
  std::mt19937 engine(7);
  std::uniform_real_distribution<float> unit(-1, 1), exponent(-4.5f, 0);
  for (int t = 0; t < 200; ++t) {
    const float size = std::pow(10.f, exponent(engine));
    for (int c = 0; c < 3; ++c) corners.push_back(size * glm::vec3(unit(engine), unit(engine), unit(engine)));
  }
  return corners;
}

double areaOf(const Posed& p, std::size_t t) {
  const glm::uvec3& v = p.object.triangles[t];
  const glm::dvec3 a(p.posed.positions[v.x]), b(p.posed.positions[v.y]), c(p.posed.positions[v.z]);
  return 0.5 * glm::length(glm::cross(b - a, c - a));
}

TEST(Surface, PointILiesInTheIthShareOfTheArea) {
  const Posed p = poseTriangles(unequalTriangles());
  std::vector<double> upTo{0};
  for (std::size_t t = 0; t < p.object.triangles.size(); ++t) upTo.push_back(upTo.back() + areaOf(p, t));
  constexpr int kCount = 4096;
  for (const std::uint32_t seed : {0u, 1u, 77u, 0xffffffffu}) {
    const auto points = sampleSurface(p.object, p.posed, kCount, seed);
    ASSERT_TRUE(points);
    ASSERT_EQ(points->size(), static_cast<std::size_t>(kCount));
    const double slack = 1e-12 * upTo.back();  // the running sums round differently
    for (int i = 0; i < kCount; ++i) {
      const std::size_t t = (*points)[i].triangle;
      EXPECT_GE(upTo[t + 1], upTo.back() * i / kCount - slack) << i;
      EXPECT_LE(upTo[t], upTo.back() * (i + 1) / kCount + slack) << i;
    }
  }
}

TEST(Surface, CountsPerTriangleFollowTheArea) {
  const Posed p = poseTriangles(unequalTriangles());
  double total = 0;
  for (std::size_t t = 0; t < p.object.triangles.size(); ++t) total += areaOf(p, t);
  constexpr int kCount = 4096;
  const auto points = sampleSurface(p.object, p.posed, kCount, 3);
  ASSERT_TRUE(points);
  std::vector<int> counts(p.object.triangles.size(), 0);
  for (const SurfacePoint& point : *points) ++counts[point.triangle];
  double worst = 0;
  for (std::size_t t = 0; t < counts.size(); ++t)
    worst = std::max(worst, std::abs(counts[t] - kCount * areaOf(p, t) / total));
  // A run of shares that begins and ends in the middle of one: never off by more than two points.
  EXPECT_LT(worst, 2);
  std::printf("[ measured ] points per triangle against area: off by at most %.2f\n", worst);
}

TEST(Surface, PointsFillATriangleEvenly) {
  // Sixteen equal sub-triangles of one: chi-square of evenly spread points is far below that of random ones.
  const Posed p = poseTriangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  constexpr int kCount = 4096, kCells = 16;
  double worst = 0;
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const auto points = sampleSurface(p.object, p.posed, kCount, seed);
    ASSERT_TRUE(points);
    int counts[kCells] = {};
    for (const SurfacePoint& point : *points) {
      ASSERT_GE(point.b1, 0);
      ASSERT_GE(point.b2, 0);
      ASSERT_LE(point.b1 + point.b2, 1 + 1e-6f);
      const int i = std::min(static_cast<int>(point.b1 * 4), 3), j = std::min(static_cast<int>(point.b2 * 4), 3);
      const bool upper = point.b1 * 4 + point.b2 * 4 > static_cast<float>(i + j + 1);
      // Row i has 2 (3 - i) + 1 cells.
      const int rowStart[] = {0, 7, 12, 15};
      ++counts[std::min(rowStart[i] + 2 * j + (upper ? 1 : 0), kCells - 1)];
    }
    double chiSquare = 0;
    for (const int n : counts) chiSquare += std::pow(n - kCount / 16., 2) / (kCount / 16.);
    worst = std::max(worst, chiSquare);
  }
  // 15 degrees of freedom: random points stay below 25 in 95% of cases; ours must stay below a fifth of the mean.
  EXPECT_LT(worst, 3);
  std::printf("[ measured ] chi-square of 16 cells: at most %.2f (random points: 15 on average)\n", worst);
}

TEST(Surface, MeanPositionIsTheCentroid) {
  const Posed p = poseTriangles(unequalTriangles());
  glm::dvec3 centroid(0), mean(0);
  double total = 0;
  for (std::size_t t = 0; t < p.object.triangles.size(); ++t) {
    const glm::uvec3& v = p.object.triangles[t];
    const glm::dvec3 middle =
        (glm::dvec3(p.posed.positions[v.x]) + glm::dvec3(p.posed.positions[v.y]) + glm::dvec3(p.posed.positions[v.z])) /
        3.;
    centroid += areaOf(p, t) * middle;
    total += areaOf(p, t);
  }
  centroid /= total;
  const auto points = sampleSurface(p.object, p.posed, 4096, 1);
  ASSERT_TRUE(points);
  for (const SurfacePoint& point : *points) {
    const PointAndNormal at = evaluateSurface(p.object, p.posed, point);
    EXPECT_EQ(surfacePosition(p.object, p.posed, point), at.position);
    mean += glm::dvec3(at.position.x, at.position.y, at.position.z) / 4096.;
  }
  // Random points would be off by about 1/64 of the extent of 1; worst measured 2e-4.
  EXPECT_LT(glm::distance(mean, centroid), 1.5e-3);
}

TEST(Surface, DegenerateTrianglesAreNeverChosen) {
  // First, middle and last triangle without area, and one of a line.
  const Posed p = poseTriangles({{5, 5, 5},
                                 {5, 5, 5},
                                 {5, 5, 5},
                                 {0, 0, 0},
                                 {1, 0, 0},
                                 {0, 1, 0},
                                 {0, 0, 0},
                                 {1, 1, 1},
                                 {2, 2, 2},
                                 {0, 0, 1},
                                 {1, 0, 1},
                                 {0, 1, 1},
                                 {7, 7, 7},
                                 {7, 7, 7},
                                 {8, 8, 8}});
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    const auto points = sampleSurface(p.object, p.posed, 33, seed);
    ASSERT_TRUE(points);
    for (const SurfacePoint& point : *points) EXPECT_TRUE(point.triangle == 1 || point.triangle == 3) << point.triangle;
  }
}

TEST(Surface, SeedsDifferAndRepeat) {
  const Posed p = poseTriangles(unequalTriangles());
  const auto a = sampleSurface(p.object, p.posed, 64, 1), b = sampleSurface(p.object, p.posed, 64, 1),
             c = sampleSurface(p.object, p.posed, 64, 2);
  ASSERT_TRUE(a && b && c);
  int same = 0;
  for (int i = 0; i < 64; ++i) {
    EXPECT_EQ((*a)[i].b1, (*b)[i].b1);
    EXPECT_EQ((*a)[i].triangle, (*b)[i].triangle);
    same += (*a)[i].b1 == (*c)[i].b1;
  }
  EXPECT_LT(same, 3);
}

TEST(Surface, NoAreaIsAnErrorThatNamesTheObject) {
  const Posed p = poseTriangles({{1, 1, 1}, {1, 1, 1}, {2, 2, 2}});
  const auto points = sampleSurface(p.object, p.posed, 16, 1);
  ASSERT_FALSE(points);
  EXPECT_EQ(points.error().line(), "object \"mesh\": has no area: nothing to light");
  EXPECT_FALSE(sampleSurface(p.object, p.posed, 0, 1));
}

TEST(Surface, AreasNearTheEndsOfTheFloatRangeStillWork) {
  for (const float scale : {1e-18f, 1e-6f, 1e18f}) {
    const Posed p = poseTriangles({glm::vec3(0), scale * glm::vec3(1, 0, 0), scale * glm::vec3(0, 1, 0)});
    EXPECT_TRUE(sampleSurface(p.object, p.posed, 16, 1)) << scale;
  }
}

TEST(Surface, FlatTrianglesUseTheirOwnNormal) {
  const Posed p = poseTriangles({{0, 0, 0}, {0, 0, 2}, {0, 2, 0}});
  const PointAndNormal at = evaluateSurface(p.object, p.posed, {0, 0.25f, 0.5f});
  EXPECT_EQ(at.position, (Vec3{0, 1, 0.5f}));
  EXPECT_EQ(at.normal, (Vec3{-1, 0, 0}));
}

TEST(Surface, FlatNormalsDoNotDependOnTheSize) {
  for (const float scale : {1e-30f, 1e-15f, 1e15f, 1e30f}) {
    const Posed p = poseTriangles({glm::vec3(0), scale * glm::vec3(0, 0, 1), scale * glm::vec3(0, 1, 0)});
    EXPECT_EQ(evaluateSurface(p.object, p.posed, {0, 0.25f, 0.5f}).normal, (Vec3{-1, 0, 0})) << scale;
  }
}

TEST(Surface, CancellingAndMissingNormalsFallBack) {
  Posed p = poseTriangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  p.posed.normals = {{1, 0, 0}, {-1, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(evaluateSurface(p.object, p.posed, {0, 0.5f, 0}).normal, (Vec3{0, 0, 1}));
  // A pose that collapses the triangle: any unit normal, never NaN.
  p.posed.positions = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
  EXPECT_EQ(evaluateSurface(p.object, p.posed, {0, 0.5f, 0}).normal, (Vec3{1, 0, 0}));
  p.posed.normals.assign(3, glm::vec3(0));
  EXPECT_EQ(evaluateSurface(p.object, p.posed, {0, 0.5f, 0}).normal, (Vec3{0, 1, 0}));
}

}  // namespace
}  // namespace rigel::tools
