// Constants that C++ and GLSL share, once and in full precision. Parsed by both languages.
#ifndef RIGEL_SHADER_CONSTANTS_H
#define RIGEL_SHADER_CONSTANTS_H

#ifdef __cplusplus
namespace rigel {
#define RIGEL_CONSTANT inline constexpr double
#else
#define RIGEL_CONSTANT const float
#endif

RIGEL_CONSTANT kRigelPi = 3.14159265358979323846;

#undef RIGEL_CONSTANT
#ifdef __cplusplus
}  // namespace rigel
#endif

#endif
