// Bytes for the report's page, small: deflated as browsers inflate them (DecompressionStream 'deflate', zlib's format).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rigel::tools {

/// RFC 1950. At most 0.1 % and 32 bytes larger than what comes in. Throws std::bad_alloc alone.
std::vector<std::uint8_t> deflated(std::span<const std::uint8_t> bytes);

/// The same as base64.
std::string packedText(std::span<const std::uint8_t> bytes);

}  // namespace rigel::tools
