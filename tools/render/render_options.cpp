#include "render/render_options.h"

#include <fmt/format.h>

#include <charconv>

namespace rigel::tools {

std::filesystem::path numberedFile(const std::filesystem::path& file, int frame, bool numbered) {
  if (!numbered) return file;
  std::filesystem::path name = file.stem();
  name += fmt::format("-{:04}", frame);
  name += file.extension();
  return file.parent_path() / name;
}

Result<std::pair<int, int>> parsePictureSize(const std::string& text) {
  std::pair<int, int> size;
  const char* const end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.first);
  if (width.ec == std::errc() && width.ptr != end && *width.ptr == 'x') {
    const auto height = std::from_chars(width.ptr + 1, end, size.second);
    const auto fits = [](int side) { return side >= 1 && side <= kMaxPictureSide; };
    if (height.ec == std::errc() && height.ptr == end && fits(size.first) && fits(size.second)) return size;
  }
  return Error{fmt::format("expected WIDTHxHEIGHT, each from 1 to {}", kMaxPictureSide), "--size " + text};
}

}  // namespace rigel::tools
