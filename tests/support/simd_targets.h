#pragma once

#include <cstdint>

#include <gtest/gtest.h>
#include <hwy/highway.h>

namespace solidnoise {

// Runs an action once with the code of each instruction set that this processor has and the library was built
// for.
template <typename Action>
void for_each_simd_target(const Action& action) {
  struct Restored {
    ~Restored() {
      hwy::SetSupportedTargetsForTest(0);
      hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    }
  } restored;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
    action(target);
  }
}

}  // namespace solidnoise
