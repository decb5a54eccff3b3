#include "crowd_near.h"

#include <algorithm>
#include <array>

#include "crowd_block.h"
#include "weights.h"

namespace rigel::crowd {
namespace {

float visible(float weight) noexcept { return weight > kLeastWeight ? weight : 0.0f; }

/// Errors and shares by the number of a light.
class Rows {
 public:
  explicit Rows(const NearView& view) noexcept : view_(view) {}

  int lightOf(int row) const noexcept { return view_.shares == nullptr ? row : static_cast<int>(view_.listed[row]); }
  float errorOf(int light) const noexcept {
    const std::ptrdiff_t row = rowOfLight(light);
    return row < 0 ? 0 : view_.errors[row * kBlock];
  }
  /// Most that its weight can be.
  float mostOf(int light) const noexcept {
    if (view_.shares == nullptr) return 1;
    // Of what is masked nothing is in the rig: it may fade.
    if ((view_.lights->groups(light) & view_.groups) == 0) return 1;
    const std::ptrdiff_t row = rowOfLight(light);
    return row < 0 ? 0 : std::min(view_.shares[row * kBlock], 1.0f);
  }

 private:
  std::ptrdiff_t rowOfLight(int light) const noexcept {
    return view_.shares == nullptr ? light : rowOf(view_.listed, static_cast<std::uint32_t>(light));
  }
  const NearView& view_;
};

}  // namespace

std::ptrdiff_t rowOf(std::span<const std::uint32_t> listed, std::uint32_t light) noexcept {
  const auto found = std::ranges::lower_bound(listed, light);
  return found != listed.end() && *found == light ? found - listed.begin() : -1;
}

int findLight(std::span<const std::uint32_t> ids, std::uint32_t id, int hint) noexcept {
  const auto count = static_cast<std::ptrdiff_t>(ids.size());
  if (hint >= 0 && hint < count && ids[hint] == id) return hint;
  // Where few lights come and go, the others move by little.
  constexpr std::ptrdiff_t kBeside = 64;
  const std::ptrdiff_t begin = std::clamp<std::ptrdiff_t>(hint - kBeside, 0, count);
  const std::ptrdiff_t end = std::clamp<std::ptrdiff_t>(hint + kBeside, begin, count);
  const auto beside = std::find(ids.begin() + begin, ids.begin() + end, id);
  if (beside != ids.begin() + end) return static_cast<int>(beside - ids.begin());
  const auto found = std::ranges::find(ids, id);
  return found == ids.end() ? -1 : static_cast<int>(found - ids.begin());
}

void updateNear(const NearView& view, std::span<NearSlot> slots) noexcept {
  if (view.cut) std::ranges::fill(slots, NearSlot{});
  const Rows rows(view);
  std::array<int, kMaxCrowdNear> wanted;
  int waiting = 0;
  for (const int row : view.above) wanted[waiting++] = rows.lightOf(row);

  for (NearSlot& slot : slots) {
    if (slot.light < 0) continue;
    slot.from = slot.to;
    slot.light = findLight(view.ids, slot.id, slot.light);
    if (slot.light < 0) {
      slot = {};
      continue;
    }
    const float target = nearWeight(rows.errorOf(slot.light), view.floor);
    const float next = slot.from + std::clamp(target - slot.from, -view.step, view.step);
    slot.to = visible(std::min(next, rows.mostOf(slot.light)));
    for (int i = 0; i < waiting; ++i)
      if (wanted[i] == slot.light) wanted[i--] = wanted[--waiting];
    if (view.atOnce) slot.from = slot.to;
    if (slot.from == 0 && slot.to == 0) slot = {};
  }

  auto free = slots.begin();
  while (waiting > 0) {
    while (free != slots.end() && free->light >= 0) ++free;
    if (free == slots.end()) return;
    // The largest error first.
    int next = 0;
    for (int i = 1; i < waiting; ++i) {
      const float more = rows.errorOf(wanted[i]) - rows.errorOf(wanted[next]);
      if (more > 0 || (more == 0 && wanted[i] < wanted[next])) next = i;
    }
    const int light = wanted[next];
    wanted[next] = wanted[--waiting];
    const bool limited = !view.cut && !std::ranges::binary_search(view.fresh, view.ids[light]);
    const float target = std::min(nearWeight(rows.errorOf(light), view.floor), rows.mostOf(light));
    const float weight = visible(limited ? std::min(target, view.step) : target);
    if (weight == 0) continue;
    *free = {view.ids[light], light, view.cut || view.atOnce ? weight : 0.0f, weight};
  }
}

}  // namespace rigel::crowd
