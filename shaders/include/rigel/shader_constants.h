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

// K_lm of the real orthonormal SH; the trailing comment is the closed form.
RIGEL_CONSTANT kRigelY00 = 0.28209479177387814347;  // sqrt(1/4pi)
RIGEL_CONSTANT kRigelY1 = 0.48860251190291992159;   // sqrt(3/4pi)
RIGEL_CONSTANT kRigelY20 = 0.31539156525252000603;  // sqrt(5/16pi)
RIGEL_CONSTANT kRigelY21 = 1.09254843059207907054;  // sqrt(15/4pi)
RIGEL_CONSTANT kRigelY22 = 0.54627421529603953527;  // sqrt(15/16pi)
RIGEL_CONSTANT kRigelY30 = 0.37317633259011539141;  // sqrt(7/16pi)
RIGEL_CONSTANT kRigelY31 = 0.45704579946446573616;  // sqrt(21/32pi)
RIGEL_CONSTANT kRigelY32 = 1.44530572132027702965;  // sqrt(105/16pi)
RIGEL_CONSTANT kRigelY33 = 0.59004358992664351035;  // sqrt(35/32pi)
RIGEL_CONSTANT kRigelY40 = 0.10578554691520430380;  // sqrt(9/256pi)
RIGEL_CONSTANT kRigelY41 = 0.66904654355728916799;  // sqrt(45/32pi)
RIGEL_CONSTANT kRigelY42 = 0.47308734787878000908;  // sqrt(45/64pi)
RIGEL_CONSTANT kRigelY43 = 1.77013076977993053104;  // sqrt(315/32pi)
RIGEL_CONSTANT kRigelY44 = 0.62583573544917613459;  // sqrt(315/256pi)

// Luminance of linear Rec.709.
RIGEL_CONSTANT kRigelLuminanceR = 0.2126;
RIGEL_CONSTANT kRigelLuminanceG = 0.7152;
RIGEL_CONSTANT kRigelLuminanceB = 0.0722;

// Wraps (wrap.h) outside this range are held to it.
RIGEL_CONSTANT kRigelMinWrap = -0.25;
RIGEL_CONSTANT kRigelMaxWrap = 1.0;

// What irradiance of a single light is held to, so that sums of any number of them stay finite (project.h).
RIGEL_CONSTANT kRigelMaxScale = 1e32;

// Disk lights farther away than this many radii are seen from here, at equal power. In float the fourth power of it is
// finite, and what it rounds off is 1e-12.
RIGEL_CONSTANT kRigelDiskReach = 1e6;

// Distances to a near light whose inverse float does not hold give no light.
RIGEL_CONSTANT kRigelMinReach = 1e-37;
RIGEL_CONSTANT kRigelMaxReach = 1e37;

#undef RIGEL_CONSTANT
#ifdef __cplusplus
}  // namespace rigel
#endif

#endif
