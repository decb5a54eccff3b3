#include "picture/camera.h"

#include <gmock/gmock.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <random>

namespace rigel::tools {
namespace {

constexpr float kPixel = 0.02f;  // of float geometry at some hundred pixels

std::vector<glm::vec3> cloud(glm::vec3 stretch, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(-1, 1);
  std::vector<glm::vec3> points;
  for (int i = 0; i < count; ++i) {
    points.push_back(stretch * glm::vec3(uniform(random), uniform(random), uniform(random)) + glm::vec3(3, 1, -2));
  }
  return points;
}

TEST(BoundingSphere, HoldsAllPointsAndIsNearlySmallest) {
  for (const glm::vec3 stretch : {glm::vec3(1), glm::vec3(4, 0.5f, 0.5f), glm::vec3(0.1f, 2, 1)}) {
    const auto points = cloud(stretch, 2000, 5);
    const BoundingSphere sphere = boundingSphere(points);
    float farthest = 0, diameter = 0;
    for (const glm::vec3 p : points) {
      farthest = std::max(farthest, glm::distance(p, sphere.centre));
      diameter = std::max(diameter, glm::distance(p, points.front()));
    }
    EXPECT_LE(farthest, sphere.radius * 1.00001f);
    EXPECT_LE(sphere.radius, 1.2f * glm::length(stretch));
    EXPECT_GE(2 * sphere.radius, diameter);
  }
  EXPECT_EQ(boundingSphere({}).radius, 0);
}

TEST(Camera, DirectionAndProjectionAreInverse) {
  View view;
  view.yaw = 2.2f;
  view.pitch = 0.4f;
  const Camera camera = frameSphere({{1, 2, 3}, 2.5f}, 640, 360, view);
  for (const glm::vec2 pixel : {glm::vec2(0, 0), glm::vec2(320, 180), glm::vec2(639.5f, 2), glm::vec2(17.25f, 300)}) {
    const glm::vec3 d = camera.direction(pixel);
    EXPECT_NEAR(glm::length(d), 1, 1e-6f);
    EXPECT_LT(glm::distance(camera.project(camera.eye + 7.0f * d), pixel), kPixel);
  }
}

TEST(Camera, AxesAreRightHandedAndUpright) {
  for (const float yaw : {-2.0f, 0.0f, 0.7f, 3.0f}) {
    View view;
    view.yaw = yaw;
    const Camera camera = frameSphere({{0, 0, 0}, 1}, 100, 100, view);
    EXPECT_LT(glm::distance(glm::cross(camera.axes[0], camera.axes[1]), camera.axes[2]), 1e-6f);
    EXPECT_NEAR(camera.axes[0].y, 0, 1e-6f) << "the horizon tilts";
    EXPECT_GT(camera.axes[1].y, 0);
  }
  View front;
  front.yaw = front.pitch = 0;
  EXPECT_GT(frameSphere({{0, 0, 0}, 1}, 100, 100, front).eye.z, 1) << "yaw 0 looks at the front, +z";
}

/// Extent of the points in the picture: left, top, right, bottom.
glm::vec4 extent(const Camera& camera, const std::vector<glm::vec3>& points) {
  glm::vec4 e{1e9f, 1e9f, -1e9f, -1e9f};
  for (const glm::vec3 p : points) {
    const glm::vec2 q = camera.project(p);
    e = {std::min(e.x, q.x), std::min(e.y, q.y), std::max(e.z, q.x), std::max(e.w, q.y)};
  }
  return e;
}

TEST(Camera, FramesTheSphereExactly) {
  for (const glm::ivec2 size : {glm::ivec2(640, 360), glm::ivec2(300, 300), glm::ivec2(200, 500)}) {
    const BoundingSphere sphere{{1, 0.5f, -2}, 1.7f};
    const View view;
    const Camera camera = frameSphere(sphere, size.x, size.y, view);
    std::vector<glm::vec3> surface;
    constexpr int kSteps = 200;
    for (int i = 0; i < kSteps; ++i)
      for (int j = 0; j < kSteps; ++j) {
        const float a = 6.2831853f * static_cast<float>(i) / kSteps;
        const float c = 2 * (static_cast<float>(j) + 0.5f) / kSteps - 1, s = std::sqrt(1 - c * c);
        surface.push_back(sphere.centre + sphere.radius * glm::vec3(s * std::cos(a), c, s * std::sin(a)));
      }
    const glm::vec4 e = extent(camera, surface);
    const auto narrow = static_cast<float>(std::min(size.x, size.y));
    EXPECT_GE(std::min({e.x, e.y, static_cast<float>(size.x) - e.z, static_cast<float>(size.y) - e.w}),
              view.margin * narrow - kPixel);
    // Filled up to the margin, short of the gap between the points on the sphere.
    EXPECT_GT(std::max(e.z - e.x, e.w - e.y), (1 - 2 * view.margin) * narrow * 0.995f);
  }
}

TEST(Camera, FramesPointsUpToTheMarginOnBothSides) {
  for (const glm::vec3 stretch : {glm::vec3(1), glm::vec3(0.5f, 0.5f, 4), glm::vec3(0.3f, 2, 0.3f)}) {
    for (const glm::ivec2 size : {glm::ivec2(640, 360), glm::ivec2(200, 500)}) {
      const auto points = cloud(stretch, 500, 11);
      const View view;
      const glm::vec4 e = extent(framePoints(points, size.x, size.y, view), points);
      const float w = static_cast<float>(size.x), h = static_cast<float>(size.y);
      EXPECT_GE(e.x, view.margin * w - kPixel);
      EXPECT_GE(e.y, view.margin * h - kPixel);
      EXPECT_LE(e.z, w - view.margin * w + kPixel);
      EXPECT_LE(e.w, h - view.margin * h + kPixel);
      // One of both directions is used up.
      EXPECT_LT(std::min((1 - 2 * view.margin) * w - (e.z - e.x), (1 - 2 * view.margin) * h - (e.w - e.y)), 2 * kPixel);
    }
  }
}

TEST(Camera, FramesAPointAtAFiniteDistance) {
  const std::vector<glm::vec3> point{{1, 2, 3}};
  const Camera camera = framePoints(point, 100, 100);
  EXPECT_GT(glm::distance(camera.eye, point[0]), 1);
  EXPECT_LT(glm::distance(camera.project(point[0]), glm::vec2(50, 50)), kPixel);
}

}  // namespace
}  // namespace rigel::tools
