// The frame's work of ObjectLighting: bounds, the choice of near lights and coefficients, the fit, the estimates.
#pragma once

#include <rigel/light_bound.h>
#include <rigel/object_lighting.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "approach.h"
#include "face_contact.h"
#include "surface_check.h"
#include "weights.h"

namespace rigel {
namespace lighting {

inline constexpr int kCandidates = 40;  // lights that are looked at one by one; the others stay in the rig
// Targets are aimed at with these margins; tools/study measures how often they are met.
inline constexpr float kSpatialMargin = 1.55f;
// Of rigs that are not `auto`, which are checked at few points: disks beside them leave up to 1.5 times the estimate.
inline constexpr float kFixedMargin = 1.8f;
inline constexpr float kTotalMargin = 1.1f, kTotalSpatialMargin = 1.4f;
// Two dozen points miss part of an error that is largest in small places; measured over the inputs of tools/study.
inline constexpr float kFewPoints = 1.35f;

/// A light that is not a number contributes nothing.
inline float orNothing(float x) noexcept { return x > 0 ? std::min(x, std::numeric_limits<float>::max()) : 0.0f; }

/// What a light is ranked by where lights compete for slots: one that the object touches comes first.
inline float urgency(float size, float contact) noexcept {
  return contact < 1 ? orNothing(size / (1 - contact)) : std::numeric_limits<float>::max();
}

/// Projecting the high bands is left out where nobody asks for what is in them.
inline bool measuresTotal(const LightingOptions& options) noexcept {
  return options.estimate || options.target.kind == LightingTarget::Kind::totalError ||
         options.target.kind == LightingTarget::Kind::budget;
}

inline void finish(LightingProbe probe, LightingStage stage) {
  if (probe.done != nullptr) probe.done(probe.context, stage);
}

}  // namespace lighting

template <int B>
struct ObjectLighting<B>::State {
  State(Rig r, const RigShape& rest, const LightingOptions& o)
      : options(o), rig(std::move(r)), check(rig, rest, options.wrap, lighting::measuresTotal(options)) {
    anchors.assign(rig.anchors().begin(), rig.anchors().end());
    measured = chooses() || options.estimate;
    if (measured) anchors.insert(anchors.end(), check.extraAnchors().begin(), check.extraAnchors().end());
    slots = options.slots();
    nearFar.options().slots = slots;
    // With slots to spare a light may take its time to leave: the rig has it before it is gone.
    if (hasSlotsToSpare()) nearFar.options().fallShare = kFallShare;
    if (chooses()) nearFar.options().approachRate = kApproachRate;
    if (options.wrap != 0) options.cost.nearLight = options.cost.nearWrap;
    functionals.resize(rig.projections());
    coefficients.resize(rig.shVectors());
    coefficientWeights.resize(check.rows.nested);
    lastCoefficients.resize(check.rows.nested);
    std::vector<Vec3> posed;
    for (int i : anchors) posed.push_back(rest.surface[i]);
    setPose({rest.box, posed}, {});
  }

  bool chooses() const noexcept { return options.target.kind != LightingTarget::Kind::none; }
  /// As many slots as there are: no light has to leave one before another can enter.
  bool hasSlotsToSpare() const noexcept { return chooses() && slots == kMaxNearLights; }
  bool adaptive() const noexcept { return check.nested().has_value(); }

  void setPose(const RigPose& pose, const RigFrame& worldFromRig) noexcept {
    frame = worldFromRig;
    // What moves as a whole keeps all that its pose alone decides.
    const bool same = pose.box.lo == box.lo && pose.box.hi == box.hi && std::ranges::equal(pose.anchors, posedAnchors);
    if (!(poseKnown && same)) {
      box = pose.box;
      posedAnchors.assign(pose.anchors.begin(), pose.anchors.end());
      rig.setPose({pose.box, pose.anchors.first(rig.anchors().size())});
      if (measured) check.setPose(rig, pose.anchors);
      bounds.reset();
    }
    poseKnown = !rig.spec().falloff;  // which depends on the light as well
    if (measured) check.place(pose.anchors, worldFromRig);
  }

  const LightBounds& boundsInFrame() noexcept {
    if (!bounds || rig.spec().falloff || boundsWrap != options.wrap) {
      boundsWrap = options.wrap;
      bounds.emplace(rig, frame, boundsWrap);
    }
    bounds->place(frame);
    return *bounds;
  }

  void boundLights(const LightSet& lights, float seconds, std::span<const std::uint32_t> ids) {
    const LightBounds& boundOf = boundsInFrame();
    const int count = lights.size();
    errors.resize(count);
    peaks.resize(count);
    contacts.resize(count);
    urgent.resize(count);
    culled.resize(count);
    verdicts.resize(count);
    if (hasSlotsToSpare()) faces.begin(seconds, lights.size());
    for (int i = 0; i < count; ++i) {
      const auto id = ids.empty() ? static_cast<std::uint32_t>(i) : ids[i];
      lights.visit(i, [&](const auto& light) {
        const LightBound bound = boundOf(light);
        const float size = magnitude(colourOf(light));
        errors[i] = lighting::orNothing(bound.error * size);
        peaks[i] = lighting::orNothing(bound.peak * size);
        culled[i] = peaks[i] > 0 ? 0 : 1;
        // Where slots are few, a light must be expected earlier: another has to leave its slot first.
        const float contact = hasSlotsToSpare() ? faces.share(id, bound.gap) : FaceContact::shareAtAnySpeed(bound.gap);
        contacts[i] = size > 0 ? contact : 0;
        const float leap = static_cast<float>(kPi) * contacts[i] * size;
        urgent[i] = lighting::urgency(std::max(errors[i], leap), contacts[i]);
      });
    }
  }

  /// All of these lights into the rig's functionals.
  void project(const LightSet& lights) {
    prepared.set(lights);
    projectSamples<B>(rig, frame, prepared, prepared.all(), functionals);
  }

  void fitFar(const LightSet& far, LightingProbe probe) {
    project(far);
    lighting::finish(probe, LightingStage::project);
    adaptRig<B>(rig, functionals);
    fitRig<B>(rig, functionals, coefficients);
    active = rig.shVectors();
  }

  // A fixed rig and a fixed number of near lights.

  void lightFixed(const LightSet& lights, float seconds, std::span<const std::uint32_t> ids, LightingProbe probe) {
    near.clear();
    const LightSet* far = &lights;
    if (slots > 0 || options.estimate) {
      boundLights(lights, seconds, ids);
      lighting::finish(probe, LightingStage::bound);
    }
    if (slots > 0) {
      makeRoom(lights.size());
      nearFar.update(urgent, ids, seconds);
      splitLights(lights, nearFar.weights(), farLights, near, culled);
      far = &farLights;
      lighting::finish(probe, LightingStage::choose);
    }
    fitFar(*far, probe);
    lighting::finish(probe, LightingStage::fit);
    frameMean = 0;
    means.assign(lights.size(), 0);
    if (options.estimate && measured) {
      estimateFixed(lights, *far);
      lighting::finish(probe, LightingStage::estimate);
    }
    if (slots > 0 || options.estimate) judge();
    nanoseconds = TradeOff::nanoseconds(options.cost, static_cast<float>(active), static_cast<float>(near.size()), 0);
  }

  void estimateFixed(const LightSet& lights, const LightSet& far) {
    check.rows.resize(0);
    check.describe(far, rig, 0);
    tradeOff.farError(check.rows, check.damping(), {}, farError);
    for (int i = 0; i < lights.size(); ++i) {
      means[i] = lights.visit(i, [&](const auto& light) { return check.meanIrradiance(light); });
      frameMean += means[i];
    }
    const float spatial = farError.beyond.back();  // all coefficients are in use
    estimate(adaptive() ? spatial : lighting::kFewPoints * spatial, farError.truncation);
  }

  void estimate(float spatialSquare, float truncationSquare) {
    const auto relative = [&](float square) { return reference() > 0 ? std::sqrt(square) / reference() : 0.0f; };
    spatialEstimate = relative(spatialSquare);
    if (check.rows.truncated > 0) totalEstimate = relative(spatialSquare + truncationSquare);
  }

  float reference() const noexcept { return options.reference > 0 ? options.reference : frameMean; }

  void judge() {
    const auto weights = nearFar.weights();
    for (std::size_t i = 0; i < verdicts.size(); ++i) {
      const float weight = weights.empty() || culled[i] != 0 ? 0 : weights[i];
      const LightRole role = culled[i] != 0 ? LightRole::culled
                             : weight <= 0  ? LightRole::inRig
                             : weight < 1   ? LightRole::blended
                                            : LightRole::exact;
      verdicts[i] = {role, weight, errors[i], frameMean > 0 ? means[i] / frameMean : 0};
    }
  }

  // A choice of near lights, and of the SH vectors of an `auto` rig.

  /// The lights most worth looking at one by one, by bound and truncation; `fade` falls to 0 where a light is about to
  /// make room for another.
  void chooseCandidates() {
    const int count = static_cast<int>(errors.size());
    const bool total = options.target.kind != LightingTarget::Kind::spatialError;
    ranks.resize(count);
    candidates.clear();
    for (int i = 0; i < count; ++i) {
      ranks[i] = urgent[i] + (total ? kTruncatedShare * peaks[i] : 0);
      if (culled[i] == 0) candidates.push_back(i);
    }
    float next = 0;
    if (candidates.size() > lighting::kCandidates) {
      std::ranges::nth_element(candidates, candidates.begin() + lighting::kCandidates,
                               [&](int a, int b) { return ranks[a] > ranks[b]; });
      next = ranks[candidates[lighting::kCandidates]];
      candidates.resize(lighting::kCandidates);
    }
    check.rows.resize(static_cast<int>(candidates.size()));
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      check.rows.fade[i] = next > 0 ? smoothstep(4 * (ranks[candidates[i]] / next - 1)) : 1;
      check.rows.contact[i] = contacts[candidates[i]];
    }
  }

  void describeLights(const LightSet& lights) {
    if (rig.spec().falloff) {  // what one light adds is judged under the falloff of all
      project(lights);
      adaptRig<B>(rig, functionals);
    }
    means.assign(lights.size(), 0);
    individually.assign(lights.size(), 0);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      individually[candidates[i]] = 1;
      some.clear();
      lights.visit(candidates[i], [&](const auto& light) { some.add(light); });
      means[candidates[i]] = check.describe(some, rig, static_cast<int>(i));
    }
    some.clear();
    for (int i = 0; i < lights.size(); ++i)
      if (individually[i] == 0 && culled[i] == 0) lights.visit(i, [&](const auto& light) { some.add(light); });
    const float rest = check.describe(some, rig, check.rows.lights);
    for (int i = 0; i < lights.size() && some.size() > 0; ++i)  // nobody looks at one of many small lights
      if (individually[i] == 0 && culled[i] == 0) means[i] = rest / static_cast<float>(some.size());
    frameMean = 0;
    for (float m : means) frameMean += m;
  }

  /// Which lights are culled, looked at one by one or near changes from frame to frame; no more than all are.
  void makeRoom(int count) {
    if (count <= room) return;
    room = count;
    const int most = std::min(count, lighting::kCandidates);
    check.rows.reserve(most);
    tradeOff.reserve(check.rows, most);
    candidates.reserve(count);
    candidateWeights.reserve(most);
    choice.weights.reserve(most);
    costing.weights.reserve(most);
    farLights.reserve(count);
    prepared.reserve(count);
    some.reserve(count);
    check.reserve(count);
    near.reserve(std::min(count, slots));
  }

  void weigh(const LightSet& lights, float seconds, std::span<const std::uint32_t> ids, LightingProbe probe) {
    makeRoom(lights.size());
    boundLights(lights, seconds, ids);
    lighting::finish(probe, LightingStage::bound);
    chooseCandidates();
    describeLights(lights);
    lighting::finish(probe, LightingStage::project);
    tradeOff.build(check.rows, check.damping(), slots, options.target.kind != LightingTarget::Kind::spatialError);
  }

  TradeOff::Request request(float target) const noexcept {
    TradeOff::Request r;
    r.kind = options.target.kind;
    r.vectors = adaptive() ? 0 : rig.shVectors();
    r.highBand = r.kind != LightingTarget::Kind::spatialError && check.rows.highCount > 0;
    r.held = lastPick;
    r.cost = options.cost;
    const bool total = r.kind == LightingTarget::Kind::totalError;
    r.spatialMargin = !adaptive() ? lighting::kFixedMargin
                      : total     ? lighting::kTotalSpatialMargin
                                  : lighting::kSpatialMargin;
    r.value = r.kind == LightingTarget::Kind::budget ? 1000 * target / static_cast<float>(std::max(1, options.points))
                                                     : target * reference() / (total ? lighting::kTotalMargin : 1);
    return r;
  }

  void settle(const LightSet& lights, float target, float seconds, std::span<const std::uint32_t> ids,
              LightingProbe probe) {
    const bool cut = fresh || !(seconds > 0 && std::isfinite(seconds));
    fresh = false;
    if (cut) lastPick.reset();
    const TradeOff::Request wanted = request(cut ? lastTarget = target : limitedTarget(target, seconds));
    tradeOff.choose(wanted, choice);
    lastPick = choice.pick;
    lightWeights.assign(lights.size(), 0);
    for (std::size_t i = 0; i < candidates.size(); ++i) lightWeights[candidates[i]] = choice.weights[i];
    for (std::size_t i = 0; i < lightWeights.size(); ++i) {
      lightWeights[i] = std::max(lightWeights[i], contacts[i]);
      urgent[i] = std::max(urgent[i], peaks[i]);
    }
    // No light leaves before the rig can take it.
    if (adaptive() && hasSlotsToSpare())
      nearFar.options().fallShare = kFallShare * tradeOff.readiness(choice, lastCoefficients);
    nearFar.follow(lightWeights, ids, seconds, urgent);
    candidateWeights.resize(candidates.size());
    for (std::size_t i = 0; i < candidates.size(); ++i) candidateWeights[i] = nearFar.weights()[candidates[i]];
    splitLights(lights, nearFar.weights(), farLights, near, culled);
    tradeOff.farError(check.rows, check.damping(), candidateWeights, farError);
    const float step = nearFar.options().weightRate * seconds;
    const float highBand = cut ? choice.highBand : moved(lastHighBand, choice.highBand, step, step, seconds);
    lastHighBand = highBand;
    // A band at weight w leaves (1-w)^2 of its energy.
    const float removed = highBand * (2 - highBand);
    const float truncation = std::lerp(farError.truncation, farError.truncationHigh, removed);
    if (wanted.kind == LightingTarget::Kind::totalError)
      choice.spatialError = TradeOff::spatialRoom(wanted, truncation);
    lighting::finish(probe, LightingStage::choose);

    if (adaptive()) {
      tradeOff.coefficientWeights(farError, choice, coefficientWeights);
      active = limitCoefficients(cut, seconds);
      check.nested()->synthesise(farError.field.data(), check.rows.width, 3 * shCount(B),
                                 std::span(coefficientWeights).first(active), coefficients[0].data());
    } else {
      fitFar(farLights, {});
    }
    check.highBand(farError.truncated, highBand, high);
    lighting::finish(probe, LightingStage::fit);
    const float spatial = TradeOff::spatialSquare(check.rows, farError, check.damping(), coefficientWeights);
    estimate(adaptive() ? spatial : lighting::kFewPoints * spatial, truncation);
    judge();
    nanoseconds = TradeOff::nanoseconds(options.cost, static_cast<float>(active), static_cast<float>(near.size()),
                                        high.band > 0 ? 1.0f : 0.0f);
  }

  /// A target moves by no more than kTargetRate e-folds a second: whoever spreads a budget over objects may find that
  /// granting two of them any error between two values costs the same.
  float limitedTarget(float target, float seconds) noexcept {
    if (target > 0 && lastTarget > 0) {
      const float step = std::exp(kTargetRate * seconds);
      target = std::clamp(target, lastTarget / step, lastTarget * step);
    }
    return lastTarget = target;
  }

  /// From one weight towards another, by no more than `fall` or `rise`.
  static float moved(float from, float to, float fall, float rise, float seconds) noexcept {
    return from + std::clamp(approach(to - from, kApproachRate, seconds), -fall, rise);
  }

  /// The cheapest choice may change from one frame to the next, and with it what is left for the rig to hold: weights
  /// of coefficients are limited as those of lights are, but rise faster, for what is not held is wrong. Returns how
  /// many are not 0.
  int limitCoefficients(bool cut, float seconds) noexcept {
    const float fall = nearFar.options().weightRate * seconds, rise = kRiseRate * seconds;
    int used = 0;
    for (std::size_t j = 0; j < coefficientWeights.size(); ++j) {
      float& weight = coefficientWeights[j];
      if (!cut) weight = moved(lastCoefficients[j], weight, fall, rise, seconds);
      lastCoefficients[j] = weight;
      if (weight > 0) used = static_cast<int>(j) + 1;
    }
    return used;
  }

  static constexpr float kFallShare = 0.25f;
  static constexpr float kRiseRate = 60;          // 1/s
  static constexpr float kApproachRate = 60;      // 1/s; nothing is held back at up to 60 frames a second
  static constexpr float kTargetRate = 4;         // 1/s
  static constexpr float kTruncatedShare = 0.1f;  // of a light's peak that three bands miss

  LightingOptions options;
  Rig rig;
  SurfaceCheck<B> check;
  bool measured = false;  // errors are, at the check's own anchors
  RigFrame frame;
  bool poseKnown = false;  // box and anchors are those of rig and check
  RigBox box;
  std::vector<Vec3> posedAnchors;
  std::optional<LightBounds> bounds;
  float boundsWrap = 0;
  FaceContact faces;
  NearFar nearFar;
  TradeOff tradeOff;
  TradeOff::Choice choice;
  mutable TradeOff::Choice costing;  // of costAt
  std::vector<int> anchors;
  int slots = 0;

  // Per light.
  std::vector<float> errors, peaks, contacts, urgent, means, ranks, lightWeights;
  std::vector<std::uint8_t> culled, individually;
  std::vector<LightVerdict> verdicts;
  std::vector<int> candidates;
  std::vector<float> candidateWeights;

  LightSet some, farLights;
  PreparedLights prepared;
  FarError farError;
  std::vector<float> coefficientWeights;
  std::vector<RadianceSH<B>> functionals, coefficients;
  int active = 0;  // of coefficients
  int room = 0;    // lights there is room for
  std::vector<NearLight> near;
  HighBand high;
  float frameMean = 0;  // [W/m2] irradiance on the object, of all lights
  float nanoseconds = 0;
  bool fresh = true;  // nothing to be continuous with
  float lastTarget = 0, lastHighBand = 0;
  std::optional<TradeOff::Pick> lastPick;
  std::vector<float> lastCoefficients;
  std::optional<float> spatialEstimate, totalEstimate;
};

}  // namespace rigel
