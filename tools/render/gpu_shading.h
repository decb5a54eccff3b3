// `rigel report --device gpu`: rigs evaluated at points by the shaders that draw them.
#pragma once

#include "gpu/context.h"
#include "report/measure/rig_runner.h"

namespace rigel::tools {

/// Times are net of reading points and writing results. Shaders are made at the first points and whenever more, or
/// other wraps, come. `context` must outlive it.
std::unique_ptr<PointShading> makeGpuShading(const GpuContext& context);

}  // namespace rigel::tools
