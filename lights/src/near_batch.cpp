// As near_irradiance.cpp, on all lanes: a block of points at a time, first what they see of a light, then its cap, by
// the text of shader_near_cap.h. Vectors to a light are floats, their difference rounded once; what is closer than
// sqrt(2) radii, where d^2 - r^2 cancels, is seen once more in double. Where floats do not hold a square, and for
// normals that are none, the scalar function serves.
#include <rigel/near_batch.h>
#include <rigel/project.h>
#include <rigel/shader_near_cap.h>

#include <algorithm>
#include <cassert>
#include <cstring>

#include "disk_batch_light.h"
#include "point_block.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "near_batch.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "disk_batch_kernels.h"

#include "near_lanes.h"

#include "block_lanes.h"
#include "lane_modulation.h"

HWY_BEFORE_NAMESPACE();
namespace rigel::HWY_NAMESPACE {

namespace {

using Kind = NearLight::Kind;

/// d^2 + r^2 between these is served in floats.
constexpr float kMinSquare = 1e-30f, kMaxSquare = 1e36f;

/// A light and a material, what they would be divided by divided.
struct NearTerms {
  Kind kind;
  Vec3 position, axis;
  float radius, radiusSquare;
  float closeSquare;  // closer, it is seen in double
  float inverseRangeSquare;
  float cosOuter, inverseConeWidth;
  float amount;       // share, times pi or Lambert's gain where they count
  float wholeSphere;  // the cap from within all of a sphere

  NearTerms(const NearLight& light, const NearWrap& wrap)
      : kind(light.kind),
        position(light.position),
        axis(light.axis),
        radius(light.radius),
        radiusSquare(light.radius * light.radius),
        closeSquare(2 * radiusSquare),
        inverseRangeSquare(static_cast<float>(1 / (static_cast<double>(light.range) * light.range))),
        cosOuter(light.cosOuter),
        inverseConeWidth(1 / std::max(light.cosInner - light.cosOuter, kMinConeWidth)),
        amount(light.share),
        wholeSphere(wrap.a == 0 ? 1 : wrap.f.x) {
    if (kind == Kind::sphere) amount *= static_cast<float>(kRigelPi);
    if (wrap.a == 0) amount *= wrap.gain;
  }
};

/// The irradiance is base + factor times a cap, of x, s and c (shader_near_cap.h).
enum SeenRow { kX, kS, kC, kBase, kFactor, kSeenRows };

struct Seen {
  using Rows = BlockRows<kSeenRows>;
  Lane x, s, c, base, factor;

  Seen() = default;
  HWY_INLINE Seen(const Rows& from, std::size_t i)
      : x(Lane::load(from.row[kX] + i)),
        s(Lane::load(from.row[kS] + i)),
        c(Lane::load(from.row[kC] + i)),
        base(Lane::load(from.row[kBase] + i)),
        factor(Lane::load(from.row[kFactor] + i)) {}

  HWY_INLINE void store(Rows& to, std::size_t i) const {
    x.store(to.row[kX] + i);
    s.store(to.row[kS] + i);
    c.store(to.row[kC] + i);
    base.store(to.row[kBase] + i);
    factor.store(to.row[kFactor] + i);
  }

  HWY_INLINE LaneMask crossed() const { return abs(x) < s; }
  HWY_INLINE Lane whole() const { return mulAdd(factor, max(x, Lane(0.0f)), base); }
  HWY_INLINE Lane clipped() const { return mulAdd(factor, lambertCap(x, s, c), base); }
  HWY_INLINE Lane wrapped(const NearWrap& wrap) const { return mulAdd(factor, wrapCap(x, s, c, wrap), base); }
};

/// What multiplies the cap but for the angular size of a sphere. `inverse`: of the larger of d and r.
template <Kind K>
HWY_INLINE Lane modulation(const NearTerms& light, Lane square, Lane inverse, Lane cosine) {
  Lane scale(light.amount);
  if constexpr (K != Kind::sphere) {
    scale *= inverse * inverse;
    if (light.inverseRangeSquare > 0) scale *= rangeWindow(square, light.inverseRangeSquare);
  }
  if constexpr (K == Kind::spot) scale *= smoothStep((cosine - Lane(light.cosOuter)) * Lane(light.inverseConeWidth));
  return scale;
}

/// A vector of points of which one is close to a light or inside.
template <Kind K>
HWY_NOINLINE void seeClose(const NearTerms& light, const SurfaceRows& surface, std::size_t i, Seen& out) {
  float dx[Lane::kCount], dy[Lane::kCount], dz[Lane::kCount], squares[Lane::kCount], gaps[Lane::kCount];
  const DoubleLane px(light.position.x), py(light.position.y), pz(light.position.z);
  const DoubleLane r2(static_cast<double>(light.radius) * static_cast<double>(light.radius));
  for (std::size_t k = 0; k < Lane::kCount; k += DoubleLane::kCount) {
    const DoubleLane x = px - loadWidened(surface.row[0] + i + k), y = py - loadWidened(surface.row[1] + i + k),
                     z = pz - loadWidened(surface.row[2] + i + k);
    const DoubleLane square = x * x + y * y + z * z;
    storeNarrowed(x, dx + k);
    storeNarrowed(y, dy + k);
    storeNarrowed(z, dz + k);
    storeNarrowed(square, squares + k);
    storeNarrowed(square - r2, gaps + k);
  }
  const Lane square = Lane::load(squares), gap = Lane::load(gaps), radius(light.radius);
  const Lane d = sqrt(square), reach = max(d, radius), inverse = Lane(1.0f) / reach;
  const LaneMask inside = gap < Lane(0.0f);
  const Lane towards = select(inside, Lane(1.0f) / max(d, Lane(1e-37f)), inverse);
  const Lane wx = Lane::load(dx) * towards, wy = Lane::load(dy) * towards, wz = Lane::load(dz) * towards;
  const Lane nx = Lane::load(surface.row[3] + i), ny = Lane::load(surface.row[4] + i),
             nz = Lane::load(surface.row[5] + i);
  const Lane facing = clamp(mulAdd(nx, wx, mulAdd(ny, wy, nz * wz)), Lane(-1.0f), Lane(1.0f));
  out.s = min(d, radius) * inverse;
  out.c = sqrt(abs(gap)) * inverse;
  out.x = select(inside, -facing, facing);
  Lane cosine(0.0f);
  if constexpr (K == Kind::spot) {
    cosine = -mulAdd(Lane(light.axis.x), wx, mulAdd(Lane(light.axis.y), wy, Lane(light.axis.z) * wz));
    cosine = select(inside, cosine * out.s, cosine);
  }
  const Lane s2 = out.s * out.s, scale = modulation<K>(light, square, inverse, cosine);
  out.base = select(inside, Lane(light.wholeSphere) * scale, Lane(0.0f));
  out.factor = select(inside, -(scale * s2), K == Kind::sphere ? scale * s2 : scale);
}

/// A bit for each lane.
HWY_INLINE std::uint64_t bitsOf(LaneMask mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(Lane::Tag(), mask.mask, bytes);
  std::uint64_t bits = 0;
  std::memcpy(&bits, bytes, sizeof bits);
  return bits;
}

static_assert(kPointBlock <= 64);
constexpr std::uint64_t kAllBits = Lane::kCount == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << Lane::kCount) - 1;

/// The points that scalars are to serve, a bit each.
template <Kind K>
HWY_NOINLINE std::uint64_t seeBlock(const NearTerms& light, const SurfaceRows& surface, std::size_t points,
                                    Seen::Rows& seen) {
  const Lane one(1.0f), radiusSquare(light.radiusSquare);
  std::uint64_t left = 0;
  for (std::size_t i = 0; i < points; i += Lane::kCount) {
    const Lane nx = Lane::load(surface.row[3] + i), ny = Lane::load(surface.row[4] + i),
               nz = Lane::load(surface.row[5] + i);
    const Lane dx = Lane(light.position.x) - Lane::load(surface.row[0] + i),
               dy = Lane(light.position.y) - Lane::load(surface.row[1] + i),
               dz = Lane(light.position.z) - Lane::load(surface.row[2] + i);
    const Lane square = mulAdd(dx, dx, mulAdd(dy, dy, dz * dz));
    const Lane inverse = inverseRoot(square);
    const Lane facing = mulAdd(nx, dx, mulAdd(ny, dy, nz * dz)) * inverse;
    Seen at;
    at.x = clamp(facing, -one, one);
    at.s = Lane(light.radius) * inverse;
    const Lane s2 = at.s * at.s;
    at.c = root(one - s2);
    Lane cosine(0.0f);
    if constexpr (K == Kind::spot)
      cosine = -mulAdd(Lane(light.axis.x), dx, mulAdd(Lane(light.axis.y), dy, Lane(light.axis.z) * dz)) * inverse;
    const Lane scale = modulation<K>(light, square, inverse, cosine);
    at.base = Lane(0.0f);
    at.factor = K == Kind::sphere ? scale * s2 : scale;

    const LaneMask apart = square >= Lane(light.closeSquare);
    if (HWY_UNLIKELY(!all(apart))) {
      Seen close;
      seeClose<K>(light, surface, i, close);
      at.x = select(apart, at.x, close.x);
      at.s = select(apart, at.s, close.s);
      at.c = select(apart, at.c, close.c);
      at.base = select(apart, at.base, close.base);
      at.factor = select(apart, at.factor, close.factor);
    }
    // Also false for NaN. A close light's own square may vanish: what is left of a normal is then seen in n alone.
    const Lane sum = square + radiusSquare, size = abs(nx) + abs(ny) + abs(nz);
    const LaneMask served = sum >= Lane(kMinSquare) && sum <= Lane(kMaxSquare) && size < Lane(4.0f);
    if (HWY_UNLIKELY(!all(served))) left |= (~bitsOf(served) & kAllBits) << i;
    at.store(seen, i);
  }
  return left;
}

/// A sphere of no size.
template <>
HWY_NOINLINE std::uint64_t seeBlock<Kind::directional>(const NearTerms& light, const SurfaceRows& surface,
                                                       std::size_t points, Seen::Rows& seen) {
  std::uint64_t left = 0;
  for (std::size_t i = 0; i < points; i += Lane::kCount) {
    const Lane nx = Lane::load(surface.row[3] + i), ny = Lane::load(surface.row[4] + i),
               nz = Lane::load(surface.row[5] + i);
    const Lane facing =
        mulAdd(nx, Lane(light.position.x), mulAdd(ny, Lane(light.position.y), nz * Lane(light.position.z)));
    Seen at;
    at.x = clamp(facing, Lane(-1.0f), Lane(1.0f));
    at.s = at.base = Lane(0.0f);
    at.c = Lane(1.0f);
    at.factor = Lane(light.amount);
    const LaneMask served = abs(nx) + abs(ny) + abs(nz) < Lane(4.0f);
    if (HWY_UNLIKELY(!all(served))) left |= (~bitsOf(served) & kAllBits) << i;
    at.store(seen, i);
  }
  return left;
}

HWY_INLINE std::uint64_t seeAny(const NearTerms& light, const SurfaceRows& surface, std::size_t points,
                                Seen::Rows& seen) {
  switch (light.kind) {
    case Kind::directional:
      return seeBlock<Kind::directional>(light, surface, points, seen);
    case Kind::point:
      return seeBlock<Kind::point>(light, surface, points, seen);
    case Kind::spot:
      return seeBlock<Kind::spot>(light, surface, points, seen);
    default:
      return seeBlock<Kind::sphere>(light, surface, points, seen);
  }
}

/// Irradiance over the light's colour.
HWY_NOINLINE void irradianceBlock(const NearLight& light, const SurfaceRows& surface, std::size_t points,
                                  const NearWrap& wrap, float* irradiance) {
  Seen::Rows seen;
  std::uint64_t left = seeAny(NearTerms(light, wrap), surface, points, seen);
  if (wrap.a == 0) {
    irradianceOf<Seen>(seen, points, irradiance);
  } else {
    for (std::size_t i = 0; i < points; i += Lane::kCount) Seen(seen, i).wrapped(wrap).store(irradiance + i);
  }
  if (HWY_LIKELY(left == 0)) return;
  NearLight white = light;
  white.colour = {1, 1, 1};
  for (std::size_t i = 0; left != 0; ++i, left >>= 1) {
    if ((left & 1) == 0) continue;
    const auto& row = surface.row;
    irradiance[i] = nearIrradiance(white, {row[0][i], row[1][i], row[2][i]}, {row[3][i], row[4][i], row[5][i]}, wrap).r;
  }
}

/// sum += colour * factor, each term held; `sum` has rows of kPointBlock.
HWY_NOINLINE void addColoured(Rgb colour, const float* factor, std::size_t points, float* sum) {
  const Lane most(kMaxProjectionScale);
  for (std::size_t i = 0; i < points; i += Lane::kCount) {
    const Lane f = Lane::load(factor + i);
    for (int k = 0; k < 3; ++k) {
      float* const at = sum + static_cast<std::size_t>(k) * kPointBlock + i;
      (Lane::load(at) + clamp(Lane(colour[k]) * f, -most, most)).store(at);
    }
  }
}

}  // namespace

/// A whole number of vectors of a block's points; `sum` has rows of kPointBlock.
void addNearLights(std::span<const NearLight> lights, const SurfaceRows& surface, std::size_t points,
                   const NearWrap& wrap, float* sum) {
  float irradiance[BlockRows<1>::kRoom];
  for (const NearLight& light : lights) {
    if (!(light.share > 0)) continue;
    Rgb colour = light.colour;
    if (light.kind == Kind::disk) {
      const DiskBatchLight disk(light);
      if (disk.perRadius == 0) continue;
      diskIrradianceBlock(disk, surface, points, wrap, irradiance);
      colour = colour * light.share;
    } else {
      irradianceBlock(light, surface, points, wrap, irradiance);
    }
    addColoured(colour, irradiance, points, sum);
  }
}

}  // namespace rigel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rigel {

HWY_EXPORT(addNearLights);

namespace {

/// More than a vector has lanes on any machine.
constexpr std::size_t kMostLanes = 16;

}  // namespace

void nearIrradianceBatch(std::span<const NearLight> lights, const Vec3Rows& points, const Vec3Rows& normals,
                         const NearWrap& wrap, std::span<float> irradiance) noexcept {
  const std::size_t size = points.size();
  assert(points.y.size() == size && points.z.size() == size);
  assert(normals.x.size() == size && normals.y.size() == size && normals.z.size() == size);
  assert(irradiance.size() == 3 * size);
  const std::span<const float> rows[] = {points.x, points.y, points.z, normals.x, normals.y, normals.z};
  alignas(64) float padded[6][kPointBlock], sum[3 * kPointBlock];
  for (std::size_t at = 0; at < size; at += kPointBlock) {
    const std::size_t count = std::min(kPointBlock, size - at);
    const std::size_t whole = (count + kMostLanes - 1) / kMostLanes * kMostLanes;
    SurfaceRows surface;
    for (int k = 0; k < 6; ++k) {
      surface.row[k] = rows[k].data() + at;
      if (count == whole) continue;
      std::copy_n(surface.row[k], count, padded[k]);
      std::fill_n(padded[k] + count, whole - count, padded[k][count - 1]);
      surface.row[k] = padded[k];
    }
    std::fill_n(sum, 3 * kPointBlock, 0.0f);
    HWY_DYNAMIC_DISPATCH(addNearLights)(lights, surface, whole, wrap, sum);
    for (std::size_t k = 0; k < 3; ++k) std::copy_n(sum + k * kPointBlock, count, &irradiance[k * size + at]);
  }
}

}  // namespace rigel
#endif
