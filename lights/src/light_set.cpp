#include <rigel/light.h>

namespace rigel {
namespace {

template <class... Arrays>
void clearAll(Arrays&... arrays) noexcept {
  (arrays.clear(), ...);
}

template <class... Arrays>
void reserveAll(std::size_t count, Arrays&... arrays) {
  (arrays.reserve(count), ...);
}

}  // namespace

void LightSet::clear() noexcept {
  clearAll(directional_.dx, directional_.dy, directional_.dz, directional_.r, directional_.g, directional_.b);
  for (Local* l : {&point_, &spot_, &sphere_}) clearAll(l->x, l->y, l->z, l->radius, l->range, l->r, l->g, l->b);
  clearAll(cone_.dx, cone_.dy, cone_.dz, cone_.inner, cone_.outer);
}

void LightSet::reserve(int perKind) {
  const auto n = static_cast<std::size_t>(perKind);
  reserveAll(n, directional_.dx, directional_.dy, directional_.dz, directional_.r, directional_.g, directional_.b);
  for (Local* l : {&point_, &spot_, &sphere_}) reserveAll(n, l->x, l->y, l->z, l->radius, l->range, l->r, l->g, l->b);
  reserveAll(n, cone_.dx, cone_.dy, cone_.dz, cone_.inner, cone_.outer);
}

}  // namespace rigel
