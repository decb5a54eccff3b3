// What the validation layer had to say.
#pragma once

#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace rigel::tools {

/// The layer may call from any thread, and until the device is gone.
class GpuMessages {
 public:
  void add(std::string message) {
    const std::scoped_lock lock(mutex_);
    messages_.push_back(std::move(message));
  }
  /// Those since the last call.
  std::vector<std::string> take() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(messages_, {});
  }

 private:
  std::mutex mutex_;
  std::vector<std::string> messages_;
};

}  // namespace rigel::tools
