// Pages that hold all they need: a template, and what is put into it.
#pragma once

#include "report/formats/page_files.h"

#include <initializer_list>
#include <string>
#include <utility>

namespace rigel::tools {

/// All files of one kind, one after another.
std::string concatenated(std::span<const PageFile> files, std::string_view extension);

/// Copies `text`, with each {{NAME}} replaced. What is put in is not searched again: it may hold braces of its own.
std::string fillTemplate(std::string_view text, std::initializer_list<std::pair<std::string_view, std::string>> values);

}  // namespace rigel::tools
