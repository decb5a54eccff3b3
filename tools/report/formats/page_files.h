// The sources of the program's pages, compiled into it by embed.cmake.
#pragma once

#include <span>
#include <string_view>

namespace rigel::tools {

struct PageFile {
  std::string_view name;  // "style.css"
  std::string_view content;
};

/// Of the report, and of the chart of cost and error; in the order in which CMakeLists.txt lists them: scripts run in
/// that order.
std::span<const PageFile> pageFiles() noexcept;
std::span<const PageFile> paretoPageFiles() noexcept;

/// The bundle of three.js, for pages with a 3-D view.
std::span<const PageFile> threeFiles() noexcept;

}  // namespace rigel::tools
