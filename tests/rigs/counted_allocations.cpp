#include "counted_allocations.h"

#include <cstddef>
#include <cstdlib>
#include <new>

namespace rigel::test {

std::atomic<long> allocations{0};
std::atomic<long> allocationsLeft{-1};

}  // namespace rigel::test

namespace {

using rigel::test::allocations, rigel::test::allocationsLeft;

void* countedAllocation(std::size_t size, std::size_t alignment) {
  ++allocations;
  if (allocationsLeft >= 0 && allocationsLeft-- == 0) throw std::bad_alloc();
  void* memory = alignment > alignof(std::max_align_t)
                     ? std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment)
                     : std::malloc(size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

// GCC inlines delete but not new, and then takes our free for a mismatch.
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"

void* operator new(std::size_t size) { return countedAllocation(size, 0); }
void* operator new[](std::size_t size) { return countedAllocation(size, 0); }
void* operator new(std::size_t size, std::align_val_t a) {
  return countedAllocation(size, static_cast<std::size_t>(a));
}
void* operator new[](std::size_t size, std::align_val_t a) {
  return countedAllocation(size, static_cast<std::size_t>(a));
}
// The library's nothrow forms would reach these, but a sanitizer's own would not.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size);
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size);
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete[](void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete[](void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }

// Eigen calls malloc itself: the linker hands those calls to us as well (--wrap=malloc).
extern "C" void* __real_malloc(std::size_t size);
extern "C" void* __wrap_malloc(std::size_t size) {
  ++allocations;
  return __real_malloc(size);
}
