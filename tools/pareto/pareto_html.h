// pareto.html: the study for people, one self-contained page that opens without a network.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace rigel::tools {

/// The page: template, styles, scripts and the document of paretoJson(). Names in it are untrusted: no byte of them can
/// end the data block, and the script writes them as text only.
std::string paretoHtml(const nlohmann::ordered_json& document);

}  // namespace rigel::tools
