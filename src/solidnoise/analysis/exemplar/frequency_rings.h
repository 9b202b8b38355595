#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "solidnoise/analysis/exemplar/exemplar.h"
#include "solidnoise/analysis/exemplar/exemplar_channels.h"
#include "solidnoise/core/progress.h"
#include "solidnoise/core/vec.h"

namespace solidnoise {

// The power of an exemplar's channels in rings of frequencies around 0, which an eye sees as its sharpness.
// Periodic components of blocks of half a thousand samples and more tell it well, under a Hann window, whose
// leakage falls off fast, and that begins at their borders and in their middle, so that all parts count;
// while the smaller patches that spectra are fitted to, whose periodic components scatter less at each
// frequency, are off by up to a third in a ring of little power.
struct FrequencyRings {
  double width = 0.0;  // cycles per unit
  Vec<2> step{1.0};    // world units between the samples
  Vec<2> blur{0.0};    // variance of what the window spreads, cycles^2 per unit^2
  // Of each channel, in each ring up to the corners' frequency; together what the channel's is
  // (balance_rings).
  std::vector<std::vector<double>> variances;

  std::size_t count() const { return variances.front().size(); }
  // The ring of a frequency, which samples fold.
  std::size_t ring_of(Vec<2> frequency) const;
};

// Of exemplars that agree with each other, as cross_spectra() asks. Throws Cancelled.
FrequencyRings frequency_rings(std::span<const Exemplar<2>> exemplars, const ExemplarChannels& channels,
                               Progress* progress = nullptr);

}  // namespace solidnoise
