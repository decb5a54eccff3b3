// What each rig costs a GPU: a time for every shader that differs.
#pragma once

#include "gpu/context.h"
#include "pareto/object_pareto.h"

#include <functional>

namespace rigel::tools {

/// Fills gpuNanoseconds of `points` (ObjectPareto::report of the same object, in the posed frame) for rigs in 32 and 16
/// bits; in other bands than the compared ones, and in 16 bits, of rigs on a front alone. A rig's time without near
/// lights is measured once for all rigs that make the same shader; that of 1, 2 and 4 near lights with one rig of each
/// number of bands, and added: near lights cost what they cost whatever rig is beside them. `auto` rigs are timed as
/// they are lit. Points whose shader was not timed, and near forms that reports do not have, stay empty. `step` is
/// called before each shader, with the share done.
std::optional<Error> measureGpuTimes(const GpuContext& context, ObjectPareto& object, const LightSet& lights,
                                     std::vector<ParetoPoint>& points, const std::function<void(double)>& step);

}  // namespace rigel::tools
