// The entry shaders as SPIR-V, compiled when Rigel was built.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace rigel {

/// "object.vert", "object.frag.bands3", "object.frag.bands3.loop24" (over up to 24 monomials), ...: the words of
/// that shader, its specialisation constants still open; empty where there is none of that name.
std::span<const std::uint32_t> shaderBinary(std::string_view name) noexcept;

}  // namespace rigel
