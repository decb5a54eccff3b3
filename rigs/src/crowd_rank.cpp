// How wrong rigs would be about each light, a character a lane.
#include "crowd_block.h"
#include "weights.h"

#include <algorithm>
#include <bit>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "crowd_rank.cpp"
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

HWY_INLINE Vec set(float x) { return hn::Set(Tag(), x); }
HWY_INLINE Vec dot(Vec ax, Vec ay, Vec az, Vec bx, Vec by, Vec bz) {
  return hn::MulAdd(az, bz, hn::MulAdd(ay, by, hn::Mul(ax, bx)));
}
HWY_INLINE Vec held(Vec x) { return hn::Min(hn::Max(x, set(0)), set(1)); }
HWY_INLINE Vec smooth(Vec t) { return hn::Mul(hn::Mul(t, t), hn::NegMulAdd(set(2), t, set(3))); }

/// A lane group's characters.
struct Seen {
  Vec frame[12];
  Vec centre[3], half[3];
  Vec offset2, radius2;  // squares of R/4 and R
  Vec size;              // R^n
  Vec ball;              // radius of the box's ball

  Seen(const RankBlock& block, int g) {
    const Tag tag;
    const Places& places = *block.places;
    for (int i = 0; i < 12; ++i) frame[i] = hn::Load(tag, places.frame[i] + g);
    for (int a = 0; a < 3; ++a) {
      const Vec lo = hn::Load(tag, places.lo[a] + g), hi = hn::Load(tag, places.hi[a] + g);
      centre[a] = hn::Mul(set(0.5f), hn::Add(lo, hi));
      half[a] = hn::Mul(set(0.5f), hn::Sub(hi, lo));
    }
    const Vec radius = hn::Load(tag, places.radius + g);
    radius2 = hn::Mul(radius, radius);
    offset2 = hn::Mul(radius2, set(1.0f / 16));
    size = radius;
    for (int n = 1; n < block.degree; ++n) size = hn::Mul(size, radius);
    ball = hn::Sqrt(dot(half[0], half[1], half[2], half[0], half[1], half[2]));
  }
};

/// Spots and disks: the largest share of their light that a ball receives, and whether it may touch a disk's face.
struct Directed {
  Vec share, contact;
};

/// `c`: from the light to the ball's centre.
HWY_INLINE Directed directed(const RankRows& lights, int i, const Vec* c, Vec radius) {
  const auto at = [&](RankRows::Row row) HWY_ATTR { return set(lights.row[row][i]); };
  const Vec zero = set(0), one = set(1);
  const Vec square = dot(c[0], c[1], c[2], c[0], c[1], c[2]);
  const Vec height = dot(c[0], c[1], c[2], at(RankRows::axisX), at(RankRows::axisY), at(RankRows::axisZ));
  const Vec before = lights.row[RankRows::twoSided][i] > 0 ? hn::Abs(height) : height;
  // The ball spans the angle alpha about the direction to its centre, which is theta from the axis.
  const Vec inverse = hn::Div(one, hn::Sqrt(hn::Max(square, set(1e-30f))));
  const Vec sinAlpha = hn::Min(hn::Mul(radius, inverse), one);
  const Vec cosAlpha = hn::Sqrt(hn::NegMulAdd(sinAlpha, sinAlpha, one));
  const Vec cosTheta = hn::Min(hn::Max(hn::Mul(before, inverse), set(-1)), one);
  const Vec sinTheta = hn::Sqrt(hn::NegMulAdd(cosTheta, cosTheta, one));
  const Vec nearest = hn::MulAdd(cosTheta, cosAlpha, hn::Mul(sinTheta, sinAlpha));
  const Vec cosine = hn::IfThenElse(hn::Ge(cosTheta, cosAlpha), one, nearest);
  if (!(lights.row[RankRows::disk][i] > 0))
    return {smooth(held(hn::Mul(hn::Sub(cosine, at(RankRows::cosOuter)), at(RankRows::inverseWidth)))), zero};

  const Vec across = hn::Sqrt(hn::Max(hn::NegMulAdd(height, height, square), zero));
  const Vec outside = hn::Max(hn::Sub(across, at(RankRows::radius)), zero);
  const Vec face = hn::Sqrt(hn::MulAdd(outside, outside, hn::Mul(height, height)));
  const Vec gap = hn::Div(hn::Max(hn::Sub(face, radius), zero), hn::Max(radius, set(1e-30f)));
  return {hn::Max(cosine, zero),
          smooth(held(hn::Mul(hn::Sub(set(kContactOuter), gap), set(1 / (kContactOuter - kContactInner)))))};
}

template <int Degree, bool AnyDirected>
HWY_INLINE Vec errorOf(const RankRows& lights, int i, const Seen& seen) {
  const auto at = [&](RankRows::Row row) HWY_ATTR { return set(lights.row[row][i]); };
  const Vec zero = set(0), one = set(1);
  const Vec* frame = seen.frame;
  const Vec dx = hn::Sub(at(RankRows::x), frame[9]);
  const Vec dy = hn::Sub(at(RankRows::y), frame[10]);
  const Vec dz = hn::Sub(at(RankRows::z), frame[11]);
  Vec from[3], out[3];  // the centre, the box
  for (int a = 0; a < 3; ++a) {
    const Vec* axis = frame + 3 * a;
    from[a] = hn::Sub(dot(dx, dy, dz, axis[0], axis[1], axis[2]), seen.centre[a]);
    out[a] = hn::Max(hn::Sub(hn::Abs(from[a]), seen.half[a]), zero);
  }
  const Vec near2 = dot(out[0], out[1], out[2], out[0], out[1], out[2]);
  const Vec inverseRange = at(RankRows::inverseRange);
  const Vec inWindow = hn::Mul(hn::Mul(near2, inverseRange), inverseRange);
  const Vec u = hn::Max(hn::NegMulAdd(inWindow, inWindow, one), zero);
  const Vec power = at(RankRows::power), radius = at(RankRows::radius), lightRadius2 = hn::Mul(radius, radius);
  Vec share = hn::Mul(u, u), contact = zero;
  if (AnyDirected) {
    Vec towards[3];
    for (int a = 0; a < 3; ++a)
      towards[a] = hn::Neg(dot(from[0], from[1], from[2], frame[a], frame[3 + a], frame[6 + a]));
    const Directed d = directed(lights, i, towards, seen.ball);
    share = hn::Mul(share, d.share);
    contact = d.contact;
  }
  const Vec e2 = hn::Add(near2, seen.offset2);
  const Vec far2 = hn::Max(e2, seen.radius2);
  Vec falling = far2;
  if (Degree != 2) falling = hn::Sqrt(far2);
  if (Degree == 3) falling = hn::Mul(falling, far2);
  const Vec over = hn::Mul(hn::Max(e2, lightRadius2), falling);
  Vec error = hn::Div(hn::Mul(hn::Mul(power, share), seen.size), over);
  if (AnyDirected) {
    const Vec face = hn::Div(power, lightRadius2);
    const Vec urgent = hn::Div(hn::Max(error, hn::Mul(contact, face)), hn::Sub(one, contact));
    error = hn::IfThenElse(hn::Gt(contact, zero), urgent, error);
  }
  // NaN fails; what is beyond all numbers is held.
  return hn::IfThenElseZero(hn::Gt(error, zero), hn::Min(error, set(std::numeric_limits<float>::max())));
}

template <int Degree, bool AnyDirected>
void rank(const RankRows& lights, const RankBlock& block, float* errors) {
  const Tag tag;
  const hn::RebindToUnsigned<Tag> bits;
  for (int g = 0; g < block.characters; g += kLanes) {
    const Seen seen(block, g);
    const auto groups = hn::Load(bits, block.groups + g);
    const Vec finite = hn::Load(tag, block.places->finite + g);
    for (int i = 0; i < lights.count; ++i) {
      const auto lit = hn::Ne(hn::And(groups, hn::Set(bits, lights.groups[i])), hn::Zero(bits));
      const auto counts = hn::And(hn::RebindMask(tag, lit), hn::Eq(finite, set(0)));
      hn::Store(hn::IfThenElseZero(counts, errorOf<Degree, AnyDirected>(lights, i, seen)), tag,
                errors + i * kBlock + g);
    }
  }
}

template <bool AnyDirected>
void rankBy(const RankRows& lights, const RankBlock& block, float* errors) {
  if (block.degree == 1) return rank<1, AnyDirected>(lights, block, errors);
  if (block.degree == 2) return rank<2, AnyDirected>(lights, block, errors);
  rank<3, AnyDirected>(lights, block, errors);
}

/// Keeps the N largest of each lane, largest first.
template <int N>
void nthLargestOf(const float* errors, int lights, int characters, float* floors) {
  const Tag tag;
  for (int g = 0; g < characters; g += kLanes) {
    Vec largest[N];
    for (int k = 0; k < N; ++k) largest[k] = hn::Zero(tag);
    for (int i = 0; i < lights; ++i) {
      Vec v = hn::Load(tag, errors + i * kBlock + g);
      for (int k = 0; k < N; ++k) {
        const Vec lower = hn::Min(largest[k], v);
        largest[k] = hn::Max(largest[k], v);
        v = lower;
      }
    }
    hn::Store(largest[N - 1], tag, floors + g);
  }
}

template <int N = kMaxCrowdNear + 1>
void dispatchLargest(const float* errors, int lights, int characters, int n, float* floors) {
  if constexpr (N > 1) {
    if (n < N) return dispatchLargest<N - 1>(errors, lights, characters, n, floors);
  }
  nthLargestOf<N>(errors, lights, characters, floors);
}

}  // namespace

void rankLights(const RankRows& lights, const RankBlock& block, float* errors) {
  lights.directed ? rankBy<true>(lights, block, errors) : rankBy<false>(lights, block, errors);
}

void nthLargest(const float* errors, int lights, int characters, int n, float* floors) {
  dispatchLargest(errors, lights, characters, n, floors);
}

void findAbove(const float* errors, int lights, int characters, const float* floors, int most, NearHits& hits) {
  const Tag tag;
  for (int& count : hits.count) count = 0;
  for (int g = 0; g < characters; g += kLanes) {
    const Vec floor = hn::Load(tag, floors + g);
    const auto used = hn::FirstN(tag, static_cast<std::size_t>(characters - g));
    for (int i = 0; i < lights; ++i) {
      const auto above = hn::And(hn::Gt(hn::Load(tag, errors + i * kBlock + g), floor), used);
      if (hn::AllFalse(tag, above)) continue;
      std::uint8_t bytes[8];
      hn::StoreMaskBits(tag, above, bytes);
      unsigned set = bytes[0];
      if (kLanes > 8) set |= static_cast<unsigned>(bytes[1]) << 8;
      for (; set != 0; set &= set - 1) {
        const int c = g + std::countr_zero(set);
        if (hits.count[c] < most) hits.light[c][hits.count[c]++] = i;
      }
    }
  }
}

}  // namespace rigel::crowd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rigel::crowd {

HWY_EXPORT(rankLights);
HWY_EXPORT(nthLargest);
HWY_EXPORT(findAbove);

void rankLights(const RankRows& lights, const RankBlock& block, float* errors) noexcept {
  HWY_DYNAMIC_DISPATCH(rankLights)(lights, block, errors);
}
void nthLargest(const float* errors, int lights, int characters, int n, float* floors) noexcept {
  HWY_DYNAMIC_DISPATCH(nthLargest)(errors, lights, characters, n, floors);
}
void findAbove(const float* errors, int lights, int characters, const float* floors, int most,
               NearHits& hits) noexcept {
  HWY_DYNAMIC_DISPATCH(findAbove)(errors, lights, characters, floors, most, hits);
}

}  // namespace rigel::crowd
#endif
