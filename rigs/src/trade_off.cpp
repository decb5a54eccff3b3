#include "trade_off.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "weights.h"

namespace rigel {
namespace {

constexpr int kReferenceTerms = 6;  // a light's error is judged against a rig of this many coefficients
// Levels reach down to this share of the largest error; a light below it stays in the rig.
constexpr float kLeastLevel = 1e-12f;
// A coefficient counts fully where the error without it is 1.3 times the target, not at all below 0.7 times.
constexpr float kActivation = 0.1f;
constexpr float kFadeFrom = 0.7f, kFadeWidth = 0.6f;
// A light is far where its error is at most the level's, near where it is 1 + kWindow times that.
constexpr float kWindow = 0.5f;
// Choices whose costs are within about this share of the least one blend, so that nothing flickers between them; not of
// a budget, where a blend of two that are far apart is wrong by more than either. The rate limits of who carries the
// choice out make both continuous in time.
constexpr float kSoftness = 0.02f;
// Of the squared total target, left to the spatial part where truncation alone takes all of it.
constexpr float kLeastRoom = 0.04f;
constexpr float kUnfit = 300;  // ns a doubling of the target that a choice misses
// Of the error of all lights left out; targets below it are held there.
constexpr float kLeastTarget = 1e-12f;

/// What is evaluated at all costs in full, however little it weighs. Counted from just before its weight rises (at `x`
/// = 0) so that the count is continuous and never too low.
float active(float x) noexcept { return std::clamp(1 + x / kActivation, 0.0f, 1.0f); }

float energy(std::span<const float> rows, std::span<const float> weight) noexcept {
  float sum = 0;
  const std::size_t width = weight.size();
  for (std::size_t r = 0; r < rows.size(); r += width)
    for (std::size_t i = 0; i < width; ++i) sum += weight[i] * rows[r + i] * rows[r + i];
  return sum;
}

float squares(std::span<const float> values) noexcept {
  float sum = 0;
  for (float v : values) sum += v * v;
  return sum;
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
}

void LightRows::reserve(int lightCount) {
  const std::size_t blocks = static_cast<std::size_t>(lightCount) + 1;
  fields.reserve(blocks * block());
  truncation.reserve(blocks * truncated);
  excess.reserve(blocks);
  fade.reserve(blocks);
}

void TradeOff::reserve(const LightRows& rows, int lightCount) {
  const std::size_t levels = static_cast<std::size_t>(lightCount) + 1;
  if (levels_.size() < levels) levels_.resize(levels);
  for (Level& level : levels_) level.beyond.reserve(rows.nested + 1);
  error_.reserve(levels);
  sorted_.reserve(levels);
  weights_.reserve(levels);
  costs_.reserve(2 * levels);
}

void TradeOff::farError(const LightRows& rows, std::span<const float> damping, std::span<const float> weights,
                        FarError& out) const {
  const std::size_t block = rows.block();
  const auto sum = [&](const std::vector<float>& from, std::size_t size, std::vector<float>& into) {
    into.assign(from.end() - static_cast<std::ptrdiff_t>(size), from.end());
    for (int i = 0; i < rows.lights; ++i) {
      const float share = 1 - weights[i];
      if (share == 0) continue;
      const float* add = from.data() + static_cast<std::size_t>(i) * size;
      for (std::size_t j = 0; j < size; ++j) into[j] += share * add[j];
    }
  };
  sum(rows.fields, block, out.field);
  sum(rows.truncation, rows.truncated, out.truncated);

  const std::size_t width = rows.width;
  const auto row = [&](int k) { return std::span(out.field).subspan(static_cast<std::size_t>(k) * width, width); };
  float rest = energy(std::span(out.field).subspan(rows.nested * width), rows.weight);
  out.beyond.resize(rows.nested + 1);
  const auto points = static_cast<float>(rows.residuals);
  out.excess = rows.excess[rows.lights];
  for (int i = 0; i < rows.lights; ++i) out.excess += (1 - weights[i]) * (1 - weights[i]) * rows.excess[i];
  out.beyond[rows.nested] = rows.nested > 0 ? rest : rest * rows.inflation;
  for (int k = rows.nested - 1; k >= 0; --k) out.beyond[k] = rest += energy(row(k), rows.weight);
  if (rows.nested > 0) {
    for (int k = 0; k < rows.nested; ++k) {
      const float undamped = 1 - damping[k];
      // What damping keeps out of coefficient k stays wrong when it is kept.
      const float kept = undamped * undamped * energy(row(k), rows.weight);
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
  const int reference = std::min(kReferenceTerms, rows.nested);
  error_.resize(rows.lights);
  for (int i = 0; i < rows.lights; ++i) {
    const std::span<const float> field(rows.fields.data() + static_cast<std::size_t>(i) * rows.block(), rows.block());
    float square = energy(field.subspan(static_cast<std::size_t>(reference) * rows.width), rows.weight);
    if (total)
      square += rows.tail * squares({rows.truncation.data() + static_cast<std::size_t>(i) * rows.truncated,
                                     static_cast<std::size_t>(rows.truncated)});
    error_[i] = std::sqrt(square + rows.excess[i]) * rows.fade[i];
  }
  sorted_.assign(error_.begin(), error_.end());
  std::ranges::sort(sorted_, std::greater<>());
  floor_ = slots < rows.lights ? sorted_[slots] : 0;

  // Level n has the n largest in full. As many levels as lights, each continuous in the errors: none comes or goes as
  // lights move.
  const int most = std::min(slots, rows.lights);
  const float largest = most > 0 ? sorted_[0] : 0;
  weights_.resize(rows.lights);
  levelCount_ = static_cast<std::size_t>(most) + 1;
  if (levels_.size() < levelCount_) levels_.resize(levelCount_);
  for (int n = 0; n <= most; ++n) {
    Level& level = levels_[n];
    // At level 0 not even the largest counts.
    const float error = n > 0 ? sorted_[n - 1] / (1 + kWindow) : largest / (1 - kActivation);
    level.log2 = largest > 0 ? std::log2(std::max({error, floor_, kLeastLevel * largest})) : 0;
    weightsAt(level.log2, weights_);
    farError(rows, damping, weights_, scratch_);
    level.beyond = scratch_.beyond;
    level.truncation = scratch_.truncation;
    level.truncationHigh = scratch_.truncationHigh;
    level.nearLights = 0;
    const float threshold = std::max(std::exp2(level.log2), floor_);
    for (int i = 0; i < rows.lights; ++i)
      if (threshold > 0 || error_[i] > 0) level.nearLights += threshold > 0 ? active(error_[i] / threshold - 1) : 1;
  }
}

void TradeOff::weightsAt(float level, std::span<float> weights) const {
  const float threshold = std::max(std::exp2(level), floor_);
  for (std::size_t i = 0; i < error_.size(); ++i)
    weights[i] = error_[i] > 0 ? (threshold > 0 ? smoothstep((error_[i] / threshold - 1) / kWindow) : 1.0f) : 0.0f;
}

float TradeOff::nanoseconds(const CostModel& cost, float vectors, float nearLights, float highBand) {
  return cost.base * std::min(1.0f, vectors) + cost.vector * vectors + cost.nearLight * nearLights +
         cost.highBand * highBand;
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
  const float least = kLeastTarget * everything;
  const auto over = [&](float square, float target) {
    return square > 0 ? std::sqrt(square) / std::max(target, least) : 0.0f;
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
    option.objective = option.nanoseconds + kUnfit * std::log2(std::max(missed, 1.0f));
    return option;
  };

  const int variants = request.highBand ? 2 : 1;
  costs_.clear();
  float cheapest = std::numeric_limits<float>::infinity();
  for (std::size_t l = 0; l < levelCount_; ++l)
    for (int v = 0; v < variants; ++v) {
      costs_.push_back(look(levels_[l], v == 1).objective);
      cheapest = std::min(cheapest, costs_.back());
    }
  // The average is over the number of near lights. A likely choice of one and a likely choice of nine meet at five,
  // which costs about as much as either, where half of both would cost the sum.
  float sum = 0, number = 0, high = 0;
  const float softness = budget ? 0 : kSoftness * (cheapest + 10);
  for (std::size_t i = 0; i < costs_.size(); ++i) {
    const float likeness =
        softness > 0 ? std::exp((cheapest - costs_[i]) / softness) : static_cast<float>(costs_[i] == cheapest);
    sum += likeness;
    number += likeness * static_cast<float>(i / variants);
    if (i % variants == 1) high += likeness;
  }
  number /= sum;
  choice.highBand = smoothstep(2 * high / sum - 0.5f);
  const float highCounted = std::clamp(1 + (high / sum - 0.25f) / kActivation, 0.0f, 1.0f);

  const auto below = std::min(static_cast<std::size_t>(number), levelCount_ - 1);
  const auto above = std::min(below + 1, levelCount_ - 1);
  const float part = number - static_cast<float>(below);
  // The next light is counted in full before its weight rises.
  const float counted = std::min(1.0f, part / kActivation);
  const float share = std::max(0.0f, (part - kActivation) / (1 - kActivation));
  choice.weights.resize(error_.size());
  weightsAt(levels_[below].log2, choice.weights);
  weightsAt(levels_[above].log2, weights_);
  for (std::size_t j = 0; j < weights_.size(); ++j)
    choice.weights[j] = std::lerp(choice.weights[j], weights_[j], share);

  const float near = std::lerp(levels_[below].nearLights, levels_[above].nearLights, counted);
  const Option few = look(levels_[below], high > 0.5f * sum), many = look(levels_[above], high > 0.5f * sum);
  choice.spatialError = std::lerp(few.spatial, many.spatial, part);
  choice.vectorCap = few.cap;
  float vectors = std::lerp(few.vectors, many.vectors, part);
  if (budget && request.vectors == 0) {
    const float spare = request.value - nanoseconds(request.cost, 0, near, highCounted) - request.cost.base;
    choice.vectorCap = std::clamp(spare / request.cost.vector, 0.0f, static_cast<float>(all.beyond.size()) - 1);
    vectors = choice.vectorCap;
  }
  choice.nanoseconds = nanoseconds(request.cost, vectors, near, highCounted);
}

int TradeOff::coefficientWeights(const FarError& error, const Choice& choice, std::span<float> weights) {
  int used = 0;
  for (std::size_t j = 0; j < weights.size(); ++j) {
    const float without = std::sqrt(error.beyond[j]);
    const float wanted = choice.spatialError > 0 ? smoothstep((without / choice.spatialError - kFadeFrom) / kFadeWidth)
                                                 : static_cast<float>(without > 0);
    weights[j] = std::min(wanted, smoothstep(choice.vectorCap - static_cast<float>(j)));
    if (weights[j] > 0) used = static_cast<int>(j) + 1;
  }
  return used;
}

float TradeOff::spatialSquare(const LightRows& rows, const FarError& error, std::span<const float> damping,
                              std::span<const float> weights) {
  const std::size_t width = rows.width;
  float sum = energy(std::span(error.field).subspan(rows.nested * width), rows.weight);
  float used = 0;
  for (int k = 0; k < rows.nested; ++k) {
    const float lost = 1 - weights[k] * damping[k];
    sum += lost * lost * energy(std::span(error.field).subspan(k * width, width), rows.weight);
    used += weights[k];
  }
  return sum * (rows.nested > 0 ? inflation(static_cast<float>(rows.residuals), used) : rows.inflation) + error.excess;
}

}  // namespace rigel
