#pragma once

#include <cstddef>

#include "solidnoise/analysis/exemplar/frequency_rings.h"
#include "solidnoise/noise/gabor/gabor_spectrum.h"

namespace solidnoise {

// Scales the components of a spectrum in the plane so that each ring has a channel's power, and all of them
// together: with s_kr the share of component k in ring r, under the window that rings were seen
// through, and T_r the power that is asked for, its variance becomes
//   v_k <- v_k sum over r of s_kr T_r / M_r,   M_r = sum over k of v_k s_kr
// (Richardson 1972, Lucy 1974). A ring without a component stays empty.
void match_rings(GaborSpectrum& spectrum, const FrequencyRings& rings, std::size_t channel);

}  // namespace solidnoise
