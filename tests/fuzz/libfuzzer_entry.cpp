// libFuzzer's side of a target; RIGEL_FUZZ_TARGET names it.
#include "targets.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  rigel::fuzz::RIGEL_FUZZ_TARGET({reinterpret_cast<const char*>(data), size});
  return 0;
}
