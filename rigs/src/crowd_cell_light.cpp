#include "crowd_cell_light.h"

#include <algorithm>
#include <bit>

namespace rigel::crowd {
namespace {

static_assert(CellLights::kBlockCells * 2 < 65535);

std::size_t hashOf(const Cell& cell) noexcept {
  std::uint64_t h = 0;
  const auto mix = [&](std::uint32_t v) { h = (h ^ v) * 0x9e3779b97f4a7c15u, h ^= h >> 29; };
  mix(static_cast<std::uint32_t>(cell.x));
  mix(static_cast<std::uint32_t>(cell.y));
  mix(static_cast<std::uint32_t>(cell.z));
  mix(static_cast<std::uint32_t>(cell.level));
  mix(cell.groups);
  return static_cast<std::size_t>(h);
}

bool same(const CrowdTree& a, const CrowdTree& b) noexcept {
  const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
  return a.tree == b.tree && bits(a.target) == bits(b.target) && bits(a.cell) == bits(b.cell) &&
         bits(a.wrap) == bits(b.wrap);
}

/// Of uses sorted by their lights: each light once.
void mergeUses(std::vector<LightUse>& uses) noexcept {
  auto last = uses.begin();
  for (const LightUse& use : uses) {
    if (last != uses.begin() && (last - 1)->light == use.light)
      (last - 1)->share = std::min(1.0f, (last - 1)->share + use.share);
    else
      *last++ = use;
  }
  uses.erase(last, uses.end());
}

}  // namespace

void CellLights::Generation::clear() noexcept {
  entries.clear();
  uses.clear();
  std::ranges::fill(slots, std::uint16_t{0});
}

std::size_t CellLights::Generation::slotOf(const Cell& cell) const noexcept {
  std::size_t slot = hashOf(cell) % kSlots;
  while (slots[slot] != 0 && entries[slots[slot] - 1u].cell != cell) slot = (slot + 1) % kSlots;
  return slot;
}

void CellLights::reserve(std::size_t uses, std::size_t rows) {
  const std::size_t list = std::min(uses, kList);
  for (Generation* generation : {&young_, &old_}) {
    generation->entries.reserve(kCells);
    generation->uses.reserve(kUses + list);
    if (4 * rows * kCells > generation->distant.size()) generation->clear();
    generation->distant.reserve(4 * rows * kCells);
    generation->slots.resize(kSlots);
  }
  selection_.nearby.reserve(list);
  selection_.distant.reserve(list);
  far_.reserve(uses, rows);
  slopes_.reserve(4 * rows);
  rows_ = rows;
}

void CellLights::begin(const FrameLights& lights) noexcept {
  asked_ = 0;
  far_.begin();
  const std::uint64_t version = lights.tree().tree->version();
  if (version == version_ && same(tree_, lights.tree())) return;
  version_ = version;
  tree_ = lights.tree();
  young_.clear();
  old_.clear();
  far_.clear();
}

void CellLights::beginBlock() noexcept {
  if (!young_.isFull()) return;
  std::swap(young_, old_);
  young_.clear();
}

template <int B>
std::size_t CellLights::find(const FrameLights& lights, const Cell& cell) {
  if (const std::uint16_t known = young_.slots[young_.slotOf(cell)]; known != 0) return known - 1u;
  if (const std::uint16_t known = old_.slots[old_.slotOf(cell)]; known != 0) {
    const Entry& entry = old_.entries[known - 1u];
    add(entry, std::span(old_.uses).subspan(entry.first, entry.count), old_.distant.data() + 4 * rows_ * (known - 1u));
  } else {
    select<B>(lights, cell);
  }
  return young_.entries.size() - 1;
}

template <int B>
void CellLights::select(const FrameLights& lights, const Cell& cell) {
  const FarLight& far = far_.find<B>(lights, cell);
  const CellBall ball = ballOf(cell, tree_.cell);
  LightQuery query;
  query.centre = ball.centre;
  query.radius = ball.radius;
  query.target = tree_.target;
  query.wrap = tree_.wrap;
  query.groups = cell.groups;
  query.everywhere = true;
  tree_.tree->select(query, &far.rest, selection_);
  ++asked_;

  Entry entry;
  entry.cell = cell;
  const auto isSingle = [&](const LightUse& use) { return use.light < static_cast<std::uint32_t>(lights.count()); };
  std::ranges::sort(selection_.nearby, {}, &LightUse::light);
  mergeUses(selection_.nearby);
  const auto count = [&](const std::vector<LightUse>& uses) { return std::ranges::count_if(uses, isSingle); };
  entry.single = static_cast<std::size_t>(count(selection_.nearby));
  const auto singles = static_cast<int>(entry.single) + static_cast<int>(count(selection_.distant));
  const auto all = static_cast<int>(selection_.nearby.size() + selection_.distant.size());
  entry.rest.lights = singles + far.lights;
  entry.rest.clusters = all - singles + far.clusters;
  entry.rest.centre = ball.centre;
  entry.rest.bound = selection_.bound;
  entry.rest.mean = selection_.mean;
  entry.distant = far.lights + far.clusters > 0 || !selection_.distant.empty();
  if (entry.distant) {
    std::fill_n(slopes_.data(), 4 * rows_, 0.0f);
    addSlopes(far, rows_, ball.centre, slopes_.data());
    addSlopes(projectFar<B>(far.parts, ball.centre), slopes_.data());
    addSlopes(projectFar<B>(lights.prepared(), selection_.distant, ball.centre), slopes_.data());
  }
  add(entry, selection_.nearby, slopes_.data());
}

void CellLights::add(const Entry& entry, std::span<const LightUse> near, const float* distant) {
  Entry own = entry;
  own.first = young_.uses.size();
  own.count = near.size();
  young_.uses.insert(young_.uses.end(), near.begin(), near.end());
  std::copy_n(distant, 4 * rows_, young_.distant.data() + 4 * rows_ * young_.entries.size());
  const std::size_t slot = young_.slotOf(entry.cell);
  young_.entries.push_back(own);
  young_.slots[slot] = static_cast<std::uint16_t>(young_.entries.size());
}

CellLight CellLights::operator[](std::size_t number) const noexcept {
  const Entry& entry = young_.entries[number];
  CellLight light = entry.rest;
  light.near = std::span(young_.uses).subspan(entry.first, entry.count);
  light.single = light.near.first(entry.single);
  if (entry.distant) light.distant = young_.distant.data() + 4 * rows_ * number;
  return light;
}

std::size_t CellLights::bytes() const noexcept {
  const auto of = [](const Generation& g) {
    return g.entries.capacity() * sizeof(Entry) + g.uses.capacity() * sizeof(LightUse) + g.distant.bytes() +
           g.slots.capacity() * sizeof(std::uint16_t);
  };
  return of(young_) + of(old_) + (selection_.nearby.capacity() + selection_.distant.capacity()) * sizeof(LightUse) +
         slopes_.bytes() + far_.bytes();
}

template std::size_t CellLights::find<2>(const FrameLights&, const Cell&);
template std::size_t CellLights::find<3>(const FrameLights&, const Cell&);
template std::size_t CellLights::find<4>(const FrameLights&, const Cell&);
template std::size_t CellLights::find<5>(const FrameLights&, const Cell&);

}  // namespace rigel::crowd
