// Runs a test on each set of instructions that this machine has and the library was compiled for.
#pragma once

#include <hwy/targets.h>

#include <gtest/gtest.h>

#include <functional>

namespace rigel::test {

inline void onEveryTarget(const std::function<void()>& body) {
  int count = 0;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
    body();
    ++count;
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  EXPECT_GE(count, 1);
}

}  // namespace rigel::test
