#include "row_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "row_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rigel::rowkernels::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<float, kMultiple>;
using Vec = hn::Vec<Tag>;
using Tag64 = hn::CappedTag<double, kMultiple / 2>;
using Vec64 = hn::Vec<Tag64>;
constexpr std::size_t kLanes = hn::MaxLanes(Tag());
constexpr std::size_t kLanes64 = hn::MaxLanes(Tag64());

// A tile of the product stays in registers.
constexpr std::size_t kTileRows = 4;

/// Some rows and columns of `from` less the product, or of the product where `from` is null.
template <std::size_t Rows, std::size_t Vectors>
HWY_INLINE void tile(const float* from, const float* matrix, std::size_t inner, const float* values, std::size_t width,
                     float* out) {
  const Tag tag;
  Vec sum[Rows][Vectors];
  for (std::size_t r = 0; r < Rows; ++r)
    for (std::size_t v = 0; v < Vectors; ++v) sum[r][v] = hn::Zero(tag);
  for (std::size_t s = 0; s < inner; ++s) {
    Vec value[Vectors];
    for (std::size_t v = 0; v < Vectors; ++v) value[v] = hn::LoadU(tag, values + s * width + v * kLanes);
    for (std::size_t r = 0; r < Rows; ++r) {
      const Vec m = hn::Set(tag, matrix[r * inner + s]);
      for (std::size_t v = 0; v < Vectors; ++v) sum[r][v] = hn::MulAdd(m, value[v], sum[r][v]);
    }
  }
  for (std::size_t r = 0; r < Rows; ++r)
    for (std::size_t v = 0; v < Vectors; ++v) {
      const std::size_t at = r * width + v * kLanes;
      if (from != nullptr) sum[r][v] = hn::Sub(hn::LoadU(tag, from + at), sum[r][v]);
      hn::StoreU(sum[r][v], tag, out + at);
    }
}

template <std::size_t Rows>
HWY_INLINE void tileRows(const float* from, const float* matrix, std::size_t inner, const float* values,
                         std::size_t width, float* out) {
  const auto fromColumn = [&](std::size_t i) { return from != nullptr ? from + i : nullptr; };
  std::size_t i = 0;
  for (; i + 2 * kLanes <= width; i += 2 * kLanes)
    tile<Rows, 2>(fromColumn(i), matrix, inner, values + i, width, out + i);
  for (; i + kLanes <= width; i += kLanes) tile<Rows, 1>(fromColumn(i), matrix, inner, values + i, width, out + i);
  for (; i < width; ++i)
    for (std::size_t r = 0; r < Rows; ++r) {
      float sum = 0;
      for (std::size_t s = 0; s < inner; ++s) sum += matrix[r * inner + s] * values[s * width + i];
      out[r * width + i] = from != nullptr ? from[r * width + i] - sum : sum;
    }
}

void subtractProduct(const float* from, const float* matrix, std::size_t rows, std::size_t inner, const float* values,
                     std::size_t width, float* out) {
  const auto fromRow = [&](std::size_t r) { return from != nullptr ? from + r * width : nullptr; };
  std::size_t r = 0;
  for (; r + kTileRows <= rows; r += kTileRows)
    tileRows<kTileRows>(fromRow(r), matrix + r * inner, inner, values, width, out + r * width);
  for (; r < rows; ++r) tileRows<1>(fromRow(r), matrix + r * inner, inner, values, width, out + r * width);
}

template <class AnyTag, class Number>
HWY_INLINE void addScaled(AnyTag tag, Number share, const Number* from, std::size_t count, Number* into) {
  constexpr std::size_t kStep = hn::MaxLanes(AnyTag());
  const auto factor = hn::Set(tag, share);
  std::size_t i = 0;
  for (; i + kStep <= count; i += kStep)
    hn::StoreU(hn::MulAdd(factor, hn::LoadU(tag, from + i), hn::LoadU(tag, into + i)), tag, into + i);
  for (; i < count; ++i) into[i] += share * from[i];
}

void addFloats(float share, const float* from, std::size_t count, float* into) {
  addScaled(Tag(), share, from, count, into);
}

void addDoubles(double share, const double* from, std::size_t count, double* into) {
  addScaled(Tag64(), share, from, count, into);
}

double product(const double* a, const double* b, std::size_t count) {
  const Tag64 tag;
  Vec64 sums = hn::Zero(tag);
  std::size_t i = 0;
  for (; i + kLanes64 <= count; i += kLanes64) sums = hn::MulAdd(hn::LoadU(tag, a + i), hn::LoadU(tag, b + i), sums);
  double sum = hn::GetLane(hn::SumOfLanes(tag, sums));
  for (; i < count; ++i) sum += a[i] * b[i];
  return sum;
}

HWY_INLINE float energy(const float* row, const float* weight, std::size_t width) {
  const Tag tag;
  Vec sums = hn::Zero(tag);
  std::size_t i = 0;
  for (; i + kLanes <= width; i += kLanes) {
    const Vec v = hn::LoadU(tag, row + i);
    sums = hn::MulAdd(hn::Mul(hn::LoadU(tag, weight + i), v), v, sums);
  }
  float sum = hn::GetLane(hn::SumOfLanes(tag, sums));
  for (; i < width; ++i) sum += weight[i] * row[i] * row[i];
  return sum;
}

void energies(const float* rows, std::size_t count, const float* weight, std::size_t width, float* out) {
  for (std::size_t r = 0; r < count; ++r) out[r] = energy(rows + r * width, weight, width);
}

float sumOfSquares(const float* values, std::size_t count) {
  const Tag tag;
  Vec sums = hn::Zero(tag);
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    const Vec v = hn::LoadU(tag, values + i);
    sums = hn::MulAdd(v, v, sums);
  }
  float sum = hn::GetLane(hn::SumOfLanes(tag, sums));
  for (; i < count; ++i) sum += values[i] * values[i];
  return sum;
}

}  // namespace
}  // namespace rigel::rowkernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rigel::rowkernels {

HWY_EXPORT(subtractProduct);
HWY_EXPORT(addFloats);
HWY_EXPORT(addDoubles);
HWY_EXPORT(product);
HWY_EXPORT(energies);
HWY_EXPORT(sumOfSquares);

void multiply(const float* matrix, std::size_t rows, std::size_t inner, const float* values, std::size_t width,
              float* out) noexcept {
  HWY_DYNAMIC_DISPATCH(subtractProduct)(nullptr, matrix, rows, inner, values, width, out);
}
void subtractProduct(const float* from, const float* matrix, std::size_t rows, std::size_t inner, const float* values,
                     std::size_t width, float* out) noexcept {
  HWY_DYNAMIC_DISPATCH(subtractProduct)(from, matrix, rows, inner, values, width, out);
}
void addScaled(float share, const float* from, std::size_t count, float* into) noexcept {
  HWY_DYNAMIC_DISPATCH(addFloats)(share, from, count, into);
}
void addScaled(double share, const double* from, std::size_t count, double* into) noexcept {
  HWY_DYNAMIC_DISPATCH(addDoubles)(share, from, count, into);
}
double product(const double* a, const double* b, std::size_t count) noexcept {
  return HWY_DYNAMIC_DISPATCH(product)(a, b, count);
}
void energies(const float* rows, std::size_t count, const float* weight, std::size_t width, float* out) noexcept {
  HWY_DYNAMIC_DISPATCH(energies)(rows, count, weight, width, out);
}
float sumOfSquares(const float* values, std::size_t count) noexcept {
  return HWY_DYNAMIC_DISPATCH(sumOfSquares)(values, count);
}

}  // namespace rigel::rowkernels
#endif
