#include <cstdarg>
#include <cstdio>

#include "call.h"

namespace rigel::c {
namespace {

constexpr std::size_t kLongestError = 256;
thread_local char lastError[kLongestError] = "";

}  // namespace

rigel_result fail(const char* function, rigel_result code, const char* format, ...) noexcept {
  const int start = std::snprintf(lastError, kLongestError, "%s: ", function);
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(lastError + start, kLongestError - static_cast<std::size_t>(start), format, arguments);
  va_end(arguments);
  return code;
}

}  // namespace rigel::c

uint32_t rigel_get_api_version(void) { return RIGEL_API_VERSION; }

const char* rigel_get_last_error(void) { return rigel::c::lastError; }

const char* rigel_get_result_name(rigel_result result) {
  switch (result) {
    case RIGEL_OK:
      return "RIGEL_OK";
    case RIGEL_ERROR_NULL:
      return "RIGEL_ERROR_NULL";
    case RIGEL_ERROR_SIZE:
      return "RIGEL_ERROR_SIZE";
    case RIGEL_ERROR_VALUE:
      return "RIGEL_ERROR_VALUE";
    case RIGEL_ERROR_ID:
      return "RIGEL_ERROR_ID";
    case RIGEL_ERROR_CAPACITY:
      return "RIGEL_ERROR_CAPACITY";
    case RIGEL_ERROR_MEMORY:
      return "RIGEL_ERROR_MEMORY";
    case RIGEL_ERROR_CALLBACK:
      return "RIGEL_ERROR_CALLBACK";
  }
  return "unknown";
}
