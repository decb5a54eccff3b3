#include "picture/bitmap_font.h"

#include <array>

namespace rigel::tools {
namespace {

struct Glyph {
  char character;
  std::array<std::string_view, kGlyphHeight> rows;
};

constexpr Glyph kGlyphs[] = {
    {'0', {" ### ", "#   #", "#   #", "#   #", "#   #", "#   #", " ### "}},
    {'1', {"  #  ", " ##  ", "# #  ", "  #  ", "  #  ", "  #  ", "#####"}},
    {'2', {" ### ", "#   #", "    #", "   # ", "  #  ", " #   ", "#####"}},
    {'3', {" ### ", "#   #", "    #", "  ## ", "    #", "#   #", " ### "}},
    {'4', {"   # ", "  ## ", " # # ", "#  # ", "#####", "   # ", "   # "}},
    {'5', {"#####", "#    ", "#### ", "    #", "    #", "#   #", " ### "}},
    {'6', {" ### ", "#    ", "#    ", "#### ", "#   #", "#   #", " ### "}},
    {'7', {"#####", "    #", "   # ", "   # ", "  #  ", "  #  ", "  #  "}},
    {'8', {" ### ", "#   #", "#   #", " ### ", "#   #", "#   #", " ### "}},
    {'9', {" ### ", "#   #", "#   #", " ####", "    #", "    #", " ### "}},
    {'.', {"     ", "     ", "     ", "     ", "     ", " ##  ", " ##  "}},
    {'%', {"##  #", "##  #", "   # ", "  #  ", " #   ", "#  ##", "#  ##"}},
    {'-', {"     ", "     ", "     ", "#####", "     ", "     ", "     "}},
    {'+', {"     ", "  #  ", "  #  ", "#####", "  #  ", "  #  ", "     "}},
    {'>', {"#    ", " #   ", "  #  ", "   # ", "  #  ", " #   ", "#    "}},
};

const Glyph* find(char character) {
  for (const Glyph& glyph : kGlyphs) {
    if (glyph.character == character) return &glyph;
  }
  return nullptr;
}

}  // namespace

int textWidth(std::string_view text, int scale) {
  return text.empty() ? 0 : scale * (kGlyphAdvance * static_cast<int>(text.size()) - (kGlyphAdvance - kGlyphWidth));
}

void drawText(Image8& image, int x, int y, std::string_view text, int scale, Rgb8 colour) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const Glyph* glyph = find(text[i]);
    if (!glyph) continue;
    const int left = x + scale * kGlyphAdvance * static_cast<int>(i);
    for (int v = 0; v < kGlyphHeight * scale; ++v) {
      for (int u = 0; u < kGlyphWidth * scale; ++u) {
        if (glyph->rows[static_cast<std::size_t>(v / scale)][static_cast<std::size_t>(u / scale)] != '#') continue;
        const int px = left + u, py = y + v;
        if (px >= 0 && py >= 0 && px < image.width && py < image.height) image.at(px, py) = colour;
      }
    }
  }
}

}  // namespace rigel::tools
