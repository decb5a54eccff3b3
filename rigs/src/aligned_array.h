// Memory for vectors: allocated once, aligned to a cache line.
#pragma once

#include <cstddef>
#include <memory>
#include <new>

namespace rigel {

/// `count` numbers, zero at first. Never shrinks.
template <class Number>
class AlignedArray {
 public:
  /// Makes room for `count`; what was in it is lost where it grows.
  void reserve(std::size_t count) {
    if (count <= size_) return;
    data_.reset(static_cast<Number*>(::operator new(count * sizeof(Number), kAlignment)));
    std::uninitialized_fill_n(data_.get(), count, Number(0));
    size_ = count;
  }
  Number* data() noexcept { return data_.get(); }
  const Number* data() const noexcept { return data_.get(); }
  std::size_t size() const noexcept { return size_; }
  std::size_t bytes() const noexcept { return size_ * sizeof(Number); }

 private:
  static constexpr std::align_val_t kAlignment{64};
  struct Free {
    void operator()(Number* p) const noexcept { ::operator delete(p, kAlignment); }
  };
  std::unique_ptr<Number, Free> data_;
  std::size_t size_ = 0;
};

}  // namespace rigel
