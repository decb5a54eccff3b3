// The sources of the report page (page/), compiled into the program by embed.cmake.
#pragma once

#include <span>
#include <string_view>

namespace rigel::tools {

struct PageFile {
  std::string_view name;  // "style.css"
  std::string_view content;
};

/// In the order in which CMakeLists.txt lists them: scripts run in that order.
std::span<const PageFile> pageFiles() noexcept;

}  // namespace rigel::tools
