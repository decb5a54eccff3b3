#include "pareto/machine.h"

#include <fmt/format.h>
#include <hwy/targets.h>

#include <fstream>
#include <thread>

namespace rigel::tools {
namespace {

/// Linux says it in a line "model name : ...".
std::string processorName() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("model name")) continue;
    const auto name = line.find_first_not_of(" \t", line.find(':') + 1);
    return name == std::string::npos ? "" : line.substr(name);
  }
  return "";
}

/// What Highway's run-time dispatch finds here.
std::string vectorName() {
  const auto targets = hwy::SupportedTargets();
  const auto widest = [&]() -> std::pair<const char*, int> {
#if HWY_ARCH_X86
    if ((targets & (HWY_AVX3 | HWY_AVX3_DL)) != 0) return {"AVX-512", 16};
    if ((targets & HWY_AVX2) != 0) return {"AVX2", 8};
    if ((targets & HWY_SSE4) != 0) return {"SSE4", 4};
    if ((targets & HWY_SSSE3) != 0) return {"SSSE3", 4};
#elif HWY_ARCH_ARM
    if ((targets & HWY_NEON) != 0) return {"NEON", 4};
#endif
    (void)targets;
    return {"no vectors", 1};
  }();
  return fmt::format("{} ({} float{})", widest.first, widest.second, widest.second == 1 ? "" : "s");
}

}  // namespace

Machine thisMachine() { return {processorName(), vectorName(), static_cast<int>(std::thread::hardware_concurrency())}; }

std::string machineText(const Machine& machine) {
  return fmt::format("{}, {}, {} hardware thread{}", machine.cpu.empty() ? "unknown processor" : machine.cpu,
                     machine.vector, machine.threads, machine.threads == 1 ? "" : "s");
}

}  // namespace rigel::tools
