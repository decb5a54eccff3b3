// Value and slopes of many distant lights at one point against the scalar projections, on every set of instructions.
#include <rigel/far_lights.h>

#include "lights/every_target.h"

#include <cmath>
#include <random>

namespace rigel::test {
namespace {

struct Scene {
  LightSet lights;
  std::vector<LightUse> uses;
  Vec3 p;
};

/// `kinds`: of them each light is one; distances from two radii to a million.
Scene randomScene(std::mt19937& random, int count) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::normal_distribution<double> normal;
  Scene scene;
  scene.p = {static_cast<float>(normal(random)), static_cast<float>(normal(random)),
             static_cast<float>(normal(random))};
  const double size = std::exp(14 * (unit(random) - 0.5));
  scene.p = scene.p * static_cast<float>(size);
  for (int i = 0; i < count; ++i) {
    const Vec3 v{static_cast<float>(normal(random)), static_cast<float>(normal(random)),
                 static_cast<float>(normal(random))};
    const Vec3 w = v * (1 / length(v));
    const double d = size * std::exp(6 * (unit(random) - 0.3));
    const auto radius = static_cast<float>(d / 2.001 * std::exp(-13 * unit(random) * unit(random)));
    const Vec3 position = scene.p + w * static_cast<float>(d);
    const Rgb colour{static_cast<float>(unit(random)), static_cast<float>(unit(random)),
                     static_cast<float>(unit(random))};
    const int kind = static_cast<int>(4 * unit(random));
    if (kind == 0) scene.lights.add(SphereLight{position, radius, colour});
    if (kind == 1) scene.lights.add(PointLight{position, colour, radius});
    if (kind == 2) scene.lights.add(SpotLight{position, -w, colour, 0.5f, 0.9f, radius});
    if (kind == 3) scene.lights.add(DirectionalLight{-w, colour * 1e-6f});
  }
  for (int i = 0; i < count; ++i)
    scene.uses.push_back({static_cast<std::uint32_t>(i), i % 3 == 0 ? 1 : static_cast<float>(unit(random))});
  return scene;
}

template <int B>
void expectLikeScalar(const Scene& scene) {
  PreparedLights prepared;
  prepared.set(scene.lights);
  std::vector<double> value(3 * B * B), slope(9 * B * B);
  double whole = 0, steep = 0;
  for (const LightUse& use : scene.uses) {
    scene.lights.visit(static_cast<int>(use.light), [&](const auto& light) {
      const auto one = projectWithGradient<B>(light, scene.p);
      double norm = 0;
      for (int i = 0; i < B * B; ++i) {
        for (int c = 0; c < 3; ++c) {
          value[3 * i + c] += double{use.share} * one.value[i][c];
          norm += std::pow(one.value[i][c], 2);
          for (int a = 0; a < 3; ++a) slope[9 * i + 3 * a + c] += double{use.share} * one.gradient.d[a][i][c];
        }
      }
      whole += use.share * std::sqrt(norm);
      if constexpr (requires { light.position; })
        steep += use.share * std::sqrt(norm) / length(light.position - scene.p);
    });
  }
  const auto found = projectFar<B>(prepared, scene.uses, scene.p);
  // Positions round to float before they are subtracted in both; measured: 6e-7 and 1.6e-6.
  constexpr double kValue = 1e-6, kSlope = 3e-6;
  for (int i = 0; i < B * B; ++i) {
    for (int c = 0; c < 3; ++c) {
      ASSERT_NEAR(found.value[i][c], value[3 * i + c], kValue * whole);
      for (int a = 0; a < 3; ++a)
        ASSERT_NEAR(found.gradient.d[a][i][c], slope[9 * i + 3 * a + c], kSlope * steep + 1e-30);
    }
  }
}

/// A list says what the lights do, at any point and however many it has held before.
template <int B>
void expectListedAlike(Scene scene, FarLightList& list) {
  std::erase_if(scene.uses, [&](const LightUse& use) {
    return use.light < static_cast<std::uint32_t>(scene.lights.directionalCount());
  });
  PreparedLights prepared;
  prepared.set(scene.lights);
  list.set(prepared, scene.uses);
  for (const Vec3 off : {Vec3{}, Vec3{0.01f, -0.02f, 0}}) {
    const Vec3 p = scene.p + off * length(scene.p);
    const auto one = projectFar<B>(prepared, scene.uses, p), all = projectFar<B>(list, p);
    for (int i = 0; i < B * B; ++i)
      for (int c = 0; c < 3; ++c) {
        // Sums in another order.
        const float whole = one.value[0][c];
        ASSERT_NEAR(all.value[i][c], one.value[i][c], 1e-6f * whole);
        for (int a = 0; a < 3; ++a)
          ASSERT_NEAR(all.gradient.d[a][i][c], one.gradient.d[a][i][c],
                      2e-6f * (std::abs(one.gradient.d[a][i][c]) + whole / length(scene.p)));
      }
  }
}

TEST(FarLights, ListsSayTheSame) {
  onEveryTarget([] {
    std::mt19937 random(4);
    FarLightList list;
    for (const int count : {300, 0, 1, 63, 64, 65, 700}) {
      const Scene scene = randomScene(random, count);
      expectListedAlike<2>(scene, list);
      expectListedAlike<3>(scene, list);
      expectListedAlike<4>(scene, list);
    }
  });
  // What is missing in a block is dark where the block is seen from too.
  LightSet lights;
  lights.add(PointLight{{3, 4, 5}, {1, 2, 3}});
  PreparedLights prepared;
  prepared.set(lights);
  FarLightList list;
  const LightUse use[] = {{0, 1}};
  list.set(prepared, use);
  const auto found = projectFar<3>(list, {}), expected = projectWithGradient<3>(lights.point(0), {});
  for (int i = 0; i < 9; ++i) {
    EXPECT_NEAR(found.value[i].g, expected.value[i].g, 1e-7f);
    EXPECT_NEAR(found.gradient.d[2][i].g, expected.gradient.d[2][i].g, 1e-7f);
  }
}

TEST(FarLights, AreAsTheScalarFunctionsSay) {
  onEveryTarget([] {
    std::mt19937 random(3);
    for (const int count : {0, 1, 2, 7, 15, 16, 17, 63, 64, 65, 130, 300}) {
      for (int i = 0; i < 10; ++i) {
        const Scene scene = randomScene(random, count);
        expectLikeScalar<2>(scene);
        expectLikeScalar<3>(scene);
        if (i > 0) continue;
        expectLikeScalar<4>(scene);
        expectLikeScalar<5>(scene);
      }
    }
  });
}

TEST(FarLights, ClustersBehindTheSetCountToo) {
  LightSet lights;
  lights.add(PointLight{{3, 4, 5}, {1, 2, 3}});
  const SphereLight cluster{{-3, 2, 8}, 0.1f, {40, 50, 60}};
  PreparedLights prepared;
  prepared.set(lights);
  const LightUse uses[] = {{prepared.add(cluster), 0.5f}};
  const auto found = projectFar<3>(prepared, uses, {1, 1, 1});
  const auto expected = projectWithGradient<3>(cluster, {1, 1, 1});
  for (int i = 0; i < 9; ++i) {
    EXPECT_NEAR(found.value[i].g, 0.5f * expected.value[i].g, 1e-7f);
    EXPECT_NEAR(found.gradient.d[1][i].g, 0.5f * expected.gradient.d[1][i].g, 1e-7f);
  }
}

// Touching, inside, at infinity, NaN: out of contract, and finite all the same.
TEST(FarLights, EverythingElseIsFinite) {
  LightSet lights;
  const float inf = kNoRange, nan = std::nanf("");
  for (const Vec3 p :
       {Vec3{0, 0, 0}, Vec3{1e-30f, 0, 0}, Vec3{1, 0, 0}, Vec3{1e20f, 0, 0}, Vec3{inf, 0, 0}, Vec3{nan, 0, 0}}) {
    for (const float radius : {0.0f, 1.0f, 1e20f, nan}) {
      lights.add(SphereLight{p, radius, {1, 2, 3}});
      lights.add(PointLight{p, {1, 2, 3}, radius});
    }
  }
  lights.add(DiskLight{{1, 2, 3}, {0, 1, 0}, 1, {1, 1, 1}});
  PreparedLights prepared;
  prepared.set(lights);
  std::vector<LightUse> uses;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(lights.size()); ++i) uses.push_back({i, 1});
  onEveryTarget([&] {
    const auto found = projectFar<3>(prepared, uses, {});
    for (int i = 0; i < 9; ++i) {
      for (int c = 0; c < 3; ++c) {
        EXPECT_TRUE(std::isfinite(found.value[i][c]));
        for (int a = 0; a < 3; ++a) EXPECT_TRUE(std::isfinite(found.gradient.d[a][i][c]));
      }
    }
  });
}

}  // namespace
}  // namespace rigel::test
