#include "picture/file_replace.h"

#include <unistd.h>

#include <exception>
#include <system_error>

namespace rigel::tools {

Result<std::size_t> replaceFile(const std::filesystem::path& file,
                                const std::function<void(const std::filesystem::path&)>& write) {
  // The process id keeps two programs that write the same file apart.
  std::filesystem::path aside = file;
  aside += ".part" + std::to_string(::getpid());
  std::error_code ignored;
  try {
    write(aside);
    const auto bytes = static_cast<std::size_t>(std::filesystem::file_size(aside));
    std::filesystem::rename(aside, file);
    return bytes;
  } catch (const std::filesystem::filesystem_error& e) {
    std::filesystem::remove(aside, ignored);
    return Error{"cannot write: " + e.code().message(), file.string()};
  } catch (const std::exception& e) {
    std::filesystem::remove(aside, ignored);
    return Error{std::string("cannot write: ") + e.what(), file.string()};
  }
}

}  // namespace rigel::tools
