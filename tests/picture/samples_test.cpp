// What every built-in scene must be: sound meshes, finite lights, unique names, and the same after a trip through glTF.
#include "samples/samples.h"

#include "mesh_checks.h"
#include "scene/gltf_load.h"
#include "scene/gltf_save.h"
#include "scene/pose.h"

#include <gmock/gmock.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <filesystem>
#include <map>
#include <set>

namespace rigel::tools {
namespace {

constexpr float kUnit = 1e-5f;  // of a normal's length and of weight sums, in float

class EverySample : public ::testing::TestWithParam<int> {
 protected:
  static const Sample& sample() { return samples()[static_cast<std::size_t>(GetParam())]; }
  Scene scene_ = sample().make();
};

INSTANTIATE_TEST_SUITE_P(All, EverySample, ::testing::Range(0, 7),
                         [](const auto& test) { return samples()[static_cast<std::size_t>(test.param)].name; });

TEST(Samples, AreTheSevenInOrder) {
  std::vector<std::string> names;
  for (const Sample& sample : samples()) {
    names.push_back(sample.name);
    EXPECT_FALSE(sample.summary.empty());
    EXPECT_EQ(sample.make().name, sample.name);
  }
  EXPECT_THAT(names, ::testing::ElementsAre("street", "stage", "dragon", "touch", "figure1", "corridor", "gallery"));
}

TEST_P(EverySample, HasSoundPrimitives) {
  for (const Mesh& mesh : scene_.meshes) {
    for (const Primitive& p : mesh.primitives) {
      ASSERT_FALSE(p.triangles.empty()) << mesh.name;
      ASSERT_EQ(p.normals.size(), p.positions.size()) << mesh.name;
      ASSERT_GE(p.material, 0);
      ASSERT_LT(p.material, static_cast<int>(scene_.materials.size()));
      for (const glm::vec3 v : p.positions) ASSERT_TRUE(std::isfinite(v.x + v.y + v.z)) << mesh.name;
      for (const glm::vec3 n : p.normals) ASSERT_NEAR(glm::length(n), 1, kUnit) << mesh.name;
      for (const glm::uvec3 t : p.triangles) ASSERT_LT(std::max({t.x, t.y, t.z}), p.positions.size()) << mesh.name;
      for (const MorphTarget& target : p.targets) {
        EXPECT_EQ(target.positions.size(), p.positions.size());
        EXPECT_EQ(target.normals.size(), p.positions.size());
      }
      EXPECT_GT(test::agreeingShare(p), 0.995) << mesh.name << ": normals against the winding";
    }
  }
}

TEST_P(EverySample, HasClosedMeshesThatEncloseTheirInside) {
  int checked = 0;
  for (const Node& node : scene_.nodes) {
    if (node.mesh < 0 || node.isStatic) continue;
    const Mesh& mesh = scene_.meshes[static_cast<std::size_t>(node.mesh)];
    EXPECT_EQ(test::openEdges(mesh), 0) << mesh.name;
    EXPECT_GT(test::volume(mesh), 0) << mesh.name << " is inside out";
    ++checked;
  }
  EXPECT_GT(checked, 0);
}

TEST_P(EverySample, SkinsAreSound) {
  for (const Node& node : scene_.nodes) {
    if (node.skin < 0) continue;
    const Skin& skin = scene_.skins[static_cast<std::size_t>(node.skin)];
    ASSERT_EQ(skin.joints.size(), skin.inverseBind.size());
    std::set<int> used;
    for (const Primitive& p : scene_.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
      ASSERT_EQ(p.influences.size(), p.positions.size());
      for (const Influences& influences : p.influences) {
        float sum = 0;
        for (std::size_t i = 0; i < influences.weight.size(); ++i) {
          ASSERT_GE(influences.weight[i], 0);
          ASSERT_LT(influences.joint[i], skin.joints.size());
          sum += influences.weight[i];
          if (influences.weight[i] > 0.5f) used.insert(influences.joint[i]);
        }
        ASSERT_NEAR(sum, 1, kUnit);
      }
    }
    EXPECT_EQ(used.size(), skin.joints.size()) << "a joint of " << skin.name << " moves nothing";
  }
}

TEST_P(EverySample, HasOneObjectOfReasonableSize) {
  int moving = 0;
  for (const SceneObject& object : findObjects(scene_)) {
    if (object.isStatic) continue;
    ++moving;
    EXPECT_GE(object.triangles.size(), 3000u);
    EXPECT_LE(object.triangles.size(), 20000u);
  }
  EXPECT_EQ(moving, 1);
}

TEST_P(EverySample, HasFiniteLightsOnNodes) {
  std::set<int> placed;
  for (const Node& node : scene_.nodes)
    if (node.light >= 0) placed.insert(node.light);
  EXPECT_EQ(placed.size(), scene_.lights.size());
  for (int frame = 0; frame <= 30; ++frame) {
    ScenePose pose;
    poseScene(scene_, scene_.animations.empty() ? kRestPose : 0, 4.0 * frame / 30, pose);
    PosedLights lights;
    poseLights(scene_, pose, lights);
    ASSERT_EQ(lights.set.size(), static_cast<int>(scene_.lights.size()));
    ASSERT_EQ(lights.names.size(), scene_.lights.size());
    const auto finite = [](Vec3 v, Rgb c) {
      return std::isfinite(v.x + v.y + v.z) && std::isfinite(c.r + c.g + c.b) && c.r >= 0 && c.g >= 0 && c.b >= 0;
    };
    for (int i = 0; i < lights.set.directionalCount(); ++i) {
      EXPECT_TRUE(finite(lights.set.directional(i).direction, lights.set.directional(i).irradiance));
    }
    for (int i = 0; i < lights.set.pointCount(); ++i) {
      EXPECT_TRUE(finite(lights.set.point(i).position, lights.set.point(i).intensity));
    }
    for (int i = 0; i < lights.set.spotCount(); ++i) {
      const SpotLight spot = lights.set.spot(i);
      EXPECT_TRUE(finite(spot.position, spot.intensity));
      EXPECT_LE(spot.innerAngle, spot.outerAngle);
    }
    for (int i = 0; i < lights.set.sphereCount(); ++i) {
      EXPECT_TRUE(finite(lights.set.sphere(i).position, lights.set.sphere(i).radiance));
      EXPECT_GT(lights.set.sphere(i).radius, 0);
    }
    for (int i = 0; i < lights.set.diskCount(); ++i) {
      EXPECT_TRUE(finite(lights.set.disk(i).position, lights.set.disk(i).radiance));
      EXPECT_NEAR(length(lights.set.disk(i).direction), 1, kUnit);
      EXPECT_GT(lights.set.disk(i).radius, 0);
    }
  }
}

TEST_P(EverySample, NamesAreUnique) {
  const auto check = [](const auto& list, const char* what) {
    std::set<std::string> seen;
    for (const auto& item : list) EXPECT_TRUE(seen.insert(item.name).second) << what << " " << item.name;
  };
  check(scene_.lights, "light");
  check(scene_.meshes, "mesh");
  check(scene_.materials, "material");
  check(scene_.animations, "animation");
  std::set<std::string> objects;
  for (const SceneObject& object : findObjects(scene_)) EXPECT_TRUE(objects.insert(object.name).second) << object.name;
}

TEST_P(EverySample, IsMadeTheSameEveryTime) {
  const Scene again = sample().make();
  ASSERT_EQ(again.nodes.size(), scene_.nodes.size());
  for (std::size_t m = 0; m < scene_.meshes.size(); ++m)
    for (std::size_t p = 0; p < scene_.meshes[m].primitives.size(); ++p)
      EXPECT_EQ(again.meshes[m].primitives[p].positions, scene_.meshes[m].primitives[p].positions);
  for (std::size_t n = 0; n < scene_.nodes.size(); ++n)
    EXPECT_EQ(again.nodes[n].translation, scene_.nodes[n].translation);
}

TEST_P(EverySample, ComesBackFromGltf) {
  const auto file = std::filesystem::temp_directory_path() / ("rigel_sample_" + sample().name + ".glb");
  const auto saved = saveGltf(scene_, file);
  ASSERT_TRUE(saved) << saved.error().line();
  const auto loaded = loadGltf(file);
  std::filesystem::remove(file);
  ASSERT_TRUE(loaded) << loaded.error().line();
  EXPECT_THAT(loaded->notes, ::testing::IsEmpty());

  const auto objects = findObjects(scene_), objectsAgain = findObjects(*loaded);
  ASSERT_EQ(objects.size(), objectsAgain.size());
  constexpr float kSame = 1e-5f;  // m; matrices pass through decimal JSON
  const int clip = scene_.animations.empty() ? kRestPose : 0;
  for (const double time : {0.0, 0.77, 1.9, 3.3}) {
    ScenePose pose, poseAgain;
    poseScene(scene_, clip, time, pose);
    poseScene(*loaded, clip, time, poseAgain);
    for (std::size_t o = 0; o < objects.size(); ++o) {
      EXPECT_EQ(objects[o].name, objectsAgain[o].name);
      EXPECT_EQ(objects[o].isStatic, objectsAgain[o].isStatic);
      EXPECT_EQ(objects[o].triangles, objectsAgain[o].triangles);
      PosedObject posed, posedAgain;
      poseObject(scene_, objects[o], pose, posed);
      poseObject(*loaded, objectsAgain[o], poseAgain, posedAgain);
      ASSERT_EQ(posed.positions.size(), posedAgain.positions.size());
      float worst = 0;
      for (std::size_t v = 0; v < posed.positions.size(); ++v) {
        worst = std::max(worst, glm::distance(posed.positions[v], posedAgain.positions[v]));
      }
      EXPECT_LE(worst, kSame) << objects[o].name << " at " << time << " s";
    }
    PosedLights lights, lightsAgain;
    poseLights(scene_, pose, lights);
    poseLights(*loaded, poseAgain, lightsAgain);
    EXPECT_EQ(lights.names, lightsAgain.names);
    ASSERT_EQ(lights.set.sphereCount(), lightsAgain.set.sphereCount());
    ASSERT_EQ(lights.set.pointCount(), lightsAgain.set.pointCount());
    ASSERT_EQ(lights.set.spotCount(), lightsAgain.set.spotCount());
    ASSERT_EQ(lights.set.diskCount(), lightsAgain.set.diskCount());
    for (int i = 0; i < lights.set.diskCount(); ++i) {
      const DiskLight a = lights.set.disk(i), b = lightsAgain.set.disk(i);
      EXPECT_LE(length(a.position - b.position), kSame);
      EXPECT_LE(length(a.direction - b.direction), kSame);
      EXPECT_EQ(a.radius, b.radius);
      EXPECT_EQ(a.radiance, b.radiance);
      EXPECT_EQ(a.twoSided, b.twoSided);
    }
    for (int i = 0; i < lights.set.sphereCount(); ++i) {
      const SphereLight a = lights.set.sphere(i), b = lightsAgain.set.sphere(i);
      EXPECT_LE(length(a.position - b.position), kSame);
      EXPECT_FLOAT_EQ(a.radius, b.radius);
      EXPECT_NEAR(a.radiance.g, b.radiance.g, 1e-5f * a.radiance.g);
    }
    for (int i = 0; i < lights.set.pointCount(); ++i) {
      EXPECT_FLOAT_EQ(lights.set.point(i).radius, lightsAgain.set.point(i).radius);
    }
    for (int i = 0; i < lights.set.spotCount(); ++i) {
      const SpotLight a = lights.set.spot(i), b = lightsAgain.set.spot(i);
      EXPECT_LE(length(a.direction - b.direction), kSame);
      EXPECT_FLOAT_EQ(a.innerAngle, b.innerAngle);
      EXPECT_FLOAT_EQ(a.outerAngle, b.outerAngle);
      EXPECT_FLOAT_EQ(a.radius, b.radius);
    }
  }
}

}  // namespace
}  // namespace rigel::tools
