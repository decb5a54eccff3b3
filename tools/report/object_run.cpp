#include "report/object_run.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace rigel::tools {
namespace {

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// `of` is a member of FitTimes, or a function of it.
template <class Of>
double medianOf(const std::vector<FitTimes>& times, Of of) {
  std::vector<double> values;
  for (const FitTimes& t : times) values.push_back(std::invoke(of, t));
  return median(std::move(values));
}

double square(double x) { return x * x; }

}  // namespace

Result<ObjectRun> ObjectRun::create(const SceneObject& object, const PosedObject& rest, const RunOptions& options,
                                    int timings) {
  ObjectRun run(object);
  run.bands_ = options.bands;
  run.timings_ = timings;
  auto surface = chooseSurface(object, rest, options.samples, options.wrap);
  if (!surface) return surface.error();
  run.surface_ = *std::move(surface);
  for (const RigSpec& spec : options.rigs) {
    auto runner = makeRigRunner(spec, options.bands, object, rest, run.surface_);
    if (!runner) return runner.error();
    run.runners_.push_back(*std::move(runner));
  }
  run.tallies_.resize(options.rigs.size());
  run.shaded_.resize(run.surface_.measured.size());
  return run;
}

void ObjectRun::measure(double time, bool followsOn, const PosedObject& posed, const LightSet& lights) {
  truth_.update(*object_, posed, surface_, lights, bands_);
  followsOn = followsOn && !frames_.empty();
  FrameTruth frame{time, truth_.mean, {}};
  if (followsOn) {
    double squares = 0;
    for (std::size_t i = 0; i < previousExact_.size(); ++i)
      for (int c = 0; c < 3; ++c) squares += square(truth_.exact[i][c] - previousExact_[i][c]);
    frame.movementSquares = squares;
  }
  previousExact_ = truth_.exact;
  frames_.push_back(frame);

  for (std::size_t r = 0; r < runners_.size(); ++r) {
    for (int i = 0; i < timings_; ++i) {
      tallies_[r].fitTimes.push_back(runners_[r]->fit(*object_, posed, lights));
      tallies_[r].shadeTimes.push_back(runners_[r]->shade(truth_.points, surface_.wrap, shaded_));
    }
    compare(tallies_[r], shaded_, followsOn);
    tallies_[r].condition = std::max(tallies_[r].condition, runners_[r]->rig().condition());
  }
}

void ObjectRun::compare(Tally& tally, std::span<const Rgb> shaded, bool followsOn) const {
  std::swap(tally.error, tally.previousError);
  tally.error.resize(shaded.size());
  double spatial = 0;
  double total = 0;
  double jump = 0;
  for (std::size_t i = 0; i < shaded.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double spatialError = static_cast<double>(shaded[i][c]) - static_cast<double>(truth_.sh[i][c]);
      const double totalError = std::max(0.0, static_cast<double>(shaded[i][c])) - truth_.exact[i][c];
      spatial += square(spatialError);
      total += square(totalError);
      tally.spatialMax = std::max(tally.spatialMax, std::abs(spatialError));
      tally.totalMax = std::max(tally.totalMax, std::abs(totalError));
      tally.error[i][c] = static_cast<float>(totalError);
      if (followsOn)
        jump = std::max(jump, static_cast<double>(std::abs(tally.error[i][c] - tally.previousError[i][c])));
    }
  }
  if (followsOn) tally.maxJump = std::max(tally.maxJump.value_or(0), jump);
  tally.spatialSquares.push_back(spatial);
  tally.totalSquares.push_back(total);
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
    for (const Tally& tally : tallies_) sum += std::sqrt(tally.totalSquares[f]);
    if (sum > worstSum) {
      worstSum = sum;
      worst = f;
    }
  }
  return worst;
}

RigReport ObjectRun::rigReport(std::size_t r, double mean) const {
  const Tally& tally = tallies_[r];
  const Rig& rig = runners_[r]->rig();
  const double scale = mean > 0 ? 1 / mean : 0;
  const double channels = 3 * static_cast<double>(surface_.measured.size());
  const auto pooled = [&](const std::vector<double>& squares) {
    return scale * std::sqrt(std::accumulate(squares.begin(), squares.end(), 0.0) /
                             (channels * static_cast<double>(std::max<std::size_t>(1, squares.size()))));
  };

  RigReport out;
  out.spec = rig.spec().text;
  out.shVectors = rig.shVectors();
  out.projections = rig.projections();
  out.spatial = {pooled(tally.spatialSquares), scale * tally.spatialMax};
  out.total = {pooled(tally.totalSquares), scale * tally.totalMax};
  out.bytes = runners_[r]->bytes();
  if (tally.maxJump) out.maxJump = scale * *tally.maxJump;
  out.condition = tally.condition;
  const double shade = median(tally.shadeTimes);
  out.stages = {{"refresh", medianOf(tally.fitTimes, &FitTimes::refresh)},
                {"project", medianOf(tally.fitTimes, &FitTimes::project)},
                {"fit", medianOf(tally.fitTimes, &FitTimes::fit)},
                {"shade", shade}};
  out.fitMicroseconds = medianOf(tally.fitTimes, &FitTimes::sum);
  out.shadeNanosecondsPerPoint = 1000 * shade / static_cast<double>(surface_.measured.size());
  for (std::size_t f = 0; f < frames_.size(); ++f) {
    RigFrame& frame = out.frames.emplace_back();
    frame.time = frames_[f].time;
    frame.spatialRms = scale * std::sqrt(tally.spatialSquares[f] / channels);
    frame.totalRms = scale * std::sqrt(tally.totalSquares[f] / channels);
    frame.shVectors = rig.shVectors();
  }
  return out;
}

ObjectReport ObjectRun::report() const {
  ObjectReport out;
  out.name = object_->name;
  out.triangles = static_cast<int>(object_->triangles.size());
  out.samples = static_cast<int>(surface_.measured.size());
  out.meanIrradiance = meanIrradiance();
  const double scale = out.meanIrradiance > 0 ? 1 / out.meanIrradiance : 0;
  const double channels = 3 * static_cast<double>(surface_.measured.size());
  for (const FrameTruth& frame : frames_) {
    TruthFrame& truth = out.truth.emplace_back(TruthFrame{frame.time, frame.mean, {}});
    if (frame.movementSquares) truth.movement = scale * std::sqrt(*frame.movementSquares / channels);
  }
  for (std::size_t r = 0; r < runners_.size(); ++r) out.rigs.push_back(rigReport(r, out.meanIrradiance));
  return out;
}

}  // namespace rigel::tools
