#include "cli/probe.h"

#include "expect.h"
#include "targets.h"

#include <nlohmann/json.hpp>

namespace rigel::fuzz {

void probe(std::string_view line) {
  const std::string answer = tools::answerProbe(std::string(line));
  expect(answer.find('\n') == std::string::npos, "an answer is one line: " + answer);
  const auto json = nlohmann::json::parse(answer, nullptr, false);
  expect(json.is_object() && (json.contains("sh") || json.contains("error")), "an answer is an object: " + answer);
}

}  // namespace rigel::fuzz
