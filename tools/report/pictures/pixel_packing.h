// Numbers of a picture, small enough to travel in the report page: half floats of covered pixels, predicted from their
// neighbours and deflated. page/js/pixels.js is the other side.
#pragma once

#include "picture/image.h"

#include <array>
#include <cstdint>
#include <vector>

namespace rigel::tools {

/// Pixels of a picture that have numbers, rows from the top; no others are packed.
struct PixelMask {
  int width = 0, height = 0;
  std::vector<bool> covered;

  std::size_t count() const;
};

/// Bits of the half floats of red, green and blue: one entry a covered pixel.
using HalfPlanes = std::array<std::vector<std::uint16_t>, 3>;

/// v rounded to a half float (to nearest, ties to even) times `scale`, a power of two. NaN stays, what exceeds the
/// largest half float becomes infinite.
float roundedToHalf(float v, float scale = 1);

/// The power of two that brings `largest` into the range where half floats have all their digits: 1 wherever possible.
float halfScale(float largest);

/// Bits of rgb / scale where `mask` is set. The lowest `dropped` bits are rounded away and shifted out.
HalfPlanes halfPlanes(const Image& image, const PixelMask& mask, float scale, int dropped = 0);

/// All of `planes`, each at most 16 bits, as one zlib stream (RFC 1950). In order, modulo 65536:
///   minus `base`, where it is given;  red and blue minus green, order G R B;
///   each minus its prediction from the left (a), upper (b) and upper left (c) neighbour: the median of a, b and
///   a + b - c as signed numbers (M. Weinberger, G. Seroussi, G. Sapiro, "The LOCO-I Lossless Image Compression
///   Algorithm", 2000); with any of the three not covered, a or else b or else 0;
///   zigzag (0, -1, 1, -2...), the upper bytes of all, then the lower ones; deflate.
std::vector<std::uint8_t> packPlanes(const HalfPlanes& planes, const PixelMask& mask, const HalfPlanes* base = nullptr);

}  // namespace rigel::tools
