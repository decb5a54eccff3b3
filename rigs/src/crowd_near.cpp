#include "crowd_near.h"

#include <algorithm>
#include <array>

#include "crowd_block.h"
#include "weights.h"

namespace rigel::crowd {
namespace {

float visible(float weight) noexcept { return weight > kLeastWeight ? weight : 0.0f; }

}  // namespace

int findLight(std::span<const std::uint32_t> ids, std::uint32_t id, int hint) noexcept {
  if (hint >= 0 && static_cast<std::size_t>(hint) < ids.size() && ids[hint] == id) return hint;
  const auto found = std::ranges::find(ids, id);
  return found == ids.end() ? -1 : static_cast<int>(found - ids.begin());
}

void updateNear(const NearView& view, std::span<NearSlot> slots) noexcept {
  if (view.cut) std::ranges::fill(slots, NearSlot{});
  const auto errorOf = [&](int light) { return view.errors[static_cast<std::ptrdiff_t>(light) * kBlock]; };
  std::array<int, kMaxCrowdNear> wanted;
  int waiting = 0;
  for (const int light : view.above) wanted[waiting++] = light;

  for (NearSlot& slot : slots) {
    if (slot.light < 0) continue;
    slot.from = slot.to;
    slot.light = findLight(view.ids, slot.id, slot.light);
    if (slot.light < 0) {
      slot = {};
      continue;
    }
    const float target = nearWeight(errorOf(slot.light), view.floor);
    slot.to = visible(slot.from + std::clamp(target - slot.from, -view.step, view.step));
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
      const float more = errorOf(wanted[i]) - errorOf(wanted[next]);
      if (more > 0 || (more == 0 && wanted[i] < wanted[next])) next = i;
    }
    const int light = wanted[next];
    wanted[next] = wanted[--waiting];
    const bool limited = !view.cut && view.fresh[light] == 0;
    const float target = nearWeight(errorOf(light), view.floor);
    const float weight = visible(limited ? std::min(target, view.step) : target);
    if (weight == 0) continue;
    *free = {view.ids[light], light, view.cut || view.atOnce ? weight : 0.0f, weight};
  }
}

}  // namespace rigel::crowd
