// Skinning, a palette's matrix row a vector, and placing, a character a lane.
#include "crowd_block.h"

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "crowd_pose.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rigel::crowd::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::ScalableTag<float>;
using Vec = hn::Vec<Tag>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(Tag()));
static_assert(kBlock % kLanes == 0);

}  // namespace

#if HWY_TARGET == HWY_SCALAR

void skinAnchors(const Skin& skin, const JointMatrix* const* palettes, int characters, float* positions) {
  for (std::size_t s = 0; s + 1 < skin.first.size(); ++s)
    for (std::size_t a = 0; a < 3; ++a)
      for (int c = 0; c < characters; ++c) {
        float sum = 0;
        for (int e = skin.first[s]; e < skin.first[s + 1]; ++e)
          for (int i = 0; i < 4; ++i) sum += palettes[c][skin.joint[e]].m[a][i] * skin.point[4 * e + i];
        positions[(3 * s + a) * kBlock + static_cast<std::size_t>(c)] = sum;
      }
}

#else

namespace {

/// The sum of each vector's numbers, 128 bits by 128 bits.
template <class V, class D>
HWY_INLINE V sums(D tag, V a, V b, V c, V d) {
  const V ac = hn::Add(hn::InterleaveLower(tag, a, c), hn::InterleaveUpper(tag, a, c));
  const V bd = hn::Add(hn::InterleaveLower(tag, b, d), hn::InterleaveUpper(tag, b, d));
  return hn::Add(hn::InterleaveLower(tag, ac, bd), hn::InterleaveUpper(tag, ac, bd));
}

using Tag4 = hn::FixedTag<float, 4>;
using Vec4 = hn::Vec<Tag4>;

#if HWY_TARGET <= HWY_AVX3

/// Four characters at an anchor: a matrix a vector, its rows 128 bits each.
HWY_INLINE void skinFour(const Skin& skin, std::size_t s, const JointMatrix* const* four, float* row) {
  const hn::FixedTag<float, 16> tag;
  const hn::Half<decltype(tag)> half;
  const auto rows = hn::FirstN(tag, 12);
  hn::Vec<decltype(tag)> sum[4];
  for (auto& v : sum) v = hn::Zero(tag);
  for (int e = skin.first[s]; e < skin.first[s + 1]; ++e) {
    const auto point = hn::LoadDup128(tag, skin.point + 4 * e);
    const std::size_t joint = skin.joint[e];
    for (int i = 0; i < 4; ++i) sum[i] = hn::MulAdd(hn::MaskedLoad(rows, tag, &four[i][joint].m[0][0]), point, sum[i]);
  }
  const auto all = sums(tag, sum[0], sum[1], sum[2], sum[3]);
  const auto xy = hn::LowerHalf(half, all);
  hn::StoreU(hn::LowerHalf(Tag4(), xy), Tag4(), row);
  hn::StoreU(hn::UpperHalf(Tag4(), xy), Tag4(), row + kBlock);
  hn::StoreU(hn::LowerHalf(Tag4(), hn::UpperHalf(half, all)), Tag4(), row + 2 * kBlock);
}

#else

/// Four characters at an anchor: a matrix row a vector.
HWY_INLINE void skinFour(const Skin& skin, std::size_t s, const JointMatrix* const* four, float* row) {
  const Tag4 tag;
  Vec4 x[4], y[4], z[4];
  for (int i = 0; i < 4; ++i) x[i] = y[i] = z[i] = hn::Zero(tag);
  for (int e = skin.first[s]; e < skin.first[s + 1]; ++e) {
    const Vec4 point = hn::LoadU(tag, skin.point + 4 * e);
    const std::size_t joint = skin.joint[e];
    for (int i = 0; i < 4; ++i) {
      const float* m = &four[i][joint].m[0][0];
      x[i] = hn::MulAdd(hn::LoadU(tag, m), point, x[i]);
      y[i] = hn::MulAdd(hn::LoadU(tag, m + 4), point, y[i]);
      z[i] = hn::MulAdd(hn::LoadU(tag, m + 8), point, z[i]);
    }
  }
  hn::StoreU(sums(tag, x[0], x[1], x[2], x[3]), tag, row);
  hn::StoreU(sums(tag, y[0], y[1], y[2], y[3]), tag, row + kBlock);
  hn::StoreU(sums(tag, z[0], z[1], z[2], z[3]), tag, row + 2 * kBlock);
}

#endif

}  // namespace

void skinAnchors(const Skin& skin, const JointMatrix* const* palettes, int characters, float* positions) {
  const std::size_t anchors = skin.first.size() - 1;
  for (int c = 0; c < characters; c += 4)
    for (std::size_t s = 0; s < anchors; ++s) skinFour(skin, s, palettes + c, positions + 3 * kBlock * s + c);
}

#endif

void placeAnchors(int characters, std::span<const float> footprints, std::span<const float> shares,
                  const float* positions, bool boxes, Places& places, float* x, float* y, float* z) {
  const Tag tag;
  const std::size_t anchors = footprints.size();
  for (int g = 0; g < characters; g += kLanes) {
    Vec frame[12];
    for (int i = 0; i < 12; ++i) frame[i] = hn::Load(tag, places.frame[i] + g);
    const auto mask = hn::FirstN(tag, static_cast<std::size_t>(std::min(kLanes, characters - g)));
    Vec lo[3], hi[3], mean[3];
    for (int a = 0; a < 3; ++a) {
      lo[a] = hn::Set(tag, std::numeric_limits<float>::max());
      hi[a] = hn::Neg(lo[a]);
      mean[a] = hn::Zero(tag);
    }
    Vec square = hn::Zero(tag), finite = hn::Zero(tag);
    for (std::size_t s = 0; s < anchors; ++s) {
      const Vec footprint = hn::Set(tag, footprints[s]), share = hn::Set(tag, shares[s]);
      Vec p[3];
      for (int a = 0; a < 3; ++a) {
        p[a] = hn::Load(tag, positions + (3 * s + static_cast<std::size_t>(a)) * kBlock + g);
        lo[a] = hn::Min(lo[a], hn::Sub(p[a], footprint));
        hi[a] = hn::Max(hi[a], hn::Add(p[a], footprint));
        mean[a] = hn::MulAdd(share, p[a], mean[a]);
        square = hn::MulAdd(share, hn::Mul(p[a], p[a]), square);
      }
      const std::size_t at = s * static_cast<std::size_t>(characters) + static_cast<std::size_t>(g);
      float* const out[3] = {x + at, y + at, z + at};
      for (int i = 0; i < 3; ++i) {
        const Vec world = hn::Add(
            hn::MulAdd(p[2], frame[6 + i], hn::MulAdd(p[1], frame[3 + i], hn::Mul(p[0], frame[i]))), frame[9 + i]);
        finite = hn::MulAdd(world, hn::Zero(tag), finite);
        hn::BlendedStore(world, mask, tag, out[i]);
      }
    }
    hn::Store(finite, tag, places.finite + g);
    const Vec off = hn::MulAdd(mean[2], mean[2], hn::MulAdd(mean[1], mean[1], hn::Mul(mean[0], mean[0])));
    hn::Store(hn::Sqrt(hn::Max(hn::Sub(square, off), hn::Zero(tag))), tag, places.radius + g);
    if (!boxes) continue;
    for (int a = 0; a < 3; ++a) {
      hn::Store(lo[a], tag, places.lo[a] + g);
      hn::Store(hi[a], tag, places.hi[a] + g);
    }
  }
}

void placeBoxes(int characters, const Places& places, float* rows) {
  using Doubles = hn::ScalableTag<double>;
  using Floats = hn::Rebind<float, Doubles>;
  using Double = hn::Vec<Doubles>;
  const Doubles tag;
  const Floats floats;
  constexpr int kDoubles = static_cast<int>(hn::MaxLanes(Doubles()));
  const auto load = [&](const float* row) HWY_ATTR { return hn::PromoteTo(tag, hn::Load(floats, row)); };
  for (int g = 0; g < characters; g += kDoubles) {
    const auto store = [&](Double v, int row) HWY_ATTR {
      const auto narrow = hn::DemoteTo(floats, v);
      hn::Store(narrow, floats, rows + row * kBlock + g);
      return hn::PromoteTo(tag, narrow);
    };
    Double centre[3], inverse[3];
    for (int i = 0; i < 3; ++i) centre[i] = load(places.frame[9 + i] + g);
    for (int a = 0; a < 3; ++a) {
      const Double lo = load(places.lo[a] + g), hi = load(places.hi[a] + g), extent = hn::Sub(hi, lo);
      const Double middle = hn::Mul(hn::Add(lo, hi), hn::Set(tag, 0.5));
      inverse[a] = hn::IfThenElseZero(hn::Gt(extent, hn::Set(tag, 2e-30)), hn::Div(hn::Set(tag, 2.0), extent));
      for (int i = 0; i < 3; ++i) centre[i] = hn::MulAdd(load(places.frame[3 * a + i] + g), middle, centre[i]);
    }
    Double lost[3];
    for (int i = 0; i < 3; ++i) lost[i] = hn::Sub(store(centre[i], i), centre[i]);
    for (int a = 0; a < 3; ++a) {
      Double w = hn::Zero(tag);
      for (int i = 0; i < 3; ++i) {
        const Double entry = hn::Mul(load(places.frame[3 * a + i] + g), inverse[a]);
        (void)store(entry, 4 + 4 * a + i);
        w = hn::MulAdd(entry, lost[i], w);
      }
      (void)store(w, 7 + 4 * a);
    }
  }
}

}  // namespace rigel::crowd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rigel::crowd {

HWY_EXPORT(skinAnchors);
HWY_EXPORT(placeAnchors);
HWY_EXPORT(placeBoxes);

void skinAnchors(const Skin& skin, std::span<const JointMatrix* const, kBlock> palettes, int characters,
                 float* positions) noexcept {
  HWY_DYNAMIC_DISPATCH(skinAnchors)(skin, palettes.data(), characters, positions);
}

void placeAnchors(int characters, std::span<const float> footprints, std::span<const float> shares,
                  const float* positions, bool boxes, Places& places, float* x, float* y, float* z) noexcept {
  HWY_DYNAMIC_DISPATCH(placeAnchors)(characters, footprints, shares, positions, boxes, places, x, y, z);
}

void placeBoxes(int characters, const Places& places, float* rows) noexcept {
  HWY_DYNAMIC_DISPATCH(placeBoxes)(characters, places, rows);
}

}  // namespace rigel::crowd
#endif
