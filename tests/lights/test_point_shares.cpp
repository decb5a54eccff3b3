// Shares of lights that differ from point to point: as if each point had been asked apart.
#include <rigel/project_batch.h>

#include <gtest/gtest.h>

#include "lights/batch_points.h"
#include "lights/every_target.h"

namespace rigel {
namespace {

using test::BatchPoints;

LightSet everyKind(int ofEach = 19) {
  LightSet lights;
  lights.add(DirectionalLight{{0.3f, -1, 0.2f}, {1, 2, 3}});
  lights.add(DirectionalLight{{-0.3f, 1, 0.2f}, {3, 2, 1}});
  for (int i = 0; i < ofEach; ++i) {
    const float t = static_cast<float>(i % 19) + 0.01f * static_cast<float>(i / 19);
    // Some of them do not reach all points.
    lights.add(PointLight{{t - 9, 2, 1}, {3, 4, 5}, 0.01f, i % 3 == 0 ? 4.0f : kNoRange});
    lights.add(SpotLight{{1, 3, t - 9}, {0.2f, -1, 0.1f * t}, {5, 4, 3}, 0.2f, 0.6f});
    lights.add(SphereLight{{0.4f * t - 3, -2, 0.3f * t}, 0.3f, {7, 8, 9}});
  }
  lights.add(SphereLight{{0.5f, 0, 0}, 0.6f, {1, 1, 2}});  // holds some of the points
  lights.add(DiskLight{{0, 3, 0}, {0, -1, 0.1f}, 0.5f, {2, 3, 4}});
  lights.add(DiskLight{{2, 0, 0}, {-1, 0, 0}, 0.5f, {4, 3, 2}, true});
  return lights;
}

template <int B>
void compare(std::size_t count, std::size_t period, int ofEach = 19) {
  SCOPED_TRACE(std::to_string(B) + " bands, " + std::to_string(count) + " points, period " + std::to_string(period));
  PreparedLights lights;
  lights.set(everyKind(ofEach));
  std::vector<LightUse> uses(lights.all().begin(), lights.all().end());
  for (std::size_t u = 0; u < uses.size(); u += 5) uses[u].share = 0.5f;
  std::vector<std::vector<float>> numbers(uses.size());
  std::vector<const float*> rows(uses.size(), nullptr);
  for (std::size_t u = 0; u < uses.size(); ++u) {
    if (u % 3 == 2) continue;
    for (std::size_t i = 0; i < period + PointShares::kRowEnd; ++i)
      numbers[u].push_back(static_cast<float>((i % period + u) % 4) / 3);
    rows[u] = numbers[u].data();
  }
  BatchPoints points;
  std::vector<float> footprints(count);
  for (std::size_t i = 0; i < count; ++i) {
    points.add({0.3f * static_cast<float>(i % 7), 0.1f * static_cast<float>(i % 5), 0.2f * static_cast<float>(i % 3)});
    footprints[i] = 0.1f * static_cast<float>(i % 2);
  }
  std::vector<float> sums(3 * B * B * count, -12345.0f);
  projectBatch<B>(lights, uses, points.rows(), footprints, sums, {rows, period});

  for (std::size_t i = 0; i < count; ++i) {
    std::vector<LightUse> own = uses;
    for (std::size_t u = 0; u < uses.size(); ++u)
      if (rows[u] != nullptr) own[u].share *= numbers[u][i % period];
    BatchPoints point;
    point.add(points[i]);
    std::vector<float> expected(3 * B * B);
    projectBatch<B>(lights, own, point.rows(), std::span(footprints).subspan(i, 1), expected);
    double norm = 0, error = 0;
    for (std::size_t k = 0; k < expected.size(); ++k) {
      norm += std::pow(static_cast<double>(expected[k]), 2);
      error += std::pow(static_cast<double>(expected[k] - sums[k * count + i]), 2);
    }
    // The order of two products. Worst measured 1.4e-7.
    ASSERT_GT(norm, 0);
    ASSERT_LT(std::sqrt(error / norm), 1e-6) << "point " << i;
  }
}

TEST(PointShares, AreThoseOfEachPoint) {
  test::onEveryTarget([] {
    for (const std::size_t period : {1, 2, 5, 8, 15, 16, 17, 40})
      for (const std::size_t count : {1, 5, 16, 37, 192}) compare<3>(count, period);
    compare<2>(50, 10);
    compare<4>(50, 10);
    compare<5>(50, 10);
    // More than are sorted at once.
    compare<3>(192, 16, 90);
    compare<4>(50, 10, 90);
  });
}

TEST(PointShares, RowsOfNothingChangeNoBit) {
  PreparedLights lights;
  lights.set(everyKind());
  const std::span<const LightUse> uses = lights.all();
  BatchPoints points;
  for (int i = 0; i < 37; ++i) points.add({0.1f * static_cast<float>(i), 0.3f, 0.2f});
  std::vector<float> plain(27 * 37), shared(27 * 37);
  const std::vector<const float*> rows(uses.size(), nullptr);
  projectBatch<3>(lights, uses, points.rows(), {}, plain);
  projectBatch<3>(lights, uses, points.rows(), {}, shared, {rows, 5});
  EXPECT_EQ(plain, shared);
}

}  // namespace
}  // namespace rigel
