// The least-squares operators of a block, a character a lane, in double: normal equations square the condition.
// Step by step what least_squares.cpp does.
#include "crowd_block.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "crowd_refresh.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "least_squares.h"

HWY_BEFORE_NAMESPACE();
namespace rigel::crowd::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::ScalableTag<double>;
using Vec = hn::Vec<Tag>;
using Floats = hn::Rebind<float, Tag>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(Tag()));
static_assert(kBlock % kLanes == 0);

HWY_INLINE Vec widened(const float* row) { return hn::PromoteTo(Tag(), hn::Load(Floats(), row)); }

/// A matrix of vectors in scratch memory.
class Matrix {
 public:
  HWY_INLINE Matrix(double*& scratch, int rows, int columns) : data_(scratch), columns_(columns) {
    scratch += static_cast<std::ptrdiff_t>(rows) * columns * kLanes;
  }
  HWY_INLINE Vec operator()(int i, int j) const { return hn::Load(Tag(), at(i, j)); }
  HWY_INLINE void set(int i, int j, Vec v) const { hn::Store(v, Tag(), at(i, j)); }

 private:
  HWY_INLINE double* at(int i, int j) const { return data_ + (static_cast<std::ptrdiff_t>(i) * columns_ + j) * kLanes; }
  double* data_;
  int columns_;
};

/// Box coordinates of model.h.
struct Coordinates {
  Vec centre[3], inverse[3];

  Coordinates(const Places& places, int g) {
    const Vec half = hn::Set(Tag(), 0.5), least = hn::Set(Tag(), 1e-30);
    for (int a = 0; a < 3; ++a) {
      const Vec lo = widened(places.lo[a] + g), hi = widened(places.hi[a] + g);
      centre[a] = hn::Mul(half, hn::Add(lo, hi));
      const Vec extent = hn::Mul(half, hn::Sub(hi, lo));
      inverse[a] = hn::IfThenElseZero(hn::Gt(extent, least), hn::Div(hn::Set(Tag(), 1.0), extent));
    }
  }
};

constexpr int kTile = 4;

/// Columns s to s + Tile of the operator: forward and back substitution.
template <int Tile>
HWY_INLINE void solve(const Matrix& factor, const Matrix& scale, const Matrix& right, int functions, int points,
                      const float* shares, int s, float* op) {
  const Tag tag;
  for (int k = 0; k < functions; ++k) {
    Vec v[Tile];
    for (int t = 0; t < Tile; ++t) v[t] = right(k, s + t);
    for (int j = 0; j < k; ++j) {
      const Vec l = factor(k, j);
      for (int t = 0; t < Tile; ++t) v[t] = hn::NegMulAdd(l, right(j, s + t), v[t]);
    }
    for (int t = 0; t < Tile; ++t) right.set(k, s + t, hn::Mul(v[t], factor(k, k)));
  }
  for (int k = functions - 1; k >= 0; --k) {
    Vec v[Tile];
    for (int t = 0; t < Tile; ++t) v[t] = right(k, s + t);
    for (int j = k + 1; j < functions; ++j) {
      const Vec l = factor(j, k);
      for (int t = 0; t < Tile; ++t) v[t] = hn::NegMulAdd(l, right(j, s + t), v[t]);
    }
    for (int t = 0; t < Tile; ++t) {
      const Vec solved = hn::Mul(v[t], factor(k, k));
      right.set(k, s + t, solved);
      // The function 1 is the first monomial.
      const Vec constant = hn::Set(tag, k == 0 ? static_cast<double>(shares[s + t]) : 0.0);
      const Vec entry = hn::MulAdd(scale(k, 0), solved, constant);
      hn::Store(hn::DemoteTo(Floats(), entry), Floats(), op + (k * points + s + t) * kBlock);
    }
  }
}

void refreshLanes(const Monomials& monomials, std::span<const float> shares, const float* positions,
                  const Places& places, int g, double* scratch, float* op) {
  const Tag tag;
  const int points = static_cast<int>(shares.size());
  const int functions = static_cast<int>(monomials.from.size());
  const Matrix a(scratch, functions, points), right(scratch, functions, points);
  const Matrix normal(scratch, functions, functions), scale(scratch, functions, 1);

  const Coordinates box(places, g);
  for (int s = 0; s < points; ++s) {
    Vec u[3];
    for (int axis = 0; axis < 3; ++axis) {
      const Vec p = widened(positions + (3 * s + axis) * kBlock + g);
      u[axis] = hn::Mul(hn::Sub(p, box.centre[axis]), box.inverse[axis]);
    }
    const Vec share = hn::Set(tag, static_cast<double>(shares[s]));
    a.set(0, s, hn::Set(tag, 1.0));
    right.set(0, s, share);
    for (int k = 1; k < functions; ++k) {
      const Vec value = hn::Mul(a(monomials.from[k], s), u[monomials.axis[k]]);
      a.set(k, s, value);
      right.set(k, s, hn::Mul(share, value));
    }
  }

  for (int k = 0; k < functions; ++k) {
    for (int j = 0; j <= k; ++j) {
      Vec even = hn::Zero(tag), odd = hn::Zero(tag);
      int s = 0;
      for (; s + 1 < points; s += 2) {
        even = hn::MulAdd(a(k, s), right(j, s), even);
        odd = hn::MulAdd(a(k, s + 1), right(j, s + 1), odd);
      }
      if (s < points) even = hn::MulAdd(a(k, s), right(j, s), even);
      normal.set(k, j, hn::Add(even, odd));
    }
    const Vec square = normal(k, k);
    const Vec one = hn::Set(tag, 1.0);
    scale.set(
        k, 0,
        hn::IfThenElseZero(hn::Gt(square, hn::Set(tag, LeastSquares::kLeastSquare)), hn::Div(one, hn::Sqrt(square))));
  }

  // (A^T W)(I - 1 w^T), scaled as the matrix.
  for (int k = 0; k < functions; ++k) {
    const Vec own = scale(k, 0), total = normal(k, 0);
    for (int s = 0; s < points; ++s)
      right.set(k, s, hn::Mul(own, hn::NegMulAdd(total, hn::Set(tag, static_cast<double>(shares[s])), right(k, s))));
  }

  // Cholesky factor of the scaled matrix; its diagonal is kept inverted.
  const Vec one = hn::Set(tag, 1.0);
  for (int k = 0; k < functions; ++k) {
    const Vec own = scale(k, 0);
    for (int j = 0; j < k; ++j) {
      Vec entry = hn::Mul(hn::Mul(normal(k, j), own), scale(j, 0));
      for (int i = 0; i < j; ++i) entry = hn::NegMulAdd(normal(k, i), normal(j, i), entry);
      normal.set(k, j, hn::Mul(entry, normal(j, j)));
    }
    Vec pivot = hn::Add(one, hn::IfThenElseZero(hn::Gt(own, hn::Zero(tag)), hn::Set(tag, LeastSquares::kRidge)));
    for (int i = 0; i < k; ++i) pivot = hn::NegMulAdd(normal(k, i), normal(k, i), pivot);
    normal.set(k, k, hn::Div(one, hn::Sqrt(pivot)));
  }

  int s = 0;
  for (; s + kTile <= points; s += kTile) solve<kTile>(normal, scale, right, functions, points, shares.data(), s, op);
  for (; s < points; ++s) solve<1>(normal, scale, right, functions, points, shares.data(), s, op);
}

}  // namespace

void refreshOperators(int characters, const Monomials& monomials, const float* shares, int samples,
                      const float* positions, const Places& places, double* scratch, float* op) {
  for (int g = 0; g < characters; g += kLanes)
    refreshLanes(monomials, {shares, static_cast<std::size_t>(samples)}, positions, places, g, scratch, op + g);
}

}  // namespace rigel::crowd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rigel::crowd {

HWY_EXPORT(refreshOperators);

std::size_t refreshScratch(int samples, int vectors) noexcept {
  const auto s = static_cast<std::size_t>(samples), k = static_cast<std::size_t>(vectors);
  constexpr std::size_t kMostLanes = kBlock / 2;
  return (2 * s * k + k * k + k) * kMostLanes;
}

void refreshOperators(int characters, const Monomials& monomials, std::span<const float> shares, const float* positions,
                      const Places& places, double* scratch, float* op) noexcept {
  HWY_DYNAMIC_DISPATCH(refreshOperators)
  (characters, monomials, shares.data(), static_cast<int>(shares.size()), positions, places, scratch, op);
}

}  // namespace rigel::crowd
#endif
