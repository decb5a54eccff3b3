// Real characters, and the malformed files of the glTF validator. Both lie outside the repository: where they are
// missing each test says so and passes.
#include "scene/gltf_save.h"
#include "scene/surface.h"
#include "scene_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>

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

// Codes of the validator's errors (severity 0); empty where there is no report.
std::set<std::string> expectedErrors(const std::filesystem::path& file) {
  std::set<std::string> codes;
  std::ifstream stream(file.string() + ".report.json");
  if (!stream) return codes;
  const auto report = nlohmann::json::parse(stream);
  for (const auto& message : report["issues"]["messages"]) {
    if (message["severity"] == 0) codes.insert(message["code"]);
  }
  return codes;
}

// The document with a good triangle added, so that "no mesh" hides no other fault.
bool addTriangle(nlohmann::json& document) {
  if (!document.is_object()) return false;
  const test::TemporaryFolder folder;
  test::GltfMaker triangle = test::GltfMaker::triangle();
  triangle.embed();
  for (const char* list : {"buffers", "bufferViews", "accessors", "meshes", "nodes", "scenes"}) {
    if (document.contains(list) && !document[list].is_array()) return false;
  }
  const auto append = [&](const char* list, nlohmann::json entry) {
    document[list].push_back(std::move(entry));
    return document[list].size() - 1;
  };
  const std::size_t buffer = append("buffers", triangle.json["buffers"][0]);
  nlohmann::json positionView = triangle.json["bufferViews"][0];
  positionView["buffer"] = buffer;
  nlohmann::json position = triangle.json["accessors"][0];
  position["bufferView"] = append("bufferViews", positionView);
  nlohmann::json primitive, mesh;
  primitive["attributes"]["POSITION"] = append("accessors", position);
  mesh["primitives"].push_back(primitive);
  const std::size_t node = append("nodes", {{"mesh", append("meshes", mesh)}});
  if (!document.contains("scenes")) return true;
  for (auto& scene : document["scenes"]) {
    if (scene.is_object() && (!scene.contains("nodes") || scene["nodes"].is_array())) scene["nodes"].push_back(node);
  }
  return true;
}

TEST(SharedFiles, ValidatorFilesNeverCrashAndBadOnesAreRefused) {
  const auto root = kData / "malformed/gltf-validator";
  if (!isThere(root)) return;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    if (entry.path().extension() == ".gltf" || entry.path().extension() == ".glb") files.push_back(entry.path());
  }
  std::ranges::sort(files);
  int marked = 0, refused = 0, forLackOfMesh = 0, withMesh = 0;
  std::vector<std::string> accepted, acceptedWithMesh;
  for (const auto& file : files) {
    const auto codes = expectedErrors(file);
    const auto scene = loadGltf(file);
    if (!scene) {
      EXPECT_EQ(scene.error().line().find('\n'), std::string::npos) << scene.error().line();
      EXPECT_EQ(scene.error().line().find(file.string()), 0u);
    }
    if (codes.empty()) continue;
    ++marked;
    std::string why = std::filesystem::relative(file, root).string();
    for (const std::string& code : codes) why += " " + code;
    if (scene) {
      accepted.push_back(why);
      continue;
    }
    ++refused;
    if (scene.error().message.find("no mesh") == std::string::npos) continue;
    ++forLackOfMesh;
    std::ifstream stream(file);
    nlohmann::json document = nlohmann::json::parse(stream, nullptr, false);
    if (document.is_discarded() || !addTriangle(document)) continue;
    const test::TemporaryFolder folder;
    for (const auto& neighbour : std::filesystem::directory_iterator(file.parent_path())) {
      if (neighbour.path().extension() == ".bin")
        std::filesystem::copy(neighbour.path(), folder / neighbour.path().filename().string());
    }
    test::writeFile(folder / "with_mesh.gltf", document.dump());
    ++withMesh;
    if (loadGltf(folder / "with_mesh.gltf")) acceptedWithMesh.push_back(why);
  }
  EXPECT_GE(marked, 90);
  std::printf("[ measured ] %zu files; %d with errors: %d refused (%d of them for having no mesh), %zu accepted\n",
              files.size(), marked, refused, forLackOfMesh, accepted.size());
  for (const std::string& line : accepted) std::printf("[ accepted ] %s\n", line.c_str());
  std::printf("[ measured ] of %d given a mesh, %zu are accepted (faults in what is not read)\n", withMesh,
              acceptedWithMesh.size());
  for (const std::string& line : acceptedWithMesh) std::printf("[ accepted ] + mesh: %s\n", line.c_str());
  EXPECT_TRUE(accepted.empty());
}

}  // namespace
}  // namespace rigel::tools
