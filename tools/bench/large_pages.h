// Memory that asks the system for pages of 2 MB, as engines keep what is large and read in every frame: with pages of
// 4 KB a core looks up an address' page for every other palette.
#pragma once

#include <cstddef>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace rigel::tools {

/// An allocator; only one that is `large` asks.
template <class T>
struct LargePages {
  using value_type = T;
  static constexpr std::size_t kPage = 2 << 20;

  bool large = false;

  LargePages() = default;
  explicit LargePages(bool isLarge) noexcept : large(isLarge) {}
  template <class Other>
  LargePages(const LargePages<Other>& other) noexcept : large(other.large) {}

  T* allocate(std::size_t count) {
    if (!large) return static_cast<T*>(::operator new(count * sizeof(T), std::align_val_t(64)));
    const std::size_t bytes = (count * sizeof(T) + kPage - 1) / kPage * kPage;
    void* memory = ::operator new(bytes, std::align_val_t(kPage));
#if defined(MADV_HUGEPAGE)
    (void)madvise(memory, bytes, MADV_HUGEPAGE);  // where it is refused, pages are small
#endif
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t) noexcept {
    ::operator delete(memory, std::align_val_t(large ? kPage : std::size_t{64}));
  }
  friend bool operator==(const LargePages&, const LargePages&) = default;
};

}  // namespace rigel::tools
