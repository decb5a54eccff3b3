#include <rigel/rig_spec.h>

#include "expect.h"
#include "targets.h"

namespace rigel::fuzz {

void rigSpec(std::string_view text) {
  const auto specs = parseRigSpecs(text);
  if (!specs) {
    const std::string line = specs.error().line();
    expect(line.find('\n') == std::string::npos, "an error is one line: " + line);
    return;
  }
  std::string joined;
  for (const RigSpec& spec : *specs) {
    expect(!checkRigSpec(spec), "what is parsed is within the limits: " + spec.text);
    expect(spec.shVectors() >= 1 && spec.shVectors() <= kMaxShVectors, "it has SH vectors: " + spec.text);
    const auto again = parseRigSpec(spec.text);
    expect(again && *again == spec && again->text == spec.text, "its text means the same: " + spec.text);
    joined += (joined.empty() ? "" : ";") + spec.text;
  }
  const auto again = parseRigSpecs(joined);
  expect(again && *again == *specs, "their texts mean the same: " + joined);
}

}  // namespace rigel::fuzz
