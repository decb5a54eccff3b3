// Save, load, compare: every float must come back as it was.
#include "samples/samples.h"
#include "scene/gltf_save.h"
#include "scene_files.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <fstream>
#include <functional>
#include <iterator>

namespace rigel::tools {
namespace {

void expectSame(const Primitive& a, const Primitive& b) {
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.normals, b.normals);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.material, b.material);
  ASSERT_EQ(a.influences.size(), b.influences.size());
  for (std::size_t v = 0; v < a.influences.size(); ++v) {
    EXPECT_EQ(a.influences[v].weight, b.influences[v].weight);
    for (std::size_t k = 0; k < 8; ++k) {
      if (a.influences[v].weight[k] == 0) continue;
      EXPECT_EQ(a.influences[v].joint[k], b.influences[v].joint[k]);
    }
  }
  ASSERT_EQ(a.targets.size(), b.targets.size());
  for (std::size_t t = 0; t < a.targets.size(); ++t) {
    EXPECT_EQ(a.targets[t].positions, b.targets[t].positions);
    EXPECT_EQ(a.targets[t].normals, b.targets[t].normals);
  }
}

void expectSame(const Node& a, const Node& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.parent, b.parent);
  EXPECT_EQ(a.children, b.children);
  EXPECT_EQ(a.translation, b.translation);
  EXPECT_EQ(a.rotation, b.rotation);
  EXPECT_EQ(a.scale, b.scale);
  EXPECT_EQ(a.hasMatrix, b.hasMatrix);
  EXPECT_EQ(a.matrix, b.matrix);
  EXPECT_EQ(a.mesh, b.mesh);
  EXPECT_EQ(a.skin, b.skin);
  EXPECT_EQ(a.light, b.light);
  EXPECT_EQ(a.morphWeights, b.morphWeights);
  EXPECT_EQ(a.isStatic, b.isStatic);
  EXPECT_EQ(a.isObject, b.isObject);
}

void expectSame(const LightShape& a, const LightShape& b) {
  ASSERT_EQ(a.index(), b.index());
  std::visit(
      [&](const auto& x) {
        using Light = std::decay_t<decltype(x)>;
        const Light& y = std::get<Light>(b);
        if constexpr (requires { x.radius; }) {
          EXPECT_EQ(x.radius, y.radius);
        }
        if constexpr (requires { x.range; }) {
          EXPECT_EQ(x.range, y.range);
        }
        if constexpr (requires { x.intensity; }) {
          EXPECT_EQ(x.intensity, y.intensity);
        }
        if constexpr (requires { x.radiance; }) {
          EXPECT_EQ(x.radiance, y.radiance);
        }
        if constexpr (requires { x.irradiance; }) {
          EXPECT_EQ(x.irradiance, y.irradiance);
        }
        if constexpr (requires { x.innerAngle; }) {
          EXPECT_EQ(x.innerAngle, y.innerAngle);
          EXPECT_EQ(x.outerAngle, y.outerAngle);
        }
        if constexpr (requires { x.direction; }) {
          EXPECT_EQ(x.direction, y.direction);
        }
        if constexpr (requires { x.twoSided; }) {
          EXPECT_EQ(x.twoSided, y.twoSided);
        }
      },
      a);
}

void expectSame(const Scene& a, const Scene& b) {
  EXPECT_EQ(a.roots, b.roots);
  ASSERT_EQ(a.nodes.size(), b.nodes.size());
  for (std::size_t i = 0; i < a.nodes.size(); ++i) {
    SCOPED_TRACE("node " + std::to_string(i));
    expectSame(a.nodes[i], b.nodes[i]);
  }
  ASSERT_EQ(a.meshes.size(), b.meshes.size());
  for (std::size_t m = 0; m < a.meshes.size(); ++m) {
    EXPECT_EQ(a.meshes[m].name, b.meshes[m].name);
    EXPECT_EQ(a.meshes[m].morphWeights, b.meshes[m].morphWeights);
    ASSERT_EQ(a.meshes[m].primitives.size(), b.meshes[m].primitives.size());
    for (std::size_t p = 0; p < a.meshes[m].primitives.size(); ++p) {
      SCOPED_TRACE("mesh " + std::to_string(m) + " primitive " + std::to_string(p));
      expectSame(a.meshes[m].primitives[p], b.meshes[m].primitives[p]);
    }
  }
  ASSERT_EQ(a.materials.size(), b.materials.size());
  for (std::size_t m = 0; m < a.materials.size(); ++m) {
    EXPECT_EQ(a.materials[m].name, b.materials[m].name);
    EXPECT_EQ(a.materials[m].baseColour, b.materials[m].baseColour);
    EXPECT_EQ(a.materials[m].wrap, b.materials[m].wrap);
  }
  ASSERT_EQ(a.skins.size(), b.skins.size());
  for (std::size_t s = 0; s < a.skins.size(); ++s) {
    EXPECT_EQ(a.skins[s].name, b.skins[s].name);
    EXPECT_EQ(a.skins[s].joints, b.skins[s].joints);
    EXPECT_EQ(a.skins[s].inverseBind, b.skins[s].inverseBind);
    EXPECT_EQ(a.skins[s].skeletonRoot, b.skins[s].skeletonRoot);
  }
  ASSERT_EQ(a.lights.size(), b.lights.size());
  for (std::size_t l = 0; l < a.lights.size(); ++l) {
    SCOPED_TRACE("light " + std::to_string(l));
    EXPECT_EQ(a.lights[l].name, b.lights[l].name);
    expectSame(a.lights[l].shape, b.lights[l].shape);
    EXPECT_EQ(a.lights[l].scalesWithNode, b.lights[l].scalesWithNode);
  }
  ASSERT_EQ(a.animations.size(), b.animations.size());
  for (std::size_t i = 0; i < a.animations.size(); ++i) {
    EXPECT_EQ(a.animations[i].name, b.animations[i].name);
    EXPECT_EQ(a.animations[i].duration, b.animations[i].duration);
    ASSERT_EQ(a.animations[i].channels.size(), b.animations[i].channels.size());
    for (std::size_t c = 0; c < a.animations[i].channels.size(); ++c) {
      const Channel &x = a.animations[i].channels[c], &y = b.animations[i].channels[c];
      EXPECT_EQ(x.node, y.node);
      EXPECT_EQ(x.path, y.path);
      EXPECT_EQ(x.interpolation, y.interpolation);
      EXPECT_EQ(x.width, y.width);
      EXPECT_EQ(x.times, y.times);
      EXPECT_EQ(x.values, y.values);
    }
  }
}

// The loader fills in what a scene made in code may leave out.
Scene asLoaded(Scene scene) {
  for (Mesh& mesh : scene.meshes) {
    for (Primitive& p : mesh.primitives) {
      for (MorphTarget& t : p.targets) t.positions.resize(p.positions.size());
      mesh.morphWeights.resize(p.targets.size());
    }
  }
  return scene;
}

void roundTrip(const Scene& scene, const std::string& extension) {
  SCOPED_TRACE(scene.name + extension);
  const test::TemporaryFolder folder;
  const auto bytes = saveGltf(scene, folder / ("saved" + extension));
  ASSERT_TRUE(bytes) << bytes.error().line();
  EXPECT_EQ(*bytes, std::filesystem::file_size(folder / ("saved" + extension)));
  const auto back = loadGltf(folder / ("saved" + extension));
  ASSERT_TRUE(back) << back.error().line();
  EXPECT_TRUE(back->notes.empty()) << back->notes.front();
  expectSame(asLoaded(scene), *back);
}

TEST(RoundTrip, EverythingComesBackExactly) {
  for (const char* extension : {".glb", ".gltf"}) roundTrip(test::everythingScene(), extension);
}

TEST(RoundTrip, AllSamples) {
  for (const Sample& sample : samples()) roundTrip(sample.make(), ".glb");
}

/// A light of every radius and radiance, each on a node of its own.
Scene lightsOfAnySizeAndPower(const std::function<SceneLight(float, Rgb)>& make) {
  Scene scene = test::triangleScene({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  int node = 0;
  for (const float radius : {1e-6f, 0.01f, 0.333333f, 17.f, 1e6f}) {
    for (const float radiance : {1e-6f, 0.1f, 7.77f, 1e10f}) {
      scene.lights.push_back(make(radius, {radiance, radiance / 3, radiance * 0.7f}));
      scene.nodes.push_back({});
      scene.nodes.back().light = static_cast<int>(scene.lights.size()) - 1;
      scene.roots.push_back(++node);
    }
  }
  return scene;
}

TEST(RoundTrip, SphereLightsOfAnySizeAndPower) {
  roundTrip(lightsOfAnySizeAndPower([](float radius, Rgb radiance) {
              return SceneLight{"s", SphereLight{{}, radius, radiance}};
            }),
            ".glb");
}

TEST(RoundTrip, DiskLightsOfAnySizeAndPower) {
  for (const bool scales : {false, true}) {
    for (const bool twoSided : {false, true}) {
      SCOPED_TRACE(scales ? "EXT_lights_area" : "KHR_lights_punctual");
      roundTrip(lightsOfAnySizeAndPower([&](float radius, Rgb radiance) {
                  return SceneLight{"d", DiskLight{{}, {0, 0, -1}, radius, radiance, twoSided}, scales};
                }),
                ".glb");
    }
  }
}

TEST(RoundTrip, DisksAreSpotOrPointLightsToOtherPrograms) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(saveGltf(test::everythingScene(), folder / "a.gltf"));
  std::ifstream stream(folder / "a.gltf");
  const auto document = nlohmann::json::parse(stream);
  const auto& extensions = document.at("extensions");
  const auto& panel = extensions.at("KHR_lights_punctual").at("lights").at(5);
  EXPECT_EQ(panel.at("type"), "spot");
  // The radiance times the disk's area, in the brightest channel.
  EXPECT_NEAR(panel.at("intensity").get<double>(), 5.1 * 3.14159265358979 * 0.49, 1e-6);
  const auto& area = extensions.at("EXT_lights_area").at("lights").at(0);
  EXPECT_EQ(area.at("type"), "disk");
  EXPECT_NEAR(area.at("size").get<double>(), 0.2, 1e-8);
  EXPECT_EQ(area.at("intensity"), 9);
  EXPECT_EQ(document.at("nodes").at(10).at("extensions").at("EXT_lights_area").at("light"), 0);
  EXPECT_EQ(document.at("extensionsUsed"), nlohmann::json({"KHR_lights_punctual", "EXT_lights_area"}));
}

TEST(RoundTrip, ASecondTripChangesNothing) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(saveGltf(test::everythingScene(), folder / "a.glb"));
  const auto once = loadGltf(folder / "a.glb");
  ASSERT_TRUE(once);
  ASSERT_TRUE(saveGltf(*once, folder / "b.glb"));
  const auto read = [&](const char* name) {
    std::ifstream stream(folder / name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  EXPECT_EQ(read("a.glb").size(), read("b.glb").size());
  const auto twice = loadGltf(folder / "b.glb");
  ASSERT_TRUE(twice);
  expectSame(*once, *twice);
}

TEST(RoundTrip, FailureLeavesNothingBehind) {
  const test::TemporaryFolder folder;
  const auto nowhere = saveGltf(test::everythingScene(), folder / "missing" / "a.glb");
  ASSERT_FALSE(nowhere);
  EXPECT_NE(nowhere.error().line().find("cannot be written"), std::string::npos);
  const auto wrong = saveGltf(test::everythingScene(), folder / "a.obj");
  ASSERT_FALSE(wrong);
  EXPECT_NE(wrong.error().line().find("must end in .glb or .gltf"), std::string::npos);
  // A folder of that name: the write succeeds aside, the rename does not.
  std::filesystem::create_directories(folder / "taken.glb" / "inside");
  EXPECT_FALSE(saveGltf(test::everythingScene(), folder / "taken.glb"));
  std::size_t entries = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) ++entries;
  EXPECT_EQ(entries, 1u);
}

TEST(RoundTrip, NamesThatAreNoUtf8AreWritten) {
  Scene scene = test::triangleScene({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  scene.nodes[0].name = "caf\xe9";
  const test::TemporaryFolder folder;
  ASSERT_TRUE(saveGltf(scene, folder / "a.glb"));
  const auto back = loadGltf(folder / "a.glb");
  ASSERT_TRUE(back);
  EXPECT_EQ(back->nodes[0].name.substr(0, 3), "caf");
}

}  // namespace
}  // namespace rigel::tools
