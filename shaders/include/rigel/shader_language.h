// What lets one text be C++ and GLSL: headers named shader_*.h hold scalar functions that both languages compile, so
// that the CPU and the shader compute the same thing. GLSL knows them as rigel_x; C++ has a namespace for that, and a
// macro beside each function makes it rigel::detail::x there. They use float literals with a suffix, no implicit
// conversion, and of the built-in functions only those below.
//
// Text that is generic in Real is a template in C++, for float, double, dual numbers and SIMD lanes; GLSL takes it with
// Real = float and Bands = 5, and leaves out what nobody reads.
// It has no branch on a Real but rigel_select, and `if (rigel_all(...))` around what is left out for speed alone; and no
// built-in function but sqrt, abs, min, max and clamp. A file of such text can be compiled into another namespace, with
// other attributes, by defining RIGEL_SHADER_NAMESPACE and RIGEL_FUNCTION anew and taking its guard away.
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
#define RIGEL_INOUT(Type) Type&
#define RIGEL_ARRAY(array, count) Real* array
#define RIGEL_SHADER_NAMESPACE rigel::detail

// A generic struct, its type in use; a generic function; one that also depends on the number of bands, and its call.
#define RIGEL_STRUCT(Type) \
  template <class Real>    \
  struct Type
#define RIGEL_OF(Type) Type<Real>
#define RIGEL_GENERIC template <class Real>
#define RIGEL_GENERIC_BANDS template <int Bands, class Real>
#define RIGEL_BANDED(function) function<Bands>

#define rigel_select select
#define rigel_all all

namespace rigel::detail {

using std::abs;
using std::max;
using std::min;
using std::sqrt;
using uint = std::uint32_t;

/// As GLSL defines it, and without the branches of std::clamp.
inline float clamp(float x, float lo, float hi) noexcept { return min(max(x, lo), hi); }
template <class Real>
inline Real clamp(const Real& x, const Real& lo, const Real& hi) noexcept {
  return min(max(x, lo), hi);
}
template <class Real>
inline Real select(bool condition, const Real& yes, const Real& no) noexcept {
  return condition ? yes : no;
}
/// In all lanes, of which a number has one.
inline bool all(bool condition) noexcept { return condition; }
inline uint floatBitsToUint(float x) noexcept { return std::bit_cast<uint>(x); }
inline float uintBitsToFloat(uint bits) noexcept { return std::bit_cast<float>(bits); }

}  // namespace rigel::detail

#else

#define RIGEL_FUNCTION
#define RIGEL_NOEXCEPT
#define RIGEL_IN(Type) Type
#define RIGEL_INOUT(Type) inout Type
#define RIGEL_ARRAY(array, count) inout float array[count]

#define RIGEL_STRUCT(Type) struct Rigel##Type
#define RIGEL_OF(Type) Rigel##Type
#define RIGEL_GENERIC
#define RIGEL_GENERIC_BANDS
#define RIGEL_BANDED(function) function

float rigel_select(bool condition, float yes, float no) { return condition ? yes : no; }
bool rigel_all(bool condition) { return condition; }

#endif

#endif
