// Where a user's programs keep what they can make again.
#pragma once

#include <filesystem>
#include <string>

namespace rigel::tools {

/// rigel/NAME under XDG_CACHE_HOME, or under ~/.cache where that is not set (XDG Base Directory Specification); its
/// folder is made. "" where there is neither, or where the folder cannot be made.
std::filesystem::path userCacheFile(const std::string& name);

}  // namespace rigel::tools
