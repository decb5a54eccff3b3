#include <rigel/light_bound.h>
#include <rigel/object_lighting.h>

#include <algorithm>
#include <cmath>

#include "anchors.h"
#include "nested_fit.h"
#include "trade_off.h"

namespace rigel {
namespace {

constexpr int kCheckPoints = 24;         // where rigs without anchors are compared with the lights' own SH
constexpr int kTruncationEvery = 3;      // the high bands, which vary less, are projected at every third point
constexpr int kCandidates = 40;          // lights that are looked at one by one; the others stay in the rig
constexpr float kSpatialMargin = 1.55f;  // see rigs/README.md
constexpr float kTotalMargin = 1.1f, kTotalSpatialMargin = 1.4f;

// Square of the height over the patch radius that a light of no size is taken to pass a patch at, when it is close.
constexpr float kLeastHeight = 0.0025f;
// Two dozen points miss part of an error that is largest in small places; measured over tools/study's inputs.
constexpr float kFewPoints = 1.25f;

/// One figure for a colour: RMS over its channels, as errors are pooled.
float magnitude(Rgb c) noexcept { return std::sqrt((c.r * c.r + c.g * c.g + c.b * c.b) / 3); }
Rgb colourOf(const DirectionalLight& l) noexcept { return l.irradiance; }
Rgb colourOf(const PointLight& l) noexcept { return l.intensity; }
Rgb colourOf(const SpotLight& l) noexcept { return l.intensity; }
Rgb colourOf(const SphereLight& l) noexcept { return l.radiance; }

}  // namespace

template <int B>
struct ObjectLighting<B>::State {
  static constexpr int kWidth = 3 * shCount(B);
  static constexpr int kFirstTruncated = B < kMaxBands ? B : kMaxBands - 1;
  static constexpr int kTruncatedWidth = 3 * (shCount(kMaxBands) - shCount(kFirstTruncated));

  struct CheckPoint {
    Vec3 position;  // world
    float share = 0;
    float footprint = 0;
  };

  State(Rig r, const RigShape& rest, const LightingOptions& o) : options(o), rig(std::move(r)) {
    anchors.assign(rig.anchors().begin(), rig.anchors().end());
    rigAnchors = static_cast<int>(anchors.size());
    // A least-squares rig's residuals at its own points tell its error, given enough of them.
    ownChecks = rig.spec().adaptive || rigAnchors >= kCheckPoints;
    if (ownChecks) {
      for (const RigSample& sample : rig.samples()) checks.push_back({{}, sample.share, sample.footprint});
    } else {
      const Anchors chosen = chooseAnchors(rest.surface, kCheckPoints);
      anchors.insert(anchors.end(), chosen.index.begin(), chosen.index.end());
      for (std::size_t i = 0; i < chosen.index.size(); ++i) checks.push_back({{}, chosen.share[i], chosen.radius[i]});
    }
    for (const CheckPoint& check : checks) shares.push_back(check.share);
    if (rig.spec().adaptive) nested.emplace(static_cast<int>(checks.size()), rig.shVectors());
    functionals.resize(rig.projections());
    coefficients.resize(rig.shVectors());
    active = rig.shVectors();
    slots = chooses() && options.nearSlots == 0 ? kMaxNearLights : options.nearSlots;
    nearFar.options().slots = slots;
    if (options.wrap != 0) options.cost.nearLight = options.cost.nearWrap;
    setUpRows();
    std::vector<Vec3> posed;
    for (int i : anchors) posed.push_back(rest.surface[i]);
    setPose({rest.box, posed}, {});
  }

  bool chooses() const noexcept { return options.target.kind != LightingTarget::Kind::none; }

  void setUpRows() {
    const std::array<float, kMaxBands> f = wrapCoefficients<kMaxBands>(options.wrap);
    const auto squared = [&](int l) {
      const double factor = kPi * static_cast<double>(f[l]);
      return factor * factor / (4 * kPi) / 3;
    };
    rows.nested = nested ? nested->functions() : 0;
    rows.residuals = static_cast<int>(checks.size());
    rows.width = kWidth;
    rows.weight.resize(kWidth);
    for (int l = 0; l < B; ++l)
      for (int i = 3 * l * l; i < 3 * (l + 1) * (l + 1); ++i) rows.weight[i] = static_cast<float>(squared(l));
    const auto points = static_cast<float>(rows.residuals);
    const auto used = static_cast<float>(rig.shVectors());
    if (!nested && ownChecks) {
      const float ratio = points / std::max(points - used, 0.25f * points);
      rows.inflation = ratio * ratio;
    }

    rows.truncatedRows = (rows.residuals + kTruncationEvery - 1) / kTruncationEvery;
    rows.truncated = rows.truncatedRows * kTruncatedWidth;
    truncationScale.resize(kTruncatedWidth);
    double held = 0;  // of a distant light's kernel energy, int f^2 dx, in the bands that are projected
    for (int l = kFirstTruncated; l < kMaxBands; ++l) {
      held += (2 * l + 1) * static_cast<double>(f[l]) * static_cast<double>(f[l]) / 8;
      for (int i = 3 * l * l; i < 3 * (l + 1) * (l + 1); ++i)
        truncationScale[i - 3 * kFirstTruncated * kFirstTruncated] =
            static_cast<float>(std::sqrt(squared(l) / rows.truncatedRows));
    }
    const double a = static_cast<double>(clampWrap(options.wrap));
    double lost = (1 + a) / (3 + 2 * a);
    for (int l = 0; l < B; ++l) lost -= (2 * l + 1) * static_cast<double>(f[l]) * static_cast<double>(f[l]) / 8;
    rows.tail = held > 1e-9 ? static_cast<float>(std::max(0.0, lost) / held) : 0;
    high.band = B > 3 ? 0 : (options.wrap > 0 ? 3 : 4);
  }

  void setPose(const RigPose& pose, const RigFrame& worldFromRig) noexcept {
    frame = worldFromRig;
    rig.setPose({pose.box, pose.anchors.first(rigAnchors)});
    for (std::size_t i = 0; i < checks.size(); ++i)
      checks[i].position = frame.point(pose.anchors[pose.anchors.size() - checks.size() + i]);
    if (!nested) return;
    RigBasis phi;
    for (std::size_t i = 0; i < checks.size(); ++i) {
      const auto row = nested->row(static_cast<int>(i));
      rig.basis(pose.anchors[i], phi);
      std::ranges::fill(row, 0.0);
      for (int j = 0; j < phi.count; ++j) row[phi.index[j]] = static_cast<double>(phi.value[j]);
    }
    nested->factor(shares);
  }

  // --- bounds -------------------------------------------------------------------------------------------------------

  void boundLights(const LightSet& lights) {
    const LightBounds bounds(rig, frame, options.wrap);
    const int count = lights.size();
    errors.resize(count);
    peaks.resize(count);
    culled.resize(count);
    verdicts.resize(count);
    for (int i = 0; i < count; ++i) {
      lights.visit(i, [&](const auto& light) {
        const LightBound bound = bounds(light);
        const float size = magnitude(colourOf(light));
        errors[i] = bound.error * size;
        peaks[i] = bound.peak * size;
        culled[i] = peaks[i] > 0 ? 0 : 1;
      });
    }
  }

  // --- rows ---------------------------------------------------------------------------------------------------------

  /// Error rows of a light or light set into block `index`; its mean irradiance on the object.
  template <class Lights>
  float describe(const Lights& lights, int index) {
    const std::size_t block = rows.block();
    float* out = rows.fields.data() + static_cast<std::size_t>(index) * block;
    float* residuals = out + static_cast<std::size_t>(rows.nested) * kWidth;
    float mean = 0;
    values.resize(checks.size() * kWidth);
    for (std::size_t s = 0; s < checks.size(); ++s) {
      const RadianceSH<B> sh = project<B>(lights, checks[s].position, checks[s].footprint);
      mean += checks[s].share * (sh[0].r + sh[0].g + sh[0].b);
      const float root = std::sqrt(checks[s].share);
      for (int i = 0; i < kWidth; ++i) values[s * kWidth + i] = root * sh.data()[i];
    }
    if (nested) {
      nested->analyse(values.data(), kWidth, out, residuals);
    } else {
      subtractRig(lights, residuals);
    }
    if (rows.truncated > 0) {
      float* t = rows.truncation.data() + static_cast<std::size_t>(index) * rows.truncated;
      for (std::size_t s = 0; s < checks.size(); s += kTruncationEvery) {
        const RadianceSH<kMaxBands> sh = project<kMaxBands>(lights, checks[s].position, checks[s].footprint);
        const float* from = sh.data() + 3 * kFirstTruncated * kFirstTruncated;
        for (int i = 0; i < kTruncatedWidth; ++i) *t++ = truncationScale[i] * from[i];
      }
    }
    rows.excess[index] = excessOf(lights);
    return mean * meanFactor();
  }

  /// What light so close that the check points are too coarse for it adds to the mean-square error. A patch of radius
  /// rho that a light of radius r passes at height h receives a mean square of 1/(h^2 (h^2 + rho^2)) relative to the
  /// light's own scale; its check point, d away, knows 1/max(d, rho)^4. How close the surface comes within the patch is
  /// not known: h^2 = r d, between touching and as far as the check point.
  float excessOf(const DirectionalLight&) const noexcept { return 0; }
  template <class Light>
  float excessOf(const Light& light) const noexcept {
    float sum = 0;
    for (const CheckPoint& check : checks) {
      const float rho = check.footprint;
      const float d = length(light.position - check.position);
      if (!(d < 3 * rho)) continue;
      const float r = std::max(light.radius, kMinPointRadius);
      const float x = std::clamp((d / rho - 1) / 2, 0.0f, 1.0f);
      const float apart = x * x * (3 - 2 * x);
      const float h2 = std::max(std::lerp(std::max(r * d, kLeastHeight * rho * rho), d * d, apart), r * r);
      const float reach = std::max({d, rho, r});
      const float ratio = reach * reach / h2 * (reach * reach / (h2 + rho * rho)) - 1;
      if (!(ratio > 0)) continue;
      const RadianceSH<B> sh = project<B>(light, check.position, rho);
      float square = 0;
      for (int i = 0; i < kWidth; ++i) square += rows.weight[i] * sh.data()[i] * sh.data()[i];
      sum += check.share * square * ratio;
    }
    return sum;
  }
  float excessOf(const LightSet& lights) const noexcept {
    float sum = 0;
    for (int i = 0; i < lights.size(); ++i) sum += lights.visit(i, [&](const auto& light) { return excessOf(light); });
    return sum;
  }

  /// From L_00, summed over channels, to the mean irradiance over normals and channels.
  float meanFactor() const noexcept {
    constexpr double kY00 = 0.28209479177387814;
    return static_cast<float>(kPi * kY00 / 3) * wrapCoefficients<kMinBands>(options.wrap)[0];
  }

  void projectInto(const LightSet& lights) noexcept { projectSamples<B>(rig, frame, lights, functionals); }
  template <class Light>
  void projectInto(const Light& light) {
    single.clear();
    single.add(light);
    projectSamples<B>(rig, frame, single, functionals);
  }

  /// What a fixed rig gets wrong at the check points.
  template <class Lights>
  void subtractRig(const Lights& lights, float* residuals) {
    projectInto(lights);
    fitRig<B>(rig, functionals, coefficients);
    for (std::size_t s = 0; s < checks.size(); ++s) {
      const RadianceSH<B> sh = evaluateRig<B>(rig, coefficients, frame.inversePoint(checks[s].position));
      const float root = std::sqrt(checks[s].share);
      for (int i = 0; i < kWidth; ++i) residuals[s * kWidth + i] = values[s * kWidth + i] - root * sh.data()[i];
    }
  }

  // --- fixed choice -------------------------------------------------------------------------------------------------

  void lightFixed(const LightSet& lights, float seconds, std::span<const std::uint32_t> ids, LightingProbe probe) {
    const bool bounded = options.nearSlots > 0 || options.estimate;
    if (bounded) {
      boundLights(lights);
      done(probe, LightingStage::bound);
    }
    const LightSet* far = &lights;
    near.clear();
    if (options.nearSlots > 0) {
      nearFar.update(errors, ids, seconds);
      splitLights(lights, nearFar.weights(), farLights, near, culled);
      far = &farLights;
      done(probe, LightingStage::choose);
    }
    if (options.estimate) {
      estimateFixed(lights, *far);
      done(probe, LightingStage::estimate);
    }
    projectInto(*far);
    done(probe, LightingStage::project);
    fitRig<B>(rig, functionals, coefficients);
    done(probe, LightingStage::fit);
    active = rig.shVectors();
    nanoseconds = TradeOff::nanoseconds(options.cost, static_cast<float>(active), static_cast<float>(near.size()), 0);
  }

  void estimateFixed(const LightSet& lights, const LightSet& far) {
    rows.resize(0);
    describe(far, 0);
    tradeOff.farError(rows, {}, {}, farError);
    float mean = 0;
    means.resize(lights.size());
    for (int i = 0; i < lights.size(); ++i) {
      means[i] = 0;
      lights.visit(i, [&](const auto& light) {
        for (const CheckPoint& check : checks) {
          const auto sh = project<kMinBands>(light, check.position, check.footprint);
          means[i] += check.share * (sh[0].r + sh[0].g + sh[0].b) * meanFactor();
        }
      });
      mean += means[i];
    }
    finishEstimate(kFewPoints * farError.beyond[0], farError.truncation, mean);
    judge(nearFar.weights(), mean);
  }

  void finishEstimate(float spatialSquare, float truncationSquare, float mean) {
    const float reference = options.reference > 0 ? options.reference : mean;
    const auto relative = [&](float square) { return reference > 0 ? std::sqrt(square) / reference : 0.0f; };
    spatialEstimate = relative(spatialSquare);
    totalEstimate = relative(spatialSquare + truncationSquare);
  }

  void judge(std::span<const float> weights, float mean) {
    for (std::size_t i = 0; i < verdicts.size(); ++i) {
      LightVerdict& verdict = verdicts[i];
      verdict.weight = weights.empty() ? 0 : weights[i];
      verdict.bound = errors[i];
      verdict.share = mean > 0 ? means[i] / mean : 0;
      verdict.role = !(peaks[i] > 0)       ? LightRole::culled
                     : verdict.weight <= 0 ? LightRole::far
                     : verdict.weight < 1  ? LightRole::blended
                                           : LightRole::near;
    }
  }

  // --- chosen -------------------------------------------------------------------------------------------------------

  /// The lights most worth looking at one by one, by bound and truncation; `fade` falls to 0 where a light would make
  /// room for another.
  void chooseCandidates() {
    const int count = static_cast<int>(errors.size());
    ranks.resize(count);
    const bool total = options.target.kind != LightingTarget::Kind::spatialError;
    for (int i = 0; i < count; ++i) ranks[i] = errors[i] + (total ? 0.1f * peaks[i] : 0);
    candidates.clear();
    for (int i = 0; i < count; ++i)
      if (peaks[i] > 0) candidates.push_back(i);
    float next = 0;
    if (candidates.size() > kCandidates) {
      std::ranges::nth_element(candidates, candidates.begin() + kCandidates,
                               [&](int a, int b) { return ranks[a] > ranks[b]; });
      next = ranks[candidates[kCandidates]];
      candidates.resize(kCandidates);
    }
    rows.resize(static_cast<int>(candidates.size()));
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const float x = next > 0 ? std::clamp(4 * (ranks[candidates[i]] / next - 1), 0.0f, 1.0f) : 1;
      rows.fade[i] = x * x * (3 - 2 * x);
    }
  }

  void describeAll(const LightSet& lights) {
    means.assign(lights.size(), 0);
    individually.assign(lights.size(), 0);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      individually[candidates[i]] = 1;
      means[candidates[i]] =
          lights.visit(candidates[i], [&](const auto& light) { return describe(light, static_cast<int>(i)); });
    }
    bulk.clear();
    for (int i = 0; i < lights.size(); ++i)
      if (individually[i] == 0) lights.visit(i, [&](const auto& light) { bulk.add(light); });
    const float bulkMean = describe(bulk, rows.lights);
    if (bulk.size() > 0)  // shared out evenly: nobody looks at one of many small lights
      for (int i = 0; i < lights.size(); ++i)
        if (individually[i] == 0) means[i] = bulkMean / static_cast<float>(bulk.size());
  }

  void prepare(const LightSet& lights, LightingProbe probe) {
    boundLights(lights);
    chooseCandidates();
    done(probe, LightingStage::bound);
    describeAll(lights);
    done(probe, LightingStage::project);
    frameMean = 0;
    for (float m : means) frameMean += m;
    tradeOff.build(rows, damping(), slots, options.target.kind != LightingTarget::Kind::spatialError);
  }

  std::span<const float> damping() const noexcept { return nested ? nested->damping() : std::span<const float>(); }

  TradeOff::Request request() const noexcept {
    const float reference = options.reference > 0 ? options.reference : frameMean;
    TradeOff::Request r;
    r.kind = options.target.kind;
    r.slots = slots;
    r.vectors = nested ? 0 : rig.shVectors();
    r.highBand = r.kind != LightingTarget::Kind::spatialError && high.band >= B;
    r.cost = options.cost;
    r.spatialMargin = r.kind == LightingTarget::Kind::totalError ? kTotalSpatialMargin : kSpatialMargin;
    switch (r.kind) {
      case LightingTarget::Kind::budget:
        r.value = 1000 * options.target.value / static_cast<float>(std::max(1, options.points));
        break;
      case LightingTarget::Kind::totalError:
        r.value = options.target.value * reference / kTotalMargin;
        break;
      default:
        r.value = options.target.value * reference;
    }
    return r;
  }

  void settle(const LightSet& lights, float seconds, std::span<const std::uint32_t> ids, LightingProbe probe) {
    const TradeOff::Request wanted = request();
    TradeOff::Choice choice = tradeOff.choose(wanted);
    candidateWeights.resize(candidates.size());
    tradeOff.weightsAt(choice.level, candidateWeights);
    lightWeights.assign(lights.size(), 0);
    for (std::size_t i = 0; i < candidates.size(); ++i) lightWeights[candidates[i]] = candidateWeights[i];
    nearFar.follow(lightWeights, ids, seconds);
    for (std::size_t i = 0; i < candidates.size(); ++i) candidateWeights[i] = nearFar.weights()[candidates[i]];
    splitLights(lights, nearFar.weights(), farLights, near, culled);
    tradeOff.farError(rows, damping(), candidateWeights, farError);
    const float truncation =
        std::lerp(farError.truncation, farError.truncationHigh, choice.highBand * (2 - choice.highBand));
    if (wanted.kind == LightingTarget::Kind::totalError)
      choice.spatialError = TradeOff::spatialRoom(wanted, truncation);
    done(probe, LightingStage::choose);

    if (nested) {
      coefficientWeights.resize(rows.nested);
      active = TradeOff::coefficientWeights(farError, choice, coefficientWeights);
      nested->synthesise(farError.field.data(), kWidth, std::span(coefficientWeights).first(active),
                         coefficients[0].data());
    } else {
      projectInto(farLights);
      fitRig<B>(rig, functionals, coefficients);
      active = rig.shVectors();
    }
    setHighBand(choice.highBand);
    done(probe, LightingStage::fit);
    finishEstimate(TradeOff::spatialSquare(rows, farError, damping(), coefficientWeights), truncation, frameMean);
    judge(nearFar.weights(), frameMean);
    nanoseconds = TradeOff::nanoseconds(options.cost, static_cast<float>(active), static_cast<float>(near.size()),
                                        high.band > 0 && choice.highBand > 0 ? 1.0f : 0.0f);
  }

  void setHighBand(float weight) noexcept {
    highWeight = weight;
    high.c.fill({});
    if (high.band < B || weight <= 0) return;
    const int first = 3 * (high.band * high.band - kFirstTruncated * kFirstTruncated);
    for (int s = 0; s < rows.truncatedRows; ++s) {
      const float* t = farError.truncated.data() + static_cast<std::size_t>(s) * kTruncatedWidth + first;
      for (int i = 0; i < 2 * high.band + 1; ++i)
        for (int c = 0; c < 3; ++c) {
          const float scale = truncationScale[first + 3 * i + c];
          if (scale > 0) high.c[i][c] += weight * t[3 * i + c] / (scale * static_cast<float>(rows.truncatedRows));
        }
    }
  }

  static void done(LightingProbe probe, LightingStage stage) {
    if (probe.done != nullptr) probe.done(probe.context, stage);
  }

  LightingOptions options;
  Rig rig;
  RigFrame frame;
  NearFar nearFar;
  std::optional<NestedFit> nested;  // `auto` only
  std::vector<int> anchors;
  int rigAnchors = 0;      // the first of `anchors`
  bool ownChecks = false;  // check points are the rig's own anchors; otherwise they follow those
  std::vector<CheckPoint> checks;
  std::vector<float> shares;

  LightRows rows;
  TradeOff tradeOff;
  FarError farError;
  std::vector<float> truncationScale;
  std::vector<float> values;  // times sqrt(share), points x width
  std::vector<float> errors, peaks, means, ranks;
  std::vector<int> candidates;
  std::vector<std::uint8_t> individually, culled;
  std::vector<float> candidateWeights, lightWeights, coefficientWeights;
  LightSet bulk, single, farLights;
  float frameMean = 0;  // [W/m2] irradiance on the object, of all lights
  int slots = 0;

  std::vector<RadianceSH<B>> functionals, coefficients;
  std::vector<NearLight> near;
  std::vector<LightVerdict> verdicts;
  HighBand high;
  float highWeight = 0;
  int active = 0;
  float nanoseconds = 0;
  std::optional<float> spatialEstimate, totalEstimate;
};

template <int B>
Result<ObjectLighting<B>> ObjectLighting<B>::create(const RigSpec& spec, const RigShape& rest,
                                                    const LightingOptions& options) {
  auto rig = Rig::create(spec, rest);
  if (!rig) return rig.error();
  return ObjectLighting(std::make_unique<State>(*std::move(rig), rest, options));
}

template <int B>
ObjectLighting<B>::ObjectLighting(std::unique_ptr<State> state) noexcept : state_(std::move(state)) {}
template <int B>
ObjectLighting<B>::ObjectLighting(ObjectLighting&&) noexcept = default;
template <int B>
ObjectLighting<B>& ObjectLighting<B>::operator=(ObjectLighting&&) noexcept = default;
template <int B>
ObjectLighting<B>::~ObjectLighting() = default;

template <int B>
const Rig& ObjectLighting<B>::rig() const noexcept {
  return state_->rig;
}
template <int B>
LightingOptions& ObjectLighting<B>::options() noexcept {
  return state_->options;
}
template <int B>
std::span<const int> ObjectLighting<B>::anchors() const noexcept {
  return state_->anchors;
}
template <int B>
void ObjectLighting<B>::setPose(const RigPose& pose, const RigFrame& worldFromRig) noexcept {
  state_->setPose(pose, worldFromRig);
}
template <int B>
void ObjectLighting<B>::reset() noexcept {
  state_->nearFar.reset();
}

template <int B>
void ObjectLighting<B>::light(const LightSet& lights, float seconds, std::span<const std::uint32_t> ids,
                              LightingProbe probe) {
  if (state_->chooses()) {
    state_->prepare(lights, probe);
    state_->settle(lights, seconds, ids, probe);
  } else {
    state_->lightFixed(lights, seconds, ids, probe);
  }
}

template <int B>
std::span<const RadianceSH<B>> ObjectLighting<B>::coefficients() const noexcept {
  return std::span(state_->coefficients).first(state_->active);
}
template <int B>
std::span<const NearLight> ObjectLighting<B>::nearLights() const noexcept {
  return state_->near;
}
template <int B>
std::span<const LightVerdict> ObjectLighting<B>::verdicts() const noexcept {
  return state_->verdicts;
}
template <int B>
std::optional<float> ObjectLighting<B>::spatialEstimate() const noexcept {
  return state_->spatialEstimate;
}
template <int B>
std::optional<float> ObjectLighting<B>::totalEstimate() const noexcept {
  return state_->totalEstimate;
}
template <int B>
float ObjectLighting<B>::modelledNanoseconds() const noexcept {
  return state_->nanoseconds;
}
template <int B>
auto ObjectLighting<B>::highBand() const noexcept -> const HighBand& {
  return state_->high;
}

template <int B>
auto ObjectLighting<B>::shade(Vec3 p, Vec3 n, const std::array<float, B>& f, float wrap) const noexcept -> Parts {
  const State& s = *state_;
  Parts parts;
  if (s.active > 0) {
    RigBasis basis;
    s.rig.basis(s.frame.inversePoint(p), basis);
    RadianceSH<B> sum;
    for (int j = 0; j < basis.count; ++j) {
      if (basis.index[j] >= s.active) continue;
      const float* c = s.coefficients[basis.index[j]].data();
      for (int i = 0; i < 3 * shCount(B); ++i) sum.data()[i] += basis.value[j] * c[i];
    }
    parts.rig = rigel::irradiance<B>(sum, f, n);
  }
  if (s.highWeight > 0) {
    float y[shCount(kMaxBands)];
    shBasis<kMaxBands>(n, y);
    const int l = s.high.band;
    const float scale = static_cast<float>(kPi) * wrapCoefficients<kMaxBands>(wrap)[l];
    for (int i = 0; i < 2 * l + 1; ++i) parts.rig += s.high.c[i] * (scale * y[l * l + i]);
  }
  for (const NearLight& light : s.near) parts.near += nearIrradiance(light, p, n, wrap);
  return parts;
}

template class ObjectLighting<2>;
template class ObjectLighting<3>;
template class ObjectLighting<4>;
template class ObjectLighting<5>;

}  // namespace rigel
