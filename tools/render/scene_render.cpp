#include "render/scene_render.h"

#include "picture/shade_exact.h"
#include "picture/tone_map.h"

#include <rigel/glm.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

namespace rigel::tools {
namespace {

// Lights are shown as the pictures of a report show them.
constexpr float kLightMarker = 0.02f;  // least radius, of what is framed
constexpr float kLightBrightness = 1.2f;

constexpr int kSurveyed = 64;         // frames that set the scale of errors and the size of the picture, as a report's
constexpr double kFrameSlack = 1e-3;  // of a frame: 0.8333333 s are 25 frames

class Stopwatch {
 public:
  double milliseconds() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::string objectNames(const std::vector<SceneObject>& objects) {
  std::string names;
  for (const SceneObject& object : objects)
    if (!object.isStatic) names += (names.empty() ? "" : ", ") + object.name;
  return names;
}

}  // namespace

Result<SceneRender> SceneRender::create(const RenderOptions& options, const GpuContext& context) {
  SceneRender render(options);
  if (auto error = render.load()) return *error;
  if (auto error = render.makeRigs()) return *error;
  render.survey();
  render.pose(render.frames().front());
  render.fit(0);
  std::vector<DrawnObject> drawn;
  for (const Lit& lit : render.lit_) drawn.push_back({lit.object, lit.rig.get()});
  const RendererOptions how{options.run.bands,
                            options.storage,
                            options.perVertex,
                            options.run.wrap,
                            options.wrappedDisk,
                            options.against != RenderReference::none,
                            options.shaderCache};
  const Stopwatch watch;
  auto renderer = SceneRenderer::create(context, drawn, render.stage_->lights().set, how);
  if (!renderer) return renderer.error();
  render.renderer_ = std::make_unique<SceneRenderer>(*std::move(renderer));
  render.loadMilliseconds_ = watch.milliseconds();
  return render;
}

std::optional<Error> SceneRender::load() {
  auto donor = loadDonor(options_.run);
  if (!donor) return donor.error();
  donor_ = std::make_unique<std::optional<LightDonor>>(*std::move(donor));
  const std::string& source = options_.run.scenes.front();
  auto scene = LoadedScene::load(source, options_.run, *donor_ ? &**donor_ : nullptr);
  if (!scene) return scene.error();
  scene_ = std::make_unique<LoadedScene>(*std::move(scene));
  auto stage = Stage::create(*scene_, timeline());
  if (!stage) return stage.error();
  stage_ = std::make_unique<Stage>(*std::move(stage));
  return std::nullopt;
}

std::optional<Error> SceneRender::makeRigs() {
  ScenePose rest;
  poseScene(scene_->scene(), kRestPose, 0, rest);
  PosedObject posed;
  const RigSpec& spec = options_.run.rigs.front();
  for (const SceneObject& object : scene_->objects()) {
    Lit lit;
    lit.object = &object;
    if (!object.isStatic) {
      poseObject(scene_->scene(), object, rest, posed);
      auto surface = chooseSurface(object, posed, options_.run.samples, options_.run.wrap);
      if (!surface) return Error{surface.error().line(), scene_->source()};
      LightingOptions asked = lightingOptions(spec, options_.run);
      asked.wrap = commonWrap(surface->wrap);
      asked.estimate = false;  // nobody reads it here
      auto rig = makeRigRunner(spec, asked, options_.run.bands, object, posed, *surface);
      if (!rig) return Error{rig.error().line(), scene_->source()};
      lit.rig = *std::move(rig);
      lit.surface = *std::move(surface);
      if (options_.object.empty() || object.name == options_.object) framed_.push_back(lit_.size());
    }
    lit_.push_back(std::move(lit));
  }
  posed_.resize(lit_.size());
  if (framed_.empty())
    return Error{
        fmt::format("no object '{}' that moves; there are {}", options_.object, objectNames(scene_->objects())),
        scene_->source()};
  return std::nullopt;
}

/// The scale of errors that rigs aim at, as a report has it, and how large the picture must be.
void SceneRender::survey() {
  const auto& frames = timeline().frames;
  const std::size_t looks = std::min<std::size_t>(kSurveyed, frames.size());
  for (std::size_t k = 0; k < looks; ++k) {
    pose(frames[k * frames.size() / looks]);
    framedRadius_ = std::max(framedRadius_, framedSphere().radius);
  }
  // Of the whole clip, whatever part of it is drawn: choices are then those of its report.
  const double duration = std::max(timeline().clipDuration, timeline().lightDuration);
  const int clipFrames = static_cast<int>(duration * timeline().rate + kFrameSlack) + 1;
  const int count = std::min(kSurveyed, clipFrames);
  std::vector<double> means(lit_.size());
  for (int k = 0; k < count; ++k) {
    pose(static_cast<int>(static_cast<long>(k) * clipFrames / count));
    for (std::size_t i = 0; i < lit_.size(); ++i) {
      if (lit_[i].rig == nullptr) continue;
      means[i] += quickMean(*lit_[i].object, posed_[i], lit_[i].surface, stage_->lights().set);
    }
  }
  for (std::size_t i = 0; i < lit_.size(); ++i)
    if (lit_[i].rig != nullptr) lit_[i].rig->setReference(static_cast<float>(means[i] / count));
}

void SceneRender::pose(int frame) {
  stage_->pose(frame);
  for (std::size_t i = 0; i < lit_.size(); ++i)
    poseObject(scene_->scene(), *lit_[i].object, stage_->nodes(), posed_[i]);
}

FitTimes SceneRender::fit(float seconds) {
  const LightSet& lights = stage_->lights().set;
  std::vector<RigRunner*> rigs;
  for (std::size_t i = 0; i < lit_.size(); ++i) {
    if (lit_[i].rig == nullptr) continue;
    rigs.push_back(lit_[i].rig.get());
    if (seconds == 0) rigs.back()->reset();
    rigs.back()->pose(*lit_[i].object, posed_[i]);
  }
  if (options_.run.budget && chooses(options_.run.rigs.front(), options_.run)) {
    shares_.resize(rigs.size());
    lightWithin(*options_.run.budget, rigs, lights, seconds, shares_);
  } else {
    for (RigRunner* rig : rigs) rig->light(lights, seconds);
  }
  FitTimes all;
  for (const RigRunner* rig : rigs) {
    const FitTimes& times = rig->times();
    for (int s = 0; s < FitTimes::kStages; ++s)
      if (times.stages[s]) all.stages[s] = all.stages[s].value_or(0) + *times.stages[s];
  }
  return all;
}

std::vector<RigState> SceneRender::rigStates() const {
  std::vector<RigState> all;
  for (const Lit& lit : lit_) {
    if (lit.rig == nullptr) continue;
    RigState& state = all.emplace_back(RigState{lit.object->name, lit.rig->shVectors(), {}});
    const auto verdicts = lit.rig->verdicts();
    for (std::size_t i = 0; i < verdicts.size(); ++i)
      if (verdicts[i].weight > 0) state.near.push_back(static_cast<int>(i));
  }
  return all;
}

BoundingSphere SceneRender::framedSphere() const {
  std::vector<glm::vec3> points;
  for (const std::size_t i : framed_)
    points.insert(points.end(), posed_[i].positions.begin(), posed_[i].positions.end());
  return boundingSphere(points);
}

Camera SceneRender::camera(int width, int height) const {
  // One picture fills its frame; over several the camera follows at one distance.
  if (timeline().frames.size() == 1) {
    std::vector<glm::vec3> points;
    for (const std::size_t i : framed_)
      points.insert(points.end(), posed_[i].positions.begin(), posed_[i].positions.end());
    return framePoints(points, width, height);
  }
  return frameSphere({framedSphere().centre, framedRadius_}, width, height);
}

Result<RenderedFrame> SceneRender::draw(const Camera& camera) {
  const auto markers = lightMarkers(stage_->lights().set, kLightMarker * framedSphere().radius, kLightBrightness);
  return renderer_->render(camera, posed_, stage_->lights().set, markers);
}

Result<RenderResult> SceneRender::render(int frame) {
  RenderResult result;
  result.number = frame;
  result.time = timeline().time(frame);
  pose(frame);
  const auto index = static_cast<std::size_t>(std::ranges::lower_bound(frames(), frame) - frames().begin());
  const bool followsOn = index > 0 && lastFrame_ == frames()[index - 1] && timeline().followsOn(index);
  lastFrame_ = frame;
  result.stages = fit(followsOn ? static_cast<float>(1 / options_.run.rate) : 0);

  const Camera plain = camera(options_.width, options_.height);
  const Stopwatch watch;
  auto measured = draw(plain);
  if (!measured) return measured.error();
  result.drawMilliseconds = watch.milliseconds();
  result.frameMilliseconds = measured->milliseconds;
  const auto unlit = renderer_->unlitMilliseconds(plain);
  if (!unlit) return unlit.error();
  result.unlitMilliseconds = *unlit;
  result.rigs = rigStates();
  result.effects = renderer_->effects();
  result.effects.add(lightEffects(stage_->lights().set));
  if (options_.run.rigs.front().adaptive) result.effects.add(Effect::rig_auto);
  if (options_.against != RenderReference::none) {
    const auto points = renderer_->points(plain);
    if (!points) return points.error();
    result.difference = compareWith(*measured, *points, plain);
  }

  RenderedFrame shown = *std::move(measured);
  if (options_.supersampling > 1) {
    auto large = draw(camera(options_.width * options_.supersampling, options_.height * options_.supersampling));
    if (!large) return large.error();
    shown = *std::move(large);
  }
  result.exposure = exposureOf(shown);
  result.radiance = picture(shown, result.exposure);
  return result;
}

float SceneRender::exposureOf(const RenderedFrame& frame) const {
  std::vector<Rgb> object;
  for (std::size_t p = 0; p < frame.part.size(); ++p)
    if (frame.part[p] > 0 && frame.part[p] <= lit_.size() && lit_[frame.part[p] - 1].rig != nullptr)
      object.push_back(frame.radiance[p]);
  return autoExposure(object);
}

/// Each pixel the mean of its samples; lights as bright as they are shown, whatever the exposure.
Image SceneRender::picture(const RenderedFrame& frame, float exposure) const {
  const int n = frame.width / options_.width;
  const float weight = 1 / static_cast<float>(n * n);
  Image image(options_.width, options_.height);
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      const auto from =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) + static_cast<std::size_t>(x);
      if (frame.part[from] == RenderedFrame::kNothing) continue;
      const auto to =
          static_cast<std::size_t>(y / n) * static_cast<std::size_t>(options_.width) + static_cast<std::size_t>(x / n);
      const float scale = weight * (frame.part[from] > lit_.size() ? 1 / exposure : 1.0f);
      for (int c = 0; c < 3; ++c) image.rgb[3 * to + static_cast<std::size_t>(c)] += scale * frame.radiance[from][c];
      image.coverage[to] += weight;
    }
  }
  for (float& c : image.coverage) c = std::min(c, 1.0f);
  return image;
}

Difference SceneRender::compareWith(const RenderedFrame& frame, const RenderedPoints& points, const Camera& camera) {
  RayCaster caster;
  std::vector<std::uint32_t> partOf;
  for (std::size_t i = 0; i < lit_.size(); ++i) {
    caster.add(*lit_[i].object, posed_[i], lit_[i].rig != nullptr ? SampleKind::object : SampleKind::scenery);
    partOf.push_back(static_cast<std::uint32_t>(i + 1));
  }
  addLights(caster, stage_->lights().set, kLightMarker * framedSphere().radius, kLightBrightness);
  VisibleSurface seen = caster.cast(camera, 1);
  const double apart = takePoints(frame, points, partOf, seen);
  if (options_.run.wrap)
    for (VisibleSample& sample : seen.samples) sample.wrap = *options_.run.wrap;
  std::vector<Rgb> reference =
      options_.against == RenderReference::truth ? exactIrradiance(seen, stage_->lights().set) : irradianceOfRigs(seen);
  Difference difference = compare(frame, seen, reference, partOf);
  difference.apart = apart / static_cast<double>(framedSphere().radius);
  return difference;
}

/// What the CPU gives at the same points from the same rigs and near lights.
std::vector<Rgb> SceneRender::irradianceOfRigs(const VisibleSurface& seen) const {
  std::vector<Rgb> all(seen.samples.size());
  std::vector<std::size_t> samples;
  std::vector<PointAndNormal> points;
  std::vector<float> wraps;
  for (std::size_t i = 0; i < lit_.size(); ++i) {
    if (lit_[i].rig == nullptr) continue;
    samples.clear();
    points.clear();
    wraps.clear();
    for (std::size_t s = 0; s < seen.samples.size(); ++s) {
      const VisibleSample& sample = seen.samples[s];
      if (sample.kind != SampleKind::object || sample.part != i) continue;
      samples.push_back(s);
      points.push_back({sample.position, sample.normal});
      wraps.push_back(sample.wrap);
    }
    std::vector<RigRunner::Shaded> shaded(points.size());
    lit_[i].rig->shade(points, wraps, shaded);
    for (std::size_t k = 0; k < samples.size(); ++k) all[samples[k]] = shaded[k].clamped();
  }
  return all;
}

}  // namespace rigel::tools
