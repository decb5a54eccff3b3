// A figure walks down a corridor under round ceiling panels, two of which hang so low that its head passes a few
// centimetres below their faces, and through the plane of a sign that shines both ways: disks as seen from straight
// below, from behind and edge on.
#include "samples/animation_builder.h"
#include "samples/mesh_builder.h"
#include "samples/scene_builder.h"
#include "samples/scenes.h"
#include "samples/walk.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/constants.hpp>

namespace rigel::tools {
namespace {

constexpr float kWall = -1.15f;  // m; the other side is open to the camera
constexpr float kEnd = 5;        // m, half the corridor's length
constexpr float kCeiling = 2.42f;

glm::mat4 moved(glm::vec3 by) { return glm::translate(glm::mat4(1), by); }

void addTiles(Scene& scene) {
  constexpr float kTile = 0.5f, kJoint = 0.006f;
  Primitive light, dark;
  for (int row = 0; row < static_cast<int>(2 * kEnd / kTile); ++row) {
    for (int column = 0; column < 7; ++column) {
      const glm::vec2 low{kWall + kTile * static_cast<float>(column), -kEnd + kTile * static_cast<float>(row)};
      addFloor((row + column) % 2 == 0 ? light : dark, low + kJoint, low + kTile - kJoint, 0);
    }
  }
  finishNormals(light, 0);
  finishNormals(dark, 0);
  addScenery(scene, "light tiles", std::move(light), addMaterial(scene, "light tile", {0.45f, 0.44f, 0.42f}));
  addScenery(scene, "dark tiles", std::move(dark), addMaterial(scene, "dark tile", {0.2f, 0.22f, 0.24f}));
}

/// Plaster above a painted wainscot, and doors whose frames give the motion something to pass.
void addWall(Scene& scene) {
  constexpr float kWainscot = 1.02f;
  const auto slab = [](Primitive& out, glm::vec3 centre, glm::vec3 half, float bevel) {
    Primitive box;
    addRoundedBox(box, half, bevel, 4);
    finishNormals(box, 0.7f);
    append(out, box, moved(centre));
  };
  Primitive plaster, paint, wood, leaf;
  slab(plaster, {kWall - 0.06f, 1.45f, 0}, {0.05f, 1.45f, kEnd}, 0.01f);
  slab(paint, {kWall - 0.045f, kWainscot / 2, 0}, {0.05f, kWainscot / 2, kEnd}, 0.01f);
  slab(plaster, {1.2f, 1.45f, -kEnd - 0.05f}, {2.4f, 1.45f, 0.05f}, 0.01f);
  slab(paint, {1.2f, kWainscot / 2, -kEnd - 0.03f}, {2.4f, kWainscot / 2, 0.05f}, 0.01f);
  slab(wood, {1.2f, kWainscot, -kEnd}, {2.4f, 0.03f, 0.04f}, 0.012f);
  slab(wood, {kWall, kWainscot, 0}, {0.02f, 0.03f, kEnd}, 0.012f);
  slab(wood, {kWall, 0.06f, 0}, {0.015f, 0.06f, kEnd}, 0.01f);
  for (const float z : {-3.4f, -0.9f, 1.6f}) {
    slab(leaf, {kWall + 0.0f, 1.02f, z}, {0.03f, 1.02f, 0.42f}, 0.01f);
    for (const float side : {-1.0f, 1.0f})
      slab(wood, {kWall + 0.02f, 1.04f, z + side * 0.46f}, {0.035f, 1.04f, 0.04f}, 0.015f);
    slab(wood, {kWall + 0.02f, 2.1f, z}, {0.035f, 0.04f, 0.5f}, 0.015f);
  }
  addScenery(scene, "plaster", std::move(plaster), addMaterial(scene, "plaster", {0.62f, 0.6f, 0.55f}));
  addScenery(scene, "wainscot", std::move(paint), addMaterial(scene, "green paint", {0.2f, 0.31f, 0.27f}));
  addScenery(scene, "woodwork", std::move(wood), addMaterial(scene, "dark wood", {0.21f, 0.13f, 0.08f}));
  addScenery(scene, "doors", std::move(leaf), addMaterial(scene, "door", {0.42f, 0.33f, 0.22f}));
}

/// The shade around a panel, open below, and the rod it hangs from.
void addFitting(Primitive& out, glm::vec3 at, float radius) {
  constexpr float kRim = 0.025f, kDepth = 0.05f;
  Primitive shade;
  const glm::vec2 profile[] = {{radius + 0.004f, -0.004f}, {radius + kRim, -0.004f}, {radius + kRim, 0.012f},
                               {0.85f * radius, kDepth},   {0.02f, kDepth + 0.012f}, {0, kDepth + 0.012f}};
  addLathe(shade, profile, 48);
  finishNormals(shade, 0.7f);
  append(out, shade, moved(at));
  Primitive rod;
  addCylinder(rod, 0.008f, 2.9f - at.y - kDepth, 0.002f, 12);
  finishNormals(rod, 0.7f);
  append(out, rod, moved(at + glm::vec3(0, kDepth, 0)));
}

DiskLight panel(float radius, Rgb radiance) { return {{}, {}, radius, radiance, false}; }

void addPanels(Scene& scene) {
  Primitive fittings;
  const auto hang = [&](const std::string& name, glm::vec3 at, const DiskLight& disk, glm::vec3 down = {0, -1, 0}) {
    addLight(scene, name, disk, kNoParent, at, down);
    addFitting(fittings, at, disk.radius);
  };
  constexpr Rgb kNeutral{7.5f, 7.0f, 6.2f}, kWarm{7, 5, 2.9f}, kCool{4.5f, 6, 8};
  int number = 0;
  for (const float z : {-4.2f, -2.9f, -1.6f, 1.0f, 2.3f, 3.6f}) {
    const std::string name = "panel " + std::to_string(++number);
    hang(name, {0, kCeiling, z}, panel(0.3f, number % 2 == 0 ? kCool : kNeutral));
  }
  // The head's top passes at about 1.75 m.
  hang("low panel", {0, 1.9f, -0.3f}, panel(0.26f, kWarm * 0.6f));
  hang("lowest panel", {0.05f, 1.79f, 1.65f}, panel(0.16f, kCool * 0.6f));
  for (const float z : {-2.15f, 0.35f, 2.9f}) {
    const std::string name = "wall lamp " + std::to_string(++number - 6);
    addLight(scene, name, panel(0.11f, kWarm * 1.6f), kNoParent, {kWall + 0.1f, 1.7f, z}, {1, -0.25f, 0});
  }
  DiskLight sign{{}, {}, 0.15f, {0.25f, 2.6f, 1.0f}, true};
  addLight(scene, "sign", sign, kNoParent, {-0.18f, 1.88f, 0.75f}, {0, 0, 1});
  addScenery(scene, "fittings", std::move(fittings), addMaterial(scene, "white enamel", {0.6f, 0.6f, 0.6f}));
}

}  // namespace

Scene makeCorridor() {
  Scene scene;
  scene.name = "corridor";
  const Figure figure = addFigure(scene);
  addTiles(scene);
  addWall(scene);
  addPanels(scene);
  addLight(scene, "daylight", DirectionalLight{{}, {0.16f, 0.2f, 0.27f}}, kNoParent, {1, 2.5f, 6}, {-0.35f, -0.3f, -1});

  AnimationBuilder walk("walk");
  addWalk(walk, scene, figure, {.speed = 1.1f, .cycle = 1.0f, .duration = 4, .start = {0, 0, -2.1f}});
  scene.animations.push_back(walk.finish());
  return scene;
}

}  // namespace rigel::tools
