#include "pareto/object_pareto.h"

#include "parallel/parallel.h"
#include "pareto/near_forms.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>

namespace rigel::tools {
namespace {

constexpr std::size_t kTimedStep = 4;  // every fourth sample: enough points that starting counts for nothing
constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr float kCut = 0;  // seconds since the last frame: none that counts

double meanOf(const std::vector<double>& values) {
  return values.empty() ? 0 : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double microsecondsOf(const auto& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
}

double squareSum(const std::vector<FrameErrors>& frames, double FrameErrors::*of) {
  double sum = 0;
  for (const FrameErrors& frame : frames) sum += frame.*of;
  return sum;
}

/// Standard error of the RMS over frames, relative to it: frames are spread evenly over the motion, so that what lies
/// between two of them is about as far from their mean as they are from each other.
double uncertaintyOf(const std::vector<FrameErrors>& frames) {
  const double count = static_cast<double>(frames.size());
  const double sum = squareSum(frames, &FrameErrors::totalSquares);
  if (frames.size() < 2 || !(sum > 0)) return 0;
  double differences = 0;
  for (std::size_t f = 1; f < frames.size(); ++f) {
    const double step = frames[f].totalSquares - frames[f - 1].totalSquares;
    differences += step * step;
  }
  const double variance = differences / (2 * (count - 1)) / count;  // of the mean square
  return 0.5 * std::sqrt(variance) / (sum / count);
}

}  // namespace

Result<ObjectPareto> ObjectPareto::create(const SceneObject& object, const PosedObject& rest, const RunOptions& run,
                                          const std::vector<RigFamilyMember>& members,
                                          const std::function<void(double)>& step) {
  ObjectPareto out(object);
  auto surface = chooseSurface(object, rest, run.samples, run.wrap);
  if (!surface) return surface.error();
  out.surface_ = *std::move(surface);
  out.wraps_ = std::ranges::any_of(out.surface_.wrap, [](float wrap) { return wrap != 0; });
  out.lit_.resize(members.size());
  std::vector<std::optional<Error>> failed(members.size());
  const auto build = [&](std::size_t m) {
    const RigFamilyMember& member = members[m];
    Lit& lit = out.lit_[m];
    lit.what = member;
    for (const NearSetting& near : member.near) {
      LightingOptions asked = lightingOptions(member.spec, runOptionsFor(member.spec, near, member.bands));
      asked.wrap = commonWrap(out.surface_.wrap);
      asked.estimate = false;
      auto runner = makeRigRunner(member.spec, asked, member.bands, object, rest, out.surface_);
      if (runner)
        lit.runners.push_back(*std::move(runner));
      else
        failed[m] = runner.error();
    }
  };
  constexpr std::size_t kAtOnce = 16;
  for (std::size_t first = 0; first < members.size(); first += kAtOnce) {
    step(static_cast<double>(first) / static_cast<double>(members.size()));
    const std::size_t count = std::min(kAtOnce, members.size() - first);
    parallelFor(static_cast<int>(count), [&](int k) { build(first + static_cast<std::size_t>(k)); });
  }
  for (const auto& error : failed)
    if (error) return *error;
  for (std::size_t m = 0; m < members.size(); ++m) out.addEntries(m);
  return out;
}

void ObjectPareto::addEntries(std::size_t m) {
  firstEntry_.push_back(entries_.size());
  const RigFamilyMember& what = lit_[m].what;
  for (std::size_t s = 0; s < what.near.size(); ++s) {
    const auto add = [&](NearForm form, bool half) {
      Entry& entry = entries_.emplace_back();
      entry.lit = m;
      entry.setting = s;
      entry.form = form;
      entry.half = half;
    };
    add(NearForm::exact, false);
    const bool onGpu = !checkGpuRig(what.spec);
    if (onGpu && (what.nearForms || what.spec.adaptive)) add(NearForm::exact, true);
    if (!what.nearForms || what.near[s].near.automatic || what.near[s].near.slots == 0) continue;
    if (!wraps_) add(NearForm::cheap, false);
    if (what.bands == kDefaultBands) add(NearForm::corrector, false);
  }
}

void ObjectPareto::survey(const LightSet& lights) {
  surveyed_.push_back(quickMean(*object_, posed_, surface_, lights));
}

void ObjectPareto::lightOne(RigRunner& runner, const LightSet& lights) {
  runner.reset();
  runner.pose(*object_, posed_);
  runner.light(lights, kCut);
}

void ObjectPareto::light(const LightSet& lights) {
  for (const Lit& lit : lit_)
    for (const auto& runner : lit.runners) lightOne(*runner, lights);
}

void ObjectPareto::measure(const LightSet& lights) {
  if (means_.empty())
    for (const Lit& lit : lit_)
      for (const auto& runner : lit.runners) runner->setReference(static_cast<float>(meanOf(surveyed_)));
  truth_.update(*object_, posed_, surface_, lights, kDefaultBands);
  means_.push_back(truth_.mean);
  for (int bands = kMinBands; bands <= kMaxBands; ++bands) {
    const auto wanted = [&](const Lit& lit) { return lit.what.bands == bands; };
    if (std::ranges::any_of(lit_, wanted)) far_[static_cast<std::size_t>(bands)].begin(truth_, surface_, lights, bands);
  }
  parallelFor(static_cast<int>(lit_.size()), [&](int m) { measureMember(static_cast<std::size_t>(m), lights); });
}

void ObjectPareto::measureMember(std::size_t m, const LightSet& lights) {
  static thread_local Scratch scratch;
  const std::size_t count = truth_.points.size();
  const Lit& lit = lit_[m];
  FarTruth& far = far_[static_cast<std::size_t>(lit.what.bands)];
  scratch.shaded.resize(count);
  scratch.formed.resize(count);
  scratch.rounded.resize(count);
  std::size_t next = firstEntry_[m];
  const std::size_t last = m + 1 < lit_.size() ? firstEntry_[m + 1] : entries_.size();
  for (std::size_t s = 0; s < lit.runners.size(); ++s) {
    RigRunner& rig = *lit.runners[s];
    lightOne(rig, lights);
    rig.shade(truth_.points, surface_.wrap, scratch.shaded);
    if (s == 0) scratch.whole = scratch.shaded;
    for (; next < last && entries_[next].setting == s; ++next) {
      Entry& entry = entries_[next];
      const bool corrects = entry.form == NearForm::corrector;
      const RigRunner& judged = corrects ? *lit.runners.front() : rig;
      std::span<const RigRunner::Shaded> result = scratch.shaded;
      if (entry.half) {
        rig.shadeRounded(truth_.points, surface_.wrap, scratch.rounded);
        for (std::size_t i = 0; i < count; ++i) scratch.formed[i] = {scratch.rounded[i], scratch.shaded[i].near};
        result = scratch.formed;
      } else if (entry.form != NearForm::exact) {
        scratch.formed = corrects ? scratch.whole : scratch.shaded;
        addNearLights(entry.form, rig.nearLights(), truth_.points, surface_.wrap, scratch.formed);
        result = scratch.formed;
      }
      far.irradiance(judged.verdicts(), scratch.sh);
      entry.errors.push_back(frameErrors(judged, result, truth_, scratch.sh, surface_.wrap));
      entry.shVectors += rig.shVectors();
      entry.nearLights += static_cast<double>(rig.nearLights().size());
      entry.modelled += static_cast<double>(rig.modelledNanoseconds());
      entry.bytes = std::max(entry.bytes, judged.bytes() / (entry.half ? 2 : 1));
    }
  }
}

void ObjectPareto::time(std::size_t slot, const LightSet& lights) {
  timedPoints_.clear();
  timedWrap_.clear();
  for (std::size_t i = 0; i < surface_.measured.size(); i += kTimedStep) {
    timedPoints_.push_back(evaluateSurface(*object_, posed_, surface_.measured[i]));
    timedWrap_.push_back(surface_.wrap[i]);
  }
  timedShaded_.resize(timedPoints_.size());
  for (std::size_t m = 0; m < lit_.size(); ++m) timeMember(m, slot, lights);
}

void ObjectPareto::timeMember(std::size_t m, std::size_t slot, const LightSet& lights) {
  const Lit& lit = lit_[m];
  double wholeFit = 0, wholeShade = 0;  // of the rig that holds all light
  std::size_t next = firstEntry_[m];
  const std::size_t last = m + 1 < lit_.size() ? firstEntry_[m + 1] : entries_.size();
  for (std::size_t s = 0; s < lit.runners.size(); ++s) {
    RigRunner& rig = *lit.runners[s];
    lightOne(rig, lights);  // once more below, with its data in the caches for all rigs alike
    rig.pose(*object_, posed_);
    rig.light(lights, 1e-9f);
    const double fit = fitMicroseconds(rig.times(), rig.asked());
    const double shade = rig.shade(timedPoints_, timedWrap_, timedShaded_);
    if (s == 0) wholeFit = fit, wholeShade = shade;
    for (; next < last && entries_[next].setting == s; ++next) {
      Entry& entry = entries_[next];
      if (entry.fit.size() <= slot) {
        entry.fit.resize(slot + 1, kNever);
        entry.shade.resize(slot + 1, kNever);
      }
      double ownFit = fit, ownShade = shade;
      if (entry.form != NearForm::exact) {
        ownShade = wholeShade + microsecondsOf([&] {
                     addNearLights(entry.form, rig.nearLights(), timedPoints_, timedWrap_, timedShaded_);
                   });
      }
      if (entry.form == NearForm::corrector) {
        const auto& stages = rig.times().stages;
        ownFit = wholeFit + stages[FitTimes::kBound].value_or(0) + stages[FitTimes::kChoose].value_or(0);
      }
      entry.fit[slot] = std::min(entry.fit[slot], ownFit);
      entry.shade[slot] = std::min(entry.shade[slot], ownShade);
    }
  }
}

double ObjectPareto::meanIrradiance() const { return meanOf(means_); }

std::vector<ParetoPoint> ObjectPareto::report() const {
  std::vector<ParetoPoint> all;
  for (const Entry& entry : entries_) all.push_back(report(entry));
  return all;
}

ParetoPoint ObjectPareto::report(const Entry& entry) const {
  const RigFamilyMember& what = lit_[entry.lit].what;
  const NearSetting& near = what.near[entry.setting];
  const double frames = static_cast<double>(entry.errors.size());
  const double scale = meanIrradiance() > 0 ? 1 / meanIrradiance() : 0;
  const double count = frames * 3 * static_cast<double>(surface_.measured.size());
  ParetoPoint out;
  out.spec = what.spec.text;
  out.family = familyOf(what.spec);
  out.fit = fitOf(what.spec);
  out.arguments = argumentsOf(what.spec, near, what.bands);
  out.near = nearText(near);
  out.target = aimOptions(near.target, {});
  out.form = entry.form;
  out.bands = what.bands;
  out.half = entry.half;
  out.shVectors = entry.shVectors / frames;
  out.nearLights = entry.nearLights / frames;
  out.projections = runner(entry).rig().projections();
  out.bytes = entry.bytes;
  out.spatial.rms = scale * std::sqrt(squareSum(entry.errors, &FrameErrors::spatialSquares) / count);
  out.total.rms = scale * std::sqrt(squareSum(entry.errors, &FrameErrors::totalSquares) / count);
  for (const FrameErrors& frame : entry.errors) {
    out.spatial.max = std::max(out.spatial.max, scale * frame.spatialMax);
    out.total.max = std::max(out.total.max, scale * frame.totalMax);
  }
  out.frameUncertainty = uncertaintyOf(entry.errors);
  if (!entry.fit.empty()) out.fitMicroseconds = meanOf(entry.fit);
  if (!entry.half && !entry.shade.empty())  // a CPU reads floats
    out.shadeNanoseconds = 1000 * meanOf(entry.shade) / static_cast<double>(timedPoints_.size());
  // The cost model is of what shaders evaluate.
  if (!entry.half && entry.form == NearForm::exact && !checkGpuRig(what.spec))
    out.modelledNanoseconds = entry.modelled / frames;
  return out;
}

}  // namespace rigel::tools
