// Which of Highway's targets the crowd's kernels are compiled for: as lights/src/disk_batch_light.h.
#pragma once

// SVE's vectors have no size at compile time, so that no array can hold them: NEON serves there. SSSE3 alone is rare.
#define RIGEL_CROWD_DISABLED_TARGETS \
  (HWY_SSSE3 | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | RIGEL_SPARED_TARGETS)
#ifndef RIGEL_SPARED_TARGETS  // what builds with sanitizers leave out
#define RIGEL_SPARED_TARGETS 0
#endif
