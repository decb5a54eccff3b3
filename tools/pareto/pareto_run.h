// Measures everything that `rigel pareto` shows.
#pragma once

#include "gpu/context.h"
#include "pareto/pareto_data.h"

namespace rigel::tools {

struct ParetoOptions {
  RunOptions run;                      // one scene; clip, frames, wrap, lights, exposure, rate
  bool allFrames = false;              // of run.frames; else kParetoFrames of them, spread evenly
  std::vector<RigSpec> rigs;           // empty: paretoRigs()
  std::vector<int> bands{2, 3, 4, 5};  // rising
  const GpuContext* device = nullptr;  // times shaders, too
};

inline constexpr std::size_t kParetoFrames = 24;

/// Errors: scenes that cannot be used, rigs that cannot be built for an object, several clips, a device that fails.
Result<Pareto> runPareto(const ParetoOptions& options, const Progress& progress);

}  // namespace rigel::tools
