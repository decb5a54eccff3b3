#include "report/measure/far_truth.h"

#include "report/run/loaded_scene.h"

#include <rigel/near_far.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace rigel::tests {
namespace {

using namespace rigel::tools;

/// The far lights' own set, projected at every point: the slow way. Both are sums of the same floats, taken in another
/// order and precision: relative to the irradiance of all light at the point, and in W/m2 where that passes 0.
constexpr double kShareTolerance = 1e-6;

struct Frame {
  RunOptions options;
  std::optional<LoadedScene> scene;
  std::optional<Stage> stage;
  SceneObject object;
  PosedObject posed;
  SurfaceSet surface;
  Truth truth;

  explicit Frame(const std::string& name) {
    options.scenes = {name};
    scene.emplace(*LoadedScene::load(name, options, nullptr));
    stage.emplace(*Stage::create(*scene, scene->timelines().front()));
    for (const SceneObject& candidate : scene->objects())
      if (!candidate.isStatic) object = candidate;
    stage->pose(25);
    poseObject(scene->scene(), object, stage->nodes(), posed);
    surface = *chooseSurface(object, posed, 64, 0.2f);
    truth.update(object, posed, surface, stage->lights().set, 3);
  }
};

TEST(FarTruth, IsTheIrradianceOfWhatIsFar) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> weight(0, 1);
  int compared = 0;
  for (const char* name : {"sample:street", "sample:touch", "sample:gallery"}) {
    Frame frame(name);
    const LightSet& lights = frame.stage->lights().set;
    for (const int bands : {2, 3, 4, 5}) {
      FarTruth far;
      far.begin(frame.truth, frame.surface, lights, bands);
      for (int round = 0; round < 4; ++round) {
        std::vector<LightVerdict> verdicts(static_cast<std::size_t>(round == 0 ? 0 : lights.size()));
        std::vector<float> weights(static_cast<std::size_t>(lights.size()), 0.0f);
        for (std::size_t i = 0; i < verdicts.size(); ++i)
          verdicts[i].weight = weights[i] = round == 1 ? 1.0f : i % 3 == 0 ? weight(random) : 0.0f;
        LightSet left;
        std::vector<NearLight> near;
        splitLights(lights, weights, left, near);
        std::vector<Rgb> expected, actual;
        frame.truth.project(left, frame.surface, bands, expected);
        far.irradiance(verdicts, actual);
        ASSERT_EQ(actual.size(), expected.size());
        std::vector<Rgb> all;
        frame.truth.project(lights, frame.surface, bands, all);
        for (std::size_t i = 0; i < all.size(); ++i)
          for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(actual[i][c], expected[i][c], kShareTolerance * (1 + std::abs(static_cast<double>(all[i][c]))))
                << name << ", " << bands << " bands, round " << round;
            ++compared;
          }
      }
    }
  }
  EXPECT_EQ(compared, 3 * 4 * 4 * 64 * 3);
}

}  // namespace
}  // namespace rigel::tests
