// Real characters, and the malformed files of the glTF validator. Both lie outside the repository: where they are
// missing each test says so and passes.
#include "scene/gltf_save.h"
#include "scene/surface.h"
#include "scene_files.h"
#include "support/validator_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace rigel::tools {
namespace {

const std::filesystem::path kData = RIGEL_SHARED_DATA;

bool isThere(const std::filesystem::path& path) {
  if (std::filesystem::exists(path)) return true;
  std::printf("[ no data  ] %s is not there: nothing tested\n", path.c_str());
  return false;
}

struct Character {
  const char* file;
  std::size_t objects, triangles, joints, clips;
};

TEST(SharedFiles, RealCharactersLoadAndMove) {
  const Character characters[] = {
      {"characters/soldier/soldier1.gltf", 1, 3144, 25, 3},    {"characters/Fox.glb", 1, 576, 24, 3},
      {"characters/simple_skin/simple_skin.gltf", 1, 8, 2, 1}, {"vehicles/car/car.gltf", 2, 334, 2, 1},
      {"scenes/collisions_level/level.gltf", 5, 558, 0, 0},
  };
  if (!isThere(kData / "characters")) return;
  for (const Character& c : characters) {
    SCOPED_TRACE(c.file);
    const auto scene = loadGltf(kData / c.file);
    ASSERT_TRUE(scene) << scene.error().line();
    const auto objects = findObjects(*scene);
    EXPECT_EQ(objects.size(), c.objects);
    EXPECT_EQ(scene->animations.size(), c.clips);
    EXPECT_EQ(scene->skins.empty() ? 0 : scene->skins[0].joints.size(), c.joints);
    std::size_t triangles = 0;
    ScenePose pose;
    PosedObject rest, posed;
    for (const SceneObject& object : objects) {
      triangles += object.triangles.size();
      poseScene(*scene, kRestPose, 0, pose);
      poseObject(*scene, object, pose, rest);
      EXPECT_TRUE(sampleSurface(object, rest, 4096, 1));
    }
    EXPECT_EQ(triangles, c.triangles);
    float moved = 0;
    for (int clip = 0; clip < static_cast<int>(scene->animations.size()); ++clip) {
      for (int frame = 0; frame <= scene->animations[clip].duration * 30; ++frame) {
        poseScene(*scene, clip, frame / 30., pose);
        poseObject(*scene, objects.back(), pose, posed);
        for (std::size_t v = 0; v < posed.positions.size(); ++v) {
          const glm::vec3 &p = posed.positions[v], &n = posed.normals[v];
          ASSERT_TRUE(std::isfinite(p.x + p.y + p.z + n.x + n.y + n.z));
          moved = std::max(moved, glm::distance(p, rest.positions[v]));
        }
      }
    }
    if (c.clips > 0) {
      EXPECT_GT(moved, 0.01f);
    }
  }
}

TEST(SharedFiles, CharactersSurviveARoundTrip) {
  if (!isThere(kData / "characters")) return;
  const test::TemporaryFolder folder;
  for (const char* file : {"characters/soldier/soldier1.gltf", "characters/Fox.glb", "vehicles/car/car.gltf"}) {
    const auto scene = loadGltf(kData / file);
    ASSERT_TRUE(scene);
    ASSERT_TRUE(saveGltf(*scene, folder / "copy.glb"));
    const auto copy = loadGltf(folder / "copy.glb");
    ASSERT_TRUE(copy) << copy.error().line();
    ScenePose a, b;
    PosedObject posedA, posedB;
    poseScene(*scene, 0, 0.4, a);
    poseScene(*copy, 0, 0.4, b);
    for (const SceneObject& object : findObjects(*scene)) {
      poseObject(*scene, object, a, posedA);
      poseObject(*copy, object, b, posedB);
      EXPECT_EQ(posedA.positions, posedB.positions) << file;
      EXPECT_EQ(posedA.normals, posedB.normals) << file;
    }
  }
}

TEST(SharedFiles, TheFileThatAbortsTinygltfIsRefused) {
  const auto file = kData / "malformed/tinygltf/tests/issue-416.gltf";
  if (!isThere(file)) return;
  const auto scene = loadGltf(file);
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().line(), file.string() + ": /asset/version: glTF version \"\" is not known (2.0 is)");
}

// By the validator's own word: errors in what is read are refused, what is valid loads. `tests/cli/test_wild_files.cpp`
// asks the same of the program, with its memory and time.
TEST(SharedFiles, ValidatorFilesAreRefusedExactlyWhereWhatIsReadIsWrong) {
  const auto root = kData / "malformed/gltf-validator";
  if (!isThere(root)) return;
  int valid = 0, wrong = 0, wrongElsewhere = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    const auto& file = entry.path();
    if (file.extension() != ".gltf" && file.extension() != ".glb") continue;
    const auto report = rigel::test::validatorReport(file);
    const auto scene = loadGltf(file);
    if (!scene) {
      EXPECT_EQ(scene.error().line().find('\n'), std::string::npos) << scene.error().line();
      EXPECT_EQ(scene.error().line().find(file.string()), 0u);
    }
    if (!report.found) continue;
    SCOPED_TRACE(std::filesystem::relative(file, root).string() + report.codes());
    const bool refuse = report.concernsRigel() || rigel::test::isBeyondRigel(file);
    EXPECT_EQ(!scene, refuse) << (scene ? "accepted" : scene.error().line());
    ++(report.errors.empty() ? valid : report.concernsRigel() ? wrong : wrongElsewhere);
  }
  EXPECT_GE(valid, 40);
  EXPECT_GE(wrong, 60);
  EXPECT_GE(wrongElsewhere, 25);
  std::printf("[ measured ] %d valid files, %d with errors in what is read, %d with errors elsewhere\n", valid, wrong,
              wrongElsewhere);
}

}  // namespace
}  // namespace rigel::tools
