// Vulkan functions that fail or lie for as long as a test needs them to.
#pragma once

#include "gpu/vulkan_api.h"

#include <utility>

namespace rigel::test {

/// Puts `with` in the place of a Vulkan function; the destructor puts it back.
template <class Function>
class Replaced {
 public:
  Replaced(Function& function, Function with) : function_(function) {
    tools::loadVulkan();  // now: later it would overwrite what is put in place
    original_ = std::exchange(function, with);
  }
  ~Replaced() { function_ = original_; }
  Replaced(const Replaced&) = delete;
  Replaced& operator=(const Replaced&) = delete;

 private:
  Function& function_;
  Function original_ = nullptr;
};

}  // namespace rigel::test
