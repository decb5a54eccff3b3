#include "report/earlier_pictures.h"

#include "expect.h"
#include "targets.h"

namespace rigel::fuzz {

void reportJson(std::string_view text) {
  for (const std::string& name : tools::picturesNamedIn(text))
    expect(!name.empty() && name.find('/') == std::string::npos && name.find('\0') == std::string::npos,
           "names stay in the folder: " + name);
}

}  // namespace rigel::fuzz
