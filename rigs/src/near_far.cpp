#include <rigel/near_far.h>

#include <algorithm>
#include <cassert>
#include <functional>
#include <limits>

#include "approach.h"
#include "weights.h"

namespace rigel {
namespace {

/// NaN and negative values become 0, infinities `largest`.
float held(float value, float largest) noexcept { return value > 0 ? std::min(value, largest) : 0.0f; }

}  // namespace

void NearFar::reset() noexcept { cut_ = true; }

void NearFar::update(std::span<const float> errors, std::span<const std::uint32_t> ids, float seconds) {
  const std::size_t slots = slotCount();
  rank_.resize(errors.size());
  for (std::size_t i = 0; i < errors.size(); ++i) rank_[i] = held(errors[i], std::numeric_limits<float>::max());

  float floor = held(options_.tolerance, std::numeric_limits<float>::max());
  wanted_ = rank_;
  if (slots < wanted_.size()) {
    const auto next = wanted_.begin() + static_cast<std::ptrdiff_t>(slots);
    std::nth_element(wanted_.begin(), next, wanted_.end(), std::greater<>());
    floor = std::max(floor, *next);
  }
  for (std::size_t i = 0; i < rank_.size(); ++i) wanted_[i] = nearWeight(rank_[i], floor);
  advance(ids, seconds);
}

void NearFar::follow(std::span<const float> weights, std::span<const std::uint32_t> ids, float seconds,
                     std::span<const float> errors) {
  assert(errors.empty() || errors.size() == weights.size());
  wanted_.resize(weights.size());
  rank_.resize(weights.size());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    wanted_[i] = held(weights[i], 1);
    // Where errors are unknown every light counts as one of which something was in the rig.
    rank_[i] = errors.empty() ? 1 + wanted_[i] : held(errors[i], std::numeric_limits<float>::max());
  }
  advance(ids, seconds);
}

std::size_t NearFar::slotCount() const noexcept {
  return static_cast<std::size_t>(std::clamp(options_.slots, 0, kMaxNearLights));
}

void NearFar::advance(std::span<const std::uint32_t> ids, float seconds) {
  if (!(seconds > 0 && seconds <= std::numeric_limits<float>::max())) cut_ = true;
  if (cut_) last_.clear();
  cut_ = false;
  listLights(ids);
  recallWeights();

  const float rate = options_.weightRate;
  const float step = rate > 0 ? std::min(rate * seconds, 1.0f) : 1.0f;
  seconds_ = seconds;
  slots_.assign(slotCount(), -1);
  weights_.assign(wanted_.size(), 0.0f);
  moveHolders(step);
  serveNewcomers(step);
  for (const Known& light : lights_) weights_[light.index] = light.weight;
  last_.swap(lights_);
}

void NearFar::listLights(std::span<const std::uint32_t> ids) {
  assert(ids.empty() || ids.size() == wanted_.size());
  lights_.resize(wanted_.size());
  // Swapped with lights_ at the end of the frame.
  last_.reserve(wanted_.size());
  waiting_.reserve(wanted_.size());
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    lights_[i] = {};
    lights_[i].id = i < ids.size() ? ids[i] : static_cast<std::uint32_t>(i);
    lights_[i].index = static_cast<int>(i);
    lights_[i].counts = rank_[i] > 0;
  }
  const auto before = [](const Known& a, const Known& b) { return a.id != b.id ? a.id < b.id : a.index < b.index; };
  if (!std::is_sorted(lights_.begin(), lights_.end(), before)) std::sort(lights_.begin(), lights_.end(), before);
}

void NearFar::recallWeights() noexcept {
  auto old = last_.begin();
  for (Known& light : lights_) {
    while (old != last_.end() && old->id < light.id) ++old;
    if (old == last_.end() || old->id != light.id) continue;
    light.weight = old->weight;
    light.slot = old->slot;
    light.fades = old->counts && light.counts;
    ++old;
  }
}

float NearFar::moved(const Known& light, float step) const noexcept {
  const float wanted = wanted_[light.index];
  if (!light.fades) return wanted;
  const float change = approach(wanted - light.weight, options_.approachRate, seconds_);
  return light.weight + std::clamp(change, -step * options_.fallShare, step);
}

void NearFar::moveHolders(float step) noexcept {
  for (Known& light : lights_) {
    if (light.slot >= static_cast<int>(slots_.size())) light.slot = -1;
    if (light.slot >= 0) light.weight = moved(light, step);
    if (light.slot < 0 || !(light.weight > kLeastWeight)) {
      light.slot = -1;
      light.weight = 0;
      continue;
    }
    slots_[light.slot] = light.index;
  }
}

void NearFar::serveNewcomers(float step) {
  waiting_.clear();
  for (std::size_t k = 0; k < lights_.size(); ++k)
    if (lights_[k].slot < 0 && wanted_[lights_[k].index] > 0) waiting_.push_back(static_cast<int>(k));
  const auto first = [this](int a, int b) {
    const int i = lights_[a].index, j = lights_[b].index;
    return rank_[i] != rank_[j] ? rank_[i] > rank_[j] : i < j;
  };
  std::sort(waiting_.begin(), waiting_.end(), first);

  int slot = 0;
  for (const int k : waiting_) {
    while (slot < static_cast<int>(slots_.size()) && slots_[slot] >= 0) ++slot;
    if (slot == static_cast<int>(slots_.size())) return;
    Known& light = lights_[k];
    const float weight = moved(light, step);
    if (!(weight > kLeastWeight)) continue;
    light.slot = slot;
    light.weight = weight;
    slots_[slot] = light.index;
  }
}

}  // namespace rigel
