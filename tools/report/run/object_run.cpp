#include "report/run/object_run.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rigel::tools {
namespace {

double square(double x) { return x * x; }

/// The wrap of most of the surface: what bounds and estimates are made for where materials differ.
double meanGranted(const RigReport& rig) {
  double sum = 0;
  for (const FrameReport& frame : rig.frames) sum += frame.granted.value_or(0);
  return sum / static_cast<double>(rig.frames.size());
}

BudgetUse budgetUse(const RigReport& rig, int points) {
  return {rig.modelledNanoseconds * points / 1000, meanGranted(rig), {}};
}

BudgetUse::Alone figuresAlone(const RigReport& rig, int points) {
  const BudgetUse use = budgetUse(rig, points);
  return {use.microseconds, use.granted, rig.spatial.rms, rig.total.rms, rig.shVectors, rig.nearLights};
}

}  // namespace

Result<ObjectRun> ObjectRun::create(const SceneObject& object, const PosedObject& rest, const RunOptions& options,
                                    const Setting& setting) {
  ObjectRun run(object);
  run.setting_ = setting;
  run.bands_ = options.bands;
  run.rate_ = options.rate;
  run.budget_ = options.budget;
  auto surface = chooseSurface(object, rest, options.samples, options.wrap);
  if (!surface) return surface.error();
  run.surface_ = *std::move(surface);
  for (const RigSpec& spec : options.rigs) {
    auto rig = run.makeRig(spec, rest, options);
    if (!rig) return rig.error();
    if (rig->shares && setting.shares) {
      auto alone = run.makeRig(spec, rest, options);
      if (!alone) return alone.error();
      rig->alone = std::make_unique<MeasuredRig>(*std::move(alone));
    }
    run.rigs_.push_back(*std::move(rig));
  }
  run.shaded_.resize(run.surface_.measured.size());
  return run;
}

Result<ObjectRun::MeasuredRig> ObjectRun::makeRig(const RigSpec& spec, const PosedObject& rest,
                                                  const RunOptions& options) const {
  LightingOptions asked = lightingOptions(spec, options);
  asked.wrap = commonWrap(surface_.wrap);
  auto runner = makeRigRunner(spec, asked, options.bands, *object_, rest, surface_, true);
  if (!runner) return runner.error();
  if (options.shading) (*runner)->setShading(options.shading());
  const bool shares = options.budget && chooses(spec, options);
  const RigTally tally(asked, shares ? options.budget : std::nullopt);
  return MeasuredRig{*std::move(runner), tally, choiceOptions(spec, options), shares, nullptr};
}

void ObjectRun::survey(const LightSet& lights) { surveyed_.push_back(quickMean(*object_, posed_, surface_, lights)); }

void ObjectRun::setReference() {
  if (surveyed_.empty()) return;
  const double mean = std::accumulate(surveyed_.begin(), surveyed_.end(), 0.0) / static_cast<double>(surveyed_.size());
  for (const MeasuredRig& rig : rigs_) {
    rig.runner->setReference(static_cast<float>(mean));
    if (rig.alone) rig.alone->runner->setReference(static_cast<float>(mean));
  }
}

void ObjectRun::measure(const RunFrame& frame, const LightSet& lights) {
  if (frames_.empty()) setReference();
  truth_.update(*object_, posed_, surface_, lights, bands_);
  farBegun_ = exactBegun_ = false;
  followsOn_ = frame.followsOn && !frames_.empty();
  FrameTruth& truth = frames_.emplace_back(FrameTruth{truth_.mean, {}});
  numbers_.push_back(frame.number);
  times_.push_back(frame.time);
  if (followsOn_) {
    double squares = 0;
    for (std::size_t i = 0; i < previousExact_.size(); ++i)
      for (int c = 0; c < 3; ++c) squares += square(truth_.exact[i][c] - previousExact_[i][c]);
    truth.movementSquares = squares;
  }
  previousExact_ = truth_.exact;
  for (MeasuredRig& rig : rigs_) {
    if (!followsOn_) rig.runner->reset();
    if (!rig.shares) lightByItself(rig, lights);
  }
}

void ObjectRun::lightByItself(MeasuredRig& rig, const LightSet& lights) {
  RigRunner* runner = rig.runner.get();
  BudgetShare share;
  const auto light = [&](float seconds) {
    runner->pose(*object_, posed_);
    if (rig.shares)
      lightWithin(*budget_, {&runner, 1}, lights, seconds, {&share, 1});
    else
      runner->light(lights, seconds);
  };
  light(secondsAFrame());
  compare(rig, lights, rig.shares ? std::optional(share.granted) : std::nullopt);
  for (int i = 0; i < setting_.timings; ++i) {
    light(kNoTime);
    time(rig);
  }
}

void ObjectRun::compareShared(std::size_t i, const LightSet& lights, float granted) {
  compare(rigs_[i], lights, granted);
  if (!rigs_[i].alone) return;
  MeasuredRig& alone = *rigs_[i].alone;
  if (!followsOn_) alone.runner->reset();
  lightByItself(alone, lights);
}

void ObjectRun::compare(MeasuredRig& rig, const LightSet& lights, std::optional<float> granted) {
  rig.runner->shade(truth_.points, surface_.wrap, shaded_);
  const std::span<const Rgb> farSh = shOfFarShares(*rig.runner, lights);
  rig.tally.addFrame(*rig.runner, rig.runner->promises(lights), shaded_, truth_, farSh, surface_.wrap, followsOn_);
  splitError(rig, lights, farSh);
  if (granted) rig.tally.grant(*granted);
  half_.resize(shaded_.size());
  if (rig.runner->shadeHalf(truth_.points, surface_.wrap, half_)) rig.tally.addHalf(shaded_, half_);
}

void ObjectRun::splitError(MeasuredRig& rig, const LightSet& lights, std::span<const Rgb> farSh) {
  if (!exactBegun_) exactShares_.begin(truth_, surface_, lights, bands_);
  exactBegun_ = true;
  const RigRunner& runner = *rig.runner;
  exactShares_.near(runner.verdicts(), nearExact_);
  exactShares_.farBands(runner.verdicts(), farBands_);
  doubleRig_.resize(shaded_.size());
  runner.shadeInDouble(lights, truth_.points, surface_.wrap, doubleRig_);
  highBand_.resize(runner.hasHighBand() ? shaded_.size() : 0);
  for (std::size_t i = 0; i < highBand_.size(); ++i)
    highBand_[i] = runner.highBand(truth_.points[i].normal, surface_.wrap[i]);
  rig.tally.addSteps({truth_.exact, nearExact_, farBands_, farSh, doubleRig_, highBand_, shaded_});
}

void ObjectRun::time(MeasuredRig& rig) {
  const double shade = rig.runner->shade(truth_.points, surface_.wrap, shaded_);
  rig.tally.addTiming(rig.runner->times(), shade);
}

std::span<const Rgb> ObjectRun::shOfFarShares(const RigRunner& rig, const LightSet& lights) {
  if (std::ranges::all_of(rig.verdicts(), [](const LightVerdict& v) { return v.weight == 0; })) return truth_.sh;
  if (!farBegun_) far_.begin(truth_, surface_, lights, bands_);
  farBegun_ = true;
  far_.irradiance(rig.verdicts(), farSh_);
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
    for (const MeasuredRig& rig : rigs_) sum += rig.tally.totalError(f);
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
  for (const MeasuredRig& rig : rigs_) {
    RigReport& shown = out.rigs.emplace_back(report(rig, lights));
    if (!rig.shares) continue;
    shown.budget = budgetUse(shown, rig.runner->asked().points);
    if (rig.alone) shown.budget->alone = figuresAlone(report(*rig.alone, lights), rig.runner->asked().points);
  }
  return out;
}

RigReport ObjectRun::report(const MeasuredRig& rig, std::span<const LightRow> lights) const {
  RigReport out =
      rig.tally.report(*rig.runner, {times_, numbers_, lights, meanIrradiance(), bodyParts_ ? &*bodyParts_ : nullptr});
  out.asked = rig.asked;
  return out;
}

void ObjectRun::relight(std::size_t i, std::size_t frame, const PosedObject& posed, const LightSet& lights) const {
  const MeasuredRig& rig = rigs_[i];
  rig.runner->reset();
  rig.runner->pose(*object_, posed);
  if (const auto granted = rig.tally.granted(frame)) {
    rig.runner->weigh(lights, 0);
    rig.runner->settle(lights, *granted, 0);
  } else {
    rig.runner->light(lights, 0);
  }
}

}  // namespace rigel::tools
