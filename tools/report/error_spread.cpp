#include "report/error_spread.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace rigel::tools {
namespace {

constexpr std::uint32_t kSteps = 1u << 15;  // of magnitudes; those with the sign bit follow

/// The magnitudes of step i: from start(i) to start(i+1).
double start(std::uint32_t step) { return static_cast<double>(std::bit_cast<float>(step << 16)); }

/// Where `share` of all magnitudes lie below.
double percentile(std::span<const std::uint32_t> counts, double share) {
  double all = 0, below = 0;
  for (const std::uint32_t count : counts) all += count;
  for (std::uint32_t step = 0; step < kSteps; ++step) {
    const double here = static_cast<double>(counts[step]) + counts[step + kSteps];
    if (below + here >= share * all && here > 0)
      return step == 0 ? 0 : std::lerp(start(step), start(step + 1), (share * all - below) / here);
    below += here;
  }
  return 0;
}

}  // namespace

void ErrorSpread::add(std::span<const Rgb> errors) {
  points_.resize(errors.size());
  ++frames_;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      ++counts_[std::bit_cast<std::uint32_t>(errors[i][c]) >> 16];
      const auto error = static_cast<double>(errors[i][c]);
      points_[i].sum += error;
      points_[i].squares += error * error;
      points_[i].largest = std::max(points_[i].largest, std::abs(error));
    }
  }
}

ErrorHistogram ErrorSpread::histogram(double meanIrradiance) const {
  ErrorHistogram out;
  out.p50 = percentile(counts_, 0.5) / meanIrradiance;
  out.p90 = percentile(counts_, 0.9) / meanIrradiance;
  out.p99 = percentile(counts_, 0.99) / meanIrradiance;
  out.limit = std::max(out.p99, ErrorHistogram::kLeast);
  for (std::uint32_t step = 0; step < kSteps; ++step) {
    const std::uint32_t positive = counts_[step], negative = counts_[step + kSteps];
    if (positive + negative == 0) continue;
    const double size = step == 0 ? 0 : 0.5 * (start(step) + start(step + 1)) / meanIrradiance;
    const double place = ErrorHistogram::kPerDecade * std::log10(std::max(1.0, size / ErrorHistogram::kLeast));
    const double bin = std::min(std::floor(place), ErrorHistogram::kAbsoluteBins - 1.0);
    out.absolute[static_cast<std::size_t>(bin)] += positive + negative;
    const double across = 0.5 * ErrorHistogram::kSignedBins * size / out.limit;  // bins from 0
    if (!(across < 0.5 * ErrorHistogram::kSignedBins)) {
      out.above += positive;
      out.below += negative;
      continue;
    }
    const auto signedBin = [&](double side) {
      return static_cast<std::size_t>(
          std::clamp(0.5 * ErrorHistogram::kSignedBins + side * across, 0.0, ErrorHistogram::kSignedBins - 1.0));
    };
    out.signedBins[signedBin(1)] += positive;
    out.signedBins[signedBin(-1)] += negative;
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
