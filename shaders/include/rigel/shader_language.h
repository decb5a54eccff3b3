// What lets one text be C++ and GLSL: headers named shader_*.h hold scalar functions that both languages compile, so
// that the CPU and the shader compute the same thing. GLSL knows them as rigel_x; C++ has a namespace for that, and a
// macro beside each function makes it rigel::detail::x there. They use float literals with a suffix, no implicit
// conversion, and of the built-in functions only those below.
#ifndef RIGEL_SHADER_LANGUAGE_H
#define RIGEL_SHADER_LANGUAGE_H

#ifdef __cplusplus

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#define RIGEL_FUNCTION inline
#define RIGEL_NOEXCEPT noexcept
#define RIGEL_IN(Type) const Type&

namespace rigel::detail {

using std::abs;
using std::max;
using std::min;
using std::sqrt;
using uint = std::uint32_t;

/// As GLSL defines it, and without the branches of std::clamp.
inline float clamp(float x, float lo, float hi) noexcept { return min(max(x, lo), hi); }
inline uint floatBitsToUint(float x) noexcept { return std::bit_cast<uint>(x); }
inline float uintBitsToFloat(uint bits) noexcept { return std::bit_cast<float>(bits); }

}  // namespace rigel::detail

#else

#define RIGEL_FUNCTION
#define RIGEL_NOEXCEPT
#define RIGEL_IN(Type) Type

#endif

#endif
