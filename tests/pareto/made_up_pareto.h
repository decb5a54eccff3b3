// Studies with known figures, for tests of what is written.
#pragma once

#include "pareto/pareto_data.h"

namespace rigel::tests {

/// Three objects: two families in two numbers of bands with near lights and every storage and form; one without light;
/// one whose name is an attack on page and terminal. `gpu`: with times of a device.
tools::Pareto madeUpPareto(bool gpu);

}  // namespace rigel::tests
