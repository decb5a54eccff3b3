#include "report/measure/error_spread.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace rigel::tools {
namespace {

/// Errors of one size, either sign.
struct Step {
  double from = 0, to = 0;  // [W/m2]; 0 is a size of its own
  std::uint64_t positive = 0, negative = 0;

  double size() const { return 0.5 * (from + to); }
  double count() const { return static_cast<double>(positive + negative); }
};

/// In order of size, of counts by sign and exponent and the seven bits that follow.
template <class Counts>
std::vector<Step> stepsOf(const Counts& counts) {
  constexpr std::uint32_t kSign = 1u << 8;
  const auto start = [](std::uint32_t upper) { return static_cast<double>(std::bit_cast<float>(upper << 16)); };
  std::map<std::uint32_t, Step> bySize;  // by the float's upper half
  for (const auto& [octave, inOctave] : counts) {
    for (std::uint32_t k = 0; k < inOctave.size(); ++k) {
      if (inOctave[k] == 0) continue;
      const auto half = static_cast<std::uint32_t>(octave % kSign * inOctave.size() + k);
      Step& step = bySize[half];
      if (half > 0) {
        step.from = start(half);
        step.to = start(half + 1);
      }
      (octave < kSign ? step.positive : step.negative) += inOctave[k];
    }
  }
  std::vector<Step> steps;
  for (const auto& [half, step] : bySize) steps.push_back(step);
  return steps;
}

/// Where `share` of all magnitudes lie below.
double percentile(std::span<const Step> steps, double share) {
  double all = 0, below = 0;
  for (const Step& step : steps) all += step.count();
  for (const Step& step : steps) {
    if (below + step.count() >= share * all) return std::lerp(step.from, step.to, (share * all - below) / step.count());
    below += step.count();
  }
  return 0;
}

}  // namespace

void ErrorSpread::add(std::span<const Rgb> errors) {
  points_.resize(errors.size());
  ++frames_;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const auto bits = std::bit_cast<std::uint32_t>(errors[i][c]);
      ++counts_[bits >> 23][(bits >> 16) % kSteps];
      const auto error = static_cast<double>(errors[i][c]);
      points_[i].sum += error;
      points_[i].squares += error * error;
      points_[i].largest = std::max(points_[i].largest, std::abs(error));
    }
  }
}

ErrorHistogram ErrorSpread::histogram(double meanIrradiance) const {
  const std::vector<Step> steps = stepsOf(counts_);
  ErrorHistogram out;
  out.p50 = percentile(steps, 0.5) / meanIrradiance;
  out.p90 = percentile(steps, 0.9) / meanIrradiance;
  out.p99 = percentile(steps, 0.99) / meanIrradiance;
  out.limit = std::max(out.p99, ErrorHistogram::kLeast);
  for (const Step& step : steps) {
    const double size = step.size() / meanIrradiance;
    const double place = ErrorHistogram::kPerDecade * std::log10(std::max(1.0, size / ErrorHistogram::kLeast));
    const double bin = std::min(std::floor(place), ErrorHistogram::kAbsoluteBins - 1.0);
    out.absolute[static_cast<std::size_t>(bin)] += step.positive + step.negative;
    const double across = 0.5 * ErrorHistogram::kSignedBins * size / out.limit;  // bins from 0
    if (!(across < 0.5 * ErrorHistogram::kSignedBins)) {
      out.above += step.positive;
      out.below += step.negative;
      continue;
    }
    const auto signedBin = [&](double side) {
      return static_cast<std::size_t>(
          std::clamp(0.5 * ErrorHistogram::kSignedBins + side * across, 0.0, ErrorHistogram::kSignedBins - 1.0));
    };
    out.signedBins[signedBin(1)] += step.positive;
    out.signedBins[signedBin(-1)] += step.negative;
  }
  return out;
}

std::vector<BodyPartErrors> ErrorSpread::bodyParts(const BodyParts& parts, double meanIrradiance) const {
  std::vector<BodyPartErrors> out;
  for (const BodyParts::Part& part : parts.parts) {
    BodyPartErrors& shown = out.emplace_back();
    shown.name = part.name;
    shown.parent = part.parent;
    shown.nodes = part.nodes;
  }
  double all = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    BodyPartErrors& part = out[static_cast<std::size_t>(parts.ofSample[i])];
    ++part.samples;
    part.mean += points_[i].sum;
    part.share += points_[i].squares;
    part.max = std::max(part.max, points_[i].largest / meanIrradiance);
    all += points_[i].squares;
  }
  for (BodyPartErrors& part : out) {
    if (part.samples == 0) continue;  // parts hang from it
    const double values = 3 * static_cast<double>(part.samples * frames_);
    part.rms = std::sqrt(part.share / values) / meanIrradiance;
    part.mean /= values * meanIrradiance;
    part.share = all > 0 ? part.share / all : 0;
    part.area = static_cast<double>(part.samples) / static_cast<double>(points_.size());
  }
  return out;
}

}  // namespace rigel::tools
