// Dispatch of impulses' positions to the instruction sets that they were compiled for.
#include "solidnoise/noise/convolution/impulse_candidates.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solidnoise/noise/convolution/impulse_candidates_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.
#include "solidnoise/noise/convolution/impulse_candidates-inl.h"

#if HWY_ONCE
namespace solidnoise {

HWY_EXPORT(PlaceCandidates);

std::uint64_t place_candidates(const CandidateBox& box, ImpulseCandidates& candidates) {
  return HWY_DYNAMIC_DISPATCH(PlaceCandidates)(box, candidates);
}

}  // namespace solidnoise
#endif  // HWY_ONCE
