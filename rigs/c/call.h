// What every function of the C interface does alike: it lets no exception out, answers what is wrong with a code and
// one line about it, and reads descriptions of this header's size and newer.
#pragma once

#include <rigel/rigel.h>
#include <rigel/vec3.h>

#include <cmath>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <new>
#include <stdexcept>

namespace rigel::c {

inline bool isFinite(float v) noexcept { return std::isfinite(v); }
inline bool isFinite(rigel_vec3 v) noexcept { return isFinite(v.x) && isFinite(v.y) && isFinite(v.z); }
inline bool isFinite(rigel_rgb v) noexcept { return isFinite(v.r) && isFinite(v.g) && isFinite(v.b); }

inline Vec3 toVec3(rigel_vec3 v) noexcept { return {v.x, v.y, v.z}; }
inline Rgb toRgb(rigel_rgb v) noexcept { return {v.r, v.g, v.b}; }

/// Keeps "function: what was wrong" for the thread; returns the code.
[[gnu::format(printf, 3, 4)]] rigel_result fail(const char* function, rigel_result code, const char* format,
                                                ...) noexcept;

/// One call of a function of the interface. Its checks return RIGEL_OK or an error that is noted already.
class Call {
 public:
  explicit Call(const char* function) noexcept : function_(function) {}

  template <class... Args>
  rigel_result fail(rigel_result code, const char* format, Args... args) const noexcept {
    return c::fail(function_, code, format, args...);
  }
  rigel_result value(const char* format) const noexcept { return fail(RIGEL_ERROR_VALUE, "%s", format); }

  struct Named {
    const void* pointer;
    const char* name;
  };
  rigel_result needs(std::initializer_list<Named> pointers) const noexcept {
    for (const Named& named : pointers)
      if (named.pointer == nullptr) return fail(RIGEL_ERROR_NULL, "%s is NULL", named.name);
    return RIGEL_OK;
  }

  /// An array of `count`: there, and no larger than memory.
  template <class T>
  rigel_result array(const T* items, std::size_t count, const char* name) const noexcept {
    if (count > 0 && items == nullptr) return fail(RIGEL_ERROR_NULL, "%s is NULL", name);
    if (count > kMost / sizeof(T)) return value("a count is larger than any array");
    return RIGEL_OK;
  }

  /// Into `own` what is known of a description.
  template <class T>
  rigel_result read(const T* desc, T& own) const noexcept {
    if (const rigel_result e = needs({{desc, "desc"}}); e != RIGEL_OK) return e;
    if (const rigel_result e = checkSize(desc->size, sizeof(T)); e != RIGEL_OK) return e;
    const auto* bytes = reinterpret_cast<const unsigned char*>(desc);
    for (std::size_t i = sizeof(T); i < desc->size; ++i)
      if (bytes[i] != 0)
        return fail(RIGEL_ERROR_SIZE, "desc is of a newer version and asks for more than this one has");
    std::memcpy(&own, desc, sizeof(T));
    return RIGEL_OK;
  }

  template <class T>
  rigel_result checkInfo(const T* info) const noexcept {
    if (const rigel_result e = needs({{info, "info"}}); e != RIGEL_OK) return e;
    return checkSize(info->size, sizeof(T));
  }
  /// What is known, and 0 for the rest.
  template <class T>
  static void write(T own, T* info) noexcept {
    own.size = info->size;
    std::memcpy(info, &own, sizeof(T));
    std::memset(reinterpret_cast<unsigned char*>(info) + sizeof(T), 0, own.size - sizeof(T));
  }

 private:
  static constexpr std::size_t kMost = static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());
  static constexpr std::size_t kLargestDesc = 4096;  // a `size` that was never set is likely larger

  rigel_result checkSize(std::size_t size, std::size_t own) const noexcept {
    if (size >= own && size <= kLargestDesc) return RIGEL_OK;
    return fail(RIGEL_ERROR_SIZE, "a size is %zu, not %zu", size, own);
  }

  const char* function_;
};

/// body(call), with exceptions as codes.
template <class F>
rigel_result guarded(const char* function, F&& body) noexcept {
  const Call call(function);
  try {
    return body(call);
  } catch (const std::bad_alloc&) {
    return call.fail(RIGEL_ERROR_MEMORY, "no memory");
  } catch (const std::length_error&) {
    return call.fail(RIGEL_ERROR_MEMORY, "more than any memory holds");
  } catch (...) {  // of the caller's own: nothing else here throws
    return call.fail(RIGEL_ERROR_CALLBACK, "a callback threw an exception");
  }
}

}  // namespace rigel::c
