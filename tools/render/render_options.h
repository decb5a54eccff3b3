// What `rigel render` is asked to do.
#pragma once

#include "report/run/run_options.h"

#include <rigel/effects.h>

#include <filesystem>

namespace rigel::tools {

inline constexpr int kMaxPictureSide = 8192;
inline constexpr int kMaxSupersampling = 4;

/// How coefficients reach the shader.
enum class RigStorage {
  float32,    // a texel buffer of 32-bit floats
  float16,    // of 16-bit floats, scaled
  texture32,  // lattice rigs: 3-D textures, filtered by hardware
  texture16,
};

inline bool isTexture(RigStorage storage) {
  return storage == RigStorage::texture32 || storage == RigStorage::texture16;
}

enum class RenderReference { none, cpu, truth };

struct RenderOptions {
  RunOptions run;      // one scene, one rig
  std::string object;  // that the picture is framed about; "": all that move
  int width = 1280, height = 720;
  int supersampling = 2;  // pictures are drawn at that many times their size a side
  RigStorage storage = RigStorage::float32;
  bool perVertex = false;
  Effect wrappedDisk = kWrappedDisk;  // light_near_diskTable or light_near_diskQuadrature
  RenderReference against = RenderReference::none;
  std::filesystem::path shaderCache = {};  // file that keeps specialised shaders; "": none
};

/// FILE.png becomes FILE-0042.png where there are several frames.
std::filesystem::path numberedFile(const std::filesystem::path& file, int frame, bool numbered);

/// "1280x720".
Result<std::pair<int, int>> parsePictureSize(const std::string& text);

}  // namespace rigel::tools
