// report.html: the report for people, one self-contained page that opens without a network.
#pragma once

#include "report/report_data.h"

#include <nlohmann/json.hpp>

#include <string>

namespace rigel::tools {

/// The page: template, style and script of page/, the document of reportJson() and the PNG bytes of every picture as
/// data URIs. Names in the document are untrusted: no byte of them can end the data block, and the script writes them
/// as text only.
std::string reportHtml(const Report& report, const nlohmann::ordered_json& document);

/// Text of a JSON document that is safe between <script type="application/json"> and </script>.
std::string scriptSafeJson(const nlohmann::ordered_json& document);

}  // namespace rigel::tools
