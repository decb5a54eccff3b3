#include "trade_off.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "row_kernels.h"
#include "weights.h"

namespace rigel {
namespace {

// Lights are ranked by what this share of the coefficients leaves of each: those that a choice will have, or the order
// tells what the rig would hold anyway. Of a total error most is beyond any rig, and rigs are smaller.
constexpr float kSpatialShare = 0.75f, kTotalShare = 0.25f;
// Levels reach down to this share of the largest error; a light below it stays in the rig.
constexpr float kLeastLevel = 1e-12f;
// A coefficient counts fully where the error without it is 0.9 times the target, not at all below 0.7 times: one that
// is evaluated costs as much in part.
constexpr float kActivation = 0.1f;
constexpr float kFadeFrom = 0.7f, kFadeWidth = 0.2f;
// A light is far where its error is at most the level's, near where it is 1 + kWindow times that.
constexpr float kWindow = 0.1f;
// The last frame's choice stands until another costs less by this share: two that cost about the same would take turns,
// and weights on their way from one to the other cost as much as both.
constexpr float kHeld = 0.03f;
// Of the squared total target, left to the spatial part where truncation alone takes all of it.
constexpr float kLeastRoom = 0.04f;
constexpr float kUnfit = 100;  // SH vectors whose time a doubling of the target is worth that a choice misses
// Of the error of all lights left out; targets below it are held there.
constexpr float kLeastTarget = 1e-12f;

/// What is evaluated at all costs in full, however little it weighs. Counted from just before its weight rises (at `x`
/// = 0) so that the count is continuous and never too low.
float active(float x) noexcept { return std::clamp(1 + x / kActivation, 0.0f, 1.0f); }

float squares(std::span<const float> values) noexcept { return rowkernels::sumOfSquares(values.data(), values.size()); }

void beginFar(const LightRows& rows, FarError& out) {
  const auto last = [](const std::vector<float>& of, std::size_t size) {
    return of.end() - static_cast<std::ptrdiff_t>(size);
  };
  out.field.assign(last(rows.fields, rows.block()), rows.fields.end());
  out.truncated.assign(last(rows.truncation, rows.truncated), rows.truncation.end());
}

/// More of each light.
template <class Share>
void addFar(const LightRows& rows, Share shareOf, FarError& out) {
  const auto add = [](float share, const float* from, std::vector<float>& into) {
    rowkernels::addScaled(share, from, into.size(), into.data());
  };
  for (int i = 0; i < rows.lights; ++i) {
    const float share = shareOf(i);
    if (share == 0) continue;
    add(share, rows.fields.data() + static_cast<std::size_t>(i) * rows.block(), out.field);
    add(share, rows.truncation.data() + static_cast<std::size_t>(i) * rows.truncated, out.truncated);
  }
}

}  // namespace

float inflation(float points, float used) noexcept {
  const float ratio = points / std::max(points - used, 0.25f * points);
  return ratio * ratio;
}

void LightRows::resize(int lightCount) {
  lights = lightCount;
  fields.resize((static_cast<std::size_t>(lights) + 1) * block());
  truncation.resize((static_cast<std::size_t>(lights) + 1) * truncated);
  excess.resize(lights + 1);
  fade.resize(lights);
  contact.resize(lights);
}

void LightRows::reserve(int lightCount) {
  const std::size_t blocks = static_cast<std::size_t>(lightCount) + 1;
  fields.reserve(blocks * block());
  truncation.reserve(blocks * truncated);
  excess.reserve(blocks);
  fade.reserve(blocks);
  contact.reserve(blocks);
}

void TradeOff::reserve(const LightRows& rows, int lightCount) {
  const std::size_t levels = static_cast<std::size_t>(lightCount) + 1;
  if (levels_.size() < levels) levels_.resize(levels);
  for (Level& level : levels_) level.beyond.reserve(rows.nested + 1);
  error_.reserve(levels);
  contact_.reserve(levels);
  sorted_.reserve(levels);
  weights_.reserve(levels);
  nearer_.reserve(levels);
}

void TradeOff::farError(const LightRows& rows, std::span<const float> damping, std::span<const float> weights,
                        FarError& out) {
  beginFar(rows, out);
  addFar(
      rows, [&](int i) { return 1 - weights[i]; }, out);
  finishFar(rows, damping, weights, out);
}

/// Errors of the sums.
void TradeOff::finishFar(const LightRows& rows, std::span<const float> damping, std::span<const float> weights,
                         FarError& out) {
  out.energy.resize(rows.rows());
  rowkernels::energies(out.field.data(), rows.rows(), rows.weight.data(), rows.width, out.energy.data());
  float rest = std::accumulate(out.energy.begin() + rows.nested, out.energy.end(), 0.0f);
  out.beyond.resize(rows.nested + 1);
  const auto points = static_cast<float>(rows.residuals);
  out.excess = rows.excess[rows.lights];
  for (int i = 0; i < rows.lights; ++i) out.excess += (1 - weights[i]) * (1 - weights[i]) * rows.excess[i];
  out.beyond[rows.nested] = rows.nested > 0 ? rest : rest * rows.inflation;
  for (int k = rows.nested - 1; k >= 0; --k) out.beyond[k] = rest += out.energy[k];
  if (rows.nested > 0) {
    for (int k = 0; k < rows.nested; ++k) {
      const float undamped = 1 - damping[k];
      // What damping keeps out of coefficient k stays wrong when it is kept.
      const float kept = undamped * undamped * out.energy[k];
      for (int j = k + 1; j <= rows.nested; ++j) out.beyond[j] += kept;
    }
    for (int j = 0; j <= rows.nested; ++j) out.beyond[j] *= inflation(points, static_cast<float>(j));
    for (int j = 1; j <= rows.nested; ++j) out.beyond[j] = std::min(out.beyond[j], out.beyond[j - 1]);
  }
  for (float& square : out.beyond) square += out.excess;

  out.truncation = rows.tail * squares(out.truncated);
  out.truncationHigh = out.truncation;
  if (rows.truncatedRows > 0) {
    const int perRow = rows.truncated / rows.truncatedRows;
    float mean = 0;
    for (int i = rows.highFirst; i < rows.highFirst + rows.highCount; ++i) {
      float value = 0;
      for (int s = 0; s < rows.truncatedRows; ++s) value += out.truncated[s * perRow + i];
      mean += value * value / static_cast<float>(rows.truncatedRows);
    }
    out.truncationHigh = std::max(0.0f, out.truncation - mean);
  }
}

void TradeOff::build(const LightRows& rows, std::span<const float> damping, int slots, bool total) {
  const auto reference =
      static_cast<std::ptrdiff_t>((total ? kTotalShare : kSpatialShare) * static_cast<float>(rows.nested));
  error_.resize(rows.lights);
  for (int i = 0; i < rows.lights; ++i) {
    const float* field = rows.fields.data() + static_cast<std::size_t>(i) * rows.block();
    scratch_.energy.resize(rows.rows());
    rowkernels::energies(field, rows.rows(), rows.weight.data(), rows.width, scratch_.energy.data());
    float square = std::accumulate(scratch_.energy.begin() + reference, scratch_.energy.end(), 0.0f);
    if (total)
      square += rows.tail * squares({rows.truncation.data() + static_cast<std::size_t>(i) * rows.truncated,
                                     static_cast<std::size_t>(rows.truncated)});
    error_[i] = std::sqrt(square + rows.excess[i]) * rows.fade[i];
  }
  // Where more lights touch than there are slots, none is known to have one.
  contact_.assign(rows.contact.begin(), rows.contact.end());
  sorted_.assign(contact_.begin(), contact_.end());
  std::ranges::sort(sorted_, std::greater<>());
  const float unserved = slots < rows.lights ? sorted_[slots] : 0;
  for (float& contact : contact_)
    if (!(contact > unserved)) contact = 0;

  sorted_.assign(error_.begin(), error_.end());
  std::ranges::sort(sorted_, std::greater<>());
  floor_ = slots < rows.lights ? sorted_[slots] : 0;

  // Level n has the n largest in full. As many levels as lights, each continuous in the errors: none comes or goes as
  // lights move.
  const int most = std::min(slots, rows.lights);
  const float largest = most > 0 ? sorted_[0] : 0;
  weights_.resize(rows.lights);
  nearer_.assign(rows.lights, 1.0f);
  levelCount_ = static_cast<std::size_t>(most) + 1;
  if (levels_.size() < levelCount_) levels_.resize(levelCount_);
  // From most near lights to fewest: each level adds to the rig what the one before it had near.
  beginFar(rows, scratch_);
  for (int n = most; n >= 0; --n) {
    Level& level = levels_[n];
    // At level 0 not even the largest counts.
    const float error = n > 0 ? sorted_[n - 1] / (1 + kWindow) : largest / (1 - kActivation);
    level.log2 = largest > 0 ? std::log2(std::max({error, floor_, kLeastLevel * largest})) : 0;
    weightsAt(level.log2, weights_);
    addFar(
        rows, [&](int i) { return nearer_[i] - weights_[i]; }, scratch_);
    finishFar(rows, damping, weights_, scratch_);
    nearer_.swap(weights_);
    level.beyond = scratch_.beyond;
    level.truncation = scratch_.truncation;
    level.truncationHigh = scratch_.truncationHigh;
    level.nearLights = 0;
    const float threshold = std::max(std::exp2(level.log2), floor_);
    for (int i = 0; i < rows.lights; ++i) {
      const float touches = std::min(1.0f, contact_[i] / kActivation);
      const float chosen = threshold > 0 ? active(error_[i] / threshold - 1) : static_cast<float>(error_[i] > 0);
      level.nearLights += std::max(touches, chosen);
    }
  }
}

void TradeOff::weightsAt(float level, std::span<float> weights) const {
  const float threshold = std::max(std::exp2(level), floor_);
  for (std::size_t i = 0; i < error_.size(); ++i) {
    const float chosen =
        threshold > 0 ? smoothstep((error_[i] / threshold - 1) / kWindow) : static_cast<float>(error_[i] > 0);
    weights[i] = std::max(chosen, contact_[i]);
  }
}

float TradeOff::nanoseconds(const CostModel& cost, float vectors, float nearLights, float highBand) {
  return cost.base * std::min(1.0f, vectors) + cost.vector * vectors + cost.anyNear * std::min(1.0f, nearLights) +
         cost.nearLight * nearLights + cost.highBand * highBand;
}

float TradeOff::spatialRoom(const Request& request, float truncation) {
  const float square = request.value * request.value;
  const float room =
      request.kind == LightingTarget::Kind::totalError ? std::max(square - truncation, kLeastRoom * square) : square;
  return std::sqrt(room) / request.spatialMargin;
}

void TradeOff::choose(const Request& request, Choice& choice) const {
  const bool budget = request.kind == LightingTarget::Kind::budget;
  const bool total = request.kind == LightingTarget::Kind::totalError;
  struct Option {
    float objective, spatial, cap, vectors, nanoseconds;
  };
  const Level& all = levels_[0];
  const float everything = std::sqrt(all.beyond.front() + all.truncation);
  const float leastTarget = kLeastTarget * everything;
  const auto over = [&](float square, float target) {
    return square > 0 ? std::sqrt(square) / std::max(target, leastTarget) : 0.0f;
  };
  // What one level costs, with and without the high band; for a budget, how wrong it is.
  const auto look = [&](const Level& level, bool high) {
    Option option{0, 0, static_cast<float>(level.beyond.size()) - 1, 0, 0};
    const float truncation = high ? level.truncationHigh : level.truncation;
    const auto most = level.beyond.size() - 1;
    if (budget) {
      const float spare = request.value - nanoseconds(request.cost, 0, level.nearLights, high ? 1 : 0);
      float vectors = (spare - request.cost.base) / request.cost.vector;
      if (request.vectors > 0) vectors = static_cast<float>(request.vectors);
      vectors = std::clamp(vectors, 0.0f, static_cast<float>(most));
      const auto whole = static_cast<std::size_t>(vectors);
      const float part = vectors - static_cast<float>(whole);
      const float spatial =
          whole < most ? std::lerp(level.beyond[whole], level.beyond[whole + 1], part) : level.beyond[most];
      option.spatial = 0;
      option.cap = option.vectors = vectors;
      option.objective = std::sqrt(spatial + truncation);
      option.nanoseconds =
          nanoseconds(request.cost, request.vectors > 0 ? static_cast<float>(request.vectors) : vectors,
                      level.nearLights, high ? 1 : 0);
      // A nanosecond too many is worse than any error.
      option.objective += everything * std::max(0.0f, option.nanoseconds - request.value);
      return option;
    }
    option.spatial = spatialRoom(request, truncation);
    float missed = total ? over(truncation, request.value) : 0;
    float vectors = static_cast<float>(request.vectors);
    if (request.vectors == 0) {
      for (std::size_t j = 0; j < most; ++j) vectors += active(over(level.beyond[j], option.spatial) - kFadeFrom);
    }
    missed = std::max(missed, over(level.beyond[most], option.spatial));
    option.vectors = vectors;
    option.nanoseconds = nanoseconds(request.cost, vectors, level.nearLights, high ? 1 : 0);
    option.objective = option.nanoseconds + kUnfit * request.cost.vector * std::log2(std::max(missed, 1.0f));
    return option;
  };

  // Not an average: between a choice of one light and many vectors and one of four lights and no rig lie those that
  // cost more than either. Who carries the choice out moves towards it at limited rates.
  Option best{};
  float least = std::numeric_limits<float>::infinity();
  choice.pick = {};
  for (int level = 0; level < static_cast<int>(levelCount_); ++level)
    for (const bool high : {false, true}) {
      if (high && !request.highBand) continue;
      const Option option = look(levels_[level], high);
      float objective = option.objective;
      if (!budget && request.held && *request.held == Pick{level, high}) objective -= kHeld * option.nanoseconds;
      // Of equal ones that with more near lights: all that are counted are near in full.
      if (!(objective <= least)) continue;
      least = objective;
      best = option;
      choice.pick = {level, high};
    }
  choice.weights.resize(error_.size());
  weightsAt(levels_[choice.pick.level].log2, choice.weights);
  choice.highBand = choice.pick.highBand ? 1.0f : 0.0f;
  choice.spatialError = choice.chosenSpatialError = best.spatial;
  choice.vectorCap = best.cap;
  choice.nanoseconds = best.nanoseconds;
  choice.objective = best.objective;
}

float TradeOff::coefficientWeight(float square, float target, float room) {
  const float without = std::sqrt(square);
  const float wanted =
      target > 0 ? smoothstep((without / target - kFadeFrom) / kFadeWidth) : static_cast<float>(without > 0);
  return std::min(wanted, smoothstep(room));
}

int TradeOff::coefficientWeights(const FarError& error, const Choice& choice, std::span<float> weights) const {
  const Level& chosen = levels_[choice.pick.level];
  int used = 0;
  for (std::size_t j = 0; j < weights.size(); ++j) {
    const float room = choice.vectorCap - static_cast<float>(j);
    weights[j] = std::max(coefficientWeight(error.beyond[j], choice.spatialError, room),
                          coefficientWeight(chosen.beyond[j], choice.chosenSpatialError, room));
    if (weights[j] > 0) used = static_cast<int>(j) + 1;
  }
  return used;
}

float TradeOff::readiness(const Choice& choice, std::span<const float> weights) const {
  const Level& chosen = levels_[choice.pick.level];
  float wanted = 0, there = 0;
  for (std::size_t j = 0; j < weights.size(); ++j) {
    const float weight =
        coefficientWeight(chosen.beyond[j], choice.chosenSpatialError, choice.vectorCap - static_cast<float>(j));
    wanted += weight;
    there += std::min(weight, weights[j]);
  }
  return wanted > 0 ? there / wanted : 1;
}

float TradeOff::spatialSquare(const LightRows& rows, const FarError& error, std::span<const float> damping,
                              std::span<const float> weights) {
  float sum = std::accumulate(error.energy.begin() + rows.nested, error.energy.end(), 0.0f);
  float used = 0;
  for (int k = 0; k < rows.nested; ++k) {
    const float lost = 1 - weights[k] * damping[k];
    sum += lost * lost * error.energy[k];
    used += weights[k];
  }
  return sum * (rows.nested > 0 ? inflation(static_cast<float>(rows.residuals), used) : rows.inflation) + error.excess;
}

}  // namespace rigel
