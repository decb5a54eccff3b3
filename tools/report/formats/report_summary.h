// What a report says in one table, for tickets (Markdown) and spreadsheets (CSV), made of report.json itself.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>

namespace rigel::tools {

/// A table an object, the advised rig in bold, and the sentence that advises it.
std::string reportMarkdown(const nlohmann::ordered_json& document);

/// A line a rig; numbers in report.json's units and at its precision.
std::string reportCsv(const nlohmann::ordered_json& document);

/// Text that may hold anything, in a cell of a Markdown table or a CSV line.
std::string markdownCell(std::string_view text);
std::string csvCell(std::string_view text);

}  // namespace rigel::tools
