// A bust is wheeled along a gallery wall and turned on its way. Twenty-eight small disks light the wall and it at
// grazing angles: a rail that washes the wall from above, picture lights that show it their backs, and a row of sconces
// so close that some rims all but touch the shoulder and one face does.
#include "samples/animation_builder.h"
#include "samples/bust.h"
#include "samples/mesh_builder.h"
#include "samples/scene_builder.h"
#include "samples/scenes.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace rigel::tools {
namespace {

constexpr float kDuration = 5;    // s
constexpr float kTravel = 1.8f;   // m to each side of the middle
constexpr float kWall = -0.7f;    // m
constexpr float kPlinth = 0.95f;  // m, its height

glm::mat4 moved(glm::vec3 by) { return glm::translate(glm::mat4(1), by); }

void addBox(Primitive& out, glm::vec3 centre, glm::vec3 half, float bevel) {
  Primitive box;
  addRoundedBox(box, half, bevel, 4);
  finishNormals(box, 0.7f);
  append(out, box, moved(centre));
}

void addRoom(Scene& scene) {
  constexpr float kEnd = 4;
  Primitive wall, skirting;
  std::array<Primitive, 2> boards;
  addBox(wall, {kWall - 0.1f, 1.5f, 0}, {0.1f, 1.5f, kEnd}, 0.02f);
  addBox(wall, {1.2f, 1.5f, -kEnd - 0.1f}, {2.2f, 1.5f, 0.1f}, 0.02f);
  addBox(skirting, {1.2f, 0.07f, -kEnd}, {2.2f, 0.07f, 0.02f}, 0.012f);
  addBox(skirting, {kWall, 0.07f, 0}, {0.02f, 0.07f, kEnd}, 0.012f);
  constexpr float kBoard = 0.16f;
  for (int i = 0; i < 18; ++i) {
    const float x = kWall + kBoard * static_cast<float>(i);
    addFloor(boards[static_cast<std::size_t>(i % 2)], {x + 0.002f, -kEnd}, {x + kBoard - 0.002f, kEnd}, 0);
  }
  addScenery(scene, "wall", std::move(wall), addMaterial(scene, "red ochre", {0.38f, 0.15f, 0.11f}));
  addScenery(scene, "skirting", std::move(skirting), addMaterial(scene, "cream", {0.62f, 0.57f, 0.47f}));
  constexpr glm::vec3 kOak[] = {{0.3f, 0.2f, 0.12f}, {0.25f, 0.16f, 0.095f}};
  for (std::size_t i = 0; i < boards.size(); ++i) {
    finishNormals(boards[i], 0);
    const std::string name = i == 0 ? "oak" : "dark oak";
    addScenery(scene, name + " boards", std::move(boards[i]), addMaterial(scene, name, kOak[i]));
  }
}

struct Painting {
  const char* name;
  float z, width, height;  // m
  glm::vec3 colour;
};
constexpr Painting kPaintings[] = {{"seascape", -2.5f, 0.95f, 0.62f, {0.16f, 0.3f, 0.4f}},
                                   {"portrait", -1.35f, 0.52f, 0.72f, {0.42f, 0.3f, 0.2f}},
                                   {"meadow", -0.2f, 0.85f, 0.6f, {0.3f, 0.38f, 0.16f}},
                                   {"still life", 0.95f, 0.6f, 0.52f, {0.5f, 0.38f, 0.14f}},
                                   {"nocturne", 2.15f, 0.95f, 0.68f, {0.1f, 0.12f, 0.26f}}};
constexpr float kHung = 1.5f;  // m, height of their middles

void addPaintings(Scene& scene) {
  Primitive frames;
  for (const Painting& painting : kPaintings) {
    const float w = painting.width / 2, h = painting.height / 2;
    const float x = kWall + 0.02f;
    for (const float side : {-1.0f, 1.0f}) {
      addBox(frames, {x, kHung + side * h, painting.z}, {0.025f, 0.032f, w + 0.032f}, 0.012f);
      addBox(frames, {x, kHung, painting.z + side * w}, {0.025f, h, 0.032f}, 0.012f);
    }
    Primitive canvas;
    addBox(canvas, {kWall + 0.005f, kHung, painting.z}, {0.015f, h, w}, 0.004f);
    addScenery(scene, painting.name, std::move(canvas), addMaterial(scene, painting.name, painting.colour));
  }
  addScenery(scene, "frames", std::move(frames), addMaterial(scene, "gilt", {0.55f, 0.41f, 0.16f}));
}

/// A shallow cap behind a disk at `at` that faces along `direction`.
void addCap(Primitive& out, float radius, glm::vec3 at, glm::vec3 direction) {
  Primitive cap;  // made to look down -z, as lights do
  const glm::vec2 profile[] = {
      {radius, -0.004f}, {radius + 0.006f, -0.004f}, {radius + 0.006f, 0.006f}, {0.7f * radius, 0.018f}, {0, 0.02f}};
  addLathe(cap, profile, 24);
  finishNormals(cap, 0.7f);
  const glm::mat4 upright = glm::rotate(glm::mat4(1), glm::half_pi<float>(), glm::vec3(1, 0, 0));
  append(out, cap, moved(at) * glm::mat4_cast(aim(direction)) * upright);
}

void addLamps(Scene& scene) {
  Primitive brass;
  const auto lamp = [&](const std::string& name, float radius, Rgb radiance, glm::vec3 at, glm::vec3 direction) {
    addLight(scene, name, DiskLight{{}, {}, radius, radiance, false}, kNoParent, at, direction);
    addCap(brass, radius, at, direction);
  };
  constexpr Rgb kWarm{34, 25, 14}, kWhite{52, 49, 44};
  for (int i = 0; i < 14; ++i) {
    const float z = 0.5f * (static_cast<float>(i) - 6.5f);
    lamp("washer " + std::to_string(i + 1), 0.06f, kWhite * (i % 2 == 0 ? 1.0f : 0.8f), {kWall + 0.14f, 2.3f, z},
         {0.1f, -1, 0});
  }
  addBox(brass, {kWall + 0.14f, 2.335f, 0}, {0.015f, 0.012f, 3.6f}, 0.006f);
  for (const Painting& painting : kPaintings) {
    lamp("picture light " + std::string(painting.name), 0.05f, kWarm,
         {kWall + 0.26f, kHung + painting.height / 2 + 0.16f, painting.z}, {-0.7f, -1, 0});
  }
  // Beside the path at the height of shoulder and chin; the shoulder comes to x = -0.27.
  struct Sconce {
    float x, y, z;
    glm::vec3 direction;
    Rgb radiance;
  };
  constexpr Rgb kSmall{3.2f, 2.3f, 1.3f}, kBlue{1.0f, 1.7f, 3.0f}, kRose{3.2f, 1.3f, 1.5f};
  constexpr Sconce kSconces[] = {
      {-0.34f, 1.3f, -1.7f, {1, 0.1f, 0}, kSmall},      {-0.31f, 1.28f, -1.15f, {0.25f, 0, -1}, kBlue},
      {-0.36f, 1.52f, -0.75f, {1, -0.4f, 0.2f}, kRose}, {-0.25f, 1.25f, -0.3f, {1, 0, 0}, kSmall},
      {-0.3f, 1.33f, 0.15f, {0.3f, -0.2f, 1}, kBlue},   {-0.33f, 1.45f, 0.6f, {1, 0, -0.5f}, kRose},
      {-0.265f, 1.27f, 1.05f, {0.1f, 1, 0}, kSmall},    {-0.32f, 1.36f, 1.5f, {1, -0.3f, 0}, kBlue},
      {-0.36f, 1.5f, 1.95f, {0.8f, -0.2f, -1}, kSmall}};
  int number = 0;
  for (const Sconce& s : kSconces) {
    const glm::vec3 at{s.x, s.y, s.z};
    lamp("sconce " + std::to_string(++number), 0.045f, s.radiance, at, s.direction);
    const float reach = (s.x - kWall) / 2;
    addBox(brass, {kWall + reach - 0.015f, s.y - 0.07f, s.z}, {reach, 0.006f, 0.006f}, 0.003f);
    addBox(brass, at - 0.02f * glm::normalize(s.direction) - glm::vec3(0, 0.035f, 0), {0.006f, 0.035f, 0.006f}, 0.003f);
  }
  addScenery(scene, "lamps", std::move(brass), addMaterial(scene, "brass", {0.5f, 0.38f, 0.17f}));
}

}  // namespace

Scene makeGallery() {
  Scene scene;
  scene.name = "gallery";
  const int trolley = addNode(scene, "trolley", kNoParent);
  // Alabaster lets light in: soft wrap.
  const int bust =
      addMeshNode(scene, "bust", trolley, makeBust(), addMaterial(scene, "alabaster", {0.74f, 0.7f, 0.63f}, 0.25f));
  scene.nodes[bust].translation = {0, kPlinth, 0};
  Primitive plinth;
  addBox(plinth, {0, 0.05f, 0}, {0.2f, 0.03f, 0.2f}, 0.012f);
  addBox(plinth, {0, 0.49f, 0}, {0.16f, 0.43f, 0.16f}, 0.012f);
  addBox(plinth, {0, kPlinth - 0.02f, 0}, {0.19f, 0.02f, 0.19f}, 0.012f);
  const int stand =
      addMeshNode(scene, "plinth", trolley, std::move(plinth), addMaterial(scene, "slate", {0.17f, 0.18f, 0.2f}));
  scene.nodes[stand].isStatic = true;
  addRoom(scene);
  addPaintings(scene);
  addLamps(scene);
  addLight(scene, "skylight", DirectionalLight{{}, {0.28f, 0.33f, 0.42f}}, kNoParent, {2, 3, 1}, {-0.8f, -1, -0.25f});

  AnimationBuilder move("move");
  const float end = kDuration / 2;
  const Key<glm::vec3> path[] = {{0, {0, 0, -kTravel}}, {end, {0, 0, 0}}, {kDuration, {0, 0, kTravel}}};
  move.translation(trolley, Interpolation::cubicSpline, path);
  move.sampledRotation(bust, kDuration, 50, [](float t) {
    return glm::angleAxis(0.5f * std::sin(glm::two_pi<float>() * t / kDuration), glm::vec3(0, 1, 0));
  });
  scene.animations.push_back(move.finish());
  return scene;
}

}  // namespace rigel::tools
