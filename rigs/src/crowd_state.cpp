#include "crowd_state.h"

#include <algorithm>

#include "crowd_cells.h"

namespace rigel::crowd {
namespace {

constexpr std::uint32_t kShownBlock = 64;  // characters that are packed only
constexpr std::size_t kPlanAhead = 16;     // characters on their way from memory

/// The interval of a character from now on: it rises at once and falls by halves, so that what lags catches up at twice
/// its speed and not in one frame.
int nextInterval(const Character& c) noexcept {
  const int wanted = std::clamp(c.input.interval, 1, kMaxCrowdInterval);
  return c.lit ? std::max(wanted, c.interval / 2) : wanted;
}

/// Frames to the next update: those of one interval are spread over its frames.
int framesToUpdate(std::uint64_t frame, std::size_t index, int interval) noexcept {
  if (interval == 1) return 1;  // and nothing is divided
  const auto n = static_cast<std::uint64_t>(interval);
  return static_cast<int>(n - (frame + index) % n);
}

}  // namespace

void Population::grow() {
  const std::size_t count = characters.size() + 1;
  if (count > characters.capacity()) characters.reserve(2 * count);
  free.reserve(characters.capacity());
  near.resize(count * nearSlots());
  results.resize(2 * count * floats());
  characters.emplace_back();
  free.push_back(static_cast<std::uint32_t>(count - 1));
}

std::uint32_t Population::take() noexcept {
  const std::uint32_t i = free.back();
  free.pop_back();
  const std::uint32_t generation = characters[i].generation;
  characters[i] = {};
  characters[i].generation = generation;
  characters[i].alive = true;
  std::ranges::fill(nearOf(i), NearSlot{});
  return i;
}

void Population::remove(std::uint32_t i) noexcept {
  Character& c = characters[i];
  c.alive = false;
  if (++c.generation == 0) c.generation = 1;
  free.push_back(i);
}

std::size_t Population::bytesPerCharacter() const noexcept {
  return sizeof(Character) + nearSlots() * sizeof(NearSlot) + 2 * floats() * sizeof(float) + 3 * sizeof(std::uint32_t) +
         16;  // free, order, shown, places
}

void Schedule::reserve(std::span<const Population> populations) {
  std::size_t characters = 0, most = 0;
  for (const Population& p : populations) {
    characters += p.characters.capacity();
    most = std::max(most, p.characters.capacity());
  }
  order_.reserve(characters);
  shown_.reserve(most);
  blocks_.reserve(2 * characters / kBlock + 3 * populations.size());
}

/// Of the characters in order_ from `begin` on.
void Schedule::addBlocks(std::uint32_t population, std::size_t begin, std::uint32_t size, bool update) {
  const auto end = static_cast<std::uint32_t>(order_.size());
  for (auto i = static_cast<std::uint32_t>(begin); i < end; i += size)
    blocks_.push_back({population, i, std::min(size, end - i), update});
}

/// The same, of those who are close together: where a block is half full, it ends with the cell.
void Schedule::addBlocksByPlace(const Population& of, std::uint32_t population, std::size_t begin, float cell) {
  places_.clear();
  for (std::size_t i = begin; i < order_.size(); ++i)
    places_.push_back({placeKey(of.characters[order_[i]].input.worldFromRig.origin, cell), order_[i]});
  std::ranges::sort(places_);
  Block block{population, static_cast<std::uint32_t>(begin), 0, true};
  for (std::size_t i = 0; i < places_.size(); ++i) {
    order_[begin + i] = places_[i].character;
    const bool newCell = i > 0 && places_[i].key >> kPlaceBits != places_[i - 1].key >> kPlaceBits;
    if (block.count == kBlock || (newCell && block.count >= kBlock / 2)) {
      blocks_.push_back(block);
      block.begin += block.count;
      block.count = 0;
    }
    ++block.count;
  }
  if (block.count > 0) blocks_.push_back(block);
}

CrowdStats Schedule::plan(std::span<Population> populations, std::uint64_t frame, float seconds, bool cut,
                          float cell) noexcept {
  CrowdStats stats;
  blocks_.clear();
  order_.clear();
  std::size_t offset = 0, near = 0;
  for (std::size_t p = 0; p < populations.size(); ++p) {
    Population& population = populations[p];
    const auto vectors = population.floats() / 4;
    const std::size_t begin = order_.size();
    shown_.clear();
    for (std::size_t i = 0; i < population.characters.size(); ++i) {
      Character& c = population.characters[i];
      __builtin_prefetch(&(&c)[std::min(kPlanAhead, population.characters.size() - 1 - i)].input.groups, 1);
      if (!c.alive) continue;
      if (!c.input.visible) {
        c.lit = false;
        c.result = {};
        continue;
      }
      c.result = {stats.visible++, static_cast<int>(near), 0};
      c.offset = offset;
      offset += vectors;
      near += population.nearSlots();
      c.seconds += seconds;
      if (cut || c.input.cut) c.lit = false;
      c.input.cut = false;
      if (c.lit && ++c.step < c.span) {
        shown_.push_back(static_cast<std::uint32_t>(i));
        continue;
      }
      c.interval = nextInterval(c);
      c.span = framesToUpdate(frame, i, c.interval);
      c.step = 0;
      order_.push_back(static_cast<std::uint32_t>(i));
    }
    stats.updated += static_cast<int>(order_.size() - begin);
    if (cell > 0) {
      addBlocksByPlace(population, static_cast<std::uint32_t>(p), begin, cell);
    } else {
      addBlocks(static_cast<std::uint32_t>(p), begin, kBlock, true);
    }
    const std::size_t rest = order_.size();
    order_.insert(order_.end(), shown_.begin(), shown_.end());
    addBlocks(static_cast<std::uint32_t>(p), rest, kShownBlock, false);
  }
  return stats;
}

}  // namespace rigel::crowd
