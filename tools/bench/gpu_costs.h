// What each effect costs on the GPU, at the points of a picture of a car under street lights: time beside error.
#pragma once

#include "bench/figures.h"

namespace rigel::tools {

/// Names of all GPU figures: "gpu.poly:6", "gpu.near4", ...
std::vector<std::string> gpuFigureNames();

/// Those of `names`: ms for 1280x720 points, net of a shader that reads them and writes results; instructions of the
/// specialised SPIR-V; errors of rigs. `ratio` is to the faster of the two textures of lattice:8x4x2. Repetitions are
/// interleaved. Error: no device.
Result<std::vector<Figure>> measureGpuFigures(const std::vector<std::string>& names, int repetitions);

}  // namespace rigel::tools
