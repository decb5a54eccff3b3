// Near lights, receivers and wraps as rows of shader inputs.
#pragma once

#include <rigel/near_light.h>

#include <string>
#include <vector>

namespace rigel::test {

/// Declarations of a row's inputs, and the GLSL that makes `light` and `wrap` of them.
inline const std::vector<std::string> kNearInputs = {"vec4 light0", "vec4 light1", "vec4 light2", "vec4 light3",
                                                     "vec4 wrap0",  "vec4 wrap1",  "vec4 wrap2",  "vec4 wrap3",
                                                     "vec3 p",      "vec3 n"};
inline const std::string kNearBody =
    "GpuNearLight light = GpuNearLight(light0.xyz, light0.w, light1.xyz, int(light1.w), light2.xyz, light2.w,\n"
    "                                  light3.x, light3.y, light3.z, light3.w);\n"
    "GpuWrap wrap = GpuWrap(wrap0, wrap1.x, wrap1.y, wrap1.z, wrap1.w, wrap2, wrap3.x, wrap3.y, 0.0, 0.0);\n";

inline void append(std::vector<float>& row, const shader_types::vec3& v) { row.insert(row.end(), {v.x, v.y, v.z}); }
inline void append(std::vector<float>& row, const shader_types::vec4& v) {
  row.insert(row.end(), {v.x, v.y, v.z, v.w});
}
inline void append(std::vector<float>& row, Vec3 v) { row.insert(row.end(), {v.x, v.y, v.z}); }

inline void append(std::vector<float>& row, const GpuNearLight& light) {
  append(row, light.position);
  row.push_back(light.radius);
  append(row, light.colour);
  row.push_back(static_cast<float>(light.kind));
  append(row, light.axis);
  row.insert(row.end(), {light.inverseRange, light.cosOuter, light.inverseConeWidth, light.extent, 0});
}

inline void append(std::vector<float>& row, const GpuWrap& wrap) {
  append(row, wrap.f);
  row.insert(row.end(), {wrap.f4, wrap.a, wrap.inverse, wrap.gain});
  append(row, wrap.blurBand);
  row.insert(row.end(), {wrap.blurBand4, wrap.blur, 0, 0});
}

}  // namespace rigel::test
