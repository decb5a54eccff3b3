#include "made_up_pareto.h"

#include <fmt/format.h>

namespace rigel::tests {
namespace {

using namespace rigel::tools;

ParetoPoint point(const std::string& spec, int size, int near, int bands, bool gpu) {
  ParetoPoint p;
  p.spec = spec;
  p.family = spec.substr(0, spec.find(':'));
  p.fit = p.family == "lattice" ? "corners" : "";
  p.near = fmt::format("{}", near);
  p.bands = bands;
  p.arguments = fmt::format("--rig {} --near {} --bands {}", spec, near, bands);
  p.shVectors = size;
  p.nearLights = near;
  p.projections = 4 * size;
  p.bytes = static_cast<std::size_t>(16 * size * (3 * bands * bands + 3) / 4);
  p.spatial.rms = 0.3 / size;
  p.total.rms = p.spatial.rms / (1 + near) + 0.1 / (bands * bands);
  p.spatial.max = 7 * p.spatial.rms;
  p.total.max = 5 * p.total.rms;
  p.frameUncertainty = 0.04;
  p.fitMicroseconds = 2.0 * size + 3 * near;
  p.shadeNanoseconds = 40 + 3 * size + 20 * near;
  p.modelledNanoseconds = 42 + 1.8 * size + 21 * near;
  if (gpu) p.gpuNanoseconds = 3 + 2.0 * size + 10 * near;
  return p;
}

ParetoPoint aiming(const char* target, double error, bool gpu) {
  ParetoPoint p = point("auto", 6, 1, 3, gpu);
  p.near = "auto";
  p.target = target;
  p.arguments = fmt::format("--rig auto {} --bands 3", target);
  p.nearLights = 1.4;
  p.shVectors = 7.25;
  p.spatial.rms = p.total.rms = error;
  p.modelledNanoseconds = 3 / error;
  return p;
}

ParetoObject car(bool gpu) {
  ParetoObject object{"car", 1200, 4096, 14, 2.5, {}};
  for (const int bands : {2, 3})
    for (const int near : {0, 1, 2, 4})
      for (const int size : {4, 6, 12}) {
        object.points.push_back(point(fmt::format("poly:{}", size), size, near, bands, gpu));
        ParetoPoint lattice = point(fmt::format("lattice:{}x1x1", size), size, near, bands, gpu);
        lattice.spatial.rms *= 1.3;
        lattice.total.rms *= 1.2;
        object.points.push_back(lattice);
      }
  ParetoPoint half = object.points[24];
  half.half = true;
  half.bytes /= 2;
  half.shadeNanoseconds = half.modelledNanoseconds = std::nullopt;
  object.points.push_back(half);
  ParetoPoint cheap = object.points[26 + 6];
  cheap.form = NearForm::cheap;
  cheap.gpuNanoseconds = cheap.modelledNanoseconds = std::nullopt;
  cheap.shadeNanoseconds = 50;
  object.points.push_back(cheap);
  object.points.push_back(aiming("--error 0.05", 0.05, gpu));
  object.points.push_back(aiming("--total-error 0.02", 0.021, gpu));
  return object;
}

ParetoObject unlit() {
  ParetoObject object{"in the dark", 12, 64, 1, 0, {point("poly:4", 4, 0, 3, false), point("poly:6", 6, 0, 3, false)}};
  for (ParetoPoint& p : object.points) p.spatial = p.total = {};
  return object;
}

}  // namespace

Pareto madeUpPareto(bool gpu) {
  Pareto pareto;
  pareto.version = "0.0.0";
  pareto.commandLine = "rigel pareto sample:made-up --out out";
  pareto.machine = {"Made-up CPU", "AVX2 (8 floats)", 2};
  if (gpu) pareto.gpu = "made-up device";
  pareto.scene = "sample:made-up";
  pareto.clip = "drive";
  pareto.frames = {0, 4, 8, 12};
  pareto.timed = {0, 8};
  pareto.repetitions = 6;
  pareto.seconds = 61;
  pareto.notes = {"a note with <b>markup</b>"};
  pareto.objects = {car(gpu), unlit(), car(gpu)};
  pareto.objects.back().name = "</script><script>document.title='taken'</script>\x1b[31m";
  return pareto;
}

}  // namespace rigel::tests
