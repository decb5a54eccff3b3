// OpenEXR and PNG files. Written aside and renamed: a failure leaves neither a half-written file nor a stray one.
#pragma once

#include "picture/image.h"

#include <rigel/result.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace rigel::tools {

enum class ExrDepth { half, full };

/// Channels R, G, B and A (coverage), ZIP compressed. On success returns the bytes written.
Result<std::size_t> writeExr(const Image& image, const std::filesystem::path& file, ExrDepth depth = ExrDepth::half);

/// A further picture in the same file, of the same size: channels NAME.R, NAME.G and NAME.B.
struct ExrLayer {
  std::string_view name;
  const Image* image = nullptr;
};
Result<std::size_t> writeExr(const Image& image, std::span<const ExrLayer> layers, const std::filesystem::path& file,
                             ExrDepth depth = ExrDepth::half);

/// Reads R, G, B (which must be there) and A (1 without).
Result<Image> readExr(const std::filesystem::path& file);
/// Reads NAME.R, NAME.G and NAME.B, which must be there; coverage is that of A.
Result<Image> readExrLayer(const std::filesystem::path& file, std::string_view name);

/// 8-bit RGB, marked as sRGB.
Result<std::vector<std::uint8_t>> encodePng(const Image8& image);
/// Writes what encodePng gave: for who needs both the bytes and the file.
Result<std::size_t> writeEncodedPng(std::span<const std::uint8_t> png, const std::filesystem::path& file);
Result<std::size_t> writePng(const Image8& image, const std::filesystem::path& file);

}  // namespace rigel::tools
