#include "report/object_run.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace rigel::tools {
namespace {

double square(double x) { return x * x; }

/// The wrap of most of the surface: what bounds and estimates are made for where materials differ.
float commonWrap(std::span<const float> wraps) {
  std::map<float, int> counts;
  for (const float wrap : wraps) ++counts[wrap];
  return std::ranges::max_element(counts, {}, [](const auto& entry) { return entry.second; })->first;
}

}  // namespace

Result<ObjectRun> ObjectRun::create(const SceneObject& object, const PosedObject& rest, const RunOptions& options,
                                    int timings) {
  ObjectRun run(object);
  run.bands_ = options.bands;
  run.timings_ = timings;
  run.rate_ = options.rate;
  auto surface = chooseSurface(object, rest, options.samples, options.wrap);
  if (!surface) return surface.error();
  run.surface_ = *std::move(surface);
  for (const RigSpec& spec : options.rigs) {
    LightingOptions asked = lightingOptions(spec, options);
    asked.wrap = commonWrap(run.surface_.wrap);
    auto runner = makeRigRunner(spec, asked, options.bands, object, rest, run.surface_);
    if (!runner) return runner.error();
    run.runners_.push_back(*std::move(runner));
    run.tallies_.emplace_back(asked);
    run.asked_.push_back(choiceOptions(spec, options));
  }
  run.shaded_.resize(run.surface_.measured.size());
  return run;
}

void ObjectRun::survey(const PosedObject& posed, const LightSet& lights) {
  surveyed_.push_back(quickMean(*object_, posed, surface_, lights));
}

void ObjectRun::setReference() {
  if (surveyed_.empty()) return;
  const double mean = std::accumulate(surveyed_.begin(), surveyed_.end(), 0.0) / static_cast<double>(surveyed_.size());
  for (const auto& runner : runners_) runner->setReference(static_cast<float>(mean));
}

void ObjectRun::measure(const RunFrame& frame, const PosedObject& posed, const LightSet& lights) {
  if (frames_.empty()) setReference();
  truth_.update(*object_, posed, surface_, lights, bands_);
  const bool followsOn = frame.followsOn && !frames_.empty();
  FrameTruth& truth = frames_.emplace_back(FrameTruth{truth_.mean, {}});
  numbers_.push_back(frame.number);
  times_.push_back(frame.time);
  if (followsOn) {
    double squares = 0;
    for (std::size_t i = 0; i < previousExact_.size(); ++i)
      for (int c = 0; c < 3; ++c) squares += square(truth_.exact[i][c] - previousExact_[i][c]);
    truth.movementSquares = squares;
  }
  previousExact_ = truth_.exact;
  for (std::size_t r = 0; r < runners_.size(); ++r)
    measureRig(r, static_cast<float>(1 / rate_), followsOn, posed, lights);
}

void ObjectRun::measureRig(std::size_t r, float seconds, bool followsOn, const PosedObject& posed,
                           const LightSet& lights) {
  // Timing a frame again must not let anything fade further.
  constexpr float kNoTime = 1e-9f;
  RigRunner& runner = *runners_[r];
  if (!followsOn) runner.reset();
  for (int i = 0; i < timings_; ++i) {
    const FitTimes fit = runner.fit(*object_, posed, lights, i == 0 ? seconds : kNoTime);
    tallies_[r].addTiming(fit, runner.shade(truth_.points, surface_.wrap, shaded_));
  }
  tallies_[r].addFrame(runner, shaded_, truth_, shOfFarShares(runner, lights), surface_.wrap, followsOn);
}

std::span<const Rgb> ObjectRun::shOfFarShares(const RigRunner& rig, const LightSet& lights) {
  weights_.clear();
  for (const LightVerdict& verdict : rig.verdicts()) weights_.push_back(verdict.weight);
  if (std::ranges::all_of(weights_, [](float w) { return w == 0; })) return truth_.sh;
  splitLights(lights, weights_, far_, near_);
  truth_.project(far_, surface_, bands_, farSh_);
  return farSh_;
}

double ObjectRun::meanIrradiance() const {
  double sum = 0;
  for (const FrameTruth& frame : frames_) sum += frame.mean;
  return frames_.empty() ? 0 : sum / static_cast<double>(frames_.size());
}

std::size_t ObjectRun::worstFrame() const {
  std::size_t worst = 0;
  double worstSum = -1;
  for (std::size_t f = 0; f < frames_.size(); ++f) {
    double sum = 0;
    for (const RigTally& tally : tallies_) sum += tally.totalError(f);
    if (sum > worstSum) {
      worstSum = sum;
      worst = f;
    }
  }
  return worst;
}

ObjectReport ObjectRun::report(std::span<const LightRow> lights) const {
  ObjectReport out;
  out.name = object_->name;
  out.triangles = static_cast<int>(object_->triangles.size());
  out.samples = static_cast<int>(surface_.measured.size());
  out.meanIrradiance = meanIrradiance();
  const double scale = out.meanIrradiance > 0 ? 1 / out.meanIrradiance : 0;
  const double channels = 3 * static_cast<double>(surface_.measured.size());
  for (std::size_t f = 0; f < frames_.size(); ++f) {
    TruthFrame& truth = out.truth.emplace_back(TruthFrame{times_[f], frames_[f].mean, {}});
    if (frames_[f].movementSquares) truth.movement = scale * std::sqrt(*frames_[f].movementSquares / channels);
  }
  for (std::size_t r = 0; r < runners_.size(); ++r) {
    out.rigs.push_back(tallies_[r].report(*runners_[r], {times_, numbers_, lights, out.meanIrradiance}));
    out.rigs.back().asked = asked_[r];
  }
  return out;
}

}  // namespace rigel::tools
