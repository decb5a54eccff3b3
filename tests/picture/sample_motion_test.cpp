// The clips: their length, their continuity, and the hard moment each scene is there for.
#include "samples/samples.h"
#include "scene/pose.h"

#include <rigel/exact.h>

#include <gmock/gmock.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace rigel::tools {
namespace {

Scene makeSample(const std::string& name) {
  for (const Sample& sample : samples())
    if (sample.name == name) return sample.make();
  ADD_FAILURE() << "no sample " << name;
  return {};
}

const SceneObject& movingObject(const std::vector<SceneObject>& objects) {
  return *std::find_if(objects.begin(), objects.end(), [](const SceneObject& o) { return !o.isStatic; });
}

/// The object's vertices, then the lights' places, at a time of the clip.
std::vector<glm::vec3> placesAt(const Scene& scene, const SceneObject& object, double time) {
  ScenePose pose;
  poseScene(scene, 0, time, pose);
  PosedObject posed;
  poseObject(scene, object, pose, posed);
  for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
    if (scene.nodes[n].light >= 0) posed.positions.push_back(glm::vec3(pose.worldFromNode[n][3]));
  }
  return posed.positions;
}

double largestStep(const Scene& scene, int rate) {
  const auto objects = findObjects(scene);
  const SceneObject& object = movingObject(objects);
  const int frames = static_cast<int>(std::lround(scene.animations[0].duration * rate));
  std::vector<glm::vec3> last = placesAt(scene, object, 0);
  double largest = 0;
  for (int frame = 1; frame <= frames; ++frame) {
    const std::vector<glm::vec3> here = placesAt(scene, object, static_cast<double>(frame) / rate);
    for (std::size_t i = 0; i < here.size(); ++i) {
      largest = std::max(largest, static_cast<double>(glm::distance(here[i], last[i])));
    }
    last = here;
  }
  return largest;
}

TEST(SampleMotion, ClipsLastAsLongAsTheyShould) {
  EXPECT_EQ(makeSample("street").animations.at(0).duration, 4);
  EXPECT_EQ(makeSample("stage").animations.at(0).duration, 3);
  EXPECT_EQ(makeSample("dragon").animations.at(0).duration, 4);
  EXPECT_EQ(makeSample("touch").animations.at(0).duration, 7);
  EXPECT_TRUE(makeSample("figure1").animations.empty());
  EXPECT_EQ(makeSample("corridor").animations.at(0).duration, 4);
  EXPECT_EQ(makeSample("gallery").animations.at(0).duration, 5);
}

TEST(SampleMotion, IsContinuousInSpace) {
  // A jump stays as large at any rate; motion shrinks with the time between frames.
  constexpr double kLargestStep = 0.6;  // m at 30 frames a second: the top of a tyre at 16 m/s
  constexpr double kShrink = 0.35;      // at four times the rate; 0.25 for uniform motion
  for (const char* name : {"street", "stage", "dragon", "touch", "corridor", "gallery"}) {
    const Scene scene = makeSample(name);
    const double slow = largestStep(scene, 30), fast = largestStep(scene, 120);
    EXPECT_GT(slow, 0.005) << name << " stands still";
    EXPECT_LT(slow, kLargestStep) << name;
    EXPECT_LT(fast, kShrink * slow) << name << " jumps";
  }
}

TEST(SampleMotion, UsesEveryInterpolationAndPath) {
  std::set<Interpolation> interpolations;
  std::set<AnimationPath> paths;
  for (const Sample& sample : samples()) {
    for (const Animation& animation : sample.make().animations) {
      for (const Channel& channel : animation.channels) {
        interpolations.insert(channel.interpolation);
        paths.insert(channel.path);
        ASSERT_TRUE(std::is_sorted(channel.times.begin(), channel.times.end()));
        const std::size_t perKey = channel.interpolation == Interpolation::cubicSpline ? 3 : 1;
        EXPECT_EQ(channel.values.size(), channel.times.size() * perKey * static_cast<std::size_t>(channel.width));
      }
    }
  }
  EXPECT_EQ(interpolations.size(), 3u);
  EXPECT_THAT(paths,
              ::testing::IsSupersetOf({AnimationPath::translation, AnimationPath::rotation, AnimationPath::weights}));
}

TEST(Street, HasTheCarsBoxAndRollsWithoutSliding) {
  const Scene scene = makeSample("street");
  const auto objects = findObjects(scene);
  const SceneObject& car = movingObject(objects);
  EXPECT_EQ(car.name, "car");
  EXPECT_EQ(car.meshNodes.size(), 5u) << "body and wheels are one object";
  glm::vec3 low(1e9f), high(-1e9f);
  const std::vector<glm::vec3> places = placesAt(scene, car, 0);
  for (int v = 0; v < car.vertexCount; ++v) {
    low = glm::min(low, places[v]);
    high = glm::max(high, places[v]);
  }
  EXPECT_LT(glm::distance(high - low, glm::vec3(1.8f, 1.5f, 4.5f)), 0.03f);
  EXPECT_NEAR(low.y, 0, 1e-3f) << "the tyres stand on the road";

  // The point of a tyre that touches the road stands still while the car moves on.
  constexpr double kStep = 1e-3;
  const std::vector<glm::vec3> before = placesAt(scene, car, 1.5), after = placesAt(scene, car, 1.5 + kStep);
  float slowest = 1e9f, fastest = 0;
  for (int v = 0; v < car.vertexCount; ++v) {
    const float speed = glm::distance(before[v], after[v]) / static_cast<float>(kStep);
    if (before[v].y < 0.02f) slowest = std::min(slowest, speed);
    fastest = std::max(fastest, speed);
  }
  EXPECT_LT(slowest, 1.0f) << "m/s, of the vertex nearest the road";
  EXPECT_NEAR(fastest, 16, 0.5) << "m/s, at the top of the tyres";
}

TEST(Stage, FingertipsLeaveTheSpotlight) {
  const Scene scene = makeSample("stage");
  const auto objects = findObjects(scene);
  const SceneObject& figure = movingObject(objects);
  // The vertex that the stretched arm carries farthest out.
  std::vector<glm::vec3> places = placesAt(scene, figure, 1.6);
  const auto tip = std::max_element(places.begin(), places.begin() + figure.vertexCount,
                                    [](glm::vec3 a, glm::vec3 b) { return a.x < b.x; }) -
                   places.begin();
  const auto lightAt = [&](double time) {
    ScenePose pose;
    poseScene(scene, 0, time, pose);
    PosedLights lights;
    poseLights(scene, pose, lights);
    const glm::vec3 p = placesAt(scene, figure, time)[static_cast<std::size_t>(tip)];
    const auto index = std::find(lights.names.begin(), lights.names.end(), "spotlight") - lights.names.begin();
    const SpotLight spot =
        lights.set.spot(static_cast<int>(index) - lights.set.directionalCount() - lights.set.pointCount());
    const Vec3 to{spot.position.x - p.x, spot.position.y - p.y, spot.position.z - p.z};
    return exactIrradiance(spot, {p.x, p.y, p.z}, to * (1 / length(to))).g;
  };
  const double inside = lightAt(0.2);
  EXPECT_GT(inside, 3) << "the hand begins in the light";
  EXPECT_EQ(lightAt(1.6), 0) << "the fingertip is outside the cone";
  EXPECT_GT(lightAt(3), 0.5 * inside) << "and comes back";
  // The chest stays lit all the while.
  glm::vec3 high(-1e9f);
  for (int v = 0; v < figure.vertexCount; ++v) high = glm::max(high, places[v]);
  EXPECT_NEAR(high.y, 1.78f, 0.06f);
}

TEST(Touch, LightsTouchEnterCrossAndGraze) {
  const Scene scene = makeSample("touch");
  const auto objects = findObjects(scene);
  const SceneObject& body = movingObject(objects);
  constexpr double kClose = 0.4;  // m, from a light's centre; the largest light has a radius of 0.25 m
  // Distance from each light's centre to the nearest vertex, over the clip.
  std::map<std::string, double> nearest;
  double crossFromMiddle = 1e9, grazeRadius = -1;
  int mostAtOnce = 0;
  const int frames = static_cast<int>(std::lround(scene.animations[0].duration * 120));
  for (int frame = 0; frame <= frames; ++frame) {
    const double time = frame / 120.0;
    int atOnce = 0;
    ScenePose pose;
    poseScene(scene, 0, time, pose);
    PosedObject posed;
    poseObject(scene, body, pose, posed);
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
      if (scene.nodes[n].light < 0) continue;
      const glm::vec3 p(pose.worldFromNode[n][3]);
      double here = 1e9;
      for (const glm::vec3 v : posed.positions) here = std::min(here, static_cast<double>(glm::distance(p, v)));
      double& d = nearest.try_emplace(scene.nodes[n].name, 1e9).first->second;
      d = std::min(d, here);
      const auto fromMiddle = static_cast<double>(glm::distance(p, glm::vec3(posed.worldFromRig[3])));
      if (scene.nodes[n].name == "cross") crossFromMiddle = std::min(crossFromMiddle, fromMiddle);
      atOnce += here < kClose || fromMiddle < kClose ? 1 : 0;
      if (const auto* point =
              std::get_if<PointLight>(&scene.lights[static_cast<std::size_t>(scene.nodes[n].light)].shape)) {
        grazeRadius = static_cast<double>(point->radius);
      }
    }
    mostAtOnce = std::max(mostAtOnce, atOnce);
  }
  EXPECT_EQ(mostAtOnce, 2) << "two near lights must be enough";
  EXPECT_EQ(grazeRadius, 0);
  EXPECT_LT(crossFromMiddle, 0.01);
  EXPECT_LT(nearest["brush"], 0.16);
  EXPECT_GT(nearest["brush"], 0.05) << "brushes, does not enter";
  EXPECT_NEAR(nearest["touch"], 0.25, 0.01) << "its radius: in contact";
  EXPECT_LT(nearest["enter"], 0.03) << "its centre passes the surface";
  EXPECT_LT(nearest["graze"], 0.03);
  EXPECT_GT(nearest["graze"], 0.005) << "a point of zero radius must not cross the surface";
}

TEST(Dragon, LivesAmongFortyLights) {
  const Scene scene = makeSample("dragon");
  EXPECT_EQ(scene.lights.size(), 40u);
  ASSERT_EQ(scene.skins.size(), 1u);
  EXPECT_EQ(scene.skins[0].joints.size(), 14u);
  const auto objects = findObjects(scene);
  const SceneObject& dragon = movingObject(objects);
  ScenePose pose;
  poseScene(scene, kRestPose, 0, pose);
  PosedObject posed;
  poseObject(scene, dragon, pose, posed);
  glm::vec3 low(1e9f), high(-1e9f);
  for (const glm::vec3 v : posed.positions) {
    low = glm::min(low, v);
    high = glm::max(high, v);
  }
  EXPECT_LT(glm::distance(high - low, glm::vec3(1, 1, 8)), 0.25f);
}

TEST(Figure1, LightsStandOffTheBoxByATenthOfTheSize) {
  const Scene scene = makeSample("figure1");
  const auto objects = findObjects(scene);
  ScenePose pose;
  poseScene(scene, kRestPose, 0, pose);
  PosedObject car;
  poseObject(scene, movingObject(objects), pose, car);
  glm::vec3 low(1e9f), high(-1e9f);
  for (const glm::vec3 v : car.positions) {
    low = glm::min(low, v);
    high = glm::max(high, v);
  }
  const float size = glm::distance(low, high);
  for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
    if (scene.nodes[n].light < 0) continue;
    const glm::vec3 p(pose.worldFromNode[n][3]);
    const float away = glm::distance(p, glm::clamp(p, low, high)) / size;
    EXPECT_GE(away, 0.07f) << scene.nodes[n].name;
    EXPECT_LE(away, 0.16f) << scene.nodes[n].name;
  }
}

/// Where a point is from a disk: in front of its plane and from the disk itself, both in metres.
struct FromDisk {
  double ahead = 0, away = 0;
};

FromDisk fromDisk(const DiskLight& disk, glm::vec3 p) {
  const glm::vec3 axis{disk.direction.x, disk.direction.y, disk.direction.z};
  const glm::vec3 v = p - glm::vec3(disk.position.x, disk.position.y, disk.position.z);
  const float ahead = glm::dot(v, axis) / glm::length(axis);
  const float beyond = std::max(0.0f, glm::length(v - ahead * axis) - disk.radius);
  return {static_cast<double>(ahead), std::hypot(static_cast<double>(ahead), static_cast<double>(beyond))};
}

/// Of each disk over the clip: the nearest that a vertex comes, and whether it shows the object both of its sides.
struct Encounter {
  double nearest = 1e9;
  bool fromAhead = false, fromBehind = false;
};

std::map<std::string, Encounter> encounters(const Scene& scene) {
  const auto objects = findObjects(scene);
  const SceneObject& object = movingObject(objects);
  std::map<std::string, Encounter> all;
  const int frames = static_cast<int>(std::lround(scene.animations[0].duration * 30));
  for (int frame = 0; frame <= frames; ++frame) {
    ScenePose pose;
    poseScene(scene, 0, frame / 30.0, pose);
    PosedObject posed;
    poseObject(scene, object, pose, posed);
    PosedLights lights;
    poseLights(scene, pose, lights);
    const int first = lights.set.directionalCount();
    for (int i = 0; i < lights.set.diskCount(); ++i) {
      Encounter& e = all[lights.names[static_cast<std::size_t>(first + i)]];
      for (const glm::vec3 p : posed.positions) {
        const FromDisk from = fromDisk(lights.set.disk(i), p);
        e.nearest = std::min(e.nearest, from.away);
        (from.ahead > 0 ? e.fromAhead : e.fromBehind) = true;
      }
    }
  }
  return all;
}

TEST(Corridor, PassesBelowPanelsAndThroughTheSignsPlane) {
  const Scene scene = makeSample("corridor");
  auto met = encounters(scene);
  ASSERT_EQ(met.size(), 12u);
  EXPECT_NEAR(met["panel 4"].nearest, 0.66, 0.02) << "the ceiling is well above the head";
  EXPECT_NEAR(met["low panel"].nearest, 0.14, 0.02);
  EXPECT_LT(met["lowest panel"].nearest, 0.04) << "the head all but touches";
  EXPECT_GT(met["lowest panel"].nearest, 0.01) << "and does not enter";
  EXPECT_FALSE(met["lowest panel"].fromBehind);
  EXPECT_LT(met["sign"].nearest, 0.07);
  EXPECT_TRUE(met["sign"].fromAhead && met["sign"].fromBehind) << "the figure walks through its plane";
  const auto sign =
      std::find_if(scene.lights.begin(), scene.lights.end(), [](const auto& l) { return l.name == "sign"; });
  EXPECT_TRUE(std::get<DiskLight>(sign->shape).twoSided);
}

TEST(Corridor, FeetStandStillOnTheGround) {
  const Scene scene = makeSample("corridor");
  const auto objects = findObjects(scene);
  const SceneObject& figure = movingObject(objects);
  constexpr double kStep = 1.0 / 120;
  constexpr float kSole = 0.012f;  // m above the floor: a sole that bears weight
  constexpr float kStill = 0.25f;  // m/s; the figure walks at 1.1
  constexpr float kThroughFloor = 0.02f;
  int checked = 0, sliding = 0;
  float lowest = 1;
  for (double time = 0.3; time < 3.5; time += 0.1) {
    const std::vector<glm::vec3> before = placesAt(scene, figure, time), after = placesAt(scene, figure, time + kStep);
    float slowest = 1e9f;
    for (int v = 0; v < figure.vertexCount; ++v) {
      lowest = std::min(lowest, before[v].y);
      if (before[v].y < kSole)
        slowest = std::min(slowest, glm::distance(before[v], after[v]) / static_cast<float>(kStep));
    }
    if (slowest > 1e8f) continue;
    ++checked;
    sliding += slowest > kStill ? 1 : 0;
  }
  EXPECT_GT(checked, 25) << "one foot or the other is on the ground nearly always";
  EXPECT_EQ(sliding, 0);
  EXPECT_GT(lowest, -kThroughFloor);
}

TEST(Gallery, HasDisksThatAllButTouchTheBust) {
  const auto met = encounters(makeSample("gallery"));
  ASSERT_EQ(met.size(), 28u);
  int touching = 0, close = 0, bothSides = 0;
  for (const auto& [name, e] : met) {
    EXPECT_GT(e.nearest, 0.002) << name << " enters the bust";
    touching += e.nearest < 0.01 ? 1 : 0;
    close += e.nearest < 0.1 ? 1 : 0;
    bothSides += e.fromAhead && e.fromBehind ? 1 : 0;
  }
  EXPECT_GE(touching, 2);
  EXPECT_GE(close, 5);
  EXPECT_GE(bothSides, 5) << "the bust passes the planes of those that shine along the wall";
}

}  // namespace
}  // namespace rigel::tools
