// Rows of numbers in vectors: what is done to them for every light of an object that chooses, in every frame.
#pragma once

#include <cstddef>

namespace rigel::rowkernels {

/// Rows that are to be fast have a multiple of this many floats.
inline constexpr std::size_t kMultiple = 16;
constexpr std::size_t padded(std::size_t width) noexcept { return (width + kMultiple - 1) / kMultiple * kMultiple; }

/// out = matrix (rows x inner) times values (inner x width).
void multiply(const float* matrix, std::size_t rows, std::size_t inner, const float* values, std::size_t width,
              float* out) noexcept;
/// out = from (rows x width) less that product.
void subtractProduct(const float* from, const float* matrix, std::size_t rows, std::size_t inner, const float* values,
                     std::size_t width, float* out) noexcept;
/// into += share * from.
void addScaled(float share, const float* from, std::size_t count, float* into) noexcept;
void addScaled(double share, const double* from, std::size_t count, double* into) noexcept;
double product(const double* a, const double* b, std::size_t count) noexcept;
/// out[r] = sum of weight[i] row[i]^2.
void energies(const float* rows, std::size_t count, const float* weight, std::size_t width, float* out) noexcept;
float sumOfSquares(const float* values, std::size_t count) noexcept;

}  // namespace rigel::rowkernels
