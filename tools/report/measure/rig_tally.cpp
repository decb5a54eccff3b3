#include "report/measure/rig_tally.h"

#include <algorithm>
#include <cmath>

namespace rigel::tools {
namespace {

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

double square(double x) { return x * x; }

std::optional<double> asDouble(std::optional<float> value) {
  return value ? std::optional<double>(*value) : std::nullopt;
}

/// RMS over the frames of what each frame may have.
template <class Of>
std::optional<double> pooled(const std::vector<FrameReport>& frames, Of of) {
  double squares = 0;
  for (const FrameReport& frame : frames) {
    if (!(frame.*of)) return std::nullopt;
    squares += square(*(frame.*of));
  }
  return std::sqrt(squares / static_cast<double>(frames.size()));
}

}  // namespace

void RigTally::addTiming(const FitTimes& fit, double shadeMicroseconds) {
  fitTimes_.push_back(fit);
  shadeTimes_.push_back(shadeMicroseconds);
}

void RigTally::addFrame(const RigRunner& rig, std::span<const LightVerdict> lights,
                        std::span<const RigRunner::Shaded> shaded, const Truth& truth, std::span<const Rgb> sh,
                        std::span<const float> wrap, bool followsOn) {
  Frame& frame = frames_.emplace_back();
  frame.estimate = rig.spatialEstimate();
  frame.totalEstimate = rig.totalEstimate();
  frame.shVectors = rig.shVectors();
  frame.modelledNanoseconds = rig.modelledNanoseconds();
  for (std::size_t i = 0; i < lights.size(); ++i)
    if (lights[i].weight > 0) frame.near.push_back(static_cast<int>(i));
  lights_.add(lights);
  bytes_ = std::max(bytes_, rig.bytes());
  condition_ = std::max(condition_, rig.rig().condition());

  samples_ = shaded.size();
  std::swap(error_, previousError_);
  error_.resize(samples_);
  frame.errors = frameErrors(rig, shaded, truth, sh, wrap, error_);
  spatialMax_ = std::max(spatialMax_, frame.errors.spatialMax);
  totalMax_ = std::max(totalMax_, frame.errors.totalMax);
  spread_.add(error_);
  if (!followsOn) return;
  double jump = 0;
  for (std::size_t i = 0; i < samples_; ++i)
    for (int c = 0; c < 3; ++c)
      jump = std::max(jump, static_cast<double>(std::abs(error_[i][c] - previousError_[i][c])));
  frame.jump = jump;
}

void RigTally::addHalf(std::span<const RigRunner::Shaded> shaded, std::span<const RigRunner::Shaded> half) {
  double squares = 0;
  for (std::size_t i = 0; i < shaded.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double change = static_cast<double>(half[i].rig[c]) - static_cast<double>(shaded[i].rig[c]);
      squares += square(change);
      halfMax_ = std::max(halfMax_, std::abs(change));
    }
  }
  frames_.back().halfSquares = squares;
}

double RigTally::totalError(std::size_t frame) const { return std::sqrt(frames_[frame].errors.totalSquares); }

void RigTally::addTimes(RigReport& out) const {
  for (int stage = 0; stage < FitTimes::kStages; ++stage) {
    std::vector<double> times;
    for (const FitTimes& frame : fitTimes_)
      if (const auto& time = frame.stages[static_cast<std::size_t>(stage)]) times.push_back(*time);
    if (!times.empty()) out.stages.push_back({FitTimes::kNames[stage], median(std::move(times))});
  }
  std::vector<double> fit;
  for (const FitTimes& frame : fitTimes_) fit.push_back(fitMicroseconds(frame, asked_));
  const double shade = median(shadeTimes_);
  out.stages.push_back({"shade", shade});
  out.fitMicroseconds = median(std::move(fit));
  out.shadeNanosecondsPerPoint = 1000 * shade / static_cast<double>(samples_);
}

void RigTally::addFrames(RigReport& out, const TallyContext& context) const {
  const double scale = context.meanIrradiance > 0 ? 1 / context.meanIrradiance : 0;
  const double channels = 3 * static_cast<double>(samples_), count = static_cast<double>(frames_.size());
  double spatial = 0, total = 0;
  std::optional<double> half;
  for (std::size_t f = 0; f < frames_.size(); ++f) {
    const Frame& from = frames_[f];
    FrameReport& frame = out.frames.emplace_back();
    frame.time = context.times[f];
    frame.spatialRms = scale * std::sqrt(from.errors.spatialSquares / channels);
    frame.totalRms = scale * std::sqrt(from.errors.totalSquares / channels);
    frame.estimate = asDouble(from.estimate);
    frame.totalEstimate = asDouble(from.totalEstimate);
    frame.granted = asDouble(from.granted);
    if (from.jump) {
      frame.jump = scale * *from.jump;
      out.maxJump = std::max(out.maxJump.value_or(0), *frame.jump);
    }
    frame.shVectors = from.shVectors;
    frame.modelledNanoseconds = static_cast<double>(from.modelledNanoseconds);
    frame.near = from.near;
    spatial += from.errors.spatialSquares / channels / count;
    total += from.errors.totalSquares / channels / count;
    if (from.halfSquares) half = half.value_or(0) + *from.halfSquares / channels / count;
    out.shVectors += from.shVectors;  // counts are summed first: their mean is then exact where all are alike
    out.nearLights += static_cast<double>(from.near.size());
    out.modelledNanoseconds += frame.modelledNanoseconds / count;
    out.highBandFrames += from.errors.highBand ? 1 : 0;
  }
  out.shVectors /= count;
  out.nearLights /= count;
  out.spatial = {scale * std::sqrt(spatial), scale * spatialMax_};
  out.total = {scale * std::sqrt(total), scale * totalMax_};
  if (half) out.halfFloat = ErrorFigures{scale * std::sqrt(*half), scale * halfMax_};
  out.estimate = pooled(out.frames, &FrameReport::estimate);
  out.totalEstimate = pooled(out.frames, &FrameReport::totalEstimate);
}

RigReport RigTally::report(const RigRunner& rig, const TallyContext& context) const {
  RigReport out;
  out.spec = rig.rig().spec().text;
  out.projections = rig.rig().projections();
  out.bytes = bytes_;
  out.condition = condition_;
  addTimes(out);
  addFrames(out, context);
  out.lights = lights_.uses({context.lights, context.frames, context.meanIrradiance, asked_, budget_});
  if (context.meanIrradiance <= 0) return out;
  out.parts = parts_.report(context.meanIrradiance);
  out.histogram = spread_.histogram(context.meanIrradiance);
  if (context.bodyParts != nullptr) out.bodyParts = spread_.bodyParts(*context.bodyParts, context.meanIrradiance);
  return out;
}

}  // namespace rigel::tools
