// Animations: samplers become channels whose keys are known to increase and to fit their target.
#include "scene/gltf_import.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace rigel::tools {
namespace {

std::optional<AnimationPath> pathOf(const std::string& text) {
  if (text == "translation") return AnimationPath::translation;
  if (text == "rotation") return AnimationPath::rotation;
  if (text == "scale") return AnimationPath::scale;
  if (text == "weights") return AnimationPath::weights;
  return std::nullopt;
}

Interpolation readInterpolation(const JsonPlace& sampler) {
  const std::string text = sampler.text("interpolation", "LINEAR");
  if (text == "LINEAR") return Interpolation::linear;
  if (text == "STEP") return Interpolation::step;
  if (text == "CUBICSPLINE") return Interpolation::cubicSpline;
  sampler.member("interpolation").fail("\"{}\" is none of STEP, LINEAR, CUBICSPLINE", text);
}

std::vector<float> readTimes(GltfImport& import, const JsonPlace& sampler) {
  const int accessor = sampler.requiredIndex("input", import.accessors.count(), "accessor");
  const JsonPlace user = sampler.member("input");
  std::vector<float> times = import.accessors.floats(user, accessor, 1, kFloat);
  if (times.size() > 1 && !import.accessors.hasData(accessor)) return times;  // ignored by who asked
  if (times.front() < 0) user.fail("accessor {} begins at the negative time {}", accessor, times.front());
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (times[i] <= times[i - 1]) {
      user.fail("accessor {}: key {} at {} s does not come after key {} at {} s", accessor, i, times[i], i - 1,
                times[i - 1]);
    }
  }
  return times;
}

void checkRotations(const JsonPlace& user, const Channel& channel) {
  const bool cubic = channel.interpolation == Interpolation::cubicSpline;
  const std::size_t stride = cubic ? 12 : 4;
  for (std::size_t key = 0; key < channel.times.size(); ++key) {
    const float* q = channel.values.data() + key * stride + (cubic ? 4 : 0);
    const double norm = std::hypot(std::hypot(double(q[0]), double(q[1])), std::hypot(double(q[2]), double(q[3])));
    // 8-bit quaternions are off by up to 0.8%.
    if (std::abs(norm - 1) > 0.02) user.fail("key {} is no unit quaternion: its length is {:.4g}", key, norm);
  }
}

void readValues(GltfImport& import, const JsonPlace& sampler, Channel& channel) {
  const int accessor = sampler.requiredIndex("output", import.accessors.count(), "accessor");
  const JsonPlace user = sampler.member("output");
  const bool weights = channel.path == AnimationPath::weights;
  const bool rotation = channel.path == AnimationPath::rotation;
  const unsigned packed = weights || rotation ? kNormalizedInt8 | kNormalizedInt16 : 0u;
  channel.values = import.accessors.floats(user, accessor, weights ? 1 : channel.width, kFloat | packed);
  const std::size_t perKey =
      static_cast<std::size_t>(channel.width) * (channel.interpolation == Interpolation::cubicSpline ? 3 : 1);
  if (channel.values.size() != channel.times.size() * perKey) {
    user.fail("accessor {} holds {} numbers; {} keys of {} need {}", accessor, channel.values.size(),
              channel.times.size(), perKey, channel.times.size() * perKey);
  }
  if (rotation) checkRotations(user, channel);
}

// nullopt where glTF says to ignore the channel, with a note.
std::optional<Channel> readChannel(GltfImport& import, const JsonPlace& place, const std::vector<JsonPlace>& samplers) {
  const Scene& scene = import.scene;
  const int sampler = place.requiredIndex("sampler", samplers.size(), "sampler");
  const JsonPlace target = place.member("target");
  const std::string pathText = target.member("path").asText();
  Channel channel;
  channel.node = target.index("node", scene.nodes.size(), "node");
  if (channel.node < 0) {
    import.note("{}: ignored: it moves no node (path \"{}\")", place.path(), pathText);
    return std::nullopt;
  }
  const auto path = pathOf(pathText);
  if (!path) {
    import.note("{}: ignored: path \"{}\" is not supported", place.path(), pathText);
    return std::nullopt;
  }
  const Node& node = scene.nodes[channel.node];
  channel.path = *path;
  channel.width = *path == AnimationPath::rotation ? 4 : 3;
  if (*path == AnimationPath::weights) {
    channel.width = node.mesh >= 0 ? static_cast<int>(scene.meshes[node.mesh].morphWeights.size()) : 0;
    if (channel.width == 0) target.fail("moves morph weights of node {}, which has no morph targets", channel.node);
  } else if (node.hasMatrix) {
    target.fail("moves node {}, whose transform is a fixed matrix", channel.node);
  }
  channel.interpolation = readInterpolation(samplers[sampler]);
  channel.times = readTimes(import, samplers[sampler]);
  readValues(import, samplers[sampler], channel);
  if (channel.times.back() == 0 && channel.times.size() > 1) {
    import.note("{}: ignored: its key times have no data", place.path());
    return std::nullopt;
  }
  return channel;
}

}  // namespace

void importAnimations(GltfImport& import) {
  for (const JsonPlace& place : import.document.root().items("animations")) {
    Animation animation;
    animation.name = readName(place, fmt::format("clip {}", import.scene.animations.size()));
    const std::vector<JsonPlace> samplers = place.items("samplers", true);
    std::set<std::pair<int, AnimationPath>> targets;
    for (const JsonPlace& channelPlace : place.items("channels", true)) {
      std::optional<Channel> channel = readChannel(import, channelPlace, samplers);
      if (!channel) continue;
      if (!targets.insert({channel->node, channel->path}).second) {
        channelPlace.fail("moves the same property of node {} as a channel before it", channel->node);
      }
      animation.duration = std::max(animation.duration, static_cast<double>(channel->times.back()));
      animation.channels.push_back(std::move(*channel));
    }
    import.scene.animations.push_back(std::move(animation));
  }
}

}  // namespace rigel::tools
