#include "report/run/capture.h"

#include "report/run/run_settings.h"
#include "report/run/timeline.h"
#include "scene/gltf_load.h"
#include "scene/gltf_save.h"
#include "scene/transplant.h"

#include <rigel/glm.h>

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>

namespace rigel::tools {
namespace {

/// The key of a frame: never after the moment at which a run looks, so that the last one is reached.
float keyTime(const Timeline& timeline, int frame) {
  const double time = timeline.time(frame);
  const auto rounded = static_cast<float>(time);
  return rounded > time ? std::nextafter(rounded, 0.0f) : rounded;
}

/// Lights travel along their node's -z; the other axes are free.
glm::quat rotationTo(const Vec3& direction) {
  const glm::dvec3 to = glm::normalize(glm::dvec3(direction.x, direction.y, direction.z));
  const glm::dvec3 from(0, 0, -1);
  const double cosine = glm::dot(from, to);
  if (cosine < -1 + 1e-12) return {0, 0, 1, 0};  // half a turn about y
  const glm::dvec3 axis = glm::cross(from, to);
  const glm::dquat q = glm::normalize(glm::dquat(1 + cosine, axis.x, axis.y, axis.z));
  return glm::quat(q);
}

/// A light in its own frame, and where it stands.
struct Placed {
  LightShape shape;
  glm::vec3 position{0};
  glm::quat rotation{1, 0, 0, 0};
};

template <class Light>
Placed placed(Light light) {
  Placed out;
  if constexpr (requires { light.position; }) {
    out.position = toGlm(light.position);
    light.position = {};
  }
  if constexpr (requires { light.direction; }) {
    out.rotation = rotationTo(light.direction);
    light.direction = {0, 0, -1};
  }
  out.shape = light;
  return out;
}

std::vector<Placed> placedLights(const LightSet& set) {
  std::vector<Placed> out;
  for (int i = 0; i < set.directionalCount(); ++i) out.push_back(placed(set.directional(i)));
  for (int i = 0; i < set.pointCount(); ++i) out.push_back(placed(set.point(i)));
  for (int i = 0; i < set.spotCount(); ++i) out.push_back(placed(set.spot(i)));
  for (int i = 0; i < set.sphereCount(); ++i) out.push_back(placed(set.sphere(i)));
  for (int i = 0; i < set.diskCount(); ++i) out.push_back(placed(set.disk(i)));
  return out;
}

/// The frames that a run of this timeline may look at, and those before: the scene's clock still begins at 0.
class Recording {
 public:
  Recording(const Scene& scene, const Timeline& timeline) : scene_(scene), timeline_(timeline) {
    for (int frame = 0; frame <= timeline.frames.back(); ++frame) times_.push_back(keyTime(timeline, frame));
    clip_.name = timeline.clipName.empty() ? "captured" : timeline.clipName;
  }

  /// The keys of the clip, once more for each lap.
  void addPoses() {
    if (timeline_.clip == kRestPose) return;
    const Animation& from = scene_.animations[timeline_.clip];
    if (timeline_.clipDuration >= times_.back()) {
      clip_.channels = from.channels;
      return;
    }
    for (const Channel& channel : from.channels) {
      clip_.channels.push_back(channel);
      clip_.channels.back().interpolation = Interpolation::linear;
      clip_.channels.back().times = times_;
      clip_.channels.back().values.clear();
    }
    ScenePose pose;
    for (std::size_t frame = 0; frame < times_.size(); ++frame) {
      poseScene(scene_, timeline_.clip, timeline_.clipTime(static_cast<int>(frame)), pose);
      for (Channel& channel : clip_.channels) append(pose, channel);
    }
  }

  Result<Scene> withLights(const LightTransplant& lights) {
    Scene out = scene_;
    for (Node& node : out.nodes) node.light = -1;
    out.lights.clear();
    std::vector<Channel> moves, turns;
    PosedLights posed;
    for (std::size_t frame = 0; frame < times_.size(); ++frame) {
      lights.lightsAt(timeline_.lightTime(static_cast<int>(frame)), posed);
      const std::vector<Placed> all = placedLights(posed.set);
      if (frame == 0) addLights(all, posed.names, out, moves, turns);
      if (all.size() != out.lights.size()) return Error{"lights come and go, which no capture can hold", scene_.name};
      for (std::size_t i = 0; i < all.size(); ++i) {
        const glm::vec3& p = all[i].position;
        const glm::quat& q = all[i].rotation;
        moves[i].values.insert(moves[i].values.end(), {p.x, p.y, p.z});
        turns[i].values.insert(turns[i].values.end(), {q.x, q.y, q.z, q.w});
      }
    }
    for (std::vector<Channel>* channels : {&moves, &turns})
      for (Channel& channel : *channels)
        if (changes(channel)) clip_.channels.push_back(std::move(channel));
    if (timeline_.clip == kRestPose) {
      if (!clip_.channels.empty()) out.animations.push_back(clip_);
    } else {
      out.animations[timeline_.clip] = clip_;
    }
    return out;
  }

 private:
  static void append(const ScenePose& pose, Channel& channel) {
    const ScenePose::Local& local = pose.local[channel.node];
    const auto add = [&](auto... numbers) { (channel.values.push_back(numbers), ...); };
    switch (channel.path) {
      case AnimationPath::translation:
        add(local.translation.x, local.translation.y, local.translation.z);
        break;
      case AnimationPath::rotation:
        add(local.rotation.x, local.rotation.y, local.rotation.z, local.rotation.w);
        break;
      case AnimationPath::scale:
        add(local.scale.x, local.scale.y, local.scale.z);
        break;
      case AnimationPath::weights:
        for (const float weight : pose.morphWeights[channel.node]) add(weight);
        break;
    }
  }

  void addLights(const std::vector<Placed>& all, const std::vector<std::string>& names, Scene& out,
                 std::vector<Channel>& moves, std::vector<Channel>& turns) const {
    for (std::size_t i = 0; i < all.size(); ++i) {
      const int node = static_cast<int>(out.nodes.size());
      out.lights.push_back({names[i], all[i].shape, false});
      Node& added = out.nodes.emplace_back();
      added.name = names[i];
      added.light = static_cast<int>(i);
      added.translation = all[i].position;
      added.rotation = all[i].rotation;
      out.roots.push_back(node);
      moves.push_back({node, AnimationPath::translation, Interpolation::linear, 3, times_, {}});
      turns.push_back({node, AnimationPath::rotation, Interpolation::linear, 4, times_, {}});
    }
  }

  static bool changes(const Channel& channel) {
    for (std::size_t i = channel.width; i < channel.values.size(); ++i)
      if (channel.values[i] != channel.values[i - channel.width]) return true;
    return false;
  }

  const Scene& scene_;
  const Timeline& timeline_;
  std::vector<float> times_;
  Animation clip_;
};

}  // namespace

Result<std::size_t> writeCapture(const RunOptions& options, const std::filesystem::path& file) {
  const std::string place = "--capture " + file.string();
  if (options.scenes.size() != 1) return Error{"a capture holds one scene", place};
  auto loaded = loadScene(options.scenes.front());
  if (!loaded) return loaded.error();
  Scene scene = *std::move(loaded);
  std::optional<LightDonor> donor;
  if (!options.lights.empty()) {
    auto lights = loadScene(options.lights);
    if (!lights) return lights.error();
    auto created = LightDonor::create(*std::move(lights));
    if (!created) return created.error();
    donor = *std::move(created);
  }
  const auto timelines = makeTimelines(scene, options, donor ? donor->duration() : 0);
  if (!timelines) return timelines.error();
  if (timelines->all.size() != 1) return Error{"a capture holds one clip (choose it by --clip NAME)", place};
  const Timeline& timeline = timelines->all.front();
  RunOptions settings = options;
  settings.clip = timeline.clipName;
  if (donor) {
    const auto transplant = LightTransplant::create(*donor, scene, timeline.clip);
    if (!transplant) return transplant.error();
    Recording recording(scene, timeline);
    recording.addPoses();
    auto recorded = recording.withLights(*transplant);
    if (!recorded) return recorded.error();
    settings.frames.last = timeline.frames.back();
    for (const double duration : {timeline.clipDuration, timeline.lightDuration})
      if (duration > 0) settings.loops.push_back(duration);
    if (recorded->animations.size() == 1) settings.clip = recorded->animations.front().name;
    scene = *std::move(recorded);
  }
  scene.settings = runSettingsText(settings);
  return saveGltf(scene, file);
}

}  // namespace rigel::tools
