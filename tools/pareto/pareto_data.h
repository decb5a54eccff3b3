// Everything that `rigel pareto` says, as plain data. Field names follow pareto.json.
#pragma once

#include "pareto/configurations.h"
#include "report/report_data.h"

#include <optional>
#include <string>
#include <vector>

namespace rigel::tools {

/// One way to light an object: what it costs and how wrong it is.
struct ParetoPoint {
  std::string spec, family, fit;
  std::string arguments;  // as typed for `rigel report`
  std::string near;       // "2", or "auto"
  std::string target;     // "--error 0.05"; "" where nothing is chosen
  NearForm form = NearForm::exact;
  int bands = 3;
  bool half = false;  // coefficients in 16 bits, which GPUs alone read

  double shVectors = 0, nearLights = 0;  // means over the frames
  int projections = 0;
  std::size_t bytes = 0;  // of the frame with most SH vectors
  ErrorFigures spatial, total;
  /// Standard error of total.rms, relative to it, for want of the frames between those looked at.
  double frameUncertainty = 0;

  // Empty: not measured, or not to be had. CPU times are of one thread.
  std::optional<double> fitMicroseconds, shadeNanoseconds;  // an object and frame; a point
  std::optional<double> gpuNanoseconds;                     // a point
  std::optional<double> modelledNanoseconds;                // a point, by CostModel
};

struct ParetoObject {
  std::string name;
  int triangles = 0, samples = 0, lights = 0;
  double meanIrradiance = 0;
  std::vector<ParetoPoint> points;
};

struct Machine {
  std::string cpu;     // as /proc/cpuinfo names it; "" where nothing does
  std::string vector;  // widest instruction set that the kernels may use: "AVX-512, 16 floats"
  int threads = 1;
};

struct Pareto {
  std::string version, commandLine;
  Machine machine;
  std::string gpu;  // "" where there is none, or none was wanted
  std::string scene, clip, lightsFrom;
  double rate = 30;         // frames a second
  std::vector<int> frames;  // numbers of those looked at
  std::vector<int> timed;   // and of those that were timed
  int repetitions = 0;      // of every time
  double seconds = 0;       // wall time
  std::vector<std::string> notes;
  std::vector<ParetoObject> objects;
};

/// Points that a frame shades of an object, where fit and shading are counted together.
inline constexpr int kShadedPoints = 10000;

}  // namespace rigel::tools
