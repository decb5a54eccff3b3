// Loops over all cores for the offline tools (the runtime starts no thread of its own).
#pragma once

#include <functional>

namespace rigel::tools {

/// Calls body(i) for every i in [0, count), in any order and on several threads; returns when all are done. `body` must
/// not throw.
void parallelFor(int count, const std::function<void(int)>& body);

}  // namespace rigel::tools
