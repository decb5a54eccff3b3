// One request of `rigel probe`: a JSON object in, a JSON object out, both as one line of text.
#pragma once

#include <string>

namespace rigel::tools {

/// Answers {"light":{"type":..},"point":[x,y,z],"normal":[x,y,z],"wrap":a,"bands":B} with
/// {"sh":..,"gradient":..,"irradiance_sh":..,"irradiance_exact":..} (the irradiances where there is a normal), or with
/// {"error":"..."} whatever is wrong. Numbers are rounded to float first. Never throws on account of the line.
std::string answerProbe(const std::string& line);

}  // namespace rigel::tools
