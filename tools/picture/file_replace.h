// Files that appear whole or not at all.
#pragma once

#include <rigel/result.h>

#include <filesystem>
#include <functional>

namespace rigel::tools {

/// Has `write` fill a temporary file beside `file`, then renames it over `file`; on failure (an exception of `write`
/// included) removes it. Returns the bytes written.
Result<std::size_t> replaceFile(const std::filesystem::path& file,
                                const std::function<void(const std::filesystem::path&)>& write);

}  // namespace rigel::tools
