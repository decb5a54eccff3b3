// A promise that ends the program where it is broken, with and without NDEBUG: fuzzers know crashes alone.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

namespace rigel::fuzz {

inline void expect(bool kept, const std::string& promise) {
  if (kept) return;
  std::fprintf(stderr, "broken promise: %s\n", promise.c_str());
  std::abort();
}

}  // namespace rigel::fuzz
