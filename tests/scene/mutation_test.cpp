// Damage at random: whatever a file holds, loading ends with a scene that can be posed and sampled, or with one line.
#include "scene/gltf_save.h"
#include "scene/surface.h"
#include "scene_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <random>

namespace rigel::tools {
namespace {

std::string slurp(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// True when loaded. Everything a report would do with the scene must then work too.
bool tryToUse(const std::filesystem::path& file) {
  const auto scene = loadGltf(file);
  if (!scene) {
    EXPECT_EQ(scene.error().line().find('\n'), std::string::npos) << scene.error().line();
    EXPECT_EQ(scene.error().line().find(file.string()), 0u);
    return false;
  }
  ScenePose pose;
  PosedObject posed;
  PosedLights lights;
  for (int clip = kRestPose; clip < static_cast<int>(scene->animations.size()); ++clip) {
    poseScene(*scene, clip, 0.3, pose);
    poseLights(*scene, pose, lights);
    for (const SceneObject& object : findObjects(*scene)) {
      poseObject(*scene, object, pose, posed);
      const auto points = sampleSurface(object, posed, 16, 1);
      if (!points) continue;
      for (const SurfacePoint& point : *points) {
        const Vec3 n = evaluateSurface(object, posed, point).normal;
        EXPECT_TRUE(std::isfinite(n.x) && std::isfinite(n.y) && std::isfinite(n.z));
      }
    }
  }
  return true;
}

// Bytes that mean something in JSON, next to any byte at all.
char randomByte(std::mt19937& engine) {
  const std::string meaningful = "0123456789-+.eE,:{}[]\"tfn \\/%";
  const auto roll = engine();
  return roll % 3 == 0 ? static_cast<char>(roll >> 8) : meaningful[(roll >> 8) % meaningful.size()];
}

void mutate(const std::string& original, const std::string& extension, int rounds, std::uint32_t seed) {
  const test::TemporaryFolder folder;
  std::mt19937 engine(seed);
  int loaded = 0;
  for (int round = 0; round < rounds; ++round) {
    std::string content = original;
    const int changes = 1 + static_cast<int>(engine() % 4);
    for (int c = 0; c < changes; ++c) {
      const std::size_t at = engine() % content.size();
      switch (engine() % 4) {
        case 0:
          content.erase(at, 1 + engine() % 8);
          break;
        case 1:
          content.insert(at, 1, randomByte(engine));
          break;
        default:
          content[at] = randomByte(engine);
          break;
      }
      if (content.empty()) content = " ";
    }
    test::writeFile(folder / ("m" + extension), content);
    loaded += tryToUse(folder / ("m" + extension)) ? 1 : 0;
    ASSERT_FALSE(testing::Test::HasFailure()) << "round " << round << " seed " << seed;
  }
  // Both outcomes must occur, or the test has tested nothing.
  EXPECT_GT(loaded, 0);
  EXPECT_LT(loaded, rounds);
  std::printf("[ measured ] %d of %d damaged %s files still load\n", loaded, rounds, extension.c_str());
}

TEST(Mutation, DamagedJson) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(saveGltf(test::everythingScene(), folder / "a.gltf"));
  mutate(slurp(folder / "a.gltf"), ".gltf", 1500, 1);
}

TEST(Mutation, DamagedGlb) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(saveGltf(test::everythingScene(), folder / "a.glb"));
  mutate(slurp(folder / "a.glb"), ".glb", 1500, 2);
}

// Valid JSON of the right shape with wrong values: gets past the parser more often than damaged bytes do.
void replaceOneValue(nlohmann::json& document, std::mt19937& engine) {
  std::vector<nlohmann::json*> values;
  const auto collect = [&](auto&& self, nlohmann::json& value) -> void {
    values.push_back(&value);
    if (value.is_structured()) {
      for (nlohmann::json& child : value) self(self, child);
    }
  };
  collect(collect, document);
  const nlohmann::json replacements[] = {0,
                                         1,
                                         2,
                                         7,
                                         -1,
                                         255,
                                         65535,
                                         4294967295u,
                                         1e18,
                                         1e300,
                                         -1e300,
                                         0.5,
                                         true,
                                         nullptr,
                                         "",
                                         "%",
                                         nlohmann::json::array(),
                                         nlohmann::json::object(),
                                         {0, 0},
                                         {1, 2, 3}};
  *values[engine() % values.size()] = replacements[engine() % std::size(replacements)];
}

TEST(Mutation, WrongValuesInValidJson) {
  constexpr int kRounds = 2500;
  const test::TemporaryFolder folder;
  ASSERT_TRUE(saveGltf(test::everythingScene(), folder / "a.gltf"));
  const auto original = nlohmann::json::parse(slurp(folder / "a.gltf"));
  std::mt19937 engine(3);
  int loaded = 0;
  for (int round = 0; round < kRounds; ++round) {
    nlohmann::json document = original;
    replaceOneValue(document, engine);
    if (round % 2 == 0) replaceOneValue(document, engine);
    test::writeFile(folder / "m.gltf", document.dump());
    loaded += tryToUse(folder / "m.gltf") ? 1 : 0;
    ASSERT_FALSE(HasFailure()) << "round " << round << ": " << document.dump().substr(0, 4000);
  }
  EXPECT_GT(loaded, 0);
  EXPECT_LT(loaded, kRounds);
  std::printf("[ measured ] %d of %d files with wrong values still load\n", loaded, kRounds);
}

}  // namespace
}  // namespace rigel::tools
