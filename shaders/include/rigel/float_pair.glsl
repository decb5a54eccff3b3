// Differences without the error of their parts: pairs of floats hold what one float would round away, where C++ takes
// double. All of it is `precise`: a compiler that contracts or rearranges these sums takes their point away (in
// languages without the word, such as GLSL ES 3.00, they are only as good as plain float).
//
// T. J. Dekker, "A floating-point technique for extending the available precision", 1971; D. E. Knuth's sum of two.
#ifndef RIGEL_FLOAT_PAIR_GLSL
#define RIGEL_FLOAT_PAIR_GLSL

/// Not NaN, nor infinite. A minimum or maximum may turn NaN into a number, and `!` of a comparison may be rearranged.
bool rigel_isNumber(float x) { return abs(x) <= 1e37f; }

/// The power of two that brings x > 0 into [1, 2), exactly and without exp2. Of 0 and of what is not finite some power.
float rigel_inverseExponent(float x) {
  return intBitsToFloat(max(0x7f000000 - (floatBitsToInt(x) & 0x7f800000), 0x00800000));
}

/// (|a - b|^2 - r^2) unit^2 to 1e-13 of (r unit)^2, where it is within a quarter of that: for a light that all but
/// touches. `unit` is a power of two that brings r near 1.
float rigel_squaredGap(vec3 a, vec3 b, float r, float unit) {
  // a - b = difference + rest.
  precise vec3 difference = a - b;
  precise vec3 virtualB = difference - a;
  precise vec3 rest = ((a - (difference - virtualB)) - (b + virtualB)) * unit;
  // Squares with their rounding errors, by splitting each factor into halves of 12 bits.
  precise vec4 v = vec4(difference, r) * unit;
  precise vec4 spread = v * 4097.0f;
  precise vec4 high = spread - (spread - v);
  precise vec4 low = v - high;
  precise vec4 square = v * v;
  precise vec4 error = ((high * high - square) + 2.0f * (high * low)) + low * low;
  // x^2 + y^2 + z^2 with its rounding errors; taking r^2 from it has none, so close are they.
  precise float xy = square.x + square.y;
  precise float virtualY = xy - square.x;
  precise float errorXy = (square.x - (xy - virtualY)) + (square.y - virtualY);
  precise float xyz = xy + square.z;
  precise float virtualZ = xyz - xy;
  precise float errorXyz = (xy - (xyz - virtualZ)) + (square.z - virtualZ);
  precise vec3 crossTerms = 2.0f * (v.xyz * rest);
  precise float errors = (errorXy + errorXyz) + ((error.x + error.y) + (error.z - error.w));
  precise float rests = (crossTerms.x + crossTerms.y) + crossTerms.z;
  precise float gap = (xyz - square.w) + (errors + rests);
  return gap;
}

/// dot(a - b, c) unit, to the last bit where it is much smaller than its products; |a - b| unit and |c| near 1.
float rigel_differenceDot(vec3 a, vec3 b, vec3 c, float unit) {
  // a - b = difference + rest.
  precise vec3 difference = a - b;
  precise vec3 virtualB = difference - a;
  precise vec3 rest = ((a - (difference - virtualB)) - (b + virtualB)) * unit;
  // Products with their rounding errors.
  precise vec3 v = difference * unit;
  precise vec3 spreadV = v * 4097.0f;
  precise vec3 highV = spreadV - (spreadV - v);
  precise vec3 lowV = v - highV;
  precise vec3 spreadC = c * 4097.0f;
  precise vec3 highC = spreadC - (spreadC - c);
  precise vec3 lowC = c - highC;
  precise vec3 product = v * c;
  precise vec3 error = ((highV * highC - product) + (highV * lowC + lowV * highC)) + lowV * lowC;
  // And their sum with its own.
  precise float xy = product.x + product.y;
  precise float virtualY = xy - product.x;
  precise float errorXy = (product.x - (xy - virtualY)) + (product.y - virtualY);
  precise float xyz = xy + product.z;
  precise float virtualZ = xyz - xy;
  precise float errorXyz = (xy - (xyz - virtualZ)) + (product.z - virtualZ);
  precise vec3 rests = error + rest * c;
  precise float sum = xyz + ((errorXy + errorXyz) + ((rests.x + rests.y) + rests.z));
  return sum;
}

#endif
