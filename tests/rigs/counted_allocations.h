// Replaces the global allocator of a test program by one that counts, and that fails when it is told to.
#pragma once

#include <atomic>

namespace rigel::test {

/// By `new`, and by `malloc` where the program is linked with --wrap=malloc.
extern std::atomic<long> allocations;

/// Until `new` finds no memory, once; negative: no limit.
extern std::atomic<long> allocationsLeft;

}  // namespace rigel::test
