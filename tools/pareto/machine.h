// The machine that times were taken on.
#pragma once

#include "pareto/pareto_data.h"

namespace rigel::tools {

Machine thisMachine();

/// "Xeon ..., AVX-512 (16 floats), 2 threads".
std::string machineText(const Machine& machine);

}  // namespace rigel::tools
