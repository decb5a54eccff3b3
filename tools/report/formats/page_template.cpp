#include "report/formats/page_template.h"

#include <algorithm>
#include <cassert>

namespace rigel::tools {

std::string concatenated(std::span<const PageFile> files, std::string_view extension) {
  std::string text;
  for (const PageFile& file : files)
    if (file.name.ends_with(extension)) text += file.content;
  return text;
}

std::string fillTemplate(std::string_view text,
                         std::initializer_list<std::pair<std::string_view, std::string>> values) {
  std::string result;
  for (;;) {
    const std::size_t open = text.find("{{");
    result += text.substr(0, open);
    if (open == std::string_view::npos) return result;
    const std::size_t close = text.find("}}", open);
    const std::string_view name = text.substr(open + 2, close - open - 2);
    const auto value = std::find_if(values.begin(), values.end(), [&](const auto& v) { return v.first == name; });
    assert(value != values.end() && "the template names a part that does not exist");
    result += value->second;
    text.remove_prefix(close + 2);
  }
}

}  // namespace rigel::tools
