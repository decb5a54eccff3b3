// A tiny font for figures in pictures: digits, '.', '%', '-', '+', '>' and space, 5 x 7 pixels.
#pragma once

#include "picture/image.h"

#include <string_view>

namespace rigel::tools {

inline constexpr int kGlyphWidth = 5, kGlyphHeight = 7, kGlyphAdvance = 6;

/// Width of `text` in pixels at a magnification.
int textWidth(std::string_view text, int scale);

/// Draws `text` with its top left corner at (x, y); pixels outside the picture and unknown characters are left out.
void drawText(Image8& image, int x, int y, std::string_view text, int scale, Rgb8 colour);

}  // namespace rigel::tools
