// Ctrl-C and its kin: asked for in a signal handler, answered where work can stop, so that destructors clean up.
#pragma once

#include <exception>

namespace rigel::tools {

class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

/// From now on SIGINT, SIGTERM and SIGHUP (where they are not ignored) are remembered instead of ending the program.
/// The second of a kind ends it.
void rememberInterrupts();

/// Throws Interrupted once a signal has come.
void stopIfInterrupted();

}  // namespace rigel::tools
