// Base64 (RFC 4648, section 4) for bytes embedded in text.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace rigel::tools {

/// Padded, without line breaks.
std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace rigel::tools
